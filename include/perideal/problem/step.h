// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_problem_step_h
#define perideal_problem_step_h

#include <perideal/solvers/equilibrium_path.h>

#include <deal.II/base/tensor.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace perideal
{
  /// What a driver hands to its recorders when a step is done. Numbers are those of all ranks.
  template <int dim>
  struct Step
  {
    std::uint64_t number = 0;
    /// Of dynamics [s]; of load steps the share of the loads, from 0 to 1 [-].
    double time = 0;
    /// Energies [J], and what is missing over the largest of them so far [-].
    EnergyBudget energy;
    double       energy_error = 0;
    /// Forces of the supports by condition [N].
    std::vector<dealii::Tensor<1, dim>> reactions;
    /// What the search for the equilibrium took; nothing in dynamics.
    EquilibriumStep search;
    unsigned int    halvings = 0;
    /// Bonds that broke until now and in this step, and nodes that came loose.
    GlobalIndex n_broken = 0, newly_broken = 0, n_floating = 0;
    /// Of the body in dynamics [kg m/s], and about the origin [kg m^2/s].
    struct Momentum
    {
      dealii::Tensor<1, dim> linear;
      dealii::Tensor<1, 3>   angular;
    };
    Momentum momentum;
    /// Whether it is the last one of the run.
    bool is_last = false;
  };
} // namespace perideal

#endif
