// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/comparison.h>
#include <perideal/application/gauge_records.h>
#include <perideal/application/simulation.h>
#include <perideal/base/instantiate.h>
#include <perideal/output/summary.h>

// Simulation: finite elements of finite strain along the same load steps.

namespace perideal
{
  template <int dim>
  void Simulation<dim>::set_up_nonlinear_fem()
  {
    const Timings::Scope scope(timings, "fem");
    LawsByMaterial<dim>  laws;
    for (const auto &solid : compared_solids_on(*scene.mesh))
      laws[solid.first] = create_law<dim>(parameters.model.law, solid.second);
    typename HyperelasticFem<dim>::Controls controls;
    controls.tolerance      = parameters.solver.tolerance;
    controls.max_iterations = parameters.solver.newton_iterations;
    controls.halvings       = parameters.solver.step_halvings;
    scene.nonlinear_fem = std::make_unique<HyperelasticFem<dim>>(*scene.mesh, scene.loads, laws, controls);
    summary["fem"]["unknowns"] = scene.nonlinear_fem->n_dofs();
  }

  template <int dim>
  void Simulation<dim>::solve_nonlinear_fem(const double time)
  {
    const Timings::Scope scope(timings, "fem");
    const auto           step = scene.nonlinear_fem->solve_step(time);
    screen << "finite elements: " << step.iterations << " iterations, residual "
           << short_number(step.residual) << std::endl;
    summary["fem"]["iterations"].push_back(step.iterations);
    summary["fem"]["linear_iterations"].push_back(step.linear_iterations);
  }

  template <int dim>
  void Simulation<dim>::record_nonlinear_fem()
  {
    const Timings::Scope        scope(timings, "fem");
    const HyperelasticFem<dim> &fem    = *scene.nonlinear_fem;
    const char                 *axes[] = {"x", "y", "z"};
    const double                energy = fem.strain_energy();
    history->add("fem: strain energy [J]", energy);
    summary["fem"]["strain_energy"] = energy;
    for (std::size_t k = 0; k < scene.loads.conditions.size(); ++k)
      if (scene.loads.conditions[k].prescribes_displacement())
        {
          dealii::Tensor<1, dim> reaction;
          for (const auto boundary : scene.loads.conditions[k].boundary_ids)
            reaction += fem.reaction(boundary);
          const std::string     &name  = scene.loads.conditions[k].name;
          nlohmann::ordered_json value = nlohmann::ordered_json::array();
          for (int d = 0; d < dim; ++d)
            {
              history->add("fem: reaction of " + name + " along " + axes[d] + " [N]", reaction[d]);
              value.push_back(reaction[d]);
            }
          summary["fem"]["reactions"][name] = value;
        }
    if (scene.gauges)
      record_gauges(*scene.gauges, fem.evaluate(scene.gauges->points()), *history, summary["gauges"]);
  }

  PERIDEAL_INSTANTIATE_CLASS(Simulation)
} // namespace perideal
