// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/equal_records.h>
#include <perideal/base/instantiate.h>
#include <perideal/reconstruction/face_moments.h>

#include <deal.II/base/memory_consumption.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  namespace
  {
    /// A quadrature point of a face and the area vector it stands for.
    template <int dim>
    struct FacePoint
    {
      dealii::Point<dim>     point;
      dealii::Tensor<1, dim> area;
    };

    template <int dim>
    using FacePoints = std::array<FacePoint<dim>, FaceMoments<dim>::n_points>;

    const dealii::QGauss<1> &gauss()
    {
      static const dealii::QGauss<1> result(3);
      return result;
    }

    template <typename Face>
    FacePoints<2> points_on(const Face &face, const dealii::Point<2> &)
    {
      const auto    along = face->vertex(1) - face->vertex(0);
      FacePoints<2> result;
      for (unsigned int q = 0; q < 3; ++q)
        result[q] = {face->vertex(0) + gauss().point(q)[0] * along,
                     gauss().weight(q) * dealii::Point<2>(along[1], -along[0])};
      return result;
    }

    template <typename Face>
    FacePoints<3> points_on(const Face &face, const dealii::Point<3> &)
    {
      FacePoints<3> result;
      const auto    bottom = face->vertex(1) - face->vertex(0), top = face->vertex(3) - face->vertex(2);
      const auto    left = face->vertex(2) - face->vertex(0), right = face->vertex(3) - face->vertex(1);
      for (unsigned int q = 0; q < 9; ++q)
        {
          const double a = gauss().point(q % 3)[0], b = gauss().point(q / 3)[0];
          result[q].point = face->vertex(0) + (1. - b) * a * bottom + b * (left + a * top);
          result[q].area  = gauss().weight(q % 3) * gauss().weight(q / 3) *
                           cross_product_3d((1. - b) * bottom + b * top, (1. - a) * left + a * right);
        }
      return result;
    }

    /// Quadrature points of a cell's face, areas pointing out of the cell.
    template <int dim, typename Cell>
    FacePoints<dim> outward_points(const Cell &cell, const unsigned int face, const double thickness)
    {
      const auto middle = cell->center();
      auto       points = points_on(cell->face(face), middle);
      double     out    = 0;
      for (const auto &p : points)
        out += p.area * (p.point - middle);
      for (auto &p : points)
        p.area *= out > 0 ? thickness : -thickness;
      return points;
    }

    /// Whether all area vectors have the direction of the first but for rounding.
    template <int dim>
    bool is_plane(const FacePoints<dim> &points)
    {
      const auto normal = points[0].area / points[0].area.norm();
      return std::all_of(points.begin(), points.end(), [&](const FacePoint<dim> &p) {
        return (p.area - (p.area * normal) * normal).norm() < 1e-12 * p.area.norm();
      });
    }
  } // namespace

  /// Fills the list of faces and their moments.
  template <int dim>
  class FaceMoments<dim>::Builder
  {
  public:
    Builder(FaceMoments                                                   &result,
            const CellPolynomials<dim>                                    &polynomials,
            const double                                                   thickness,
            const std::function<double(const dealii::types::material_id)> &stiffness,
            const BondPredicate<dim>                                      &is_cut,
            const bool                                                     share_equal)
      : result(result)
      , graph(polynomials.graph())
      , centroid(polynomials.centroids())
      , thickness(thickness)
      , stiffness(stiffness)
      , is_cut(is_cut)
      , rounding(coordinate_rounding(centroid))
      , equal(share_equal)
    {
    }

    /// Adds the inner faces of an owned cell, those to other owned cells once; open ones are kept for later.
    void add_inner_faces(const Cell &cell, const unsigned int f)
    {
      if (!cell->face(f)->has_children())
        {
          const Cell other = cell->neighbor(f);
          if (cell->neighbor_is_coarser(f) || !other->is_locally_owned() ||
              graph.node_of(cell) < graph.node_of(other))
            add_inner(cell, f, other);
          return;
        }
      for (unsigned int s = 0; s < cell->face(f)->n_children(); ++s)
        {
          // Faces of owned cells are visited from there.
          const Cell child = cell->neighbor_child_on_subface(f, s);
          if (!child->is_locally_owned())
            add_inner(child, cell->neighbor_face_no(f), cell);
        }
    }

    /// Adds the sides of open faces that are owned.
    void add_open_faces()
    {
      for (const auto &[cell, f, nodes] : open)
        for (unsigned int side = 0; side < 2; ++side)
          if (nodes[side] < graph.n_owned())
            {
              auto points = outward_points<dim>(cell, f, thickness);
              for (auto &p : points)
                p.area *= side == 0 ? 1. : -1.;
              add(points, {{nodes[side], none}}, {{1., 0.}});
            }
    }

    /// Adds a face at the boundary.
    void add_boundary_face(const Cell &cell, const unsigned int f)
    {
      const LocalIndex node   = graph.node_of(cell);
      const auto       number = static_cast<unsigned int>(result.list.size() - result.first_at_boundary);
      const auto       points = outward_points<dim>(cell, f, thickness);
      for (const auto &p : points)
        result.points.push_back({node, number, cell->face(f)->boundary_id(), p.point, p.area});
      add(points, {{node, none}}, {{1., 0.}});
    }

  private:
    /// A face that a crack crosses, seen from the cell that has it whole.
    struct OpenFace
    {
      Cell                      cell;
      unsigned int              face;
      std::array<LocalIndex, 2> node;
    };

    void add_inner(const Cell &cell, const unsigned int f, const Cell &other)
    {
      const LocalIndex i = graph.node_of(cell), j = graph.node_of(other);
      if (is_cut && is_cut(graph.position[i], graph.position[j]))
        {
          open.push_back({cell, f, {{i, j}}});
          return;
        }
      std::array<double, 2> share = {{0.5, 0.5}};
      if (graph.material[i] != graph.material[j])
        {
          const double of_i = stiffness(graph.material[i]), of_j = stiffness(graph.material[j]);
          share = {{of_i / (of_i + of_j), of_j / (of_i + of_j)}};
        }
      add(outward_points<dim>(cell, f, thickness), {{i, j}}, share);
    }

    void add(const FacePoints<dim>           &points,
             const std::array<LocalIndex, 2> &nodes,
             const std::array<double, 2>     &share)
    {
      dealii::Point<dim> centre;
      for (const auto &p : points)
        centre += p.point / static_cast<double>(points.size());
      Shape shape{is_plane(points), share, {}, 0};
      for (unsigned int s = 0; s < 2; ++s)
        if (nodes[s] != none)
          shape.offset[s] = centre - centroid[nodes[s]];
      find_moments(points, centre, shape.is_plane);
      std::size_t  own   = EqualRecords::none;
      std::size_t &place = equal.is_looking() ? place_of_equal(points, centre, shape) : own;
      if (place == EqualRecords::none)
        {
          place       = result.kinds.size();
          shape.first = result.value.size();
          result.value.insert(result.value.end(), moments.begin(), moments.end());
          result.kinds.push_back(shape);
        }
      result.list.push_back({nodes, static_cast<std::uint32_t>(place)});
    }

    /// Sets moments to those of a face.
    void find_moments(const FacePoints<dim> &points, const dealii::Point<dim> &centre, const bool is_plane)
    {
      using M = Monomials<dim>;
      moments.clear();
      dealii::Tensor<1, dim> normal;
      if (is_plane)
        {
          normal = points[0].area / points[0].area.norm();
          for (unsigned int l = 0; l < dim; ++l)
            moments.push_back(normal[l]);
        }
      const std::size_t at = moments.size();
      moments.resize(at + (is_plane ? 1 : dim) * M::n, 0.);
      std::array<double, M::n> monomials;
      for (const auto &p : points)
        {
          M::evaluate(p.point - centre, monomials);
          if (is_plane)
            for (unsigned int m = 0; m < M::n; ++m)
              moments[at + m] += (p.area * normal) * monomials[m];
          else
            for (unsigned int l = 0; l < dim; ++l)
              for (unsigned int m = 0; m < M::n; ++m)
                moments[at + l * M::n + m] += p.area[l] * monomials[m];
        }
    }

    /// Number of a shape equal to this one with the moments found, if some was there before.
    std::size_t &
    place_of_equal(const FacePoints<dim> &points, const dealii::Point<dim> &centre, const Shape &shape)
    {
      using M     = Monomials<dim>;
      double area = 0, size = 0;
      for (const auto &p : points)
        {
          area += p.area.norm();
          size = std::max(size, 2. * p.point.distance(centre));
        }
      const double relative = 1e-14 + rounding / size;
      record.clear();
      const std::size_t n_normals = shape.is_plane ? dim : 0;
      for (std::size_t m = 0; m < n_normals; ++m)
        record.push_back({moments[m], relative});
      for (std::size_t m = n_normals; m < moments.size(); ++m)
        record.push_back({moments[m], relative * area * std::pow(size, M::degree((m - n_normals) % M::n))});
      for (unsigned int s = 0; s < 2; ++s)
        {
          record.push_back({shape.share[s], 1e-14});
          for (int d = 0; d < dim; ++d)
            record.push_back({shape.offset[s][d], rounding + 1e-14 * size});
        }
      return equal.place_of(record);
    }

    FaceMoments                                                   &result;
    const CellGraph<dim>                                          &graph;
    const std::vector<dealii::Point<dim>>                         &centroid;
    const double                                                   thickness;
    const std::function<double(const dealii::types::material_id)> &stiffness;
    const BondPredicate<dim>                                      &is_cut;
    std::vector<OpenFace>                                          open;

    /// What coordinates of equal faces differ by [m].
    double                           rounding;
    EqualRecords                     equal;
    std::vector<EqualRecords::Entry> record;
    /// Of the face that is added.
    std::vector<double> moments;
  };

  template <int dim>
  FaceMoments<dim>::FaceMoments(const Mesh<dim>                                               &mesh,
                                const CellPolynomials<dim>                                    &polynomials,
                                const std::function<double(const dealii::types::material_id)> &stiffness,
                                const BondPredicate<dim>                                      &is_cut,
                                const bool                                                     share_equal)
  {
    const CellGraph<dim> &graph = polynomials.graph();
    list.reserve(mesh.triangulation.n_active_faces());
    // In the order of the nodes, so that those of a cell's faces lie close in memory.
    std::vector<Cell> cells(graph.n_owned());
    for (const Cell &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        cells[graph.node_of(cell)] = cell;
    Builder    builder(*this, polynomials, mesh.thickness, stiffness, is_cut, share_equal);
    const auto visit = [&](const bool at_boundary, const auto &act) {
      for (const Cell &cell : cells)
        for (const unsigned int f : cell->face_indices())
          if (cell->at_boundary(f) == at_boundary)
            act(cell, f);
    };
    visit(false, [&](const Cell &cell, const unsigned int f) { builder.add_inner_faces(cell, f); });
    n_inner = list.size();
    builder.add_open_faces();
    first_at_boundary = list.size();
    visit(true, [&](const Cell &cell, const unsigned int f) { builder.add_boundary_face(cell, f); });
    list.shrink_to_fit();
    kinds.shrink_to_fit();
    value.shrink_to_fit();
  }

  template <int dim>
  std::size_t FaceMoments<dim>::memory_consumption() const
  {
    return list.size() * sizeof(Face) + kinds.size() * sizeof(Shape) +
           dealii::MemoryConsumption::memory_consumption(value) + points.size() * sizeof(BoundaryPoint<dim>);
  }

  PERIDEAL_INSTANTIATE_CLASS(FaceMoments)
} // namespace perideal
