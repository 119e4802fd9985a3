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

    static FamilyShape family_shape() { return {1, false}; }

    FamilyShape shape() const override { return family_shape(); }
    bool        is_symmetric() const override { return true; }
    void        compute(const FamilyView<dim> &family, FamilyCoefficients &coefficients) override;

  private:
    InfluenceFunction   influence;
    double              thickness;
    std::vector<double> weights;
  };

  /**
   * Stretch at which a bond of an ordinary state-based material breaks, so that
   * opening a unit of crack surface takes the fracture energy [-].
   *
   *     3-D: s0^2 = G0 / ((3 mu + (3/4)^4 (kappa - 5 mu/3)) horizon)
   *     2-D: s0^2 = G0 / ((6 mu/pi + 16/(9 pi^2) (kappa - 2 mu)) horizon)
   *
   * (TIPD eqs. 43 and 56, where G stands for G0; Madenci and Oterkus 2014.) It is that of springs where
   * Poisson's ratio is theirs.
   *
   * @param fracture_energy G0 [J/m^2]
   * @param horizon [m]
   */
  double ordinary_critical_stretch(const ElasticConstants &constants,
                                   const double            fracture_energy,
                                   const double            horizon);
} // namespace perideal

#endif
