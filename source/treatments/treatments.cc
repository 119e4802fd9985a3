// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/treatments/treatments.h>

namespace perideal
{
  template <int dim>
  std::unique_ptr<Supports<dim>> create_supports(const TreatedBody<dim> &body)
  {
    switch (body.parameters.displacement_treatment)
      {
#define PERIDEAL_TREATMENT(name, text, meaning)                                                              \
  case DisplacementTreatment::name:                                                                          \
    return hold_by_##name(body);
        PERIDEAL_DISPLACEMENT_TREATMENTS(PERIDEAL_TREATMENT)
#undef PERIDEAL_TREATMENT
      case DisplacementTreatment::automatic:
        break;
      }
    AssertThrow(false, dealii::ExcMessage("the treatment of displacements is not resolved"));
    return {};
  }

  template <int dim>
  std::unique_ptr<Tractions<dim>> create_tractions(const TreatedBody<dim>  &body,
                                                   const TreatedBonds<dim> &bonds)
  {
    switch (body.parameters.traction_treatment)
      {
#define PERIDEAL_TREATMENT(name, text, meaning)                                                              \
  case TractionTreatment::name:                                                                              \
    return load_by_##name(body, bonds);
        PERIDEAL_TRACTION_TREATMENTS(PERIDEAL_TREATMENT)
#undef PERIDEAL_TREATMENT
      case TractionTreatment::automatic:
        break;
      }
    AssertThrow(false, dealii::ExcMessage("the treatment of tractions is not resolved"));
    return {};
  }

  PERIDEAL_INSTANTIATE(create_supports)
  PERIDEAL_INSTANTIATE(create_tractions)
} // namespace perideal
