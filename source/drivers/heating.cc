// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/drivers/heating.h>

#include <utility>

namespace perideal
{
  template <int dim>
  void Heating<dim>::begin_cold()
  {
    if (problem.loading.expansion)
      *problem.loading.expansion = CellExpansion<dim>(problem.body.nodes->size());
  }

  template <int dim>
  void Heating<dim>::remember()
  {
    if (!problem.loading.expansion)
      return;
    earlier       = std::make_unique<CellExpansion<dim>>(*problem.loading.expansion);
    energy_before = problem.force->strain_energy();
  }

  template <int dim>
  void Heating<dim>::take_loads()
  {
    if (earlier)
      first_change = problem.force->strain_energy() - energy_before;
  }

  template <int dim>
  double Heating<dim>::work()
  {
    if (!earlier)
      return 0.;
    const double with_later = problem.force->strain_energy();
    std::swap(*earlier, *problem.loading.expansion);
    const double with_earlier = problem.force->strain_energy();
    std::swap(*earlier, *problem.loading.expansion);
    earlier.reset();
    return 0.5 * (first_change + with_later - with_earlier);
  }

  template <int dim>
  void Heating<dim>::go_back(const NodalVector &displacement)
  {
    if (!earlier)
      return;
    *problem.loading.expansion = *earlier;
    earlier.reset();
    NodalVector forces;
    forces.reinit(displacement, true);
    problem.force->compute(forces, displacement);
  }

  PERIDEAL_INSTANTIATE_CLASS(Heating)
} // namespace perideal
