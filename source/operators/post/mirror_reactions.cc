// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/post/mirror_reactions.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace perideal
{
  template <int dim>
  MirrorReactions<dim> sum_mirror_reactions(const ConstrainedOperator<dim> &system,
                                            const unsigned int              n_conditions)
  {
    const MirrorLayer<dim> &mirror = system.mirror_layer();
    MirrorReactions<dim>    result;
    result.force.resize(n_conditions);
    if (mirror.nodes().n_global == system.n_global())
      return result;

    NodalVector holders, values;
    system.initialize_all(holders);
    system.initialize_all(values);
    mirror.holders(holders);
    mirror.boundary_values(values);
    holders.update_ghost_values();
    values.update_ghost_values();

    // Every plane holds a component, so an image is known by its holders.
    const auto is_image = [&](const LocalIndex i) {
      for (int d = 0; d < dim; ++d)
        if (holders.local_element(dim * i + d) != 0)
          return true;
      return false;
    };
    const auto add = [&](const LocalIndex image, const dealii::Tensor<1, dim> &force) {
      for (int d = 0; d < dim; ++d)
        {
          const long holder = std::lround(holders.local_element(dim * image + d));
          if (holder > 0)
            {
              result.force[holder - 1][d] += force[d];
              result.work += force[d] * values.local_element(dim * image + d);
            }
        }
    };
    const LocalIndex n_owned = mirror.nodes().size();
    system.bond_operator().visit_bond_forces(
      [&](const LocalIndex i, const LocalIndex j, const dealii::Tensor<1, dim> &force_on_i) {
        const bool i_is_image = is_image(i), j_is_image = is_image(j);
        if (!i_is_image && j_is_image)
          add(j, force_on_i);
        // Of a bond that the partition cuts, the other rank counts its own real node.
        if (i_is_image && !j_is_image && j < n_owned)
          add(i, -force_on_i);
      });
    for (auto &force : result.force)
      force = dealii::Utilities::MPI::sum(force, system.communicator());
    result.work = dealii::Utilities::MPI::sum(result.work, system.communicator());
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(MirrorReactions)
  PERIDEAL_INSTANTIATE(sum_mirror_reactions)
} // namespace perideal
