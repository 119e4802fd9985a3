// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/equal_records.h>
#include <perideal/base/instantiate.h>
#include <perideal/base/work_progress.h>
#include <perideal/reconstruction/cell_moments.h>
#include <perideal/reconstruction/cell_polynomials.h>
#include <perideal/reconstruction/quadratic_fit.h>

#include <deal.II/base/memory_consumption.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <map>

namespace perideal
{
  /// Fills the rows of CellPolynomials, cell by cell.
  template <int dim>
  class CellPolynomials<dim>::Builder
  {
  public:
    using Cell    = typename CellGraph<dim>::Cell;
    using Stencil = std::vector<LocalIndex>;

    Builder(CellPolynomials          &result,
            const Stiffness          &stiffness,
            const BondPredicate<dim> &is_cut,
            const bool                share_equal)
      : result(result)
      , graph(result.cells)
      , volume(graph.with_ghosts(result.volume))
      , stiffness(stiffness)
      , is_cut(is_cut)
      , rounding(coordinate_rounding(result.centroid))
      , equal(share_equal)
    {
    }

    /// Takes the cells of this rank in the order of their nodes.
    void add(const Cell &cell)
    {
      node            = graph.node_of(cell);
      Stencil stencil = near(cell);
      collect(stencil);
      std::size_t *const place = equal.is_looking() ? &place_of_equal() : nullptr;
      if (place != nullptr && *place != EqualRecords::none)
        result.row_of.push_back(*place);
      else
        {
          result.row_of.push_back(result.coefficient.size());
          fit_to(stencil);
          if (!fit.is_complete())
            complete(cell, stencil);
          else if (place != nullptr)
            *place = result.row_of.back();
          result.is_deficient[node] = !fit.is_solid();
          result.n_incomplete_cells += !fit.is_complete();
          result.coefficient.insert(result.coefficient.end(), fit.rows().begin(), fit.rows().end());
        }
      for (const LocalIndex k : stencil)
        if (k != node)
          result.column.push_back(k);
      result.row.push_back(result.column.size());
    }

  private:
    /// Where the coefficients of complete stencils equal to that collected begin, if one was there before.
    std::size_t &place_of_equal()
    {
      const double size = std::pow(result.volume[node], 1. / dim), of_length = rounding + 1e-14 * size;
      record.clear();
      const auto add_moment = [&](const dealii::SymmetricTensor<2, dim> &moment) {
        for (unsigned int e = 0; e < moment.n_independent_components; ++e)
          record.push_back({moment.access_raw_entry(e), 4. * of_length * size});
      };
      add_moment(result.moments[node]);
      for (const auto &other : others)
        {
          for (int d = 0; d < dim; ++d)
            record.push_back({other.distance[d], of_length});
          if (result.unknown == CellUnknown::mean)
            add_moment(other.second_moment);
          else
            record.push_back({other.share, 4. * dim * of_length / size});
        }
      std::size_t &result_of = equal.place_of(record);
      if (!equal.is_looking())
        result.coefficient.reserve(result.column.capacity());
      return result_of;
    }

    /// Takes one ring more where that helps, and closes what is left out.
    void complete(const Cell &cell, Stencil &stencil)
    {
      // A wider stencil of a thin body sees how it is curved and no more.
      const auto surfaces = ends(cell);
      if (!fit.is_solid() || !fit.misses_only_across(surfaces))
        {
          const unsigned int n_determined = fit.n_determined();
          const Stencil      wider        = with_ring(cell, stencil);
          fit_to(wider);
          if (fit.n_determined() > n_determined)
            stencil = wider;
          else
            fit_to(stencil);
        }
      if (stiffness && fit.is_solid() && !fit.is_complete())
        result.closures.add(
          node, fit.undetermined(), fit.squares_across(surfaces), result.moments[node], stiffness_here());
    }

    /// The cells around a cell, and around those behind it.
    Stencil near(const Cell &cell)
    {
      Stencil stencil = graph.nodes_around(graph.node_of(cell));
      for (const unsigned int f : cell->face_indices())
        if (ends_at(cell, f))
          visit_beyond(cell, dealii::GeometryInfo<dim>::opposite_face[f], [&](const Cell &behind) {
            const Stencil &more = graph.nodes_around(graph.node_of(behind));
            stencil.insert(stencil.end(), more.begin(), more.end());
          });
      clean(stencil);
      return stencil;
    }

