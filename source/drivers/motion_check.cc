// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/drivers/motion_check.h>
#include <perideal/output/summary.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace perideal
{
  template <int dim>
  MotionCheck<dim>::MotionCheck(const Problem<dim> &problem)
    : problem(problem)
  {
  }

  template <int dim>
  std::string MotionCheck<dim>::fastest_node(const ExplicitDynamics<dim> &dynamics) const
  {
    const Nodes<dim> &nodes   = *problem.body.nodes;
    double            fastest = -1;
    LocalIndex        node    = 0;
    for (LocalIndex i = 0; i < nodes.size(); ++i)
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
      text << nodes.first_global + node << " at (" << nodes.position[node] << ")";
    const auto of_ranks =
      dealii::Utilities::MPI::all_gather(problem.run.communicator, std::make_pair(fastest, text.str()));
    return std::max_element(
             of_ranks.begin(), of_ranks.end(), [](const auto &a, const auto &b) { return a.first < b.first; })
      ->second;
  }

  template <int dim>
  void MotionCheck<dim>::look(const ExplicitDynamics<dim> &dynamics,
                              const EnergyBudget          &energy,
                              const double                 largest_energy,
                              const double                 stable_step)
  {
    // Which knows the steps of rows only; frames are measured between.
    const double largest = std::max({largest_energy, std::abs(energy.external), energy.kinetic});
    std::string  reason;
    if (!std::isfinite(energy.kinetic) || !std::isfinite(energy.strain))
      reason = "the motion is not finite";
    // Bonds that break may keep a motion finite that is none. At the very beginning, energies are small.
    else if (largest_energy > 0 && std::abs(energy.imbalance()) > 0.5 * largest)
      ++rows_without_balance;
    else
      rows_without_balance = 0;
    if (rows_without_balance > 3)
      reason = "the energy balance error exceeds half of the energy";
    if (reason.empty())
      return;
    const bool has_energy = problem.parameters.model.form_traits().follows_from_energy;
    throw ComputationError(
      reason + ": step " + std::to_string(dynamics.step()) + ", t = " + short_number(dynamics.time()) +
      " s, fastest is node " + fastest_node(dynamics) + "\n  likely cause: " +
      (has_energy ? "" : "the paper's forces, which follow from no energy and let motions grow, or ") +
      "an unstable time step; the largest stable one is " + short_number(stable_step) + " s\n  advice: set " +
      (has_energy ? "" : "Material/Form = energy, or ") + "Solver/Time step = 0");
  }

  PERIDEAL_INSTANTIATE_CLASS(MotionCheck)
} // namespace perideal
