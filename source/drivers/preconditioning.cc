// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/drivers/preconditioning.h>
#include <perideal/mesh/parent_mesh.h>
#include <perideal/operators/force/continuum_force.h>
#include <perideal/solvers/preconditioner_choice.h>

#include <deal.II/base/mpi.h>
#include <deal.II/fe/mapping_q_cache.h>

#include <algorithm>
#include <cmath>
#include <vector>

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
    // Parents cannot follow a deformation.
    if (!problem.parameters.model.law->is_linear && solves.auxiliary_mesh == AuxiliaryMesh::automatic)
      solves.auxiliary_mesh = AuxiliaryMesh::same;
    choice = choose_preconditioner(solves,
                                   measure_solve(mesh,
                                                 *problem.body.nodes,
                                                 *problem.system,
                                                 problem.discretisation.families->n_bonds(),
                                                 problem.parameters.model.is_consistent()));
    if (choice.preconditioner == PreconditionerName::auxiliary)
      {
        const auto fem =
          choice.auxiliary_mesh == AuxiliaryMesh::parent ?
            std::make_shared<ElasticFem<dim>>(
              mesh, problem.loading.loads, create_parent_mesh(mesh, problem.failure.precrack_test())) :
            std::make_shared<ElasticFem<dim>>(mesh, problem.loading.loads);
        fem->assemble(problem.body.solids, 0., nullptr, precracks());
        at_rest = elements = make_elements(fem);
      }
    report["preconditioner"] = name_of(choice.preconditioner);
    report["auxiliary_mesh"] = choice.auxiliary_mesh ? name_of(*choice.auxiliary_mesh) : std::string();
  }

  template <int dim>
  typename SplitVertices<dim>::AreApart Preconditioning<dim>::precracks() const
  {
    const BondPredicate<dim> is_cut = problem.failure.precrack_test();
    if (!is_cut)
      return {};
    return [is_cut](const auto &a, const auto &b) { return is_cut(a->center(), b->center()); };
  }

  template <int dim>
  std::unique_ptr<LinearSolver<dim>>
  Preconditioning<dim>::create_solver(const SolverParameters         &parameters,
                                      const ConstrainedOperator<dim> &system) const
  {
    return create_linear_solver<dim>(parameters, choice, system, problem.free_motions, elements);
  }

  template <int dim>
  std::shared_ptr<const AuxiliaryElements<dim>>
  Preconditioning<dim>::make_elements(const std::shared_ptr<const ElasticFem<dim>> &fem) const
  {
    return std::make_shared<AuxiliaryElements<dim>>(
      *problem.body.nodes, fem, problem.loading.supports->surface_nodes());
  }

  namespace
  {
    /// Change of bonds over their length [-], by the mean of squares, from which the elements follow the
    /// body.
    constexpr double far_enough = 0.05;

    /// That change, of the bonds that hold the body together, which turns of it make, too. Collective.
    template <int dim>
    double change_of_bonds(const BondForce<dim> &force, const Families<dim> &families)
    {
      const BondList     &bonds = force.body_bonds();
      const auto         *now   = force.positions();
      std::vector<double> sums(2);
      for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
        for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
          {
            const LocalIndex             j    = bonds.neighbour[slot];
            const dealii::Tensor<1, dim> bond = families.position[j] - families.position[i];
            for (int d = 0; d < dim; ++d)
              {
                const double change = now[j].value[d] - now[i].value[d] - bond[d];
                sums[0] += change * change;
              }
            sums[1] += bond.norm_square();
          }
      const auto mine = sums;
      dealii::Utilities::MPI::sum(mine, families.communicator, sums);
      return std::sqrt(sums[0] / sums[1]);
    }

    /// The mapping of the cells as the last forces found them: vertices move by the mean of what the cells
    /// around make of their gradients. Null where a cell lost its orientation. Collective.
    template <int dim>
    std::shared_ptr<const dealii::Mapping<dim>> deformed_mapping(const Nodes<dim>          &nodes,
                                                                 const ElasticFem<dim>     &fem,
                                                                 const BondForce<dim>      &force,
                                                                 const ContinuumForce<dim> &by_law)
    {
      const auto  gradients = by_law.gradients();
      const auto *now       = force.positions();
      const auto &unknowns  = fem.elements().unknowns;
      NodalVector n_cells, moved;
      n_cells.reinit(unknowns.locally_owned_dofs(), fem.elements().relevant, unknowns.get_communicator());
      moved.reinit(n_cells);
      bool is_oriented = true;
      for (const auto &cell : unknowns.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            const LocalIndex i = nodes.node_of_cell[cell->active_cell_index()];
            is_oriented =
              is_oriented &&
              determinant(gradients[i] + dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>())) > 0.05;
            for (const unsigned int v : cell->vertex_indices())
              {
                const auto change = gradients[i] * (cell->vertex(v) - nodes.position[i]);
                for (int d = 0; d < dim; ++d)
                  {
                    const auto unknown = cell->vertex_dof_index(v, d);
                    moved(unknown) += now[i].value[d] - nodes.position[i][d] + change[d];
                    n_cells(unknown) += 1.;
                  }
              }
          }
      n_cells.compress(dealii::VectorOperation::add);
      moved.compress(dealii::VectorOperation::add);
      for (unsigned int k = 0; k < moved.locally_owned_size(); ++k)
        moved.local_element(k) /= n_cells.local_element(k);
      moved.update_ghost_values();
      if (dealii::Utilities::MPI::min(is_oriented ? 1 : 0, nodes.communicator) == 0)
        return nullptr;
      // deal.II takes linear cells of one shape at rest for alike wherever they have moved; not quadratic
      // ones.
      auto result = std::make_shared<dealii::MappingQCache<dim>>(2);
      result->initialize(fem.elements().geometry, unknowns, moved, true);
      return result;
    }
  } // namespace

  template <int dim>
  void Preconditioning<dim>::follow_deformation()
  {
    const auto *by_law = dynamic_cast<const ContinuumForce<dim> *>(problem.force.get());
    const auto &solids = problem.body.solids;
    if (!at_rest || !at_rest->fem().is_on_mesh_itself() || by_law == nullptr ||
        !std::all_of(solids.begin(), solids.end(), [](const auto &s) { return s.second.is_isotropic(); }))
      return;
    elements = at_rest;
    if (change_of_bonds(*problem.force, *problem.discretisation.families) < far_enough)
      return;
    const auto mapping = deformed_mapping(*problem.body.nodes, at_rest->fem(), *problem.force, *by_law);
    if (!mapping)
      return;
    const auto fem = std::make_shared<ElasticFem<dim>>(*problem.body.mesh, problem.loading.loads);
    fem->assemble(solids, 0., mapping, precracks());
    elements = make_elements(fem);
  }

  PERIDEAL_INSTANTIATE_CLASS(Preconditioning)
} // namespace perideal
