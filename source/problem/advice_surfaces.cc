// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/materials/lattice.h>
#include <perideal/output/summary.h>
#include <perideal/problem/advice.h>
#include <perideal/problem/output_fields.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace perideal
{
  namespace
  {
    /// What a boundary is like: how far it turns around, and its size in horizons.
    template <int dim>
    struct Surroundings
    {
      /// |sum A n| / sum A: 0 of a closed surface, 1 of a plane one [-].
      double flatness = 0;
      /// The largest horizon of its cells over the longest edge of its box [-].
      double horizons = 0;
    };

    /// Collective.
    template <int dim>
    Surroundings<dim> look_at(const BoundaryCondition<dim> &condition, const Body<dim> &body)
    {
      dealii::Tensor<1, dim> sum;
      double                 area = 0, horizon = 0, lower[dim], upper[dim];
      std::fill_n(lower, dim, std::numeric_limits<double>::max());
      std::fill_n(upper, dim, std::numeric_limits<double>::lowest());
      for (const auto &cell : body.mesh->triangulation.active_cell_iterators())
        if (cell->is_locally_owned() && cell->at_boundary())
          for (const unsigned int f : cell->face_indices())
            if (cell->at_boundary(f) && condition.acts_on(cell->face(f)->boundary_id()))
              {
                const auto   face      = cell->face(f);
                const auto   outward   = face->center() - cell->center();
                const double magnitude = face->measure();
                // A normal of the straight face through the centre, of a length that does not matter.
                dealii::Tensor<1, dim> normal;
                if constexpr (dim == 2)
                  normal = cross_product_2d(face->vertex(1) - face->vertex(0));
                else
                  normal =
                    cross_product_3d(face->vertex(3) - face->vertex(0), face->vertex(2) - face->vertex(1));
                sum += (normal * outward > 0 ? magnitude : -magnitude) / normal.norm() * normal;
                area += magnitude;
                horizon =
                  std::max(horizon, body.nodes->horizon[body.nodes->node_of_cell[cell->active_cell_index()]]);
                for (const unsigned int v : face->vertex_indices())
                  for (int d = 0; d < dim; ++d)
                    {
                      lower[d] = std::min(lower[d], face->vertex(v)[d]);
                      upper[d] = std::max(upper[d], face->vertex(v)[d]);
                    }
              }
      namespace mpi               = dealii::Utilities::MPI;
      const MPI_Comm communicator = body.nodes->communicator;
      double         extent       = 0;
      for (int d = 0; d < dim; ++d)
        extent = std::max(extent, mpi::max(upper[d], communicator) - mpi::min(lower[d], communicator));
      return {mpi::sum(sum, communicator).norm() / mpi::sum(area, communicator),
              mpi::max(horizon, communicator) / extent};
    }

    /// Loads on holes that are few horizons wide: forms that correct families for uniform strain hand them to
    /// cells that lie in a strain which is far from uniform. Measured with pressure in holes 2.7 to 15
    /// horizons wide, energy and paper form: the error of the displacement is 0.4 to 1.5 times the horizon
    /// over the width of the hole.
    template <int dim>
    void warn_of_loaded_holes(const Problem<dim> &problem, std::vector<std::string> &result)
    {
      for (const BoundaryCondition<dim> &condition : problem.loading.loads.conditions)
        if (condition.prescribes_traction())
          {
            const Surroundings<dim> boundary = look_at(condition, problem.body);
            if (boundary.flatness < 0.2 && boundary.horizons > 0.03)
              result.push_back(
                "the boundary of " + condition.name + " is loaded all around and " +
                short_number(1. / boundary.horizons) +
                " horizons wide: displacements there are off by about " +
                short_number(std::floor(40. * boundary.horizons)) + " to " +
                short_number(std::ceil(150. * boundary.horizons)) +
                " %, stresses by more: take finer cells, or Material/Form = consistent in statics");
          }
    }
  } // namespace

  template <int dim>
  void warn_of_surfaces(const Problem<dim> &problem, std::vector<std::string> &result)
  {
    const ModelParameters &model = problem.parameters.model;
    if ((model.is_consistent() && !model.is_correspondence()) ||
        problem.loading.tractions->complete_families())
      return;
    const double      whole   = lattice_family<dim>(problem.parameters.nodes.horizon_factor).size;
    const double      missing = 1. - problem.discretisation.families->statistics().mean / whole;
    const double      percent = std::round(100. * missing);
    const std::string share =
      percent > 0 ? "families lack " + short_number(percent) + " % of their bonds on average, " : "";
    const bool is_uncorrected = !model.model->corrects_surfaces && !model.compensates();
    if (is_uncorrected)
      {
        // Where little volume changes, the whole of a strain is in sums that surfaces cut.
        const auto &solids = problem.body.solids;
        const bool  is_stiff_in_volume =
          problem.parameters.material.assumption != PlaneAssumption::plane_stress &&
          std::any_of(solids.begin(), solids.end(), [&](const auto &solid) {
            return solid.second.is_isotropic() &&
                   model.constants_of_model(solid.second.isotropic()).poisson_ratio > 0.4;
          });
        result.push_back(
          "the " + model.model->name + " model has no surface correction: " + share + "errors of " +
          (is_stiff_in_volume ? "tens of per cent are usual where Poisson's ratio is above 0.4" :
                                "several per cent are usual"));
      }
    // Families of long cells have other numbers of members.
    if (problem.discretisation.families->statistics().max < whole &&
        problem.body.nodes->max_aspect_ratio < 1.5)
      result.push_back(
        "the body is nowhere two horizons thick: " + share +
        "bending may be off by tens of per cent: take more cells across it, or Material/Model = "
        "extended ordinary with Form = consistent in statics");
    if (model.is_consistent())
      return;
    warn_of_loaded_holes(problem, result);
    // Measured against finite elements: 5 % in l2 on the plate with a hole, 25 % in a cantilever of eight
    // cells.
    if (needs_strain(problem.parameters.all_field_names()) && !model.is_correspondence())
      result.push_back(
        "fields of strain and stress are means over families here: expect 5 % in wide bodies and 25 % "
        "in bent parts of eight cells; Comparison/FEM = true tells how far they are off" +
        std::string(problem.parameters.solver.is_linear_static() ?
                      ", and Material/Form = consistent knows them as finite elements do" :
                      ""));
  }

  PERIDEAL_INSTANTIATE(warn_of_surfaces)
} // namespace perideal
