// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_problem_failure_h
#define perideal_problem_failure_h

#include <perideal/fracture/no_fail_zones.h>
#include <perideal/materials/separation.h>
#include <perideal/neighbourhood/precrack.h>
#include <perideal/operators/force/bond_force.h>
#include <perideal/operators/weights/calibration_memo.h>
#include <perideal/problem/discrete_body.h>

#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace perideal
{
  /// What of a body is cut, what may break, and when.
  template <int dim>
  struct Failure
  {
    /// Reads precracks and no-fail zones. Collective.
    /// @throws InputError on text that is no precrack or zone.
    void prepare(const Body<dim> &body);

    /// Returns a test of bonds that precracks cut; empty where there are none. It refers to this object.
    BondPredicate<dim> precrack_test() const;

    /// Every precrack must cut something. Collective.
    /// @throws InputError naming a precrack that crosses no bond.
    void check_precracks(const Body<dim> &body, const Families<dim> &families) const;

    /// What the bonds of the body break at.
    struct Breaking
    {
      /// Root of the mean square of the critical stretches within each material [-]; none: unbreakable.
      std::map<dealii::types::material_id, double> stretch;
      /// What cracks take of the fracture energy, by direction; none where a formula gives the stretches.
      std::optional<EnergyByDirection> share_of_energy;
    };
    /// Looks at the bonds of a scene that breaks them by stretch, where they are made on demand at those of
    /// some nodes. Collective.
    static Breaking breaking(const Body<dim> &body, const DiscreteBody<dim> &discretisation);

    /// Cuts what precracks cross and gives bonds their limits. Collective.
    void apply(const Body<dim> &body, const DiscreteBody<dim> &discretisation, BondForce<dim> &force);

    /// What families were calibrated to, where a scene calibrates more than once; else null.
    std::shared_ptr<CalibrationMemo> calibrations;
    /// Whether bonds are calibrated on demand, for which the members of families are needed.
    bool                              calibrates_later = false;
    std::vector<Precrack<dim>>        precracks;
    std::unique_ptr<NoFailZones<dim>> no_fail_zones;
    /// Nodes of all ranks in these zones, and bonds that precracks cut.
    GlobalIndex n_no_fail_nodes = 0, n_cut_bonds = 0;
  };

  /// Returns the share of the family behind broken bonds and precracks, by owned node.
  template <int dim>
  std::vector<double> total_damage(const BondForce<dim> &force);
} // namespace perideal

#endif
