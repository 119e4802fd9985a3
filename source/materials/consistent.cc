// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/materials/consistent.h>
#include <perideal/materials/models.h>

#include <cmath>

namespace perideal
{
  FormTraits consistent_form()
  {
    // Half or twice the stabilisation changes errors by less than a tenth, eigenvalues by a third: so less in
    // motion. The horizon is the smallest with bonds in all directions.
    FormTraits result;
    result.name                        = "consistent";
    result.discretisation              = Discretisation::faces;
    result.solvers                     = {true, false, true};
    result.defaults.influence_function = "cubic spline";
    result.defaults.stabilisation      = {{1.1, 0.5}};
    result.defaults.horizon_factor     = 2.01;

    result.defaults.stabilisation_in_motion = {{0.5, 0.5}};
    return result;
  }

  void declare_stabilisation(dealii::ParameterHandler &prm, ModelParameters &parameters)
  {
    prm.add_parameter(
      "Stabilisation",
      parameters.stabilisation,
      "Consistent form: factor of the bonds' energy, > 0 [-]; automatic: 1.1 in 2-D, 0.5 "
      "in 3-D and in motion; it hardly matters. Form = family of correspondence: alpha of the penalty over "
      "Young's modulus, >= 0 [-], 0: none; automatic: 5, as published");
  }

  template <int dim>
  Consistent<dim>::Consistent(const InfluenceFunction &influence,
                              const double             stabilisation,
                              const double             horizon_factor)
    : influence(influence)
    // wd = (dim+2)/2 dim/m omega, m = m_1 horizon^(dim+2) the analytic weighted volume
    // (XOSB 24, 25, 28), horizon^dim = factor^dim V, horizon = |xi|/distance.
    , factor(stabilisation * dim * (dim + 2) /
             (influence.template weighted_volume<dim>(1.) * std::pow(horizon_factor, dim)))
  {
  }

  template <int dim>
  double Consistent<dim>::stabilising_modulus(const ElasticSolid<dim> &solid)
  {
    const double shear = solid.isotropic().shear_modulus();
    if (solid.is_isotropic())
      return shear;
    const double softest = 0.5 * smallest_stiffness(solid);
    return softest > 0 ? softest : shear;
  }

  PERIDEAL_INSTANTIATE_CLASS(Consistent)
} // namespace perideal
