// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_problem_bond_limits_h
#define perideal_problem_bond_limits_h

#include <perideal/operators/weights/calibrated_stretches.h>
#include <perideal/problem/discrete_body.h>

#include <functional>
#include <utility>

namespace perideal
{
  /// Returns the strain along a uniaxial stress of the tensile strength, and its contraction over that [-];
  /// {0, 0} of materials without one.
  template <int dim>
  std::pair<double, double> strain_of_strength(const Body<dim> &body, const dealii::types::material_id id);

  /// Whether bonds of a material soften from its tensile strength on.
  template <int dim>
  bool softens_from_strength(const Body<dim> &body, const dealii::types::material_id id)
  {
    return SofteningLaw(body.parameters.material.softening).softens() &&
           strain_of_strength(body, id).first > 0;
  }

  /// Returns the strain at which bonds of a material and a horizon begin to fail [-], whether they are
  /// calibrated or not: by the strength, a stretch that is given or the published formula; infinity: never.
  template <int dim>
  double first_strain(const Body<dim> &body, const dealii::types::material_id id, const double horizon);

  /// Knows the critical stretches of bonds, given by their ends and slot.
  template <int dim>
  class BondLimits
  {
  public:
    /// How bonds are calibrated besides: whether shares() is asked for; where families are looked up, may be
    /// null; of which owned nodes the families are, at least, empty: of all.
    struct Calibrating
    {
      bool                                  with_shares = false;
      CalibrationMemo                      *memo        = nullptr;
      std::function<bool(const LocalIndex)> is_wanted   = {};
    };
    /// Collective.
    BondLimits(const Body<dim>         &body,
               const DiscreteBody<dim> &discretisation,
               const Families<dim>     &families,
               const BondList          &bonds,
               const Calibrating       &calibrating);

    double operator()(const LocalIndex i, const LocalIndex j, const BondIndex slot) const;

    /// Whether a bond is calibrated, if it is to be; until then its stretches are the least they can be.
    bool is_known(const BondIndex slot) const { return calibrated.is_known(slot); }
    /// Whether all bonds of all ranks are.
    bool are_all_known() const { return calibrated.are_all_known; }

    /// The stretch at which a bond begins to soften: that with which families bear the tensile strength, of
    /// the weaker material; or a share of the stretch at which it would break at once.
    double first(const LocalIndex i, const LocalIndex j, const BondIndex slot) const;

    /// What cracks take of the fracture energy, by direction.
    const EnergyByDirection &shares() const { return calibrated.shares; }

  private:
    /// The square of the stretch for an end of a material.
    double square(const dealii::types::material_id id, const double of_unit_energy) const;

    const Body<dim>     &body;
    const Families<dim> &families;
    ModelParameters      model;
    SofteningLaw         law;
    CalibratedStretches  calibrated;
  };
} // namespace perideal

#endif
