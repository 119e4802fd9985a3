// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_force_contact_force_h
#define perideal_operators_force_contact_force_h

#include <perideal/operators/force/bond_force.h>
#include <perideal/operators/force/contact_parameters.h>
#include <perideal/output/lasting_state.h>

#include <functional>
#include <memory>
#include <vector>

namespace perideal
{
  /**
   * Computes the short-range force between nodes without an intact bond, which keeps fragments from passing
   * through each other (Macek & Silling 2007, Finite Elements in Analysis and Design 43): nodes that are
   * nearer than d_ij are pushed apart along the line between them, with the energy
   *
   *     k_ij (d_ij - |y_j - y_i|)^2/2,   k_ij = min(k_i, k_j),   k_i = stiffness K_i V_i/horizon_i^2,
   *     d_ij = min(r_i + r_j, distance |xi|),   r_i = distance D_i/2,
   *
   * K the bulk modulus of the body's dimension, D the spacing. With distance <= 1 nothing repels at rest, and
   * as bonds break longer than at rest no energy appears when they do.
   *
   * In the micromodulus c = 18 K/(pi horizon^4), or 12 K/(pi h horizon^3) in 2-D, a family holds its node
   * along any direction with sum_j c V_i V_j/(dim |xi|) = 12 K V/horizon^2. Macek and Silling's stiffness,
   * 15 c/horizon, is 3.2 K V/horizon^2 in 3-D at three spacings; hence the default. Such a pair adds at most
   * 2 x 3 K V/horizon^2 to an eigenvalue: what half a family holds, and at least half of the family is gone
   * where nodes touch. So the stable time step of the intact body stays one until many nodes press on one.
   *
   * Pairs are sought among two kinds. Those that were bonded once are the lost bonds; no search is needed.
   * Others are more than a horizon apart at rest: they are sought, at present positions, once nodes have
   * moved far enough to meet, and only between nodes on the surface or with a lost bond. Lists hold what may
   * touch until a node has moved by half a spacing, and are made anew then.
   *
   * Where a cell is halved, r of its halves may be larger than what cells of its size kept free between them:
   * these come nearer by a tenth of their spacing before they touch. Such halves would be thrown apart by
   * energy from nowhere, so they begin with as much less r as nothing pushes them.
   */
  template <int dim>
  class ContactForce
  {
  public:
    /// @param horizon_factor horizon over spacing
    /// @param bulk_modulus by material id [Pa]
    /// @param on_surface of owned nodes
    ContactForce(const std::shared_ptr<const Families<dim>>                    &families,
                 const ContactParameters                                       &parameters,
                 const double                                                   horizon_factor,
                 const std::function<double(const dealii::types::material_id)> &bulk_modulus,
                 const std::vector<bool>                                       &on_surface);

    /// Adds the forces [N] at the positions of the last @p bonds.compute() to those of owned nodes.
    /// Collective.
    void add(NodalVector &force, const BondForce<dim> &bonds);

    std::size_t memory_consumption() const;

    /// Registers r over distance D/2 of nodes, from which it differs where cells were halved.
    void register_state(LastingState &state);

    /// Makes the lists anew in the next add(), as a run does that continues from a checkpoint.
    void forget_lists() { lists.are_made = false; }

    /// Energy of the contacts of all ranks at the last add() [J]. Collective.
    double energy() const;

    /// Pairs in contact at the last add(); the largest overlap over its contact distance so far. Collective.
    GlobalIndex n_contacts() const;
    double      largest_overlap() const;

    /// Searches so far, and nodes that the last one left out.
    unsigned int n_searches() const { return sought.n_searches; }
    GlobalIndex  n_left_out() const { return sought.n_left_out; }

  private:
    /// Two nodes that may touch; the first is owned.
    struct Pair
    {
      LocalIndex i, j;
      double     distance, stiffness;
    };

    Pair   pair_of_lost(const typename BondForce<dim>::LostBond &bond) const;
    double present_length(const Pair &pair) const;
    void   take_lost_bonds(const BondForce<dim> &bonds);
    /// Whether a node of any rank has moved by half its spacing since the lists were made. Collective.
    bool lists_are_old() const;
    /// Whether nodes of any rank are so far from rest that before the lists are old they may meet others than
    /// their family. Collective.
    bool may_meet_strangers() const;
    void list_lost_bonds(const BondForce<dim> &bonds);
    /// Lists what may touch. Collective.
    void make_lists(const BondForce<dim> &bonds);
    /// Lessens r of halves until no pair of the lists pushes them. Collective.
    void release_halves();
    /// Brings positions of strangers up to date, and of their ghosts. Collective.
    void place_strangers();
    /// Brings r of nodes of other ranks up to date, and which are halves. Collective.
    void publish_reach();
    /// Over the spacing: what may come within the contact distance until the lists are old.
    double search_radius() const { return parameters.distance + 1.; }
    /// What may touch, at present positions; sets the nodes sought.
    NodeCloud<dim> candidates();
    void           search();
    bool           are_family(const LocalIndex i, const GlobalIndex j) const;
    /// The nodes are the pair's ends among the families; beyond the owned ones: not owned.
    void repel(const Pair      &pair,
               const double    *y_i,
               const double    *y_j,
               const LocalIndex node_i,
               const LocalIndex node_j,
               NodalVector     &force);

    std::shared_ptr<const Families<dim>> families;
    const ContactParameters              parameters;
    const double                         horizon_factor;

    std::function<double(const dealii::types::material_id)> bulk_modulus;
    /// Of local nodes: spacing, r [m], stiffness [N/m].
    std::vector<double> spacing, reach, stiffness;
    /// Of local nodes: of a cell that was halved just now; empty where there are none on any rank.
    std::vector<bool> is_half;

    const NodeRecord *position = nullptr;

    /// What may touch: pairs that were bonded once, by the numbers of the families, and strangers, by those
    /// of the last search.
    struct Lists
    {
      std::vector<dealii::Point<dim>> made_at;
      bool                            are_made     = false;
      std::size_t                     n_lost_taken = 0;
      std::vector<Pair>               once_bonded, strangers;
      bool                            any_strangers = false;
    };
    Lists lists;

    /// Owned nodes that are sought: on the surface or with a lost bond. Nodes among which the last search
    /// looked for strangers, their r [m] and whether they are halves, and how many it left out.
    struct Search
    {
      std::vector<bool>       is_exposed;
      std::vector<LocalIndex> node;
      NodalVector             position, reach;
      unsigned int            n_searches = 0;
      GlobalIndex             n_left_out = 0;
    };
    Search sought;

    /// Of the contacts of this rank at the last add(); the overlap is the largest so far.
    struct Sums
    {
      double energy = 0, overlap = 0, ends = 0;
    };
    Sums own;
  };
} // namespace perideal

#endif