    /// Whether the body or its material ends at a face of the cell, or a crack is there.
    bool ends_at(const Cell &cell, const unsigned int f) const
    {
      bool result = cell->at_boundary(f);
      visit_beyond(cell, f, [&](const Cell &other) { result = result || !is_alike(graph.node_of(other)); });
      return result;
    }

    /// Area vectors of the faces of the cell where the body or its material ends.
    std::vector<dealii::Tensor<1, dim>> ends(const Cell &cell) const
    {
      std::vector<dealii::Tensor<1, dim>> areas;
      for (const unsigned int f : cell->face_indices())
        if (ends_at(cell, f))
          {
            const auto &face = cell->face(f);
            if constexpr (dim == 2)
              areas.push_back(dealii::cross_product_2d(face->vertex(1) - face->vertex(0)));
            else
              areas.push_back(0.5 * dealii::cross_product_3d(face->vertex(3) - face->vertex(0),
                                                             face->vertex(2) - face->vertex(1)));
          }
      return areas;
    }

    const dealii::SymmetricTensor<4, dim> &stiffness_here()
    {
      const auto id       = graph.material[node];
      const auto existing = stiffness_of.find(id);
      return existing != stiffness_of.end() ? existing->second :
                                              stiffness_of.emplace(id, stiffness(id)).first->second;
    }

    template <typename Visit>
    static void visit_beyond(const Cell &cell, const unsigned int f, const Visit &visit)
    {
      if (cell->at_boundary(f))
        return;
      if (cell->face(f)->has_children())
        for (unsigned int s = 0; s < cell->face(f)->n_children(); ++s)
          visit(Cell(cell->neighbor_child_on_subface(f, s)));
      else
        visit(Cell(cell->neighbor(f)));
    }

    Stencil with_ring(const Cell &cell, const Stencil &stencil)
    {
      Stencil wider = stencil;
      for (const LocalIndex k : graph.nodes_around(graph.node_of(cell)))
        if (is_alike(k))
          {
            const Stencil &more = graph.nodes_around(k);
            wider.insert(wider.end(), more.begin(), more.end());
          }
      clean(wider);
      return wider;
    }

    /// Whether a cell is of the same material, on the same side of all cracks.
    bool is_alike(const LocalIndex k) const
    {
      return graph.material[k] == graph.material[node] &&
             !(is_cut && k != node && is_cut(graph.position[node], graph.position[k]));
    }

    /// Sorts a stencil and keeps what is like its cell.
    void clean(Stencil &stencil)
    {
      stencil.erase(
        std::remove_if(stencil.begin(), stencil.end(), [&](const LocalIndex k) { return !is_alike(k); }),
        stencil.end());
      // In the order of all ranks, so that sums do not depend on their number.
      const auto before = [&](const LocalIndex a, const LocalIndex b) {
        return graph.global_number(a) < graph.global_number(b);
      };
      if (!std::is_sorted(stencil.begin(), stencil.end(), before))
        std::sort(stencil.begin(), stencil.end(), before);
      stencil.erase(std::unique(stencil.begin(), stencil.end()), stencil.end());
      if (equal.is_looking())
        sort_by_place(stencil);
    }

