// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem_test.h"

#include <perideal/base/exceptions.h>
#include <perideal/mesh/create_mesh.h>

namespace perideal::test
{
  namespace
  {
    std::vector<BoundaryConditionText> stretched()
    {
      return {displacement("left", {"1e-3*x*y", "0", ""}),
              displacement("right", {"2e-3*x*y+1e-4", "1e-3*x", ""})};
    }

    class Evaluation : public ::testing::Test
    {
    protected:
      Evaluation()
        : mesh(MPI_COMM_WORLD)
        , loads(make_loads<2>(stretched()))
      {
        make_unit_box(mesh, 6);
        distort(mesh);
        fem = std::make_unique<ElasticFem<2>>(mesh, loads);
        fem->assemble(one_material<2>(), 0.);
        fem->solve(1e-12);
      }

      Mesh<2>                        mesh;
      Loads<2>                       loads;
      std::unique_ptr<ElasticFem<2>> fem;
    };

    TEST_F(Evaluation, vertices_give_the_unknowns_themselves)
    {
      std::vector<dealii::Point<2>>     points;
      std::vector<dealii::Tensor<1, 2>> expected;
      for (const auto &cell : fem->elements().unknowns.active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int vertex : cell->vertex_indices())
            {
              points.push_back(cell->vertex(vertex));
              expected.emplace_back();
              for (unsigned int d = 0; d < 2; ++d)
                expected.back()[d] = fem->solution()(cell->vertex_dof_index(vertex, d));
            }
      const auto values = fem->evaluate(points);
      for (unsigned int i = 0; i < points.size(); ++i)
        EXPECT_LT((values[i] - expected[i]).norm(), 1e-14);
    }

    TEST_F(Evaluation, known_cells_and_search_agree)
    {
      std::vector<dealii::Point<2>> centroids(mesh.triangulation.n_active_cells()), owned;
      for (const auto &cell : mesh.triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            centroids[cell->active_cell_index()] = cell->center();
            owned.push_back(cell->center());
          }
      const auto   in_cells = fem->evaluate_in_cells(centroids);
      const auto   searched = fem->evaluate(owned);
      unsigned int k        = 0;
      for (const auto &cell : mesh.triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            EXPECT_LT((in_cells[cell->active_cell_index()] - searched[k++]).norm(), 1e-14);
          }
    }

    TEST_F(Evaluation, points_just_outside_count_to_the_nearest_cell)
    {
      // The boundary stays where it was when the mesh was distorted.
      const auto values = fem->evaluate({dealii::Point<2>(1., 0.5), dealii::Point<2>(1. + 1e-3, 0.5)});
      // Displacement gradients are of the order of 1e-2 here.
      EXPECT_LT((values[0] - values[1]).norm(), 3e-5);
      EXPECT_GT(values[1].norm(), 1e-3);
    }

    // Middles of cells are vertices of the refined copy where it is not curved.
    TEST(EvaluationOnReference, is_exact_for_a_linear_field_on_a_curved_mesh)
    {
      MeshParameters parameters;
      parameters.generator = "plate with hole";
      parameters.cells     = {4, 3};
      const auto mesh      = create_mesh<2>(parameters, MPI_COMM_WORLD, "");
      // Every boundary, the hole included, moves with the linear field.
      std::vector<BoundaryConditionText> conditions;
      for (const auto &boundary : mesh->boundary_names)
        conditions.push_back(displacement(boundary.first, {"1e-3*(x+2*y)", "1e-3*(3*x-y)", ""}));
      const Loads<2>      loads = make_loads<2>(conditions);
      SolidsByMaterial<2> solids;
      for (const auto material : mesh->material_ids)
        solids[material] = elastic_constants(PlaneAssumption::plane_stress);
      ElasticFem<2> fem(*mesh, loads, 2, 2);
      fem.assemble(solids, 0.);
      fem.solve(1e-12);

      std::vector<dealii::Point<2>> points;
      for (const auto &cell : mesh->triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          points.push_back(cell->center());
      const auto values = fem.evaluate(points);
      for (unsigned int i = 0; i < points.size(); ++i)
        {
          EXPECT_NEAR(values[i][0], 1e-3 * (points[i][0] + 2 * points[i][1]), 1e-11);
          EXPECT_NEAR(values[i][1], 1e-3 * (3 * points[i][0] - points[i][1]), 1e-11);
        }
    }

    TEST_F(Evaluation, points_far_outside_are_an_error)
    {
      EXPECT_THROW(fem->evaluate({dealii::Point<2>(0.5, 0.5), dealii::Point<2>(1.5, 0.5)}), ComputationError);
    }
  } // namespace
} // namespace perideal::test
