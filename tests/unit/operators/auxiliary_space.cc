// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/models.h>
#include <perideal/mesh/parent_mesh.h>
#include <perideal/operators/system/auxiliary_space.h>
#include <perideal/operators/system/constrained_operator.h>

#include "bodies.h"
#include "testing.h"

#include <deal.II/lac/solver_cg.h>

using namespace perideal;

namespace
{
  constexpr ElasticConstants constants(const int dim)
  {
    return {70e9, 0.3, dim == 2 ? PlaneAssumption::plane_stress : PlaneAssumption::solid};
  }

  /// A distorted box refined as told, held on the left, with the system of the energy form.
  template <int dim>
  struct HeldBox
  {
    HeldBox(const unsigned int refinements, const LocalRefinement &local, MPI_Comm communicator)
      : mesh(make_mesh(refinements, local, communicator))
      , body(*mesh)
      , loads(hold_left())
    {
      ModelParameters parameters;
      parameters.form = "energy";
      parameters.resolve(dim);
      const auto                                     model = create_model<dim>(parameters, 1.);
      const std::shared_ptr<const BondOperator<dim>> bonds =
        create_bond_operator<dim>(body.families, *model, [](const dealii::types::material_id) {
          return ElasticSolid<dim>(constants(dim));
        });
      std::vector<std::uint8_t> held(dim * body.nodes.size(), 0);
      for (LocalIndex i = 0; i < body.nodes.size(); ++i)
        if (body.nodes.position[i][0] < 0.08)
          std::fill_n(held.begin() + dim * i, dim, 1);
      system = std::make_unique<ConstrainedOperator<dim>>(
        bonds, std::make_shared<MirrorLayer<dim>>(body.nodes), body.nodes, held);
    }

    static std::unique_ptr<Mesh<dim>>
    make_mesh(const unsigned int refinements, const LocalRefinement &local, MPI_Comm communicator)
    {
      const std::vector<unsigned int> cells(dim, dim == 2 ? 8 : 4);
      dealii::Point<dim>              size;
      for (int d = 0; d < dim; ++d)
        size[d] = 1.;
      auto mesh = test::make_box<dim>(cells, size, 0.2, communicator);
      mesh->triangulation.refine_global(refinements);
      mesh->refinements = refinements;
      refine_locally(local, mesh->triangulation);
      mesh->local_refinement = local;
      return mesh;
    }

    static Loads<dim> hold_left()
    {
      BoundaryConditionText text;
      text.name = text.boundary = "0";
      for (int d = 0; d < dim; ++d)
        text.displacement[d] = "0";
      LoadParameters parameters;
      parameters.conditions = {text};
      return Loads<dim>(parameters);
    }

    AuxiliarySpace<dim> make_preconditioner(const bool on_parents) const
    {
      const auto fem = on_parents ?
                         std::make_shared<ElasticFem<dim>>(*mesh, loads, create_parent_mesh(*mesh)) :
                         std::make_shared<ElasticFem<dim>>(*mesh, loads);
      fem->assemble({{0, constants(dim)}}, 0.);
      return AuxiliarySpace<dim>(*system, std::make_shared<AuxiliaryElements<dim>>(body.nodes, fem));
    }

    /// CG under forces without pattern; returns the number of iterations.
    template <typename Preconditioner>
    unsigned int solve(NodalVector &solution, const Preconditioner &preconditioner) const
    {
      NodalVector source;
      system->initialize(source);
      system->initialize(solution);
      for (LocalIndex k = 0; k < source.locally_owned_size(); ++k)
        source.local_element(k) =
          system->is_held(k) ? 0. : 1. + test::scatter(body.nodes.position[k / dim], k % dim);
      dealii::ReductionControl      control(2000, 0., 1e-10);
      dealii::SolverCG<NodalVector> cg(control);
      cg.solve(*system, solution, source, preconditioner);
      return control.last_step();
    }

    std::unique_ptr<Mesh<dim>>                mesh;
    test::Body<dim>                           body;
    Loads<dim>                                loads;
    std::unique_ptr<ConstrainedOperator<dim>> system;
  };

  /// Solutions agree with that of block Jacobi in few iterations, as many on any number of ranks.
  template <int dim>
  void expect_good_preconditioners(const unsigned int     refinements,
                                   const LocalRefinement &local,
                                   const unsigned int     most_iterations)
  {
    const HeldBox<dim> box(refinements, local, MPI_COMM_WORLD), alone(refinements, local, MPI_COMM_SELF);
    NodalVector        expected;
    const unsigned int by_jacobi = box.solve(expected, BlockJacobi<dim>(*box.system));
    for (const bool on_parents : {false, true})
      {
        SCOPED_TRACE(on_parents ? "parents" : "same");
        NodalVector found, found_alone;
        const auto  iterations       = box.solve(found, box.make_preconditioner(on_parents));
        const auto  iterations_alone = alone.solve(found_alone, alone.make_preconditioner(on_parents));
        EXPECT_LE(iterations, most_iterations);
        EXPECT_LT(iterations, by_jacobi);
        EXPECT_NEAR(iterations, iterations_alone, 3);
        EXPECT_NEAR(found.l2_norm(), found_alone.l2_norm(), 1e-8 * found_alone.l2_norm());
        found -= expected;
        EXPECT_LE(found.l2_norm(), 1e-8 * expected.l2_norm());
      }
  }

  /// CG needs a symmetric, positive preconditioner.
  template <int dim>
  void expect_symmetry(const LocalRefinement &local, const bool on_parents)
  {
    const HeldBox<dim>        box(1, local, MPI_COMM_WORLD);
    const AuxiliarySpace<dim> preconditioner = box.make_preconditioner(on_parents);
    NodalVector               a, b, of_a, of_b;
    for (NodalVector *vector : {&a, &b, &of_a, &of_b})
      box.system->initialize(*vector);
    for (LocalIndex k = 0; k < a.locally_owned_size(); ++k)
      {
        a.local_element(k) = test::scatter(box.body.nodes.position[k / dim], k % dim);
        b.local_element(k) = test::scatter(box.body.nodes.position[k / dim], 7 + k % dim);
      }
    preconditioner.vmult(of_a, a);
    preconditioner.vmult(of_b, b);
    EXPECT_NEAR(a * of_b, b * of_a, 1e-9 * std::sqrt((a * of_a) * (b * of_b)));
    EXPECT_GT(a * of_a, 0.);
  }

  LocalRefinement towards_right(const unsigned int times)
  {
    LocalRefinement result;
    result.boundaries = {1};
    result.times      = times;
    result.layers     = 4;
    return result;
  }
} // namespace

// Bounds: a quarter more than measured.
TEST(AuxiliarySpace, UniformlyRefined2D)
{
  expect_good_preconditioners<2>(2, {}, 36);
}
TEST(AuxiliarySpace, UniformlyRefined3D)
{
  expect_good_preconditioners<3>(1, {}, 36);
}
TEST(AuxiliarySpace, LocallyRefined2D)
{
  expect_good_preconditioners<2>(1, towards_right(1), 60);
}
TEST(AuxiliarySpace, LocallyRefined3D)
{
  expect_good_preconditioners<3>(1, towards_right(1), 60);
}
TEST(AuxiliarySpace, IsSymmetric)
{
  for (const bool on_parents : {false, true})
    for (const unsigned int times : {0, 1})
      {
        expect_symmetry<2>(towards_right(times), on_parents);
        expect_symmetry<3>(towards_right(times), on_parents);
      }
}
