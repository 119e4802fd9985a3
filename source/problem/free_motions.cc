// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/base/rigid_body_motions.h>
#include <perideal/problem/free_motions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <sstream>

namespace perideal
{
  namespace
  {
    /// Holds each of several bodies against its own conditions.
    /// @throws InputError when one of them can move as a whole. Collective.
    template <int dim>
    void check_bodies_held(const Loading<dim> &loading, const ConnectedParts<dim> &parts)
    {
      using dealii::Utilities::MPI::max;
      using dealii::Utilities::MPI::sum;
      const Nodes<dim>         &nodes        = *loading.body.nodes;
      const MPI_Comm            communicator = nodes.communicator;
      const DirichletNodes<dim> held(loading.body.faces, loading.loads, nodes.size());
      const auto               &body_of_node = parts.body_of_node;
      for (unsigned int body = 0; body < parts.n_bodies; ++body)
        {
          dealii::Tensor<1, dim> sum_of_places;
          double                 number = 0, reach = 0;
          for (LocalIndex i = 0; i < nodes.size(); ++i)
            if (body_of_node[i] == body)
              {
                sum_of_places += nodes.position[i];
                ++number;
              }
          const dealii::Point<dim> centre(sum(sum_of_places, communicator) / sum(number, communicator));
          for (LocalIndex i = 0; i < nodes.size(); ++i)
            if (body_of_node[i] == body)
              reach = std::max(reach, centre.distance(nodes.position[i]) + nodes.spacing[i]);
          RigidBodyMotions<dim> motions(centre, max(reach, communicator));
          for (const auto &entry : held.entries())
            if (body_of_node[entry.node] == body)
              motions.hold(entry.point, entry.component);
          const auto free = motions.free_motions(communicator);
          if (free.empty())
            continue;
          std::ostringstream place;
          place << centre;
          throw InputError(
            "the mesh has " + std::to_string(parts.n_bodies) +
            " bodies that nothing joins, and the conditions leave a rigid-body motion of the one about (" +
            place.str() + ") free: " + RigidBodyMotions<dim>::describe(free))
            .parameter("Boundary conditions")
            .hint("hold each of them, or mesh them so that they share faces; Rigid body motions = remove "
                  "serves a single body");
        }
    }

    /// The motions of a single body, with none of them held.
    template <int dim>
    RigidBodyMotions<dim> motions_of(const Mesh<dim> &mesh, MPI_Comm communicator)
    {
      const auto         box = dealii::GridTools::compute_bounding_box(mesh.triangulation);
      dealii::Point<dim> lower, upper;
      for (int d = 0; d < dim; ++d)
        {
          lower[d] = dealii::Utilities::MPI::min(box.lower_bound(d), communicator);
          upper[d] = dealii::Utilities::MPI::max(box.upper_bound(d), communicator);
        }
      return RigidBodyMotions<dim>(lower + 0.5 * (upper - lower), lower.distance(upper));
    }
  } // namespace

  template <int dim>
  NullSpace<dim> find_free_motions(const Loading<dim> &loading, const ConnectedParts<dim> &parts)
  {
    if (parts.n_bodies > 1)
      {
        check_bodies_held(loading, parts);
        return {};
      }
    const Body<dim>      &body         = loading.body;
    const NodeCloud<dim> &unknowns     = loading.supports->unknowns();
    const MPI_Comm        communicator = body.nodes->communicator;
    RigidBodyMotions<dim> motions      = motions_of(*body.mesh, communicator);
    loading.supports->hold(motions);
    const auto free = motions.free_motions(communicator);
    if (free.empty())
      return {};
    if (body.parameters.loads.rigid_body_motions == FreeMotions::error)
      throw InputError("the conditions leave a rigid-body motion free: " +
                       RigidBodyMotions<dim>::describe(free))
        .parameter("Boundary conditions")
        .hint("hold these motions, or, where the loads balance, set Boundary conditions/Rigid body "
              "motions = remove");
    NodalVector      layout;
    dealii::IndexSet owned(dim * unknowns.n_global);
    owned.add_range(dim * unknowns.first_global, dim * (unknowns.first_global + unknowns.size()));
    layout.reinit(owned, communicator);
    return NullSpace<dim>(unknowns, motions, free, layout);
  }

  PERIDEAL_INSTANTIATE(find_free_motions)
} // namespace perideal
