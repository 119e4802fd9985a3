// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/base/work_progress.h>
#include <perideal/fem/algebraic_multigrid.h>
#include <perideal/fem/displacement_constraints.h>
#include <perideal/fem/elastic_fem.h>
#include <perideal/fem/polynomial_multigrid.h>
#include <perideal/mesh/create_mesh.h>

#include <deal.II/lac/solver_cg.h>

#include <cmath>

namespace perideal
{
  namespace
  {
    /// The copy of a mesh that elements live on, or null for the mesh itself.
    template <int dim>
    std::shared_ptr<const dealii::Triangulation<dim>>
    make_cells(const Mesh<dim> &mesh, const unsigned int degree, const int refinements)
    {
      if (degree == 1 && refinements == 0)
        return nullptr;
      auto cells = std::make_shared<dealii::parallel::distributed::Triangulation<dim>>(
        mesh.triangulation.get_communicator());
      copy_refined(mesh, refinements, *cells);
      return cells;
    }
  } // namespace

  template <int dim>
  ElasticFem<dim>::ElasticFem(const Mesh<dim>   &mesh,
                              const Loads<dim>  &loads,
                              const unsigned int degree,
                              const int          refinements)
    : ElasticFem(mesh, loads, degree, make_cells(mesh, degree, refinements))
  {
  }

  template <int dim>
  ElasticFem<dim>::ElasticFem(const Mesh<dim>                                  &mesh,
                              const Loads<dim>                                 &loads,
                              std::shared_ptr<const dealii::Triangulation<dim>> cells)
    : ElasticFem(mesh, loads, 1, std::move(cells))
  {
  }

  template <int dim>
  ElasticFem<dim>::ElasticFem(const Mesh<dim>                                  &mesh,
                              const Loads<dim>                                 &loads,
                              const unsigned int                                degree,
                              std::shared_ptr<const dealii::Triangulation<dim>> cells)
    : body(mesh)
    , loads(loads)
    , external(mesh, loads)
    , own_cells(std::move(cells))
    , space(own_cells != nullptr ? *own_cells : mesh.triangulation, degree)
  {
  }

  template <int dim>
  ElasticFem<dim>::~ElasticFem() = default;

  template <int dim>
  void ElasticFem<dim>::cell_system(const Cell                 &cell,
                                    CellIntegrals<dim>         &integrals,
                                    dealii::FullMatrix<double> &matrix,
                                    dealii::Vector<double>     &forces) const
  {
    const auto material = assembled.solids.find(cell->material_id());
    // Not an Assert: in Release a body without stiffness would come out, silently.
    AssertThrow(
      material != assembled.solids.end(),
      dealii::ExcMessage("no elastic constants for material id " + std::to_string(cell->material_id())));
    integrals.stiffness(cell, material->second, matrix);
    external.add_springs(cell, integrals, matrix);

    forces = 0.;
    external.add(cell, integrals, forces);
    if (!loads.has_temperature())
      return;
    const auto of_expansion = material->second.stress_of_expansion();
    integrals.add_stress(
      cell,
      [&](const dealii::Point<dim> &point) {
        return loads.expansion_at(point, assembled.time, cell->material_id()) * of_expansion;
      },
      forces);
  }

  template <int dim>
  void ElasticFem<dim>::assemble(const SolidsByMaterial<dim>                       &solids,
                                 const double                                       time,
                                 const std::shared_ptr<const dealii::Mapping<dim>> &deformed,
                                 const typename SplitVertices<dim>::AreApart       &are_apart)
  {
    assembled.solids   = solids;
    assembled.time     = time;
    assembled.deformed = deformed;
    algebraic_multigrid.reset();
    polynomial_multigrid.reset();
    space.distribute();
    held = space.hanging_nodes();
    add_prescribed_displacements(space.geometry, space.unknowns, body, loads, time, held);
    assembled.pins = pin_free_motions(space.geometry, space.unknowns, body, loads, held);
    held.close();
    if (are_apart)
      space.open_cracks(are_apart, held);
    space.reinit(stiffness, held);
    space.reinit(right_hand_side);
    displacement.reinit(right_hand_side);
    external.reinit(space.unknowns.get_triangulation(), space.geometry, time);

    CellIntegrals<dim>         integrals(matrix_mapping(), space.element, dim == 2 ? body.thickness : 1.);
    const unsigned int         n = space.element.n_dofs_per_cell();
    dealii::FullMatrix<double> matrix(n, n);
    dealii::Vector<double>     forces(n);
    std::vector<dealii::types::global_dof_index> indices(n);
    for (const Cell &cell : space.unknowns.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          cell_system(cell, integrals, matrix, forces);
          space.cell_unknowns(cell, indices);
          held.distribute_local_to_global(matrix, forces, indices, stiffness, right_hand_side);
        }
    stiffness.compress(dealii::VectorOperation::add);
    right_hand_side.compress(dealii::VectorOperation::add);
    space.add_ties(stiffness, held);
  }

  template <int dim>
  void ElasticFem<dim>::set_up_solver()
  {
    if (space.element.degree == 1)
      algebraic_multigrid = std::make_unique<AlgebraicMultigrid<dim>>(*this);
    else
      {
        auto linear = std::make_unique<ElasticFem<dim>>(body, loads, own_cells);
        linear->assemble(assembled.solids, assembled.time);
        polynomial_multigrid = std::make_unique<PolynomialMultigrid<dim>>(*this, std::move(linear));
      }
  }

  template <int dim>
  unsigned int ElasticFem<dim>::solve(const double tolerance)
  {
    if (algebraic_multigrid == nullptr && polynomial_multigrid == nullptr)
      set_up_solver();
    const unsigned int    largest_number_of_iterations = 2000;
    dealii::SolverControl control(largest_number_of_iterations, tolerance * right_hand_side.l2_norm());
    dealii::SolverCG<NodalVector> cg(control);
    displacement = 0.;
    const WorkProgress progress("solving finite elements");
    const double       first = right_hand_side.l2_norm();
    cg.connect([&](const unsigned int, const double residual, const NodalVector &) {
      if (residual > 0 && residual < first)
        progress.share(std::log(residual / first) / std::log(tolerance));
      return dealii::SolverControl::success;
    });
    try
      {
        if (algebraic_multigrid != nullptr)
          cg.solve(stiffness, displacement, right_hand_side, *algebraic_multigrid);
        else
          cg.solve(stiffness, displacement, right_hand_side, *polynomial_multigrid);
      }
    catch (const dealii::SolverControl::NoConvergence &error)
      {
        throw ComputationError("the finite-element comparison did not converge: residual " +
                               std::to_string(error.last_residual / right_hand_side.l2_norm()) +
                               " of the right-hand side after " + std::to_string(error.last_step) +
                               " CG iterations");
      }
    held.distribute(displacement);
    displacement.update_ghost_values();
    return control.last_step();
  }

  template <int dim>
  dealii::types::global_cell_index ElasticFem<dim>::n_cells() const
  {
    return space.unknowns.get_triangulation().n_global_active_cells();
  }

  PERIDEAL_INSTANTIATE_CLASS(ElasticFem)
} // namespace perideal
