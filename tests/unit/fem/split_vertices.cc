// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem_test.h"

namespace perideal::test
{
  namespace
  {
    /// A crack along y = .5 from the left side to x.
    template <int dim>
    typename SplitVertices<dim>::AreApart crack_to(const double x)
    {
      return [x](const auto &a, const auto &b) {
        return a->center()[0] < x && b->center()[0] < x && (a->center()[1] < 0.5) != (b->center()[1] < 0.5);
      };
    }

    /// Linear elements on the unit box, held as a whole at the bottom and moved along y at the top.
    template <int dim>
    struct CrackedBox
    {
      CrackedBox(const unsigned int n, const double x)
        : mesh(MPI_COMM_WORLD)
        , loads(make_loads<dim>({displacement("bottom", {"0", "0", dim == 3 ? "0" : ""}),
                                 displacement("top", {"0", "1e-3", dim == 3 ? "0" : ""})}))
      {
        make_unit_box(mesh, n);
        fem = std::make_unique<ElasticFem<dim>>(mesh, loads);
        fem->assemble(one_material<dim>(), 0., nullptr, crack_to<dim>(x));
      }

      dealii::types::global_dof_index n_added() const
      {
        return fem->elements().split ? fem->elements().split->n_added() : 0;
      }

      Mesh<dim>                        mesh;
      Loads<dim>                       loads;
      std::unique_ptr<ElasticFem<dim>> fem;
    };

    TEST(SplitVertices, a_crack_splits_the_vertices_up_to_its_tip)
    {
      const CrackedBox<2> half(8, 0.5), all(8, 1.), none(8, 0.);
      const CrackedBox<3> solid(4, 0.5);
      EXPECT_EQ(none.n_added(), 0u);
      EXPECT_EQ(half.n_added(), 2u * 4u);
      EXPECT_EQ(all.n_added(), 2u * 9u);
      EXPECT_EQ(solid.n_added(), 3u * 2u * 5u);
    }

    // The ties pull with a hundred-thousandth of the stiffness of the elements.
    TEST(SplitVertices, halves_of_a_parted_body_move_apart)
    {
      CrackedBox<2> box(8, 1.);
      box.fem->solve(1e-10);
      std::vector<dealii::types::global_dof_index> numbers(8);
      for (const auto &cell : box.fem->elements().unknowns.active_cell_iterators())
        {
          if (!cell->is_locally_owned())
            continue;
          box.fem->elements().cell_unknowns(cell, numbers);
          for (const unsigned int v : cell->vertex_indices())
            {
              EXPECT_EQ(numbers[2 * v], box.fem->elements().first_unknown(cell, v));
              EXPECT_NEAR(box.fem->solution()(numbers[2 * v + 1]), cell->center()[1] > 0.5 ? 1e-3 : 0., 2e-7);
              EXPECT_NEAR(box.fem->solution()(numbers[2 * v]), 0., 2e-7);
            }
        }
    }

    // No traction acts on planes along the stress: uniaxial tension does not see the crack.
    TEST(SplitVertices, tension_along_a_crack_is_as_without)
    {
      Mesh<2> mesh(MPI_COMM_WORLD);
      make_unit_box(mesh, 8);
      const Loads<2> loads = make_loads<2>({displacement("left", {"0", "-0.3/0.7*1e-3*y", ""}),
                                            displacement("right", {"1e-3", "-0.3/0.7*1e-3*y", ""})});
      ElasticFem<2>  fem(mesh, loads);
      fem.assemble(one_material<2>(), 0., nullptr, crack_to<2>(0.75));
      ASSERT_NE(fem.elements().split, nullptr);
      fem.solve(1e-12);
      for (const auto &cell : fem.elements().unknowns.active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int v : cell->vertex_indices())
            {
              const auto first = fem.elements().first_unknown(cell, v);
              EXPECT_NEAR(fem.solution()(first), 1e-3 * cell->vertex(v)[0], 1e-12);
              EXPECT_NEAR(fem.solution()(first + 1), -0.3 / 0.7 * 1e-3 * cell->vertex(v)[1], 1e-12);
            }
    }

    // An assembly without cracks takes the split back.
    TEST(SplitVertices, cracks_close_with_the_next_assembly)
    {
      CrackedBox<2> box(8, 1.);
      EXPECT_GT(box.n_added(), 0u);
      box.fem->assemble(one_material<2>(), 0.);
      EXPECT_EQ(box.n_added(), 0u);
      EXPECT_EQ(box.fem->matrix().m(), box.fem->n_dofs());
    }

    // Vertices on which hanging ones depend stay whole, and so do these.
    TEST(SplitVertices, hanging_vertices_stay_whole)
    {
      Mesh<2> mesh(MPI_COMM_WORLD);
      make_unit_box(mesh, 4);
      for (const auto &cell : mesh.triangulation.active_cell_iterators())
        if (cell->is_locally_owned() && cell->center()[0] > 0.5)
          cell->set_refine_flag();
      mesh.triangulation.execute_coarsening_and_refinement();
      const Loads<2> loads = make_loads<2>({displacement("bottom", {"0", "0", ""})});
      ElasticFem<2>  fem(mesh, loads);
      fem.assemble(one_material<2>(), 0., nullptr, crack_to<2>(1.));
      ASSERT_NE(fem.elements().split, nullptr);
      // Nine on the crack, five of which at x >= .5; that at .5 holds hanging ones.
      EXPECT_EQ(fem.elements().split->n_added(), 2u * (2u + 4u));
      fem.solve(1e-8);
    }
  } // namespace
} // namespace perideal::test
