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
    , n_nodal(dim * mass.size())
    , is_held(is_held)
    , longest(longest)
    , parts(steps->n_levels())
    , levels(steps->n_levels())
  {
    by_level.take_local_steps(steps);
    for (LevelledForce::Part &part : parts)
      bonds.initialize(part.force);
    bonds.initialize(place);
    for (LocalIndex i = 0; i < mass.size(); ++i)
      points.push_back({mass[i], steps->level_of_force(i)});
    for (const unsigned int level : steps->levels_of_supports())
      points.push_back({1., level});
    whole_way.resize(dim * points.size());
    for (unsigned int level = 0; level < levels.size(); ++level)
      {
        for (Components *components :
             {&levels[level].way, &levels[level].force, &levels[level].before, &levels[level].place})
          components->resize(whole_way.size());
        for (LocalIndex i = 0; i < points.size(); ++i)
          if (points[i].level <= level)
            levels[level].pulled.push_back(i);
      }
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
      result += k < n_nodal ? parts[level].force.local_element(k) : parts[level].support[k - n_nodal];
    return result;
  }

  template <int dim>
  void SubSteps<dim>::compute(NodalVector &force, const NodalVector &displacement)
  {
    const unsigned int highest = steps->n_levels() - 1;
    place                      = displacement;
    compute_parts(highest);
    for (std::size_t k = 0; k < n_nodal; ++k)
      force.local_element(k) = sum_of_parts(k, highest);
  }

  template <int dim>
  double SubSteps<dim>::take_steps(NodalVector &force)
  {
    const unsigned int highest = steps->n_levels() - 1;
    Components         all(force.begin(), force.begin() + n_nodal);
    for (std::size_t k = n_nodal; k < whole_way.size(); ++k)
      all.push_back(sum_of_parts(k, highest));
    energy = 0;
    move(highest, all, true, whole_way);
    for (std::size_t k = 0; k < n_nodal; ++k)
      force.local_element(k) = 2. * points[k / dim].mass * whole_way[k] / (longest * longest);
    return energy;
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>> SubSteps<dim>::support_forces() const
  {
    std::vector<dealii::Tensor<1, dim>> result((whole_way.size() - n_nodal) / dim);
    for (std::size_t k = n_nodal; k < whole_way.size(); ++k)
      result[(k - n_nodal) / dim][k % dim] = 2. * whole_way[k] / (longest * longest);
    return result;
  }

  template <int dim>
  void
  SubSteps<dim>::move(const unsigned int level, const Components &force, const bool at_start, Components &way)
  {
    // 2 c.
    constexpr double of_second = LocalSteps::omega / LocalSteps::nu;
    const double     step      = step_of(level);
    const bool       is_whole  = level == 0 || !steps->any_up_to(level - 1);
    visit_components(levels[level].pulled, [&](const std::size_t k) {
      if (is_whole || points[k / dim].level == level)
        way[k] = way_of(force, k, step);
    });
    if (is_whole)
      return;

    const unsigned int             lower  = level - 1;
    const std::vector<LocalIndex> &moving = steps->moving(lower), &changed = levels[lower].pulled;
    const double                   interval = step_of(lower);
    Level                         &own      = levels[level];
    visit_components(changed, [&](const std::size_t k) { own.before[k] = sum_of_parts(k, lower); });
    move(lower, force, at_start, own.way);
    visit_free(moving, [&](const std::size_t k) {
      const double first = own.way[k];
      if (at_start)
        energy -= of_second * points[k / dim].mass * first * first / (interval * interval);
      own.place[k] = place.local_element(k);
      place.local_element(k) += first;
    });
    compute_parts(lower);
    visit_components(changed, [&](const std::size_t k) {
      own.force[k] = force[k] + sum_of_parts(k, lower) - own.before[k];
    });
    move(lower, own.force, false, way);
    visit_free(moving, [&](const std::size_t k) { place.local_element(k) = own.place[k]; });
    visit_components(changed, [&](const std::size_t k) {
      way[k] = LocalSteps::growth_square * ((1. - of_second) * own.way[k] + of_second * way[k]);
    });
  }

  template <int dim>
  void SubSteps<dim>::settle(const NodalVector &displacement)
  {
    NodalVector force;
    bonds.initialize(force);
    bonds.compute(force, displacement);
  }

  PERIDEAL_INSTANTIATE_CLASS(SubSteps)
} // namespace perideal
