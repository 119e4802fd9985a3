// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/solvers/sub_steps.h>

#include <cmath>

namespace perideal
{
  template <int dim>
  SubSteps<dim>::SubSteps(BondForce<dim>                          &bonds,
                          const std::shared_ptr<const LocalSteps> &steps,
                          ContactForce<dim>                       *contact,
                          const std::vector<double>               &mass,
                          const std::vector<std::uint8_t>         &is_held,
                          const double                             longest)
    : bonds(bonds)
    , steps(steps)
    , contact(contact)
    , mass(mass)
    , is_held(is_held)
    , longest(longest)
    , parts(steps->n_levels())
    , levels(steps->n_levels())
  {
    bonds.take_local_steps(steps);
    for (NodalVector &part : parts)
      bonds.initialize(part);
    for (Level &level : levels)
      for (NodalVector *vector : {&level.way, &level.place, &level.force, &level.before})
        bonds.initialize(*vector);
    bonds.initialize(whole_way);
  }

  template <int dim>
  double SubSteps<dim>::step_of(const unsigned int level) const
  {
    return longest / LocalSteps::ratio(steps->n_levels() - 1 - level);
  }

  template <int dim>
  template <typename Visit>
  void SubSteps<dim>::visit_moving(const unsigned int level, const Visit &visit) const
  {
    for (LocalIndex i = 0; i < mass.size(); ++i)
      if (steps->level_of(i) <= level)
        for (std::size_t k = dim * i; k < dim * (i + 1); ++k)
          if (!is_held[k])
            visit(k);
  }

  template <int dim>
  void SubSteps<dim>::compute_parts(const NodalVector &displacement, const unsigned int highest)
  {
    bonds.compute_parts(parts, displacement, highest);
    if (contact)
      contact->add(parts[0], bonds);
  }

  template <int dim>
  void SubSteps<dim>::sum_parts(const unsigned int highest, NodalVector &sum) const
  {
    sum = parts[0];
    for (unsigned int level = 1; level <= highest; ++level)
      sum += parts[level];
  }

  template <int dim>
  void SubSteps<dim>::compute(NodalVector &force, const NodalVector &displacement)
  {
    compute_parts(displacement, steps->n_levels() - 1);
    sum_parts(steps->n_levels() - 1, force);
  }

  template <int dim>
  double SubSteps<dim>::take_steps(NodalVector &force, const NodalVector &displacement)
  {
    energy = 0;
    // Softened bonds keep what they have; what they would soften by on the way is not for good.
    bonds.judge_bonds(Judgement::on_trial);
    move(steps->n_levels() - 1, displacement, force, true, whole_way);
    bonds.judge_bonds(Judgement::for_good);
    for (std::size_t k = 0; k < dim * mass.size(); ++k)
      force.local_element(k) = 2. * mass[k / dim] * whole_way.local_element(k) / (longest * longest);
    return energy;
  }

  template <int dim>
  void SubSteps<dim>::move(const unsigned int level,
                           const NodalVector &from,
                           const NodalVector &force,
                           const bool         at_present,
                           NodalVector       &way)
  {
    // 2 c.
    constexpr double of_second = LocalSteps::omega / LocalSteps::nu;
    const double     step      = step_of(level);
    if (level == 0 || !steps->any_up_to(level - 1))
      {
        for (std::size_t k = 0; k < dim * mass.size(); ++k)
          way.local_element(k) = 0.5 * step * step * force.local_element(k) / mass[k / dim];
        return;
      }
    Level &own = levels[level];
    sum_parts(level - 1, own.before);
    move(level - 1, from, force, at_present, own.way);
    if (at_present)
      visit_moving(level - 1, [&](const std::size_t k) {
        const double velocity = own.way.local_element(k) / step_of(level - 1);
        energy -= of_second * mass[k / dim] * velocity * velocity;
      });
    own.place = from;
    visit_moving(level - 1,
                 [&](const std::size_t k) { own.place.local_element(k) += own.way.local_element(k); });
    compute_parts(own.place, level - 1);
    sum_parts(level - 1, own.force);
    own.force -= own.before;
    own.force += force;
    move(level - 1, own.place, own.force, false, way);
    way.sadd(of_second * LocalSteps::growth_square, (1. - of_second) * LocalSteps::growth_square, own.way);
  }

  template <int dim>
  void SubSteps<dim>::settle(const NodalVector &displacement)
  {
    bonds.judge_bonds(Judgement::on_trial);
    bonds.compute(whole_way, displacement);
    bonds.judge_bonds(Judgement::for_good);
    if (contact)
      contact->add(whole_way, bonds);
  }

  PERIDEAL_INSTANTIATE_CLASS(SubSteps)
} // namespace perideal
