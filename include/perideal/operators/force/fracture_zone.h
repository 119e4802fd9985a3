// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_force_fracture_zone_h
#define perideal_operators_force_fracture_zone_h

#include <perideal/neighbourhood/families.h>

#include <deal.II/numerics/rtree.h>

#include <memory>
#include <utility>
#include <vector>

namespace perideal
{
  /**
   * Knows where a body is one of bonds, which may break, and where it is one of cells: chi is the share of
   * the bonds in the energy of each node. It is one around nodes that came near to breaking, falls to zero
   * over ramp more, and never falls with time. An abrupt change from one form to the
   * other would leave forces of its own, and bend cracks.
   */
  template <int dim>
  class FractureZone
  {
  public:
    /// In spacings of the node in the middle: what follows from where chi is one until it is zero, and up to
    /// where further nodes do not let the zone grow again.
    static constexpr double ramp = 3., core_radius = 2.;

    /// @param held where prescribed values at faces of this rank act on cells, with the spacing of these:
    /// bonds do not feel them, so that chi is zero there and rises over ramp. Collective.
    FractureZone(const std::shared_ptr<const Families<dim>>               &families,
                 const std::vector<std::pair<dealii::Point<dim>, double>> &held);

    /// chi by local node.
    const std::vector<double> &share() const { return chi; }
    /// Whether chi is anywhere larger than zero, on any rank.
    bool is_there() const { return there; }
    /// Whether an owned node needs no further growth around it.
    bool is_core(const LocalIndex i) const { return core[i]; }
    /// How often it grew.
    unsigned int version() const { return n_growths; }
    /// Number of nodes of all ranks whose bonds count. Collective.
    GlobalIndex n_nodes() const;

    /// Grows around owned nodes; returns whether chi has changed. Collective.
    bool grow(const std::vector<LocalIndex> &nodes);

    /// chi of owned nodes and which of them are core, as 0 or 1, one after the other.
    std::vector<double> state() const;
    /// Goes on from such a state of an earlier run. Collective.
    void restore(const std::vector<double> &state);

    std::size_t memory_consumption() const;

  private:
    /// Up to where chi is one around an owned node, in its spacings: bonds that fail have whole families of
    /// whole ones around them.
    double full_radius(const LocalIndex i) const;
    using Entry = std::pair<dealii::Point<dim>, LocalIndex>;

    /// Calls visit(owned node, distance) for those within a radius [m].
    template <typename Visit>
    void visit_within(const dealii::Point<dim> &middle, const double radius, const Visit &visit) const;
    /// Tells the ghosts. Collective.
    void update_ghosts();

    std::shared_ptr<const Families<dim>> families;
    dealii::RTree<Entry>                 tree;
    std::vector<double>                  chi, largest;
    std::vector<bool>                    core;
    bool                                 there     = false;
    unsigned int                         n_growths = 0;
    NodalVector                          ghosted;
  };
} // namespace perideal

#endif
