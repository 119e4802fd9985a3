// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/reconstruction/face_gradient.h>
#include <perideal/reconstruction/linear_interpolation.h>

#include <deal.II/base/memory_consumption.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  namespace
  {
    /// A point of a face and the area vector it stands for.
    template <int dim>
    struct FacePoint
    {
      dealii::Point<dim>     point;
      dealii::Tensor<1, dim> area;
    };

    template <int dim>
    constexpr unsigned int n_face_points = dim == 2 ? 1 : 4;

    template <int dim>
    using FacePoints = std::array<FacePoint<dim>, n_face_points<dim>>;

    /// Quadrature points of a straight edge.
    template <typename Face>
    FacePoints<2> points_on(const Face &face, const dealii::Point<2> &)
    {
      const auto along = face->vertex(1) - face->vertex(0);
      return {{{face->vertex(0) + 0.5 * along, dealii::Point<2>(along[1], -along[0])}}};
    }

    /// Quadrature points of a bilinear face. (FEFaceValues takes four times as
    /// long, which would be a third of the whole set-up.)
    template <typename Face>
    FacePoints<3> points_on(const Face &face, const dealii::Point<3> &)
    {
      const double  g = 0.5 * (1. - 1. / std::sqrt(3.));
      FacePoints<3> result;
      for (unsigned int q = 0; q < 4; ++q)
        {
          const double a = q % 2 == 0 ? g : 1. - g, b = q / 2 == 0 ? g : 1. - g;
          const auto   bottom = face->vertex(1) - face->vertex(0), top = face->vertex(3) - face->vertex(2);
          const auto   left = face->vertex(2) - face->vertex(0), right = face->vertex(3) - face->vertex(1);
          result[q].point = face->vertex(0) + (1. - b) * a * bottom + b * (left + a * top);
          result[q].area  = 0.25 * cross_product_3d((1. - b) * bottom + b * top, (1. - a) * left + a * right);
        }
      return result;
    }

    /// Quadrature points of a cell's face, areas pointing out of the cell.
    template <int dim, typename Cell>
    FacePoints<dim> outward_points(const Cell               &cell,
                                   const unsigned int        face,
                                   const dealii::Point<dim> &centroid,
                                   const double              thickness)
    {
      auto   points = points_on(cell->face(face), centroid);
      double out    = 0;
      for (const auto &p : points)
        out += p.area * (p.point - centroid);
      for (auto &p : points)
        p.area *= out > 0 ? thickness : -thickness;
      return points;
    }

  } // namespace

  /// Fills the rows of a FaceGradient, face by face.
  template <int dim>
  class FaceGradient<dim>::Builder
  {
  public:
    using Cell  = typename CellGraph<dim>::Cell;
    using Nodes = std::vector<LocalIndex>;

    Builder(FaceGradient                                                  &result,
            const Mesh<dim>                                               &mesh,
            const std::vector<double>                                     &volume,
            const std::function<double(const dealii::types::material_id)> &stiffness)
      : result(result)
      , graph(result.cells)
      , mesh(mesh)
      , volume(volume)
      , stiffness(stiffness)
    {
      make_pattern();
      for (const Cell &cell : mesh.triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          visit_faces(cell, true, [&](const Cell &from, const unsigned int f, const Cell &other) {
            add_inner_face(from, f, other);
          });
      for (const Cell &cell : mesh.triangulation.active_cell_iterators())
        if (cell->is_locally_owned() && cell->at_boundary())
          for (const unsigned int f : cell->face_indices())
            if (cell->at_boundary(f))
              add_boundary_face(cell, f);
    }

  private:
    /// Calls visit(cell, face, other) for the inner faces of an owned cell, a
    /// face between different sizes as that of the finer cell.
    /// @param once leave a face to its other cell where that visits it too
    template <typename Visit>
    void visit_faces(const Cell &cell, const bool once, const Visit &visit) const
    {
      for (const unsigned int f : cell->face_indices())
        if (cell->at_boundary(f))
          continue;
        else if (cell->face(f)->has_children())
          {
            for (unsigned int s = 0; s < cell->face(f)->n_children(); ++s)
              {
                const Cell child = cell->neighbor_child_on_subface(f, s);
                if (!once || !child->is_locally_owned())
                  visit(child, cell->neighbor_face_no(f), cell);
              }
          }
        else
          {
            const Cell other = cell->neighbor(f);
            if (!once || cell->neighbor_is_coarser(f) || !other->is_locally_owned() ||
                cell->active_cell_index() < other->active_cell_index())
              visit(cell, f, other);
          }
    }

    bool differ(const Cell &a, const Cell &b) const
    {
      return graph.material[graph.node_of(a)] != graph.material[graph.node_of(b)];
    }

    static void sort(Nodes &list)
    {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }

    /// Columns of each row: the cells that touch the cell, and those that touch
    /// a neighbour of another material.
    void make_pattern()
    {
      std::vector<Nodes> columns(graph.n_owned());
      for (const Cell &cell : mesh.triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            Nodes &list = columns[graph.node_of(cell)];
            list        = graph.cells_around(cell);
            if (mesh.material_ids.size() > 1)
              visit_faces(cell, false, [&](const Cell &a, const unsigned int, const Cell &b) {
                const Nodes around = differ(a, b) ? graph.cells_around(a == cell ? b : a) : Nodes();
                list.insert(list.end(), around.begin(), around.end());
              });
            sort(list);
          }
      auto &rows = result.gradient;
      for (const Nodes &list : columns)
        rows.first.push_back(rows.first.back() + list.size());
      rows.column.reserve(rows.first.back());
      for (const Nodes &list : columns)
        rows.column.insert(rows.column.end(), list.begin(), list.end());
      rows.value.resize(rows.first.back());
    }

    void add_boundary_face(const Cell &cell, const unsigned int f)
    {
      const LocalIndex i      = graph.node_of(cell);
      const auto       points = outward_points<dim>(cell, f, graph.position[i], mesh.thickness);
      const bool       solid  = fit_one_side(cell, points);
      for (const FacePoint<dim> &p : points)
        {
          const auto &phi = interpolation.weights_at(p.point);
          result.points.push_back({i, result.n_faces, cell->face(f)->boundary_id(), p.point, p.area});
          auto &rows = result.at_boundary;
          rows.column.insert(rows.column.end(), stencil.begin(), stencil.end());
          rows.value.insert(rows.value.end(), phi.begin(), phi.end());
          rows.first.push_back(rows.column.size());
          add_to_row(i, p.area, phi, 1.);
        }
      ++result.n_faces;
      result.is_deficient[i] = result.is_deficient[i] || !solid;
    }

    /// @param f face of @p cell, which is not the coarser one
    void add_inner_face(const Cell &cell, const unsigned int f, const Cell &other)
    {
      const LocalIndex i = graph.node_of(cell), j = graph.node_of(other);
      const auto       points = outward_points<dim>(cell, f, graph.position[i], mesh.thickness);
      if (differ(cell, other) && fit_one_side(cell, points) && fit_one_side(other, points))
        {
          const double of_i = stiffness(graph.material[i]), of_j = stiffness(graph.material[j]);
          add_inner_points(points, i, j, of_j / (of_i + of_j));
          fit_one_side(cell, points);
          add_inner_points(points, i, j, of_i / (of_i + of_j));
          return;
        }
      const bool solid = fit_both_sides(cell, f, i, j, points);
      add_inner_points(points, i, j, 1.);
      for (const LocalIndex node : {i, j})
        if (node < graph.n_owned() && !solid)
          result.is_deficient[node] = true;
    }

    void add_inner_points(const FacePoints<dim> &points,
                          const LocalIndex       i,
                          const LocalIndex       j,
                          const double           share)
    {
      for (const FacePoint<dim> &p : points)
        {
          const auto &phi = interpolation.weights_at(p.point);
          add_to_row(i, p.area, phi, share);
          add_to_row(j, p.area, phi, -share);
        }
    }

    /// Interpolates from the cell and its vertex neighbours of its own material.
    bool fit_one_side(const Cell &cell, const FacePoints<dim> &points)
    {
      stencil = graph.cells_around(cell);
      keep_material(graph.material[graph.node_of(cell)]);
      return fit(points, LinearInterpolation<dim>::Decay::at_rim, {});
    }

    /// Interpolates from the cells that share a vertex with the face, of its
    /// material if they suffice.
    bool fit_both_sides(const Cell            &cell,
                        const unsigned int     f,
                        const LocalIndex       i,
                        const LocalIndex       j,
                        const FacePoints<dim> &points)
    {
      const auto fit_to_cells_at_face = [&](const bool of_one_material) {
        stencil = {i, j};
        for (const unsigned int v : cell->face(f)->vertex_indices())
          graph.add_cells_at(cell->face(f)->vertex_index(v), stencil);
        sort(stencil);
        if (of_one_material)
          keep_material(graph.material[i]);
        std::vector<unsigned int> favoured;
        for (unsigned int k = 0; k < stencil.size(); ++k)
          if (stencil[k] == i || stencil[k] == j)
            favoured.push_back(k);
        return fit(points, LinearInterpolation<dim>::Decay::between, favoured);
      };
      if (mesh.material_ids.size() > 1 && graph.material[i] == graph.material[j] &&
          fit_to_cells_at_face(true))
        return true;
      return fit_to_cells_at_face(false);
    }

    void keep_material(const dealii::types::material_id material)
    {
      stencil.erase(std::remove_if(stencil.begin(),
                                   stencil.end(),
                                   [&](const LocalIndex k) { return graph.material[k] != material; }),
                    stencil.end());
    }

    bool fit(const FacePoints<dim>                         &points,
             const typename LinearInterpolation<dim>::Decay decay,
             const std::vector<unsigned int>               &favoured)
    {
      dealii::Point<dim> centre;
      for (const FacePoint<dim> &p : points)
        centre += p.point / static_cast<double>(points.size());
      stencil_points.clear();
      for (const LocalIndex k : stencil)
        stencil_points.push_back(graph.position[k]);
      return interpolation.reinit(centre, stencil_points, decay, favoured);
    }

    /// Adds share phi (x) area/volume to the row of a node, if that is of this rank.
    void add_to_row(const LocalIndex              node,
                    const dealii::Tensor<1, dim> &area,
                    const std::vector<double>    &phi,
                    const double                  share)
    {
      if (node >= graph.n_owned())
        return;
      auto      &rows = result.gradient;
      const auto of   = share / volume[node] * area;
      // Both lists ascend, and the row's has all of the stencil's.
      BondIndex at = rows.first[node];
      for (std::size_t k = 0; k < stencil.size(); ++k)
        {
          while (rows.column[at] != stencil[k])
            ++at;
          AssertIndexRange(at, rows.first[node + 1]);
          rows.value[at] += phi[k] * of;
        }
    }

    FaceGradient                                                  &result;
    const CellGraph<dim>                                          &graph;
    const Mesh<dim>                                               &mesh;
    const std::vector<double>                                     &volume;
    const std::function<double(const dealii::types::material_id)> &stiffness;
    LinearInterpolation<dim>                                       interpolation;
    /// The cells of the last fit.
    Nodes                           stencil;
    std::vector<dealii::Point<dim>> stencil_points;
  };

  template <int dim>
  FaceGradient<dim>::FaceGradient(const Mesh<dim>                                               &mesh,
                                  const Nodes<dim>                                              &nodes,
                                  const std::function<double(const dealii::types::material_id)> &stiffness)
    : cells(mesh, nodes)
    , is_deficient(nodes.size(), false)
  {
    Builder(*this, mesh, nodes.volume, stiffness);
  }

  template <int dim>
  std::size_t FaceGradient<dim>::memory_consumption() const
  {
    using dealii::MemoryConsumption::memory_consumption;
    return memory_consumption(gradient.first) + memory_consumption(gradient.column) +
           memory_consumption(gradient.value) + memory_consumption(at_boundary.first) +
           memory_consumption(at_boundary.column) + memory_consumption(at_boundary.value) +
           points.size() * sizeof(points[0]) + cells.memory_consumption();
  }

  PERIDEAL_INSTANTIATE_CLASS(FaceGradient)
} // namespace perideal
