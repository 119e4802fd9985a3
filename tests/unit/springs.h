// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_tests_unit_springs_h
#define perideal_tests_unit_springs_h

#include <perideal/materials/linear_model.h>
#include <perideal/materials/traits.h>

#include <deal.II/base/tensor.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace perideal::test
{
  /// Strain energy of a family of springs under a uniform strain [J].
  template <int dim>
  double spring_energy(const FamilyView<dim>        &view,
                       const FamilyCoefficients     &coefficients,
                       const dealii::Tensor<2, dim> &strain)
  {
    double energy = 0;
    for (LocalIndex k = 0; k < view.size; ++k)
      {
        dealii::Tensor<1, dim> bond;
        for (int d = 0; d < dim; ++d)
          bond[d] = view.bond[d][k];
        energy += 0.5 * coefficients.stiffness[k] * std::pow(bond * (strain * bond), 2);
      }
    return energy;
  }

  /// Model and form of everything made of bonds, as the list of models has it.
  /// @param may_move only where bonds may move
  inline std::vector<std::pair<std::string, std::string>> list_bond_models(const bool may_move)
  {
    std::vector<std::pair<std::string, std::string>> result;
    for (const auto &[name, model] : ModelChoice::list())
      for (const FormTraits &form : model.forms)
        if (!model.has_law &&
            (!may_move || (form.solvers.dynamics && form.discretisation == Discretisation::families)))
          result.emplace_back(name, form.name);
    return result;
  }

  inline const auto bond_models = list_bond_models(true);
} // namespace perideal::test

#endif
