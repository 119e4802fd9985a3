// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/simulation.h>
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/base/rigid_body_motions.h>
#include <perideal/base/text.h>
#include <perideal/output/summary.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <sstream>

// Simulation: parts of the body that hang together with nothing else, from the beginning or in the end.

namespace perideal
{
  template <int dim>
  void Simulation<dim>::find_parts()
  {
    if (!scene.parts)
      scene.parts.emplace(*scene.mesh, *scene.nodes, *scene.families, precrack_test());
  }

  template <int dim>
  void Simulation<dim>::check_bodies_held() const
  {
    using dealii::Utilities::MPI::max;
    using dealii::Utilities::MPI::sum;
    const DirichletNodes<dim> held(scene.faces, scene.loads, scene.nodes->size());
    const auto               &body_of_node = scene.parts->body_of_node;
    for (unsigned int body = 0; body < scene.parts->n_bodies; ++body)
      {
        dealii::Tensor<1, dim> sum_of_places;
        double                 number = 0, reach = 0;
        for (LocalIndex i = 0; i < scene.nodes->size(); ++i)
          if (body_of_node[i] == body)
            {
              sum_of_places += scene.nodes->position[i];
              ++number;
            }
        const dealii::Point<dim> centre(sum(sum_of_places, communicator) / sum(number, communicator));
        for (LocalIndex i = 0; i < scene.nodes->size(); ++i)
          if (body_of_node[i] == body)
            reach = std::max(reach, centre.distance(scene.nodes->position[i]) + scene.nodes->spacing[i]);
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
          "the mesh has " + std::to_string(scene.parts->n_bodies) +
          " bodies that nothing joins, and the conditions leave a rigid-body motion of the one about (" +
          place.str() + ") free: " + RigidBodyMotions<dim>::describe(free))
          .parameter("Boundary conditions")
          .hint(
            "hold each of them, or mesh them so that they share faces; Rigid body motions = remove serves "
            "a single body");
      }
  }

  template <int dim>
  void Simulation<dim>::warn_of_large_rotations()
  {
    if (!parameters.model.is_tensor_involved() || !scene.force)
      return;
    const BondList   &bonds = scene.force->bond_list();
    std::vector<bool> is_lost(bonds.n_slots(), false);
    for (const auto &bond : scene.force->lost_bonds())
      is_lost[bond.slot] = true;
    const NodeRecord *y       = scene.force->positions();
    const auto       &x       = scene.families->position;
    double            largest = 0;
    for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
      for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
        if (const LocalIndex j = bonds.neighbour[slot]; j != i && !is_lost[slot])
          {
            dealii::Tensor<1, dim> moved;
            for (int d = 0; d < dim; ++d)
              moved[d] = (y[j].value[d] - y[i].value[d]) - (x[j][d] - x[i][d]);
            largest = std::max(largest, moved.norm() / x[i].distance(x[j]));
          }
    largest = dealii::Utilities::MPI::max(largest, communicator);
    // Taken for small, a rotation by w stretches by w^2/2: 0.5 % here.
    if (largest > 0.1)
      screen << "warning     the ends of bonds have moved against each other by up to "
             << short_number(largest) << " times their length: bonds with tensors know small rotations only"
             << std::endl;
  }

  template <int dim>
  void Simulation<dim>::warn_of_loose_nodes(const GlobalIndex n_loose)
  {
    if (n_loose == 0)
      return;
    summary["damage"]["floating_nodes"] = n_loose;
    screen
      << "warning     " << grouped(n_loose)
      << " nodes hang loose, held by weak springs where they came loose: loads on them move them as far as "
         "these give"
      << std::endl;
  }

  PERIDEAL_INSTANTIATE_CLASS(Simulation)

} // namespace perideal
