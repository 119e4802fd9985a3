// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/drivers/heating.h>

#include <utility>

namespace perideal
{
  template <int dim>
  Heating<dim>::Heating(const Problem<dim> &problem)
    : problem(problem)
  {
    if (!problem.loading.expansion)
      return;
    earlier       = std::make_unique<const CellExpansion<dim>>(*problem.loading.expansion);
    energy_before = problem.force->strain_energy();
  }

  template <int dim>
  double Heating<dim>::change()
  {
    if (earlier)
      first_change = problem.force->strain_energy() - energy_before;
    return first_change;
  }

  template <int dim>
  double Heating<dim>::work()
  {
    if (!earlier)
      return 0.;
    const double       with_later = problem.force->strain_energy();
    CellExpansion<dim> later      = *earlier;
    std::swap(later, *problem.loading.expansion);
    const double with_earlier = problem.force->strain_energy();
    std::swap(later, *problem.loading.expansion);
    return 0.5 * (first_change + with_later - with_earlier);
  }

  PERIDEAL_INSTANTIATE_CLASS(Heating)
} // namespace perideal
