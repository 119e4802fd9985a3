// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_problem_carried_softening_h
#define perideal_problem_carried_softening_h

#include <perideal/output/checkpoint.h>
#include <perideal/problem/problem.h>

namespace perideal
{
  /**
   * What softening left of the bonds around nodes, for bonds that join halves of their cells: these were no
   * bonds before.
   *
   * Bonds of halves bear as much of their largest force, f, as the bonds of their cells along the same
   * direction e did. Where the strain around a node is uniform the openings of its bonds are about quadratic
   * forms of e, as their stretches are; so 1 - f is fitted by e.H e, and a bond gets the mean of its ends.
   * What they have taken of the energy of a crack is then gone of the halves, too: in the row of them in
   * which it opens in the end it takes no more than among equal cells. The other rows are softer than they
   * were: the body gives way a little.
   *
   * Where bonds wait for a stress, those that softened were told the stretch at which they begin, e.F e.
   */
  template <int dim>
  struct CarriedSoftening
  {
    /// Of each node: whether it is that of a half, 0 or 1, and the components of H and F.
    static constexpr unsigned int n_components = dim * (dim + 1) / 2, width = 1 + 2 * n_components;

    /// What bonds may have lost, 1 - f, of cells that are halved: beyond that the strain has gone, or is
    /// about to go, into one row of cells, and halves would not find it there [-].
    static constexpr double largest_loss = 0.5;

    /// The node array of a Checkpoint that soften_halves() looks at.
    static constexpr char name[] = "softening of halves";

    /// Fits H and F around the owned nodes of a problem, whose force has bonds; none is that of a half.
    /// @param softened the bonds that softened, with SoftenedBond
    static NodeArray fit(const Problem<dim> &problem, const BondArray &softened);

    /// Softens the bonds that end in halves, where a state has such. Collective.
    static void soften_halves(Problem<dim> &problem, const Checkpoint &state);
  };
} // namespace perideal

#endif
