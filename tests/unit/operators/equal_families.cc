// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/models.h>
#include <perideal/operators/linear/family_operator.h>
#include <perideal/operators/weights/equal_families.h>
#include <perideal/operators/weights/family_weights.h>

#include "bodies.h"
#include "dense_matrix.h"
#include "testing.h"

#include <string>
#include <utility>
#include <vector>

using namespace perideal;

namespace
{
  /// The same body twice: equal families weighed once, and each family weighed.
  template <int dim>
  struct Pair
  {
    Pair(const test::Body<dim> &body, const std::string &model, const std::string &form)
      : body(body)
    {
      ModelParameters parameters;
      parameters.model = model;
      parameters.form  = form;
      parameters.resolve(dim);
      const ElasticConstants own = parameters.constants_of_model(
        {1., 0.3, dim == 3 ? PlaneAssumption::solid : PlaneAssumption::plane_strain});
      const auto weigh = [&](const bool share) {
        return weigh_bonds<dim>(body.families,
                                *create_model<dim>(parameters, 1.),
                                [&](const dealii::types::material_id) { return ElasticSolid<dim>(own); },
                                {{}, false, share});
      };
      shared = weigh(true);
      apart  = weigh(false);
    }

    const test::Body<dim>            &body;
    std::shared_ptr<BondWeights<dim>> shared, apart;
  };

  template <int dim>
  const std::vector<std::pair<std::string, std::string>> models_and_forms = {{"bond based", "energy"},
                                                                             {"ordinary", "energy"},
                                                                             {"extended ordinary", "paper"},
                                                                             {"extended ordinary", "energy"}};

  /// The largest difference over the largest value, of all ranks.
  double difference(NodalVector a, const NodalVector &b)
  {
    a -= b;
    return a.linfty_norm() / b.linfty_norm();
  }

  template <int dim>
  void expect_the_same(const Pair<dim> &pair)
  {
    const auto  shared = create_bond_operator<dim>(std::shared_ptr<const BondWeights<dim>>(pair.shared));
    const auto  apart  = create_bond_operator<dim>(std::shared_ptr<const BondWeights<dim>>(pair.apart));
    NodalVector displacement, a, b;
    for (NodalVector *vector : {&displacement, &a, &b})
      shared->initialize(*vector);
    for (LocalIndex i = 0; i < pair.body.nodes.size(); ++i)
      for (int d = 0; d < dim; ++d)
        displacement.local_element(dim * i + d) = 1e-3 * test::scatter(pair.body.nodes.position[i], d);

    shared->vmult(a, displacement);
    apart->vmult(b, displacement);
    EXPECT_LT(difference(a, b), 1e-13);

    const auto blocks = shared->jacobi_blocks(), expected = apart->jacobi_blocks();
    for (std::size_t i = 0; i < blocks.size(); ++i)
      EXPECT_LT((blocks[i] - expected[i]).norm(), 1e-13 * expected[i].norm());

    auto       matrix          = test::dense_matrix(*shared);
    const auto expected_matrix = test::dense_matrix(*apart);
    matrix.add(-1., expected_matrix);
    EXPECT_LT(matrix.linfty_norm(), 1e-13 * expected_matrix.linfty_norm());

    const auto force          = create_bond_force<dim>(*pair.shared),
               expected_force = create_bond_force<dim>(*pair.apart);
    force->compute(a, displacement);
    expected_force->compute(b, displacement);
    // Weights are in single precision there: rounding may choose another neighbour.
    EXPECT_LT(difference(a, b), 1e-7);

    // The tangent at rest is the operator.
    const auto tangent = create_tangent<dim>(std::shared_ptr<const BondWeights<dim>>(pair.shared));
    tangent->vmult(a, displacement);
    apart->vmult(b, displacement);
    EXPECT_LT(difference(a, b), 1e-13);
  }

