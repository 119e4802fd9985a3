// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_parameters_elastic_constants_h
#define perideal_parameters_elastic_constants_h

#include <perideal/parameters/choice.h>

namespace perideal
{
  /// How a two-dimensional body stands in space; three-dimensional bodies have no choice.
  enum class PlaneAssumption
  {
    plane_stress,
    plane_strain,
    solid
  };

  /// Those that a scene may choose.
  template <>
  struct ChoiceNames<PlaneAssumption>
  {
    static constexpr const char *list[] = {"plane stress", "plane strain"};
  };

  /// Linear isotropic elasticity, stored as Young's modulus [Pa] and Poisson's ratio.
  struct ElasticConstants
  {
    double          young_modulus = 0;
    double          poisson_ratio = 0;
    PlaneAssumption assumption    = PlaneAssumption::solid;

    /// Those with given moduli in the problem's own dimension.
    static ElasticConstants
    of_moduli(const double bulk_modulus, const double shear_modulus, const PlaneAssumption assumption);

    /// mu = E/(2(1+nu)) [Pa].
    double shear_modulus() const;

    /// kappa [Pa] such that W = kappa/2 tr(eps)^2 + mu |dev eps|^2 with the
    /// deviator of the problem's own dimension: 3-D E/(3(1-2nu)), plane strain
    /// E/(2(1+nu)(1-2nu)), plane stress E/(2(1-nu)) (XOSB eq. 66).
    double bulk_modulus() const;

    /// lambda [Pa] of sigma = lambda tr(eps) I + 2 mu eps in the problem's own
    /// dimension: kappa - 2 mu/dim.
    double lame_lambda() const;
  };
} // namespace perideal

#endif
