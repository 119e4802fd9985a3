// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_weights_calibrated_stretches_h
#define perideal_operators_weights_calibrated_stretches_h

#include <perideal/materials/separation.h>
#include <perideal/neighbourhood/bond_list.h>
#include <perideal/neighbourhood/families.h>

#include <functional>
#include <vector>

namespace perideal
{
  class CalibrationMemo;

  /// What of a material decides at which stretches its bonds fail.
  template <int dim>
  struct BondFracture
  {
    /// On the mean over all directions [J/m^2]; 0: its bonds do not break, or not by this.
    double energy = 0;
    /// G of the energy |G n| of planes of the normal n, over the mean [-].
    dealii::SymmetricTensor<2, dim> by_normal = dealii::unit_symmetric_tensor<dim>();
    /// The strain along a uniaxial stress of the tensile strength, and the one across it over this, as a
    /// contraction [-]; 0: bonds begin to soften at a share of their critical stretches.
    double of_strength = 0, lateral = 0;
  };

  /// How bonds are calibrated.
  template <int dim>
  struct Calibration
  {
    std::function<BondFracture<dim>(const dealii::types::material_id)> fracture_of;
    SofteningLaw                                                       law;
    /// Share of the critical stretch at which bonds begin to soften whose material does not say it.
    double first_share = 1.;
    /// Square of the critical stretch of a continuum of bonds for a unit of the mean fracture energy, by
    /// material and horizon [m^2/J]. Where cells grow at once, sums over part of a family, as a crack leaves
    /// them, may count many times what those over all do, and its bonds would break far too early; none is
    /// taken below a share of this. Empty: all are taken as they are.
    std::function<double(const dealii::types::material_id, const double)> of_continuum;
    /// Of which owned nodes families are calibrated, and some more where that takes no time worth speaking
    /// of; empty, or without of_continuum: all.
    std::function<bool(const LocalIndex)> is_wanted;
    /// Whether the energies by direction are looked at, too.
    bool with_shares = false;
    /// Where families are looked up first, and kept; null: nowhere. All else here must be as it was.
    CalibrationMemo *memo = nullptr;
  };

  /// Critical stretches by which cracks take the fracture energy, as the bonds of whole families stand
  /// (Separation): what the families of either end make of them. Bonds that soften have them for s_d.
  struct CalibratedStretches
  {
    /// Squares of the stretches for a unit of the mean fracture energy, by slot [m^2/J]; 0 where a family has
    /// no say. Of families that are not calibrated yet, - the least that they can be.
    std::vector<double> near, far;
    /// Where bonds begin to soften, so that the family bears the tensile strength (BulkStrength), by slot
    /// [-], or the least that this can be; 0 without a strength; empty where bonds break at once.
    std::vector<double> first_near, first_far;
    /// What planes take of the fracture energy, by direction, on the mean over the families [-].
    EnergyByDirection shares;

    /// Whether both ends of a bond are calibrated.
    bool is_known(const BondIndex slot) const { return near.empty() || (near[slot] >= 0 && far[slot] >= 0); }
    /// Whether all families of all ranks are.
    bool are_all_known = true;
  };

  /// Calibrates the bonds of all whole families of materials that break, as if no bond was cut. Collective.
  template <int dim>
  CalibratedStretches calibrate_stretches(const Families<dim>    &families,
                                          const BondList         &bonds,
                                          LinearModel<dim>       &model,
                                          const SolidOf<dim>     &solid_of,
                                          const Calibration<dim> &how);
} // namespace perideal

#endif
