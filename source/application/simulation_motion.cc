// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/areal_forces.h>
#include <perideal/application/comparison.h>
#include <perideal/application/gauge_records.h>
#include <perideal/application/output_fields.h>
#include <perideal/application/prescribed_displacements.h>
#include <perideal/application/simulation.h>
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/output/summary.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

// Simulation: what a motion leaves behind: history, summary, fields; and whether it is one.

namespace perideal
{
  template <int dim>
  std::vector<double> Simulation<dim>::total_damage() const
  {
    std::vector<double>       result = scene.force->damage();
    const std::vector<double> cut    = scene.force->cut_share();
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] += cut[i];
    return result;
  }

  template <int dim>
  std::string Simulation<dim>::fastest_node(const ExplicitDynamics<dim> &dynamics) const
  {
    double     fastest = -1;
    LocalIndex node    = 0;
    for (LocalIndex i = 0; i < scene.nodes->size(); ++i)
      for (int d = 0; d < dim; ++d)
        {
          const double speed = std::abs(dynamics.velocity.local_element(dim * i + d));
          if (!(speed <= fastest))
            {
              fastest = std::isfinite(speed) ? speed : std::numeric_limits<double>::max();
              node    = i;
            }
        }
    std::ostringstream text;
    if (fastest >= 0)
      text << scene.nodes->first_global + node << " at (" << scene.nodes->position[node] << ")";
    const auto of_ranks =
      dealii::Utilities::MPI::all_gather(communicator, std::make_pair(fastest, text.str()));
    return std::max_element(
             of_ranks.begin(), of_ranks.end(), [](const auto &a, const auto &b) { return a.first < b.first; })
      ->second;
  }

  template <int dim>
  void Simulation<dim>::check_motion(const ExplicitDynamics<dim> &dynamics, const EnergyBudget &energy)
  {
    std::string problem;
    if (!std::isfinite(energy.kinetic) || !std::isfinite(energy.strain))
      problem = "the motion is not finite";
    // Bonds that break may keep a motion finite that is none. At the very beginning, energies are small.
    else if (largest_energy > 0 && std::abs(energy.imbalance()) > 0.5 * largest_energy)
      ++rows_without_balance;
    else
      rows_without_balance = 0;
    if (rows_without_balance > 3)
      problem = "the energy that is there is not what was put in";
    if (problem.empty())
      return;
    const bool has_energy = parameters.model.form_traits().follows_from_energy;
    throw ComputationError(
      problem + ": step " + std::to_string(dynamics.step()) + ", t = " + short_number(dynamics.time()) +
      " s, fastest is node " + fastest_node(dynamics) + "\n  likely cause: " +
      (has_energy ? "" : "the paper's forces, which follow from no energy and let motions grow, or ") +
      "an unstable time step; the largest stable one is " +
      short_number(summary["solver"]["stable_time_step"].template get<double>()) + " s\n  advice: set " +
      (has_energy ? "" : "Material/Form = energy, or ") + "Solver/Time step = 0");
  }

  template <int dim>
  void Simulation<dim>::record_dynamics(const ExplicitDynamics<dim> &dynamics)
  {
    const Timings::Scope scope(timings, "energy");
    const EnergyBudget   energy = dynamics.energy();
    check_motion(dynamics, energy);
    store_motion(dynamics);
    largest_energy     = std::max({largest_energy, std::abs(energy.external), energy.kinetic});
    const double drift = largest_energy > 0 ? energy.imbalance() / largest_energy : 0.;
    history->add("step", dynamics.step());
    history->add("time [s]", dynamics.time());
    history->add("kinetic energy [J]", energy.kinetic);
    history->add("strain energy [J]", energy.strain);
    if (scene.contact)
      history->add("contact energy [J]", energy.contact);
    history->add("dissipated energy [J]", energy.dissipated);
    history->add("damped energy [J]", energy.damped);
    history->add("external work [J]", energy.external);
    history->add("drift [-]", drift);
    history->add("broken bonds", dynamics.n_broken());
    const auto  reactions = scene.held.sum_by_condition(dynamics.reaction(), communicator);
    const char *axes[]    = {"x", "y", "z"};
    for (std::size_t k = 0; k < scene.loads.conditions.size(); ++k)
      if (scene.loads.conditions[k].prescribes_displacement())
        for (int d = 0; d < dim; ++d)
          history->add("reaction of " + scene.loads.conditions[k].name + " along " + axes[d] + " [N]",
                       reactions[k][d]);
    summary["displacements"] = record_displacements(scene, dynamics.time(), *history);
    if (scene.crack_tracker)
      record_crack_tips(dynamics.n_broken(), dynamics.time());
    if (scene.areal_forces)
      summary["areal_force_densities"] = record_areal_forces(scene, parameters, *history);
    if (scene.gauges)
      record_gauges(*scene.gauges, dynamics.displacement, *history, nullptr);
    history->end_row();
    double worst = summary.contains("energy") ? summary["energy"]["drift"].template get<double>() : 0.;
    if (std::abs(drift) > std::abs(worst))
      worst = drift;
    summary["energy"]                     = {{"strain", energy.strain},
                                             {"kinetic", energy.kinetic},
                                             {"contact", energy.contact},
                                             {"dissipated", energy.dissipated},
                                             {"damped", energy.damped},
                                             {"external", energy.external},
                                             {"drift", worst}};
    summary["damage"]["broken_bonds"]     = dynamics.n_broken();
    summary["momentum"]                   = nlohmann::ordered_json::array();
    const dealii::Tensor<1, dim> momentum = dynamics.momentum();
    for (int d = 0; d < dim; ++d)
      summary["momentum"].push_back(momentum[d]);
    if (scene.contact)
      {
        const double before =
          summary.contains("contact") ? summary["contact"].value("largest_overlap", 0.) : 0.;
        summary["contact"] = {{"pairs", scene.contact->n_contacts()},
                              {"largest_overlap", std::max(before, scene.contact->largest_overlap())},
                              {"searches", scene.contact->n_searches()}};
      }
  }

  template <int dim>
  void Simulation<dim>::record_crack_tips(const GlobalIndex n_broken, const double time)
  {
    if (n_broken != broken_in_cracks)
      scene.crack_tracker->collect();
    broken_in_cracks   = n_broken;
    const char *axes[] = {"x", "y", "z"};
    for (const auto &tip : scene.crack_tracker->tips(time))
      {
        for (int d = 0; d < dim; ++d)
          history->add(std::string("tip ") + axes[d] + " of " + tip.name + " [m]", tip.position[d]);
        history->add("reach of " + tip.name + " [m]", tip.reach);
        history->add("speed of " + tip.name + " [m/s]", tip.speed);
      }
  }

  template <int dim>
  void Simulation<dim>::store_motion(const ExplicitDynamics<dim> &dynamics)
  {
    motion_time = dynamics.time();
    scene.displacement.resize(scene.nodes->size());
    scene.velocity.resize(scene.nodes->size());
    for (LocalIndex i = 0; i < scene.nodes->size(); ++i)
      for (int d = 0; d < dim; ++d)
        {
          scene.displacement[i][d] = dynamics.displacement.local_element(dim * i + d);
          scene.velocity[i][d]     = dynamics.velocity.local_element(dim * i + d);
        }
  }

  template <int dim>
  void Simulation<dim>::write_frame(const unsigned int number, const ExplicitDynamics<dim> &dynamics)
  {
    const Timings::Scope scope(timings, "output");
    if (motion_time != dynamics.time())
      {
        check_motion(dynamics, dynamics.energy());
        store_motion(dynamics);
      }
    if (parameters.comparison.has_exact())
      scene.comparisons["exact"] = evaluate_exact(scene, parameters.comparison, dynamics.time());
    add_output_fields(scene, parameters.field_names(), *field_output);
    field_output->write(number, dynamics.time());
    frame_time = dynamics.time();
  }

  PERIDEAL_INSTANTIATE_CLASS(Simulation)

} // namespace perideal
