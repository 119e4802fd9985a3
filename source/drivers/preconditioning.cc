// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/drivers/preconditioning.h>
#include <perideal/mesh/parent_mesh.h>
#include <perideal/solvers/preconditioner_choice.h>

namespace perideal
{
  template <int dim>
  Preconditioning<dim>::Preconditioning(const Problem<dim>     &problem,
                                        const unsigned int      n_solves,
                                        nlohmann::ordered_json &report)
    : problem(problem)
  {
    const Mesh<dim> &mesh   = *problem.body.mesh;
    SolverParameters solves = problem.parameters.solver;
    solves.load_steps       = n_solves;
    choice                  = choose_preconditioner(solves,
                                   measure_solve(mesh,
                                                 *problem.body.nodes,
                                                 *problem.system,
                                                 problem.discretisation.families->n_bonds(),
                                                 problem.parameters.model.is_consistent()));
    if (choice.preconditioner == PreconditionerName::auxiliary)
      {
        if (choice.auxiliary_mesh == AuxiliaryMesh::parent)
          fem = std::make_unique<ElasticFem<dim>>(mesh, problem.loading.loads, create_parent_mesh(mesh));
        else
          fem = std::make_unique<ElasticFem<dim>>(mesh, problem.loading.loads);
        fem->assemble(problem.body.solids, 0.);
      }
    report["preconditioner"] = name_of(choice.preconditioner);
    report["auxiliary_mesh"] = choice.auxiliary_mesh ? name_of(*choice.auxiliary_mesh) : std::string();
  }

  template <int dim>
  std::unique_ptr<LinearSolver<dim>>
  Preconditioning<dim>::create_solver(const SolverParameters         &parameters,
                                      const ConstrainedOperator<dim> &system) const
  {
    return create_linear_solver(parameters,
                                choice,
                                system,
                                problem.free_motions,
                                *problem.body.nodes,
                                fem.get(),
                                problem.loading.supports->surface_nodes());
  }

  PERIDEAL_INSTANTIATE_CLASS(Preconditioning)
} // namespace perideal
