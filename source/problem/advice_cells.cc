// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/text.h>
#include <perideal/output/summary.h>
#include <perideal/problem/advice.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

// What families make of parts that are few cells thick, and of irregular cells.

namespace perideal
{
  namespace
  {
    template <int dim>
    using Cell = typename dealii::Triangulation<dim>::active_cell_iterator;

    /// Beyond that many cells parts are thick.
    constexpr unsigned int thick = 12;

    /// Number of cells from a cell to the boundary through a face and the opposite faces behind it, the cell
    /// itself left out; `thick` where other ranks know.
    template <int dim>
    unsigned int cells_behind(Cell<dim> cell, unsigned int face)
    {
      unsigned int n = 0;
      while (n < thick && !cell->at_boundary(face))
        {
          Cell<dim>    next;
          unsigned int back;
          if (cell->face(face)->has_children())
            {
              next = cell->neighbor_child_on_subface(face, 0);
              back = cell->neighbor_face_no(face);
            }
          else
            {
              next = cell->neighbor(face);
              back = cell->neighbor_is_coarser(face) ? cell->neighbor_of_coarser_neighbor(face).first :
                                                       cell->neighbor_of_neighbor(face);
            }
          if (next->is_artificial())
            return thick;
          cell = next;
          face = back ^ 1u;
          ++n;
        }
      return n;
    }

    /// The thickness in cells that no more than a twentieth of the cells fall short of. Collective.
    template <int dim>
    unsigned int layers_across(const Mesh<dim> &mesh)
    {
      std::vector<double> n_cells(thick + 1, 0.);
      for (const auto &cell : mesh.triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            unsigned int n = thick;
            for (unsigned int axis = 0; axis < dim; ++axis)
              n = std::min(n, 1 + cells_behind<dim>(cell, 2 * axis) + cells_behind<dim>(cell, 2 * axis + 1));
            n_cells[n] += 1.;
          }
      dealii::Utilities::MPI::sum(n_cells, mesh.triangulation.get_communicator(), n_cells);
      const double n_all = mesh.triangulation.n_global_active_cells();
      double       sum   = 0;
      for (unsigned int n = 1; n < thick; ++n)
        if ((sum += n_cells[n]) > 0.05 * n_all)
          return n;
      return thick;
    }

    /// Root mean square of half the second difference of cell volumes along the lines of cells, over the
    /// volume: 0 of boxes, graded or skewed; about 1.2 to 1.5 d where vertices were moved by a share d of an
    /// edge. Collective.
    template <int dim>
    double irregularity(const Mesh<dim> &mesh)
    {
      double sum = 0, n = 0;
      for (const auto &cell : mesh.triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          for (unsigned int axis = 0; axis < dim; ++axis)
            {
              const auto is_alike = [&](const unsigned int f) {
                return !cell->at_boundary(f) && !cell->face(f)->has_children() &&
                       !cell->neighbor_is_coarser(f);
              };
              if (!is_alike(2 * axis) || !is_alike(2 * axis + 1))
                continue;
              const double difference =
                0.5 * (cell->neighbor(2 * axis)->measure() + cell->neighbor(2 * axis + 1)->measure()) /
                  cell->measure() -
                1.;
              sum += difference * difference;
              n += 1.;
            }
      const MPI_Comm communicator = mesh.triangulation.get_communicator();
      n                           = dealii::Utilities::MPI::sum(n, communicator);
      return n > 0 ? std::sqrt(dealii::Utilities::MPI::sum(sum, communicator) / n) : 0.;
    }
    /// What a kind of families made of slender parts, against finite elements; horizons of 3.01.
    struct Measured
    {
      /// Error of a cantilever ten times as long as thick is this by n^1.5 for n layers, in 2-D and 3-D:
      /// 2 to 12 and 2 to 6 layers, square and long cells.
      std::array<double, 2> bending;
      /// Whether it is too stiff by so much, rather than off by it.
      bool is_stiff;
      /// Errors of such bars of 4 and 8 layers, pulled along, whose vertices were moved by a tenth of an
      /// edge.
      std::string pulled;
    };

    /// Null where families were not measured, or are not what strains come from.
    template <int dim>
    std::optional<Measured> measured(const Problem<dim> &problem)
    {
      const ModelParameters &model = problem.parameters.model;
      if (model.is_consistent() || model.is_tensor_involved() || model.compensates() ||
          problem.parameters.quadrature.has_gauss_points() || problem.loading.tractions->complete_families())
        return {};
      if (model.is_correspondence())
        return Measured{{{24., 24.}}, true, "4 to 8 %"};
      if (!model.model->corrects_surfaces)
        return Measured{{{4.3, 7.}}, false, "25 to 90 %"};
      if (model.form_traits().is_made_for_each_family)
        return Measured{{{1.5, 1.7}}, false, "7 to 47 %"};
      return Measured{{{2.6, 3.9}}, false, "9 to 52 %"};
    }

    std::string advice_of_layers()
    {
      return ": take more cells across, or Material/Form = consistent in statics, which bends three right";
    }
  } // namespace

  template <int dim>
  void warn_of_few_cells(const Problem<dim> &problem, std::vector<std::string> &result)
  {
    const auto of_families = measured(problem);
    if (!of_families)
      return;
    const unsigned int n_layers = layers_across(*problem.body.mesh);
    if (n_layers == thick)
      return;
    const std::string parts = std::to_string(n_layers) + (n_layers == 1 ? " cell" : " cells") + " thick";
    const double      share = of_families->bending[dim - 2] / std::pow(n_layers, 1.5);
    const double      error = of_families->is_stiff ? share / (1. + share) : share;
    if (error > 0.05)
      result.push_back("parts are " + parts + ": a cantilever of such, ten times as long, is " +
                       (of_families->is_stiff ? "too stiff" : "off") + " by about " +
                       (error > 1. ? "100 % or more" : short_number(std::round(100. * error)) + " %") +
                       advice_of_layers());
    if (irregularity(*problem.body.mesh) > 0.05)
      result.push_back("cells are irregular in parts " + parts +
                       ": when pulled they bend aside, bars of 4 and 8 such cells by " + of_families->pulled +
                       " of their displacement. Take regular cells there, more of them, or Material/Form = "
                       "consistent in statics");
  }

  PERIDEAL_INSTANTIATE(warn_of_few_cells)
} // namespace perideal
