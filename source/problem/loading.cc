// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/base/timing.h>
#include <perideal/boundary/balanced_transfer.h>
#include <perideal/boundary/surface_planes.h>
#include <perideal/operators/linear/nodal_springs.h>
#include <perideal/problem/loading.h>

namespace perideal
{
  template <int dim>
  Loading<dim>::Loading(const Body<dim> &body)
    : body(body)
  {
  }

  template <int dim>
  void Loading<dim>::read()
  {
    loads = resolve_boundaries(*body.mesh, Loads<dim>(body.parameters.loads));
  }

  template <int dim>
  const NodeCloud<dim> &Loading<dim>::unknowns() const
  {
    return surface_nodes ? surface_nodes->nodes() : static_cast<const NodeCloud<dim> &>(*body.nodes);
  }

  template <int dim>
  bool Loading<dim>::holds_nodes() const
  {
    const LoadParameters &given = body.parameters.loads;
    return given.holds_layer() || given.has_surface_nodes();
  }

  template <int dim>
  void Loading<dim>::choose_nodes()
  {
    const LoadParameters &given = body.parameters.loads;
    const Nodes<dim>     &nodes = *body.nodes;
    if (given.act_in_depth() ||
        body.parameters.model.boundary_compensation == BoundaryCompensation::closed_form)
      surface = gather_faces(body.faces, nodes.communicator);
    if (given.has_mirror())
      {
        images = std::make_shared<MirrorLayer<dim>>(*body.mesh, nodes, body.faces, loads);
        held   = DirichletNodes<dim>({}, loads, nodes.size());
      }
    else if (given.has_surface_nodes())
      {
        surface_nodes = std::make_unique<SurfaceNodes<dim>>(nodes, body.faces, loads);
        images        = std::make_shared<MirrorLayer<dim>>(unknowns());
        held          = DirichletNodes<dim>(surface_nodes->faces(), loads, unknowns().size());
      }
    else
      {
        images = std::make_shared<MirrorLayer<dim>>(nodes);
        if (given.layers > 1)
          held = DirichletNodes<dim>(*body.mesh, nodes, body.faces, loads, given.layers);
        else
          held = DirichletNodes<dim>(
            holds_nodes() ? body.faces : std::vector<BoundaryFace<dim>>(), loads, nodes.size());
      }
  }

  template <int dim>
  void Loading<dim>::place_point_forces()
  {
    if (!loads.point_loads.empty())
      point_forces = PointForces<dim>(*body.mesh, CellGraph<dim>(*body.mesh, *body.nodes), loads);
  }

  template <int dim>
  void Loading<dim>::take_face_values(const FaceGradient<dim> &gradient)
  {
    face_values = holds_nodes() ? std::make_shared<FaceValues<dim>>() :
                                  std::make_shared<FaceValues<dim>>(gradient, loads);
  }

  template <int dim>
  void Loading<dim>::surround(DiscreteBody<dim> &discretisation, Timings &timings)
  {
    const LoadParameters &given = body.parameters.loads;
    if (given.has_taylor_extension())
      {
        // Between materials a uniform strain needs forces that no missing bond stands for.
        if (body.mesh->material_ids.size() > 1)
          throw InputError("what ghosts do is known in bodies of one material")
            .parameter("Boundary conditions/Traction treatment")
            .given("taylor ghosts")
            .allowed("automatic | layer for several cell groups");
        const Timings::Scope part(timings, "setup: ghosts");
        extension = std::make_shared<TaylorExtension<dim>>(
          discretisation.bonds,
          discretisation.families,
          *body.nodes,
          body.faces,
          surface,
          loads,
          solids_of_model(body)(*body.mesh->material_ids.begin()).stiffness());
        discretisation.bonds            = extension;
        discretisation.family_stiffness = extension->stiffness();
      }
    if (!given.has_transfer())
      return;
    const Timings::Scope   part(timings, "setup: transfer functions");
    TransferFunctions<dim> functions(*body.nodes, surface);
    if (!given.has_published_transfer())
      {
        transfer = std::make_shared<BalancedTransfer<dim>>(std::move(functions));
        return;
      }
    published_transfer = std::make_shared<PublishedTransfer<dim>>(
      std::move(functions), loads, given.transfer_chi, given.transfer_lambda);
    transfer = published_transfer;
    if (!published_transfer->springs().empty())
      discretisation.bonds =
        std::make_shared<NodalSprings<dim>>(discretisation.bonds, published_transfer->springs());
  }

  template <int dim>
  void Loading<dim>::check_finite(const double time) const
  {
    perideal::check_finite(body.faces, loads, time, body.nodes->communicator);
    held.check_finite(loads, time, body.nodes->communicator);
  }

  template <int dim>
  void Loading<dim>::move_supports(const double time)
  {
    images->set_time(loads, time);
    // Along nonlinear equilibria, values at faces move with the solver.
    if (face_values && !body.parameters.solver.is_nonlinear_static())
      face_values->set_time(loads, time);
  }

  template <int dim>
  void Loading<dim>::prescribe(const double                               time,
                               const std::vector<dealii::Tensor<1, dim>> *reference,
                               NodalVector                               &displacement) const
  {
    if (reference == nullptr)
      {
        held.set_boundary_values(loads, time, displacement);
        return;
      }
    // The reference belongs to the final loads; linear scenes scale.
    auto values = *reference;
    for (auto &value : values)
      value *= time;
    held.set_nodal_values(values, displacement);
  }

  PERIDEAL_INSTANTIATE_CLASS(Loading)
} // namespace perideal
