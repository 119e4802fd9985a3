// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/boundary/body_forces.h>
#include <perideal/problem/loading.h>

#include <deal.II/base/mpi.h>

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
    loads            = resolve_boundaries(*body.mesh, Loads<dim>(body.parameters.loads));
    loads.densities  = body.densities_on(*body.mesh);
    loads.expansions = body.expansions_on(*body.mesh);
  }

  template <int dim>
  TreatedBody<dim> Loading<dim>::treated_body(Timings &timings) const
  {
    return {*body.mesh, *body.nodes, body.faces, loads, body.parameters.loads, timings};
  }

  template <int dim>
  void Loading<dim>::choose_nodes(Timings &timings)
  {
    supports = create_supports(treated_body(timings));
    if (loads.has_temperature())
      expansion = std::make_shared<CellExpansion<dim>>(body.nodes->size());
  }

  template <int dim>
  void Loading<dim>::place_point_forces(const CellGradients<dim> &gradients)
  {
    if (loads.point_loads.empty())
      return;
    point_forces = gradients.polynomials ?
                     PointForces<dim>(*body.mesh, *gradients.polynomials, loads) :
                     PointForces<dim>(*body.mesh, CellGraph<dim>(*body.mesh, *body.nodes), loads);
  }

  template <int dim>
  void Loading<dim>::surround(DiscreteBody<dim> &discretisation, Timings &timings)
  {
    tractions            = create_tractions(treated_body(timings),
                                 TreatedBonds<dim>{discretisation.families,
                                                              discretisation.gradients.moments,
                                                              solids_of_model(body),
                                                   discretisation.consistent_bonds ?
                                                                discretisation.consistent_bonds->shares() :
                                                                nullptr});
    discretisation.bonds = tractions->around(discretisation.bonds);
    moments              = discretisation.gradients.moments;
    place_point_forces(discretisation.gradients);
    if (const auto stiffness = tractions->stiffness())
      discretisation.family_stiffness = stiffness;
  }

  template <int dim>
  void Loading<dim>::check_finite(const double time) const
  {
    const SolverParameters &solver = body.parameters.solver;
    loads.check_tables(solver.is_dynamic() ? 0. : 1. / solver.load_steps);
    loads.check_tables(time);
    perideal::check_finite(body.faces, loads, time, body.nodes->communicator);
    supports->held().check_finite(loads, time, body.nodes->communicator);
  }

  template <int dim>
  void Loading<dim>::apply(const double time, NodalVector &force, NodalVector &displacement) const
  {
    if (!body.parameters.solver.is_nonlinear_static())
      supports->set_face_values(time);
    external_force(time, force);
    supports->set_displacements(time, displacement);
  }

  template <int dim>
  void Loading<dim>::external_force(const double time, NodalVector &force) const
  {
    // No external force acts on nodes that are not those of cells.
    force = 0.;
    if (expansion)
      expansion->set(*body.mesh, *body.nodes, loads, time);
    set_body_forces(time, force);
    tractions->add_tractions(loads, time, force);
    tractions->add_given(time, force);
    point_forces.add(loads, time, force);
  }

  template <int dim>
  void Loading<dim>::set_body_forces(const double time, NodalVector &force) const
  {
    // In motion a body force acts as inertia does, on the values that carry the masses.
    if (!moments || body.parameters.solver.is_dynamic())
      {
        perideal::set_body_forces(*body.nodes, loads, time, force);
        return;
      }
    if (loads.has_body_force())
      supports->face_values()->bear(moments->add_body_forces(*body.mesh, *body.nodes, loads, time, force));
  }

  template <int dim>
  std::vector<typename NullSpace<dim>::Force> Loading<dim>::forces_on_body() const
  {
    const Nodes<dim>                           &nodes = *body.nodes;
    std::vector<typename NullSpace<dim>::Force> result;
    visit_loaded_faces(
      loads, body.faces, [&](const BoundaryCondition<dim> &condition, const BoundaryFace<dim> &face) {
        result.emplace_back(face.centre,
                            face.area * Loads<dim>::traction(condition, face.centre, face.normal, 1.));
      });
    for (LocalIndex i = 0; i < nodes.size(); ++i)
      result.emplace_back(nodes.position[i],
                          nodes.volume[i] * loads.body_force_at(nodes.position[i], 1., nodes.material[i]));
    if (dealii::Utilities::MPI::this_mpi_process(nodes.communicator) == 0)
      for (const auto &load : loads.point_loads)
        result.emplace_back(load.position, load.force_at(1.));
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(Loading)
} // namespace perideal
