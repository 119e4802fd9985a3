// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_treatments_treatments_h
#define perideal_treatments_treatments_h

#include <perideal/treatments/supports.h>
#include <perideal/treatments/tractions.h>

#include <memory>

namespace perideal
{
  /// The treatment that the scene chose for prescribed displacements. Collective.
  template <int dim>
  std::unique_ptr<Supports<dim>> create_supports(const TreatedBody<dim> &body);

  /// The treatment that the scene chose for tractions. Collective.
  template <int dim>
  std::unique_ptr<Tractions<dim>> create_tractions(const TreatedBody<dim>  &body,
                                                   const TreatedBonds<dim> &bonds);

  // Every treatment of the lists in treatment_list.h is a file of this room that defines one of these.

#define PERIDEAL_TREATMENT(name, text, meaning)                                                              \
  template <int dim>                                                                                         \
  std::unique_ptr<Supports<dim>> hold_by_##name(const TreatedBody<dim> &body);
  PERIDEAL_DISPLACEMENT_TREATMENTS(PERIDEAL_TREATMENT)
#undef PERIDEAL_TREATMENT

#define PERIDEAL_TREATMENT(name, text, meaning)                                                              \
  template <int dim>                                                                                         \
  std::unique_ptr<Tractions<dim>> load_by_##name(const TreatedBody<dim>  &body,                              \
                                                 const TreatedBonds<dim> &bonds);
  PERIDEAL_TRACTION_TREATMENTS(PERIDEAL_TREATMENT)
#undef PERIDEAL_TREATMENT
} // namespace perideal

#endif
