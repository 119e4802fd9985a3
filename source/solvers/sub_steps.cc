// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/solvers/sub_steps.h>

namespace perideal
{
  template <int dim>
  SubSteps<dim>::SubSteps(BondForce<dim>                          &bonds,
                          const std::shared_ptr<const LocalSteps> &steps,
                          const std::vector<double>               &mass,
                          const std::vector<std::uint8_t>         &is_held,
                          const double                             longest)
    : bonds(bonds)
    , by_level(dynamic_cast<LevelledForce &>(bonds))
    , steps(steps)
    , mass(mass)
    , is_held(is_held)
    , longest(longest)
    , parts(steps->n_levels())
    , levels(steps->n_levels())
  {
    by_level.take_local_steps(steps);
    for (NodalVector &part : parts)
      bonds.initialize(part);
    for (Level &level : levels)
      for (NodalVector *vector : {&level.way, &level.force, &level.before, &level.place})
        bonds.initialize(*vector);
    bonds.initialize(place);
    bonds.initialize(whole_way);
  }

  template <int dim>
  double SubSteps<dim>::step_of(const unsigned int level) const
  {
    return longest / LocalSteps::ratio(steps->n_levels() - 1 - level);
  }

  template <int dim>
  template <typename Visit>
  void SubSteps<dim>::visit_components(const std::vector<LocalIndex> &nodes, const Visit &visit)
  {
    for (const std::size_t i : nodes)
      for (std::size_t k = dim * i; k < dim * (i + 1); ++k)
        visit(k);
  }

  template <int dim>
  template <typename Visit>
  void SubSteps<dim>::visit_free(const std::vector<LocalIndex> &nodes, const Visit &visit) const
  {
    visit_components(nodes, [&](const std::size_t k) {
      if (!is_held[k])
        visit(k);
    });
  }

  template <int dim>
  void SubSteps<dim>::compute_parts(const unsigned int highest)
  {
    by_level.compute_parts(parts, place, highest);
  }

  template <int dim>
  double SubSteps<dim>::sum_of_parts(const std::size_t k, const unsigned int highest) const
  {
    double result = 0;
    for (unsigned int level = 0; level <= highest; ++level)
      result += parts[level].local_element(k);
    return result;
  }

  template <int dim>
  void SubSteps<dim>::compute(NodalVector &force, const NodalVector &displacement)
  {
    const unsigned int highest = steps->n_levels() - 1;
    place                      = displacement;
    compute_parts(highest);
    for (std::size_t k = 0; k < dim * mass.size(); ++k)
      force.local_element(k) = sum_of_parts(k, highest);
  }

  template <int dim>
  double SubSteps<dim>::take_steps(NodalVector &force)
  {
    energy = 0;
    move(steps->n_levels() - 1, force, true, whole_way);
    for (std::size_t k = 0; k < dim * mass.size(); ++k)
      force.local_element(k) = 2. * mass[k / dim] * whole_way.local_element(k) / (longest * longest);
    return energy;
  }

  template <int dim>
  void SubSteps<dim>::move(const unsigned int level,
                           const NodalVector &force,
                           const bool         at_start,
                           NodalVector       &way)
  {
    // 2 c.
    constexpr double of_second = LocalSteps::omega / LocalSteps::nu;
    const double     step      = step_of(level);
    const bool       is_whole  = level == 0 || !steps->any_up_to(level - 1);
    const auto      &nodes     = steps->pulled(level);
    visit_components(nodes, [&](const std::size_t k) {
      if (is_whole || steps->level_of_force(k / dim) == level)
        way.local_element(k) = way_of(force, k, step);
    });
    if (is_whole)
      return;

    const unsigned int             lower  = level - 1;
    const std::vector<LocalIndex> &moving = steps->moving(lower), &changed = steps->pulled(lower);
    const double                   interval = step_of(lower);
    Level                         &own      = levels[level];
    visit_components(changed,
                     [&](const std::size_t k) { own.before.local_element(k) = sum_of_parts(k, lower); });
    move(lower, force, at_start, own.way);
    visit_free(moving, [&](const std::size_t k) {
      const double first = own.way.local_element(k);
      if (at_start)
        energy -= of_second * mass[k / dim] * first * first / (interval * interval);
      own.place.local_element(k) = place.local_element(k);
      place.local_element(k) += first;
    });
    compute_parts(lower);
    visit_components(changed, [&](const std::size_t k) {
      own.force.local_element(k) =
        force.local_element(k) + sum_of_parts(k, lower) - own.before.local_element(k);
    });
    move(lower, own.force, false, way);
    visit_free(moving, [&](const std::size_t k) { place.local_element(k) = own.place.local_element(k); });
    visit_components(changed, [&](const std::size_t k) {
      double &whole = way.local_element(k);
      whole = LocalSteps::growth_square * ((1. - of_second) * own.way.local_element(k) + of_second * whole);
    });
  }

  template <int dim>
  void SubSteps<dim>::settle(const NodalVector &displacement)
  {
    bonds.compute(whole_way, displacement);
  }

  PERIDEAL_INSTANTIATE_CLASS(SubSteps)
} // namespace perideal
