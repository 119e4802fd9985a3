// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_materials_ordinary_h
#define perideal_materials_ordinary_h

#include <perideal/materials/influence_function.h>
#include <perideal/materials/linear_model.h>

#include <vector>

namespace perideal
{
  /// Weights of a full spherical family, by member (XOSB eqs. 24, 28); the
  /// deviatoric ones are (dim+2)/2 times these.
  /// ws_h = dim/m omega, m the weighted volume of the node's own horizon.
  template <int dim>
  void spherical_weights(const FamilyView<dim>   &family,
                         const InfluenceFunction &influence,
                         const double             thickness,
                         std::vector<double>     &hydrostatic);

  /**
   * Ordinary state-based peridynamics (linear peridynamic solid), linearised,
   * without surface or volume corrections: the baseline.
   */
  template <int dim>
  class Ordinary : public LinearModel<dim>
  {
  public:
    Ordinary(const InfluenceFunction &influence, const double thickness);

    FamilyShape shape() const override { return {1, false}; }
    bool        is_symmetric() const override { return true; }
    void        compute(const FamilyView<dim> &family, FamilyCoefficients &coefficients) override;

  private:
    InfluenceFunction   influence;
    double              thickness;
    std::vector<double> weights;
  };
} // namespace perideal

#endif