  template <int dim>
  void expect_the_same(const test::Body<dim> &body, const GlobalIndex n_different)
  {
    const bool alone = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1;
    for (const auto &variant : models_and_forms<dim>)
      {
        SCOPED_TRACE(variant.first + ", " + variant.second);
        const Pair<dim> pair(body, variant.first, variant.second);
        EXPECT_EQ(pair.apart->counts.different, body.nodes.n_global);
        if (alone)
          EXPECT_EQ(pair.shared->counts.different, n_different);
        else
          EXPECT_LT(pair.shared->counts.different, body.nodes.n_global);
        expect_the_same(pair);
      }
  }
} // namespace

/// Along each axis, a node has 0, 1 or 2 cells before it, or at least 3 on either side, or 2, 1 or 0 behind
/// it.
TEST(EqualFamilies, ShareTheirWeights2D)
{
  const auto mesh = test::make_box<2>({12, 9}, {1.2, 0.9}, 0.);
  expect_the_same<2>(test::Body<2>(*mesh), 7 * 7);
}

TEST(EqualFamilies, ShareTheirWeights3D)
{
  const auto mesh = test::make_box<3>({9, 6, 5}, {0.9, 0.6, 0.5}, 0.);
  expect_the_same<3>(test::Body<3>(*mesh, 2.01), 5 * 5 * 5);
}

/// Cells that are no squares, by volumes in part: these reach three cells far along the short side.
TEST(EqualFamilies, ShareTheirWeightsOnRectangles)
{
  const auto mesh = test::make_box<2>({14, 11}, {2.1, 1.1}, 0.);
  expect_the_same<2>(test::Body<2>(*mesh, 2.01, "sphere", "partial volume"), 5 * 7);
}

/// Two sizes of cells: families are recognised in either.
TEST(EqualFamilies, KnowSizesOfCellsApart)
{
  auto mesh = test::make_box<2>({24, 20}, {2.4, 2.}, 0.);
  for (const auto &cell : mesh->triangulation.active_cell_iterators())
    if (cell->is_locally_owned() && cell->center()[0] < 0.6)
      cell->set_refine_flag();
  mesh->triangulation.execute_coarsening_and_refinement();
  const test::Body<2> body(*mesh);
  const Pair<2>       pair(body, "extended ordinary", "energy");
  EXPECT_LT(2 * pair.shared->counts.different, body.nodes.n_global);
  expect_the_same(pair);
}

/// The material is part of what families are.
TEST(EqualFamilies, KnowMaterialsApart)
{
  auto mesh = test::make_box<2>({16, 16}, {1., 1.}, 0.);
  for (const auto &cell : mesh->triangulation.active_cell_iterators())
    if (cell->is_locally_owned() && cell->center()[0] < 0.5)
      cell->set_material_id(cell->material_id() + 1);
  const test::Body<2>     body(*mesh);
  EqualFamilies<2>        equal(*body.families);
  FamilyView<2>           view;
  std::vector<LocalIndex> codes;
  for (LocalIndex i = 0; i < body.families->n_owned(); ++i)
    {
      view.reinit(*body.families, i);
      equal.find(view, body.families->material[i], codes);
    }
  // The inside stands on both sides of the middle, the surfaces on one.
  const LocalIndex in_the_whole = 7 * (3 + 1 + 1 + 3);
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
    {
      EXPECT_EQ(equal.size(), in_the_whole);
    }
  else
    {
      EXPECT_LE(equal.size(), in_the_whole);
    }
}

/// Where no family is like another, each is weighed.
TEST(EqualFamilies, LeaveIrregularMeshesAlone)
{
  const auto          mesh = test::make_box<2>({12, 12}, {1., 1.}, 0.3);
  const test::Body<2> body(*mesh);
  EXPECT_FALSE(EqualFamilies<2>::are_many(*body.families));
  const Pair<2> pair(body, "extended ordinary", "energy");
  EXPECT_EQ(pair.shared->counts.different, body.nodes.n_global);
  expect_the_same(pair);
}
