// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_post_mirror_reactions_h
#define perideal_operators_post_mirror_reactions_h

#include <perideal/operators/system/constrained_operator.h>

#include <vector>

namespace perideal
{
  /// Holds the reactions of the boundaries behind a mirrored layer.
  template <int dim>
  struct MirrorReactions
  {
    /// Force on the body by condition [N], held components only.
    std::vector<dealii::Tensor<1, dim>> force;
    /// That force times the prescribed displacement [J].
    double work = 0;
  };

  /**
   * Sums the forces of the bonds between real and fictitious nodes, as of the
   * last internal_force(). Forces along a free component cancel between a bond
   * and its mirror image. Collective.
   */
  template <int dim>
  MirrorReactions<dim> sum_mirror_reactions(const ConstrainedOperator<dim> &system,
                                            const unsigned int              n_conditions);
} // namespace perideal

#endif
