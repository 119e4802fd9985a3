// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/work_progress.h>
#include <perideal/reconstruction/cell_polynomials.h>
#include <perideal/reconstruction/quadratic_fit.h>

#include <deal.II/base/memory_consumption.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/utilities.h>
#include <deal.II/fe/fe_q.h>

#include <algorithm>
#include <map>

namespace perideal
{
  namespace
  {
    /// Measure, centroid and second moment of (bi-, tri-)linear cells: three points in each direction
    /// integrate all of them exactly.
    template <int dim>
    class CellIntegrals
    {
    public:
      CellIntegrals()
        : quadrature(3)
      {
        const dealii::FE_Q<dim> shape(1);
        for (const auto &point : quadrature.get_points())
          {
            std::array<double, n_vertices>                 value;
            std::array<dealii::Tensor<1, dim>, n_vertices> gradient;
            for (unsigned int v = 0; v < n_vertices; ++v)
              {
                value[v]    = shape.shape_value(v, point);
                gradient[v] = shape.shape_grad(v, point);
              }
            values.push_back(value);
            gradients.push_back(gradient);
          }
      }

      template <typename Cell>
      void integrate(const Cell                      &cell,
                     dealii::Point<dim>              &centroid,
                     dealii::SymmetricTensor<2, dim> &second_moment) const
      {
        std::array<dealii::Tensor<1, dim>, n_vertices> vertex;
        for (unsigned int v = 0; v < n_vertices; ++v)
          vertex[v] = cell->vertex(v) - cell->vertex(0);
        double                          measure = 0;
        dealii::Tensor<1, dim>          first;
        dealii::SymmetricTensor<2, dim> second;
        for (unsigned int q = 0; q < values.size(); ++q)
          {
            dealii::Tensor<1, dim> x;
            dealii::Tensor<2, dim> jacobian;
            for (unsigned int v = 0; v < n_vertices; ++v)
              {
                x += values[q][v] * vertex[v];
                jacobian += outer_product(vertex[v], gradients[q][v]);
              }
            const double part = determinant(jacobian) * quadrature.weight(q);
            measure += part;
            first += part * x;
            second += part * symmetrize(outer_product(x, x));
          }
        first /= measure;
        centroid      = cell->vertex(0) + first;
        second_moment = second / measure - symmetrize(outer_product(first, first));
      }

    private:
      static constexpr unsigned int n_vertices = 1u << dim;

      dealii::QGauss<dim>                                         quadrature;
      std::vector<std::array<double, n_vertices>>                 values;
      std::vector<std::array<dealii::Tensor<1, dim>, n_vertices>> gradients;
    };
  } // namespace

  /// Fills the rows of CellPolynomials, cell by cell.
  template <int dim>
  class CellPolynomials<dim>::Builder
  {
  public:
    using Cell    = typename CellGraph<dim>::Cell;
    using Stencil = std::vector<LocalIndex>;

    Builder(CellPolynomials &result, const Stiffness &stiffness, const BondPredicate<dim> &is_cut)
      : result(result)
      , graph(result.cells)
      , stiffness(stiffness)
      , is_cut(is_cut)
    {
    }

    /// Takes the cells of this rank in the order of their nodes.
    void add(const Cell &cell)
    {
      node            = graph.node_of(cell);
      Stencil stencil = near(cell);
      fit_to(stencil);
      if (!fit.is_complete())
        complete(cell, stencil);
      result.is_deficient[node] = !fit.is_solid();
      result.n_incomplete_cells += !fit.is_complete();
      for (const LocalIndex k : stencil)
        if (k != node)
          result.column.push_back(k);
      result.coefficient.insert(result.coefficient.end(), fit.rows().begin(), fit.rows().end());
      result.row.push_back(result.column.size());
    }

  private:
    /// Takes one ring more where that helps, and closes what is left out.
    void complete(const Cell &cell, Stencil &stencil)
    {
      // A wider stencil of a thin body sees how it is curved and no more.
      const auto surfaces = ends(cell);
      if (!stiffness || !fit.is_solid() || !fit.misses_only_across(surfaces))
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
    Stencil near(const Cell &cell) const
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

    Stencil with_ring(const Cell &cell, const Stencil &stencil) const
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
    void clean(Stencil &stencil) const
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
    }

    dealii::SymmetricTensor<2, dim> moment_of_unknown(const LocalIndex k) const
    {
      return result.unknown == CellUnknown::mean ? result.moments[k] : dealii::SymmetricTensor<2, dim>();
    }

    /// Of the weights of fits. Nearly even ones lengthen the stable step by 5 % (distorted squares) to 15 %
    /// (cubes), while the speed of surface waves stays as it is. A fourth layer of cells at surfaces would
    /// lengthen it by a further 20 % and treble the error of that speed at 12 cells a wave.
    double decay() const { return result.unknown == CellUnknown::value ? 0.1 : 0.5; }

    void fit_to(const Stencil &stencil)
    {
      others.clear();
      for (const LocalIndex k : stencil)
        if (k != node)
          others.push_back({result.centroid[k] - result.centroid[node], moment_of_unknown(k)});
      fit.reinit(moment_of_unknown(node), others, result.moments[node], decay());
    }

    CellPolynomials                              &result;
    const CellGraph<dim>                         &graph;
    const Stiffness                              &stiffness;
    const BondPredicate<dim>                     &is_cut;
    LocalIndex                                    node = 0;
    QuadraticFit<dim>                             fit;
    std::vector<typename QuadraticFit<dim>::Cell> others;

    std::map<dealii::types::material_id, dealii::SymmetricTensor<4, dim>> stiffness_of;
  };

  template <int dim>
  CellPolynomials<dim>::CellPolynomials(const Mesh<dim>          &mesh,
                                        const Nodes<dim>         &nodes,
                                        const Stiffness          &stiffness,
                                        const BondPredicate<dim> &is_cut,
                                        const CellUnknown         unknown)
    : cells(mesh, nodes, GhostLayers::two)
    , unknown(unknown)
    , moments(nodes.size())
    , centroid(nodes.size())
    , volume(nodes.volume)
    , is_deficient(nodes.size(), false)
  {
    const CellIntegrals<dim>                   integrals;
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
    // What regular meshes take.
    const std::size_t n_entries =
      (dealii::Utilities::pow(3, dim) - 1) * static_cast<std::size_t>(nodes.size());
    row.reserve(nodes.size() + 1);
    column.reserve(n_entries);
    coefficient.reserve(n_entries);
    Builder      builder(*this, stiffness, is_cut);
    WorkProgress progress("fitting polynomials", cell_of_node.size());
    for (LocalIndex i = 0; i < cell_of_node.size(); ++i)
      {
        progress(i);
        builder.add(cell_of_node[i]);
      }
    cells.forget_layers();
  }

  template <int dim>
  std::size_t CellPolynomials<dim>::memory_consumption() const
  {
    using dealii::MemoryConsumption::memory_consumption;
    return memory_consumption(row) + memory_consumption(column) + coefficient.size() * sizeof(Terms) +
           moments.size() * sizeof(moments[0]) + memory_consumption(centroid) + memory_consumption(volume) +
           cells.memory_consumption() + closures.memory_consumption();
  }

  PERIDEAL_INSTANTIATE_CLASS(CellPolynomials)
} // namespace perideal
