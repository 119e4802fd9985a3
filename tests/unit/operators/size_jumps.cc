// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/operators/system/stable_time_step.h>
#include <perideal/parameters/elastic_constants.h>

#include "bodies.h"
#include "moments.h"
#include "testing.h"

using namespace perideal;

namespace
{
  enum class Refined
  {
    corner,
    all_but_a_corner,
    all
  };

  /// Stable step of a free plate or strip two cells thick, some cells of which are halved.
  template <int dim>
  double step_of_thin_body(const Refined refined)
  {
    std::vector<unsigned int> cells(dim, 8);
    dealii::Point<dim>        size;
    for (int d = 0; d < dim; ++d)
      size[d] = 8.;
    cells[dim - 1]  = 2;
    size[dim - 1]   = 2.;
    const auto mesh = test::make_box<dim>(cells, size, 0.);
    for (const auto &cell : mesh->triangulation.active_cell_iterators())
      {
        bool in_corner = true;
        for (int d = 0; d < dim - 1; ++d)
          in_corner = in_corner && cell->center()[d] > 4.;
        if (cell->is_locally_owned() &&
            (refined == Refined::all || in_corner == (refined == Refined::corner)))
          cell->set_refine_flag();
      }
    mesh->triangulation.execute_coarsening_and_refinement();

    const test::Body<dim>  body(*mesh, 2.01);
    const ElasticConstants constants{
      1., 0.25, dim == 2 ? PlaneAssumption::plane_strain : PlaneAssumption::solid};
    const auto bonds = test::make_moving_operator<dim>(
      *mesh, body.nodes, body.families, 2.01, [&](const auto) { return ElasticSolid<dim>(constants); });
    const ConstrainedOperator<dim> system(bonds,
                                          std::make_shared<MirrorLayer<dim>>(body.nodes),
                                          body.nodes,
                                          std::vector<std::uint8_t>(dim * body.nodes.size(), 0));
    return stable_time_step<dim>(system, [](const dealii::types::material_id) { return 1.; });
  }

  template <int dim>
  void expect_steps_of_small_cells()
  {
    const double of_small_cells = step_of_thin_body<dim>(Refined::all);
    for (const Refined refined : {Refined::corner, Refined::all_but_a_corner})
      {
        const double step = step_of_thin_body<dim>(refined);
        EXPECT_GT(step, 0.95 * of_small_cells);
        EXPECT_LT(step, 1.3 * of_small_cells);
      }
  }
} // namespace

/// With equal weights of cells their steps are .65 in two dimensions, .5 and .7 in three.
TEST(SizeJumps, ThinBodiesMoveInTheStepsOfTheirSmallCells)
{
  expect_steps_of_small_cells<2>();
  expect_steps_of_small_cells<3>();
}
