// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/boundary/surface_recovery.h>

#include "bodies.h"
#include "boundary/elastic_field.h"
#include "solids.h"
#include "testing.h"

#include <array>

using namespace perideal;
using namespace elastic_field_test;

namespace
{
  /// Recovers at all faces of a mesh and calls check(state).
  template <int dim, typename Function, typename Check>
  void for_each_state(const Mesh<dim>             &mesh,
                      const LoadParameters        &text,
                      const SolidsByMaterial<dim> &materials,
                      const Function              &displacement,
                      const Check                 &check)
  {
    const Nodes<dim>           nodes(mesh, NodeParameters{3.01});
    const CellGraph<dim>       graph(mesh, nodes);
    const Loads<dim>           loads = resolve_boundaries(mesh, Loads<dim>(text));
    const SurfaceRecovery<dim> recovery(mesh, graph, materials, loads, Held::at_faces);
    for (const auto id : mesh.boundary_ids)
      for (const auto &state : recovery.recover(id, at_nodes(nodes, displacement), 1.))
        check(state);
  }

  template <int dim>
  void expect_recovery(const Field<dim> &field, const double tolerance)
  {
    for (const auto &mesh : test::make_boxes<dim>())
      {
        unsigned int n_faces = 0;
        for_each_state(
          *mesh,
          field.loads(),
          {{0, field.solid}},
          [&](const auto &x) { return field.displacement(x); },
          [&](const SurfaceState<dim> &state) {
            ++n_faces;
            const auto exact = field.gradient(state.centre);
            EXPECT_LE((state.gradient - exact).norm(), tolerance * exact.norm()) << state.centre;
            EXPECT_LE((state.displacement - field.displacement(state.centre)).norm(),
                      tolerance * exact.norm())
              << state.centre;
          });
        EXPECT_GE(dealii::Utilities::MPI::sum(n_faces, MPI_COMM_WORLD), 20u);
      }
  }

  /// Uniaxial strain across a plane where the stiffness jumps.
  template <int dim>
  void expect_each_material_to_be_recovered()
  {
    dealii::Point<dim> size;
    for (int d = 0; d < dim; ++d)
      size[d] = 1.;
    const auto mesh = test::make_box<dim>(std::vector<unsigned int>(dim, dim == 2 ? 6 : 4), size, 0.);
    for (const auto &cell : mesh->triangulation.active_cell_iterators())
      if (!cell->is_artificial())
        cell->set_material_id(cell->center()[0] > 0.5);
    mesh->material_ids                        = {0, 1};
    std::array<ElasticConstants, 2> materials = {{constants<dim>(), constants<dim>()}};
    materials[1].young_modulus *= 100.;
    const double pull   = 1e7;
    const auto   strain = [&](const unsigned int m) {
      return pull / (materials[m].lame_lambda() + 2. * materials[m].shear_modulus());
    };
    LoadParameters text;
    for (unsigned int id = 0; id < 2 * dim; ++id)
      {
        BoundaryConditionText condition;
        condition.name = condition.boundary = std::to_string(id);
        if (id == 1)
          condition.traction[0] = number(pull);
        else
          condition.displacement[id / 2] = "0";
        text.conditions.push_back(condition);
      }
    for_each_state(
      *mesh,
      text,
      {{0, materials[0]}, {1, materials[1]}},
      [&](const dealii::Point<dim> &x) {
        dealii::Tensor<1, dim> u;
        u[0] = strain(0) * std::min(x[0], 0.5) + strain(1) * std::max(x[0] - 0.5, 0.);
        return u;
      },
      [&](const SurfaceState<dim> &state) {
        auto error = state.gradient;
        error[0][0] -= strain(state.centre[0] > 0.5);
        EXPECT_LE(error.norm(), 1e-10 * strain(0)) << state.centre;
      });
  }

  /// All states of a field that no cubic fits, by centre.
  template <int dim>
  std::vector<SurfaceState<dim>> states_of_waves(MPI_Comm communicator)
  {
    std::vector<SurfaceState<dim>> result;
    for (const auto &mesh : test::make_boxes<dim>(communicator))
      for_each_state(
        *mesh,
        Field<dim>(1.).loads(),
        {{0, constants<dim>()}},
        [](const dealii::Point<dim> &x) {
          dealii::Tensor<1, dim> u;
          for (int d = 0; d < dim; ++d)
            u[d] = 1e-3 * std::sin(4. * x[0] + 3. * x[1] + d);
          return u;
        },
        [&](const SurfaceState<dim> &state) { result.push_back(state); });
    return result;
  }

  template <int dim>
  void expect_independence_of_ranks()
  {
    const auto alone = states_of_waves<dim>(MPI_COMM_SELF), shared = states_of_waves<dim>(MPI_COMM_WORLD);
    for (const auto &state : shared)
      {
        double best = 1e300;
        for (const auto &other : alone)
          if (other.centre.distance(state.centre) < 1e-12 && (other.normal - state.normal).norm() < 1e-12)
            best = std::min(best, (other.gradient - state.gradient).norm());
        EXPECT_LE(best, 1e-12) << state.centre;
      }
    const auto count = [](const std::size_t n) {
      return dealii::Utilities::MPI::sum(static_cast<unsigned int>(n), MPI_COMM_WORLD);
    };
    EXPECT_EQ(count(shared.size()) * dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD),
              count(alone.size()));
  }

} // namespace

TEST(SurfaceRecovery, IsExactForLinearFields)
{
  expect_recovery(Field<2>(0.), 1e-10);
  expect_recovery(Field<3>(0.), 1e-10);
}
TEST(SurfaceRecovery, IsExactForQuadraticFieldsAndTheirLoads)
{
  expect_recovery(Field<2>(1.), 1e-8);
  expect_recovery(Field<3>(1.), 1e-8);
}
TEST(SurfaceRecovery, IsExactForAnisotropicSolids)
{
  expect_recovery(Field<2>(1., test::solid_without_symmetry<2>()), 1e-8);
  expect_recovery(Field<3>(1., test::solid_without_symmetry<3>()), 1e-8);
}
TEST(SurfaceRecovery, KeepsMaterialsApart)
{
  expect_each_material_to_be_recovered<2>();
  expect_each_material_to_be_recovered<3>();
}
TEST(SurfaceRecovery, DoesNotDependOnTheRanks)
{
  expect_independence_of_ranks<2>();
  expect_independence_of_ranks<3>();
}
