// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/solvers/newton.h>

#include <cmath>

// What NewtonSolver does where bonds soften.

namespace perideal
{
  namespace
  {
    /// Iterations that may pass before the residual is half of what it was.
    constexpr unsigned int most_in_vain = 5;
    /// How often over a step is gone that softens bonds for good, while the energy falls.
    constexpr double longest_step = 16.;
    /// The longest step over the one before that goes on as that did, and the residual over the largest load
    /// from which it does.
    constexpr double longest_start = 2., largest_mistake = 0.1;
  } // namespace

  template <int dim>
  bool NewtonSolver<dim>::start_along_last_step(const NodalVector &external, const double time)
  {
    const double ahead = (time - this->last.time) / this->last.time_change;
    if (!this->bonds.softening_bonds().softens() || this->breaks.wait ||
        !(this->last.time_change > 0 && ahead > 0 && ahead <= longest_start))
      return false;
    displacement.add(ahead, this->last.motion);
    held.set_boundary_values(this->loads, time, displacement);
    if (this->face_values != nullptr)
      this->face_values->set_time(this->loads, time);
    this->compute_forces();
    compute_residual(external);
    if (residual.l2_norm() <= largest_mistake * std::sqrt(this->last.largest_load))
      return true;
    this->restore();
    return false;
  }

  template <int dim>
  bool NewtonSolver<dim>::iterate_softening(const NodalVector &external, EquilibriumStep &result)
  {
    if (norms.residual < 0.25 * searching.least_residual)
      {
        searching.least_residual = norms.residual;
        searching.n_in_vain      = 0;
      }
    if (searching.n_in_vain < most_in_vain)
      {
        ++searching.n_in_vain;
        linearise(Slope::tangent);
        if (solve(result, true) && search(external, 1))
          return true;
      }
    if (!may_jump)
      {
        result.problem = "the path turns back";
        return false;
      }
    searching.n_in_vain = 0;
    // There is no equilibrium nearby. What has softened until here stays so.
    this->extend_bonds();
    this->judge(external);
    compute_residual(external);
    linearise(Slope::secant);
    if (!solve(result, true))
      return false;
    result.problem.clear();
    // Bonds that open and close would alternate without a search; a crack that jumps goes far.
    if (!search(external, max_trials, longest_step))
      {
        displacement += correction;
        this->compute_forces();
      }
    return true;
  }

#define PERIDEAL_INSTANTIATE_SOFTENING(dim)                                                                  \
  template bool NewtonSolver<dim>::start_along_last_step(const NodalVector &, const double);                 \
  template bool NewtonSolver<dim>::iterate_softening(const NodalVector &, EquilibriumStep &);
  PERIDEAL_INSTANTIATE_SOFTENING(2)
  PERIDEAL_INSTANTIATE_SOFTENING(3)
#undef PERIDEAL_INSTANTIATE_SOFTENING
} // namespace perideal
