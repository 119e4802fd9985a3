// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/nodes/cell_keys.h>
#include <perideal/problem/present_state.h>

namespace perideal
{
  template <int dim>
  CheckpointNodes nodes_of_state(const Problem<dim> &problem)
  {
    const Families<dim> &families = *problem.discretisation.families;
    CheckpointNodes      result{cell_keys(*problem.body.mesh, *problem.body.nodes),
                           families.n_owned(),
                           problem.loading.supports->unknowns().n_global,
                           families.communicator};
    if (problem.loading.supports->surface_nodes())
      {
        // Cells have at most six; no cell uses the highest bits.
        std::vector<std::uint64_t> n_of_cell(problem.body.nodes->size(), 0);
        for (const LocalIndex cell : problem.loading.supports->surface_nodes()->cell_nodes())
          result.key.push_back(result.key[cell] | (++n_of_cell[cell] << 61));
      }
    // Halves of keys are exact as doubles.
    NodalVector halves(families.make_partitioner(2));
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      {
        halves.local_element(2 * i)     = static_cast<double>(result.key[i] >> 32);
        halves.local_element(2 * i + 1) = static_cast<double>(result.key[i] & 0xffffffffu);
      }
    halves.update_ghost_values();
    for (LocalIndex i = families.n_owned(); i < families.n_local(); ++i)
      result.key.push_back((static_cast<std::uint64_t>(halves.local_element(2 * i)) << 32) |
                           static_cast<std::uint64_t>(halves.local_element(2 * i + 1)));
    return result;
  }

  template <int dim>
  Checkpoint state_after(const Problem<dim> &problem, const std::uint64_t step, const double time)
  {
    Checkpoint checkpoint;
    checkpoint.header = {{"step", step}, {"time", time}, {"parameters", problem.run.context.parameters}};
    problem.lasting.save(checkpoint);
    return checkpoint;
  }

  PERIDEAL_INSTANTIATE(nodes_of_state)
  PERIDEAL_INSTANTIATE(state_after)
} // namespace perideal
