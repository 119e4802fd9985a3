// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/treatments/supports.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace perideal
{
  template <int dim>
  Supports<dim>::Supports(const TreatedBody<dim> &body)
    : body(body)
    , mirror(std::make_shared<MirrorLayer<dim>>(body.nodes))
    , held_nodes({}, body.loads, body.nodes.size())
  {
  }

  template <int dim>
  void Supports<dim>::make_face_values(const std::vector<BoundaryPoint<dim>> &points)
  {
    values = hold_nodes() ? std::make_shared<FaceValues<dim>>() :
                            std::make_shared<FaceValues<dim>>(points, body.loads);
  }

  template <int dim>
  void Supports<dim>::set_face_values(const double time) const
  {
    if (values)
      values->set_time(body.loads, time);
  }

  template <int dim>
  void Supports<dim>::hold_layers()
  {
    const unsigned int n_layers = body.parameters.layers;
    held_nodes = n_layers > 1 ? DirichletNodes<dim>(body.mesh, body.nodes, body.faces, body.loads, n_layers) :
                                DirichletNodes<dim>(body.faces, body.loads, body.nodes.size());
  }

  template <int dim>
  void Supports<dim>::set_displacements(const double time, NodalVector &displacement) const
  {
    mirror->set_time(body.loads, time);
    held_nodes.set_boundary_values(body.loads, time, displacement);
  }

  template <int dim>
  void Supports<dim>::hold(RigidBodyMotions<dim> &motions) const
  {
    if (hold_nodes())
      {
        for (const auto &entry : held_nodes.entries())
          motions.hold(unknowns().position[entry.node], entry.component);
        return;
      }
    const DirichletNodes<dim> at_faces(body.faces, body.loads, body.nodes.size());
    for (const auto &entry : at_faces.entries())
      motions.hold(entry.point, entry.component);
    for (const BoundaryCondition<dim> &condition : body.loads.conditions)
      if (const bool has_springs = condition.spring.stiffness > 0; condition.slides || has_springs)
        visit_faces(condition, body.faces, [&](const BoundaryFace<dim> &face) {
          for (const dealii::Point<dim> &vertex : face.vertices)
            if (has_springs && condition.spring.direction == SpringDirection::all)
              for (int d = 0; d < dim; ++d)
                motions.hold(vertex, d);
            else
              motions.hold_along(vertex, face.normal);
        });
  }

  template <int dim>
  MirrorReactions<dim> Supports<dim>::act_on_surface(const ConstrainedOperator<dim> &) const
  {
    MirrorReactions<dim> nothing;
    nothing.force.resize(body.loads.conditions.size());
    return nothing;
  }

  template <int dim>
  SupportBalance<dim> Supports<dim>::balance(const LinearEquilibrium<dim> &equilibrium) const
  {
    const auto &[system, displacement, external_force, time] = equilibrium;
    const MPI_Comm communicator                              = body.nodes.communicator;
    NodalVector    on_all, force;
    system.initialize_all(on_all);
    system.initialize(force);
    system.internal_force(on_all, displacement);
    std::copy(on_all.begin(), on_all.begin() + force.locally_owned_size(), force.begin());

    // The strain energy is half the work of all forces that act on the body, and what heating puts in.
    const auto   on_surface = act_on_surface(system);
    const double by_heating =
      dealii::Utilities::MPI::sum(system.bond_operator().energy_of_expansion(), communicator);
    SupportBalance<dim> result;
    result.strain_energy = 0.5 * (force * displacement + on_surface.work) + by_heating;
    force -= external_force;
    result.reactions     = hold_nodes() ? held_nodes.sum_by_condition(force, communicator) : on_surface.force;
    result.external_work = 0.5 * (external_force * displacement +
                                  held_nodes.work(force, displacement, communicator) + on_surface.work) +
                           by_heating;
    return result;
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  Supports<dim>::reactions(const NodalVector                         &on_nodes,
                           const std::vector<dealii::Tensor<1, dim>> &on_faces) const
  {
    auto result = held_nodes.sum_by_condition(on_nodes, body.nodes.communicator);
    if (values && !hold_nodes())
      {
        const auto at_faces = values->sum_by_condition(on_faces, body.nodes.communicator);
        for (std::size_t k = 0; k < result.size(); ++k)
          result[k] += at_faces[k];
      }
    return result;
  }

  template <int dim>
  std::string Supports<dim>::describe() const
  {
    const unsigned int n_layers = body.parameters.layers;
    return name_of(body.parameters.displacement_treatment) +
           (n_layers > 1 ? ", " + std::to_string(n_layers) + " layers of cells" : "");
  }

  PERIDEAL_INSTANTIATE_CLASS(Supports)
} // namespace perideal
