// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/operators/weights/node_values.h>
#include <perideal/problem/finite_elements.h>
#include <perideal/problem/free_motions.h>
#include <perideal/problem/problem.h>

namespace perideal
{
  template <int dim>
  Problem<dim>::Problem(const SceneParameters &parameters, const RunContext &context, MPI_Comm communicator)
    : parameters(parameters)
    , run(context, communicator)
    , body(parameters)
    , loading(body)
  {
  }

  template <int dim>
  void Problem<dim>::build()
  {
    {
      const Timings::Scope scope(run.timings, "mesh");
      body.make_mesh(run.context.scene_directory, run.communicator);
      loading.read();
    }
    const Timings::Scope scope(run.timings, "neighbours");
    body.make_nodes();
    loading.choose_nodes(run.timings);
    discretisation.find_families(parameters, loading.supports->images()->nodes());
  }

  template <int dim>
  void Problem<dim>::find_motions()
  {
    discretisation.find_parts(body, failure.precrack_test());
    free_motions = find_free_motions(loading, *discretisation.parts);
  }

  template <int dim>
  void Problem<dim>::weigh()
  {
    const Timings::Scope   scope(run.timings, "setup");
    const ModelParameters &model  = parameters.model;
    const auto             is_cut = failure.precrack_test();
    failure.check_precracks(body, *discretisation.families);
    discretisation.find_parts(body, is_cut);
    if (model.has_cell_strains())
      {
        const Timings::Scope part(run.timings, "setup: gradients");
        discretisation.gradients.make(body, is_cut);
        loading.supports->make_face_values(discretisation.gradients.boundary_points());
      }
    {
      const Timings::Scope part(run.timings, "setup: weights");
      discretisation.weigh(body, loading.supports->face_values(), is_cut);
    }
    if (loading.expansion)
      discretisation.expand(body, loading.expansion);
    loading.surround(discretisation, run.timings);
    discretisation.measure_families(body);
    const Supports<dim> &supports = *loading.supports;
    system                        = std::make_unique<ConstrainedOperator<dim>>(
      discretisation.bonds, supports.images(), supports.unknowns(), supports.held().mask());
  }

  template <int dim>
  void Problem<dim>::solve_fem(const double time)
  {
    state.fem                = solve_compared_fem(*this, time);
    state.comparisons["fem"] = state.fem->displacement;
  }

  template <int dim>
  void Problem<dim>::solve_comparisons(const bool is_linear_static)
  {
    const ComparisonParameters &comparison = parameters.comparison;
    if (comparison.by_families() && !discretisation.family_stiffness)
      return;
    const bool has_reference = comparison.reference || loading.supports->needs_reference();
    if (has_reference && state.comparisons.count("reference") == 0)
      {
        run.screen << "reference   Q2 finite elements, " << comparison.reference_refinements
                   << " refinement(s)"
                   << (comparison.reference_mesh.empty() ? "" : " of " + comparison.reference_mesh)
                   << std::endl;
        state.comparisons["reference"] = reference_at_nodes(*this);
        loading.supports->set_reference(state.comparisons["reference"]);
      }
    if (comparison.fem && is_linear_static && !state.fem)
      {
        run.screen << "comparison  finite elements on the mesh itself" << std::endl;
        solve_fem(1.);
      }
  }

  template <int dim>
  void Problem<dim>::make_force()
  {
    const Timings::Scope scope(run.timings, "setup");
    force = discretisation.create_force(body);
    if (loading.expansion)
      discretisation.expand(body, loading.expansion, *force);
    force->register_state(lasting);
  }

  template <int dim>
  void Problem<dim>::make_failure()
  {
    const Timings::Scope scope(run.timings, "setup");
    // Bonds are calibrated anew where a zone grows, or as they come near to breaking.
    if (parameters.model.calibrates_bonds() && !failure.calibrations)
      failure.calibrations = std::make_shared<CalibrationMemo>();
    failure.apply(body, discretisation, *force);
  }

  template <int dim>
  void Problem<dim>::keep_force()
  {
    system.reset();
    discretisation.bonds.reset();
    if (!parameters.model.recomputes())
      {
        discretisation.weights.reset();
        if (!failure.calibrates_later)
          discretisation.families->release_members();
        return;
      }
    force->reweigh_as_bonds_break(discretisation.weights, [this](const auto &nodes, const auto &is_gone) {
      discretisation.weights->reweigh(nodes, *discretisation.model, solids_of_model(body), is_gone);
    });
  }

  template <int dim>
  void Problem<dim>::check_loads()
  {
    system->initialize(state.unknowns);
    system->initialize(state.external_force);
    loading.check_finite(1.);
    apply_loads(1.);
    NodalVector residual;
    system->initialize(residual);
    system->residual(residual, state.external_force, state.unknowns);
    // What bonds, ghosts and the published transfer make of tractions balances roughly; the tractions must.
    const double share = loading.tractions->keep_balance() ?
                           free_motions.share_in(residual) :
                           free_motions.share_in(loading.forces_on_body(), run.communicator);
    if (share > 1e-6)
      throw InputError("the loads push the body along a rigid-body motion that nothing holds")
        .parameter("Boundary conditions/Rigid body motions")
        .hint("balance the loads, or hold the body");
    state.unknowns = 0.;
  }

  template <int dim>
  void Problem<dim>::apply_loads(const double time)
  {
    loading.apply(time, state.external_force, state.unknowns);
  }

  template <int dim>
  void Problem<dim>::store_displacement()
  {
    if (const auto &moments = discretisation.gradients.moments)
      state.displacement = values_at_nodes(*moments, state.unknowns);
    else
      {
        state.displacement.resize(body.nodes->size());
        for (LocalIndex i = 0; i < body.nodes->size(); ++i)
          for (int d = 0; d < dim; ++d)
            state.displacement[i][d] = state.unknowns.local_element(dim * i + d);
      }
    free_motions.remove_mean(*body.nodes, state.displacement);
  }

  PERIDEAL_INSTANTIATE_CLASS(Problem)
} // namespace perideal
