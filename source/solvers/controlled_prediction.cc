// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/solvers/controlled_newton.h>

#include <algorithm>

// Where the steps of ControlledNewton begin, and what they keep for the next.

namespace perideal
{
  namespace
  {
    /// Largest step over the one before that a prediction extends.
    constexpr double longest_prediction = 1.5;
    /// What a prediction that goes with the fronts may leave of the residual of one in place, to be taken:
    /// where cracks go on steadily it leaves .05 to .25, near the end of a body half, which no tangent mends.
    constexpr double left_by_fronts = 1. / 3.;
  } // namespace

  template <int dim>
  bool ControlledNewton<dim>::predict(const double amount)
  {
    const double ahead = previous.amount > 0 ? std::min(amount / previous.amount, longest_prediction) : 0.;
    start.time         = last.time + ahead * last.time_change;
    previous.iteration = 0.;
    this->correction   = 0.;
    const auto go      = [&](const NodalVector &motion) {
      start.displacement = last.displacement;
      start.displacement.add(ahead, motion);
      place(0., 0.);
      this->compute_residual(external);
      return this->residual.l2_norm();
    };
    const double in_place = go(last.motion);
    if (control.gauge || ahead == 0. || !fronts.carry(last.motion, carried))
      return false;
    const bool is_near = go(carried) < left_by_fronts * in_place;
    if (!is_near)
      go(last.motion);
    return is_near;
  }

  template <int dim>
  void ControlledNewton<dim>::keep_step(const double change, const std::optional<Start> &with_cells)
  {
    if (!with_cells)
      last.note_step(this->increment, now);
    else
      {
        this->increment += with_cells->displacement;
        this->increment -= displacement;
        last.note_step(this->increment, now);
        last.time_change += with_cells->time - now;
      }
    keep_amount(change);
  }

  template <int dim>
  void ControlledNewton<dim>::keep_amount(const double change)
  {
    previous.amount = change;
    previous.reading += change;
    if (!control.gauge)
      fronts.note(this->bonds.damage());
  }

#define PERIDEAL_INSTANTIATE_PREDICTION(dim)                                                                 \
  template bool ControlledNewton<dim>::predict(const double);                                                \
  template void ControlledNewton<dim>::keep_step(const double, const std::optional<Start> &);                \
  template void ControlledNewton<dim>::keep_amount(const double);
  PERIDEAL_INSTANTIATE_PREDICTION(2)
  PERIDEAL_INSTANTIATE_PREDICTION(3)
#undef PERIDEAL_INSTANTIATE_PREDICTION
} // namespace perideal
