// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/boundary/transfer_functions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace perideal
{
  template <int dim>
  TransferFunctions<dim>::TransferFunctions(const NodeCloud<dim>                &nodes,
                                            const std::vector<SurfaceFace<dim>> &faces)
    : surface(faces)
    , list(faces.size())
    , sums_over_nodes(faces.size(), 0.)
    , sums_over_faces(nodes.size(), 0.)
    , position(nodes.position)
    , volume(nodes.volume)
    , comm(nodes.communicator)
  {
    visit_nearby_faces<dim>(
      nodes, surface, [&](const LocalIndex i, const std::vector<const SurfaceFace<dim> *> &near) {
        for (const auto *face : near)
          {
            const double distance = position[i].distance(face->centre), horizon = nodes.horizon[i];
            // On a grid, faces at the horizon itself belong to it whatever rounding says.
            if (distance > horizon * (1 + 1e-9))
              continue;
            const std::size_t k = face - surface.data();
            const double      q = horizon / (distance + horizon);
            list[k].emplace_back(i, q);
            sums_over_nodes[k] += q * volume[i];
            sums_over_faces[i] += q * face->area;
          }
      });
    dealii::Utilities::MPI::sum(sums_over_nodes, comm, sums_over_nodes);
    if (std::count(sums_over_nodes.begin(), sums_over_nodes.end(), 0.) > 0)
      throw InputError("a boundary face lies in the horizon of no node, so that its tractions act on none")
        .parameter("Nodes/Horizon factor")
        .hint("enlarge the factor, or take less slender cells");
    for (std::size_t k = 0; k < surface.size(); ++k)
      sum_over_both += sums_over_nodes[k] * surface[k].area;
  }

  PERIDEAL_INSTANTIATE_CLASS(TransferFunctions)
} // namespace perideal