    /// Sorts a stencil by where its cells lie, so that those of equal cells are in the same order.
    void sort_by_place(Stencil &stencil)
    {
      // No regular mesh has centroids in the middle between two such lines.
      const double lines = 161.803398875 / std::pow(result.volume[node], 1. / dim);
      by_place.clear();
      for (const LocalIndex k : stencil)
        {
          std::array<double, dim> line;
          for (int d = 0; d < dim; ++d)
            line[dim - 1 - d] = std::round(lines * (result.centroid[k][d] - result.centroid[node][d]));
          by_place.emplace_back(line, k);
        }
      std::stable_sort(
        by_place.begin(), by_place.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
      std::transform(
        by_place.begin(), by_place.end(), stencil.begin(), [](const auto &entry) { return entry.second; });
    }

    dealii::SymmetricTensor<2, dim> moment_of_unknown(const LocalIndex k) const
    {
      return result.unknown == CellUnknown::mean ? result.moments[k] : dealii::SymmetricTensor<2, dim>();
    }

    /// Of the weights of fits. Nearly even ones lengthen the stable step by 5 % (distorted squares) to 15 %
    /// (cubes), while the speed of surface waves stays as it is. A fourth layer of cells at surfaces would
    /// lengthen it by a further 20 % and treble the error of that speed at 12 cells a wave.
    double decay() const { return result.unknown == CellUnknown::value ? 0.1 : 0.5; }

    /// In motion cells smaller than that in the middle weigh by the square of the ratio of volumes. Else the
    /// energy of a large cell would be that of a few light nodes on one side of it, which in strips and
    /// plates two cells thick shortens the stable step to .65 and .5; what only they know of it is left out.
    /// With weights by the ratio itself, strips would keep a step of .83. Means are fitted to all cells
    /// alike: with such weights a plate with a hole takes 6,369 cells instead of 5,004 where it is adapted to
    /// an error.
    double share_of(const LocalIndex k) const
    {
      const double ratio = volume[k] / volume[node];
      return result.unknown == CellUnknown::mean ? 1. : std::min(1., ratio * ratio);
    }

    void collect(const Stencil &stencil)
    {
      others.clear();
      for (const LocalIndex k : stencil)
        if (k != node)
          others.push_back({result.centroid[k] - result.centroid[node], moment_of_unknown(k), share_of(k)});
    }

    void fit_to(const Stencil &stencil)
    {
      collect(stencil);
      fit.reinit(moment_of_unknown(node), others, result.moments[node], decay());
    }

    CellPolynomials      &result;
    const CellGraph<dim> &graph;
    /// Of cells, those of other ranks included [m^3].
    std::vector<double>                           volume;
    const Stiffness                              &stiffness;
    const BondPredicate<dim>                     &is_cut;
    LocalIndex                                    node = 0;
    QuadraticFit<dim>                             fit;
    std::vector<typename QuadraticFit<dim>::Cell> others;

    /// What coordinates of equal stencils differ by [m].
    double                                                      rounding;
    EqualRecords                                                equal;
    std::vector<EqualRecords::Entry>                            record;
    std::vector<std::pair<std::array<double, dim>, LocalIndex>> by_place;

    std::map<dealii::types::material_id, dealii::SymmetricTensor<4, dim>> stiffness_of;
  };

  template <int dim>
  CellPolynomials<dim>::CellPolynomials(const Mesh<dim>          &mesh,
                                        const Nodes<dim>         &nodes,
                                        const Stiffness          &stiffness,
                                        const BondPredicate<dim> &is_cut,
                                        const CellUnknown         unknown,
                                        const bool                share_equal)
    : cells(mesh, nodes, GhostLayers::two)
    , unknown(unknown)
    , moments(nodes.size())
    , centroid(nodes.size())
    , volume(nodes.volume)
    , is_deficient(nodes.size(), false)
  {
    const CellMoments<dim>                     integrals;
    std::vector<typename CellGraph<dim>::Cell> cell_of_node(nodes.size());
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const LocalIndex i = cells.node_of(cell);
          cell_of_node[i]    = cell;
          integrals.integrate(cell, centroid[i], moments[i]);
        }
    centroid = cells.with_ghosts(centroid);
    moments  = cells.with_ghosts(moments);
    row.reserve(nodes.size() + 1);
    row_of.reserve(nodes.size());
    // What regular meshes take.
    column.reserve((dealii::Utilities::pow(3, dim) - 1) * static_cast<std::size_t>(nodes.size()));
    Builder      builder(*this, stiffness, is_cut, share_equal);
    WorkProgress progress("fitting polynomials", cell_of_node.size());
    for (LocalIndex i = 0; i < cell_of_node.size(); ++i)
      {
        progress(i);
        builder.add(cell_of_node[i]);
      }
    coefficient.shrink_to_fit();
    cells.forget_neighbours();
  }

  template <int dim>
  std::size_t CellPolynomials<dim>::memory_consumption() const
  {
    using dealii::MemoryConsumption::memory_consumption;
    return memory_consumption(row) + memory_consumption(row_of) + memory_consumption(column) +
           coefficient.size() * sizeof(Terms) + moments.size() * sizeof(moments[0]) +
           memory_consumption(centroid) + memory_consumption(volume) + cells.memory_consumption() +
           closures.memory_consumption();
  }

  PERIDEAL_INSTANTIATE_CLASS(CellPolynomials)
} // namespace perideal
