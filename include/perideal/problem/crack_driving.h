// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_problem_crack_driving_h
#define perideal_problem_crack_driving_h

#include <perideal/fracture/crack_tips.h>
#include <perideal/fracture/domain_integral.h>
#include <perideal/problem/problem.h>

#include <limits>
#include <optional>
#include <vector>

namespace perideal
{
  /// What the node nearest to a point has.
  struct NearestNode
  {
    /// [m]
    double                     distance = std::numeric_limits<double>::max(), spacing = 0, horizon = 0;
    dealii::types::material_id material = 0;
  };

  /// Finds the node nearest to a point. Collective.
  template <int dim>
  NearestNode nearest_node(const Problem<dim> &problem, const dealii::Point<dim> &point);

  /// Returns the tips of the precracks: those of their ends that lie in the body, not on its surface.
  /// Collective.
  template <int dim>
  std::vector<CrackEnd<dim>> precrack_tips(const Problem<dim> &problem);

  /// Returns the tip of a precrack next to a point; nothing where there is none. Collective.
  template <int dim>
  std::optional<CrackEnd<dim>> nearest_tip(const Problem<dim> &problem, const dealii::Point<dim> &point);

  /**
   * Computes what drives plane cracks from the displacement and the bond forces of an equilibrium, by domain
   * integrals over rings of cells (DomainIntegral). Displacement gradients come from the whole bonds of
   * families (FamilyQuadratics); stress and energy density from the forces of the bonds (partial_stress()):
   * what these carry, beside surfaces and in families of another stiffness than the solid's too. G is then
   * the change of the energy of the bonds with the length of the crack. Forces by a law of the continuum have
   * all three by that law.
   */
  class CrackDriving
  {
  public:
    /// The problem must outlive this object. Collective.
    explicit CrackDriving(const Problem<2> &problem);

    /// A tip as it is now.
    struct Tip
    {
      PlaneTip tip;
      /// Outer radius of the ring [m]; 0: as large as there is room, up to so many of the largest horizons in
      /// it.
      double                  radius          = 0;
      static constexpr double most_horizons   = 8;
      static constexpr double fewest_horizons = 2;
      /// Largest radius with nothing in the way that the precracks and the body do not tell [m].
      double limit = std::numeric_limits<double>::max();
    };

    struct Result
    {
      /// None where there is no room for a ring.
      std::optional<CrackDrive> drive;
      /// Outer radius of the ring, and the largest for which there is room [m].
      double radius = 0, room = 0;
    };

    /// Collective.
    std::vector<Result> compute(const std::vector<Tip> &tips) const;

    /**
     * Returns how far it is from a tip to what must not be in its ring: the surface of the body, another
     * material, point loads, precracks but for those that are straight behind the tip, and the other ends of
     * these [m]. Collective.
     */
    double room(const PlaneTip &tip) const;

  private:
    /**
     * Returns the outer radius of a ring whose tip tells none [m], negative where there is no room for any.
     * Cells that get smaller towards the tip say nothing about how far from it the field is well described:
     * there the smallest ones stand where it is worst. Collective.
     */
    double radius_in(const PlaneTip &tip, const double room, const double horizon_at_tip) const;

    /// What the integrals need of nodes.
    struct States
    {
      std::vector<dealii::Tensor<2, 2>> gradient, stress;
      std::vector<double>               energy_density;
    };
    /// By owned node in the order given. Collective.
    States states(const std::vector<LocalIndex> &nodes) const;

    /// On which side of a crack a node on its line is.
    DomainIntegral::Side side(const PlaneTip &tip, const LocalIndex node) const;

    const Problem<2>        &problem;
    std::vector<CrackEnd<2>> ends;
  };
} // namespace perideal

#endif
