// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/report.h>
#include <perideal/application/simulation.h>
#include <perideal/base/instantiate.h>
#include <perideal/fracture/floating_nodes.h>
#include <perideal/solvers/newton.h>

#include <utility>

// Simulation: equilibria of the nonlinear force by Newton's method.

namespace perideal
{
  template <int dim>
  void Simulation<dim>::set_up_tangent()
  {
    const Timings::Scope scope(timings, "setup");
    const Timings::Scope part(timings, "setup: preconditioner");
    if (!scene.correspondence)
      scene.tangent = create_tangent<dim>(std::shared_ptr<const BondWeights<dim>>(scene.weights));
    scene.tangent_system = std::make_unique<ConstrainedOperator<dim>>(
      scene.tangent, scene.mirror, scene.unknowns(), scene.held.mask());
    // A load step takes about four solves.
    const auto choice = prepare_preconditioner(4 * parameters.solver.load_steps);
    scene.tangent_solver =
      std::make_unique<TangentSolver<dim>>(parameters.solver, [this, choice](const SolverParameters &solver) {
        return create_linear_solver(solver,
                                    choice,
                                    *scene.tangent_system,
                                    scene.null_space,
                                    *scene.nodes,
                                    scene.auxiliary_fem.get(),
                                    scene.surface_nodes.get());
      });
  }

  template <int dim>
  void Simulation<dim>::run_quasi_static()
  {
    make_bond_force();
    set_up_tangent();
    prepare_equilibria("quasi static, " + scene.tangent_solver->name());
    typename NewtonSolver<dim>::Controls controls;
    controls.tolerance      = parameters.solver.tolerance;
    controls.max_iterations = parameters.solver.newton_iterations;
    controls.bonds_break    = can_break(parameters);
    typename NewtonSolver<dim>::FindFloating find_floating;
    if (controls.bonds_break || !scene.precracks.empty())
      find_floating = [this]() {
        std::vector<bool> is_lost(scene.force->bond_list().n_slots(), false);
        for (const auto &bond : scene.force->lost_bonds())
          is_lost[bond.slot] = true;
        return find_floating_nodes(
          *scene.families,
          scene.force->bond_list(),
          [&](const BondIndex slot) { return is_lost[slot]; },
          scene.held.mask());
      };
    NewtonSolver<dim> newton(*scene.force,
                             *scene.tangent,
                             *scene.tangent_system,
                             *scene.tangent_solver,
                             scene.held,
                             scene.loads,
                             scene.null_space,
                             controls,
                             by_nodes() ? nullptr : scene.face_values.get(),
                             find_floating);
    run_load_steps(newton);
  }

  PERIDEAL_INSTANTIATE_CLASS(Simulation)
} // namespace perideal
