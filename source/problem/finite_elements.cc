// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/mesh/create_mesh.h>
#include <perideal/problem/finite_elements.h>

namespace perideal
{
  namespace
  {
    /// Returns a solution by finite elements at the nodes, rigid-body motions removed. Collective.
    template <int dim>
    NodalField<dim> at_nodes(const Problem<dim> &problem, const ElasticFem<dim> &fem)
    {
      if (fem.is_on_mesh_itself())
        return on_mesh_at_nodes<dim>(problem, fem);
      auto result = fem.evaluate(problem.body.nodes->position);
      problem.free_motions.remove_mean(*problem.body.nodes, result);
      return result;
    }

    /// Returns strain and stress of finite elements on the mesh itself at the nodes.
    template <int dim>
    std::vector<ElasticState>
    states_of_fem(const Problem<dim> &problem, const ElasticFem<dim> &fem, const double time)
    {
      const Nodes<dim> &nodes  = *problem.body.nodes;
      const auto        solids = problem.discretisation.compared_solids(problem.body, *problem.body.mesh);
      const Loads<dim> &loads  = problem.loading.loads;
      std::vector<ElasticState> result;
      for (const auto &gradient :
           in_cells_of_nodes(nodes, [&](const auto &points) { return fem.gradients_in_cells(points); }))
        {
          const LocalIndex i = result.size();
          const double     expansion =
            loads.has_temperature() ? loads.expansion_at(nodes.position[i], time, nodes.material[i]) : 0.;
          result.push_back(elastic_state<dim>(symmetrize(gradient), solids.at(nodes.material[i]), expansion));
        }
      return result;
    }
  } // namespace

  template <int dim>
  FemSolution<dim> solve_compared_fem(Problem<dim> &problem, const double time)
  {
    Timings             &timings = problem.run.timings;
    const Timings::Scope scope(timings, "fem");
    const Mesh<dim>     &mesh = *problem.body.mesh;
    ElasticFem<dim>      fem(mesh, problem.loading.loads, problem.parameters.comparison.fem_degree);
    {
      const Timings::Scope part(timings, "fem: assembly");
      fem.assemble(problem.discretisation.compared_solids(problem.body, mesh), time);
    }
    {
      const Timings::Scope part(timings, "fem: multigrid");
      fem.set_up_solver();
    }
    const Timings::Scope part(timings, "fem: solve");
    FemSolution<dim>     result;
    result.iterations = fem.solve(problem.parameters.solver.tolerance);
    result.n_unknowns = fem.n_dofs();
    if (fem.is_on_mesh_itself())
      result.states = states_of_fem(problem, fem, time);
    result.displacement = at_nodes<dim>(problem, fem);
    return result;
  }

  template <int dim>
  NodalField<dim> reference_at_nodes(Problem<dim> &problem)
  {
    const ComparisonParameters &comparison = problem.parameters.comparison;
    std::unique_ptr<Mesh<dim>>  own_mesh;
    if (!comparison.reference_mesh.empty())
      {
        MeshParameters mesh = problem.parameters.mesh;
        mesh.file           = comparison.reference_mesh;
        mesh.generator.clear();
        mesh.distortion  = 0.;
        mesh.refinements = mesh.refine_times = 0;
        own_mesh = create_mesh<dim>(mesh, problem.run.communicator, problem.run.context.scene_directory);
      }
    const Mesh<dim>     &mesh = own_mesh ? *own_mesh : *problem.body.mesh;
    const Timings::Scope scope(problem.run.timings, "reference");
    Loads<dim>           loads = problem.loading.loads;
    loads.densities            = problem.body.densities_on(mesh);
    loads.expansions           = problem.body.expansions_on(mesh);
    ElasticFem<dim> fem(mesh, loads, 2, comparison.reference_refinements);
    fem.assemble(problem.discretisation.compared_solids(problem.body, mesh), 1.);
    fem.set_up_solver();
    // Far below the discretisation errors that are to be seen.
    fem.solve(1e-10);
    auto result = fem.evaluate(problem.body.nodes->position);
    problem.free_motions.remove_mean(*problem.body.nodes, result);
    return result;
  }

  PERIDEAL_INSTANTIATE(solve_compared_fem)
  PERIDEAL_INSTANTIATE(reference_at_nodes)
} // namespace perideal
