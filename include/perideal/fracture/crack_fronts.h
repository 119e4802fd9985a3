// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_fracture_crack_fronts_h
#define perideal_fracture_crack_fronts_h

#include <perideal/nodes/nodes.h>
#include <perideal/output/lasting_state.h>

#include <vector>

namespace perideal
{
  /**
   * Follows the fronts along which bonds soften from one load step to the next, and moves fields with them. A
   * crack that goes on steadily does in each step what it did in the last one, ahead of it: moved as far as
   * its front has moved, the motion of the last step predicts the next.
   *
   * A front is what lost some of its bonds in a step and hangs together within horizons. It has moved from
   * the centre of the nearest front of the step before to its own; centres weigh nodes by volume times loss.
   */
  template <int dim>
  class CrackFronts
  {
  public:
    /// @param nodes which must outlive this object
    explicit CrackFronts(const NodeCloud<dim> &nodes);

    /// Begins where nodes have this damage, or goes on there after a run before.
    void begin(const std::vector<double> &damage);

    /// Notes the damage of owned nodes at the end of a step.
    void note(const std::vector<double> &damage);

    /// Moves a motion with the fronts around which it took place: near them that of where a node will be in
    /// their place, far from them the node's own. False, with nothing done, where none has moved. Collective.
    bool carry(const NodalVector &motion, NodalVector &carried) const;

    void register_state(LastingState &state);

  private:
    /// The fronts of a step: nodes of all ranks with the number of their front each, centres by number.
    struct Fronts
    {
      std::vector<dealii::Point<dim>> points, centres;
      std::vector<unsigned int>       front;
      /// The largest horizon of the points [m].
      double horizon = 0;
    };
    /// Collective.
    Fronts find(const std::vector<double> &lost) const;

    const NodeCloud<dim> &nodes;
    /// Damage of owned nodes, and what of it came in the last step and in the one before.
    std::vector<double> damage, lost, lost_before;
  };
} // namespace perideal

#endif
