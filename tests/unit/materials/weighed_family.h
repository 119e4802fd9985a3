// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_tests_unit_materials_weighed_family_h
#define perideal_tests_unit_materials_weighed_family_h

#include <perideal/materials/lattice.h>
#include <perideal/materials/models.h>

#include <string>

namespace perideal::test
{
  /// A family of a square or cubic lattice of unit cells, as a model weighs it.
  template <int dim>
  struct WeighedFamily
  {
    WeighedFamily(const std::string &model,
                  const std::string &form,
                  const double       horizon_factor,
                  const double       poisson_ratio      = 0.3,
                  const std::string &influence_function = "constant")
      : family(lattice_family<dim>(horizon_factor))
    {
      ModelParameters parameters;
      parameters.model              = model;
      parameters.form               = form;
      parameters.influence_function = influence_function;
      parameters.resolve(dim);
      const auto bonds = create_model<dim>(parameters, 1.);
      family.set_solid(parameters.constants_of_model(
        {1., poisson_ratio, dim == 3 ? PlaneAssumption::solid : PlaneAssumption::plane_strain}));
      shape = bonds->shape();
      coefficients.resize(family.size, shape);
      bonds->compute(family, coefficients);
    }

    FamilyView<dim>    family;
    FamilyShape        shape;
    FamilyCoefficients coefficients;
  };
} // namespace perideal::test

#endif
