// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/models.h>
#include <perideal/operators/force/cell_steps.h>
#include <perideal/operators/force/consistent_force.h>
#include <perideal/operators/force/levelled_force.h>

#include "bodies.h"
#include "moments.h"
#include "testing.h"

#include <cmath>

using namespace perideal;

namespace
{
  /// A stretched and bent body whose nodes are of levels 0, 1 and 2 from left to right.
  template <int dim>
  struct SteppedBody
  {
    SteppedBody(const Mesh<dim> &mesh, const std::string &model, const std::string &form)
      : body(mesh, form == "consistent" ? 2.015 : 3.01)
    {
      ModelParameters parameters;
      parameters.model = model;
      parameters.form  = form;
      parameters.resolve(dim);
      const ElasticConstants own = parameters.constants_of_model(
        {1., 0.3, dim == 3 ? PlaneAssumption::solid : PlaneAssumption::plane_strain});
      const ElasticSolid<dim> solid(own);
      const auto              solid_of = [solid](const dealii::types::material_id) { return solid; };
      if (parameters.is_consistent())
        {
          moments = test::make_moments(mesh, body.nodes, std::make_shared<const FaceValues<dim>>());
          LawsByMaterial<dim> laws;
          laws[0] = create_law<dim>(LawChoice("Saint Venant-Kirchhoff"), solid);
          bonds   = std::make_unique<ConsistentForce<dim>>(
            body.families,
            moments,
            std::make_shared<ConsistentBonds<dim>>(body.families,
                                                   moments->cell_polynomials(),
                                                   create_consistent<dim>(parameters, 2.015),
                                                   solid_of),
            laws);
        }
      else
        {
          weights = weigh_bonds<dim>(body.families, *create_model<dim>(parameters, 1.), solid_of);
          bonds   = create_bond_force<dim>(*weights);
        }
      bonds->initialize(displacement);
      std::vector<unsigned int> own_level;
      for (LocalIndex i = 0; i < body.nodes.size(); ++i)
        {
          const dealii::Point<dim> &x = body.nodes.position[i];
          own_level.push_back(x[0] < 0.3 ? 0 : x[0] < 0.6 ? 1 : 2);
          for (int d = 0; d < dim; ++d)
            displacement.local_element(dim * i + d) =
              0.1 * x[d] + 0.05 * std::sin(3. * x[(d + 1) % dim]) + 0.01 * test::scatter(x, d);
        }
      if (moments)
        steps = std::make_shared<const CellSteps>(*moments, *body.families, bonds->bond_list(), own_level, 3);
      else
        steps = std::make_shared<const LocalSteps>(*body.families, bonds->bond_list(), own_level, 3);
      by_level().take_local_steps(steps);
      parts.resize(3);
      for (LevelledForce::Part &part : parts)
        bonds->initialize(part.force);
    }

    LevelledForce &by_level() { return dynamic_cast<LevelledForce &>(*bonds); }

    NodalVector force()
    {
      NodalVector result(displacement);
      bonds->compute(result, displacement);
      return result;
    }

    NodalVector sum_of_parts(const unsigned int highest)
    {
      by_level().compute_parts(parts, displacement, highest);
      NodalVector result(parts[0].force);
      for (unsigned int level = 1; level <= highest; ++level)
        result += parts[level].force;
      return result;
    }

    /// Moves the nodes of the levels up to one.
    void move(const unsigned int highest)
    {
      for (LocalIndex i = 0; i < body.nodes.size(); ++i)
        for (int d = 0; d < dim && steps->level_of(i) <= highest; ++d)
          displacement.local_element(dim * i + d) += 0.01 * test::scatter(body.nodes.position[i], d + 7);
    }

    test::Body<dim>                             body;
    std::shared_ptr<const GradientMoments<dim>> moments;
    std::shared_ptr<BondWeights<dim>>           weights;
    std::unique_ptr<BondForce<dim>>             bonds;
    std::shared_ptr<const LocalSteps>           steps;
    std::vector<LevelledForce::Part>            parts;
    NodalVector                                 displacement;
  };

  const std::vector<std::pair<std::string, std::string>> models = {{"bond based", "energy"},
                                                                   {"ordinary", "energy"},
                                                                   {"extended ordinary", "paper"},
                                                                   {"extended ordinary", "energy"},
                                                                   {"extended ordinary", "consistent"}};

  /// Parts of all levels are the force; those of some levels change as it does where only their nodes move.
  template <int dim>
  void expect_parts_of_force(const Mesh<dim> &mesh)
  {
    for (const auto &[model, form] : models)
      {
        SteppedBody<dim>  body(mesh, model, form);
        const NodalVector whole = body.force();
        const double      scale = whole.l2_norm();
        NodalVector       sum   = body.sum_of_parts(2);
        sum -= whole;
        EXPECT_LE(sum.l2_norm(), 1e-13 * scale) << model << ' ' << form;
        for (unsigned int highest = 0; highest < 3; ++highest)
          {
            NodalVector change = body.force();
            // Seen beside what all levels together have left.
            body.sum_of_parts(2);
            NodalVector change_of_parts(body.parts[0].force);
            for (unsigned int level = 1; level <= highest; ++level)
              change_of_parts += body.parts[level].force;
            body.move(highest);
            change_of_parts -= body.sum_of_parts(highest);
            change -= body.force();
            change -= change_of_parts;
            EXPECT_LE(change.l2_norm(), 1e-13 * scale) << model << ' ' << form << " level " << highest;
          }
      }
  }
} // namespace

TEST(LocalSteps, PartsAreThoseOfTheForce)
{
  for (const auto &mesh : test::make_boxes<2>())
    expect_parts_of_force(*mesh);
  for (const auto &mesh : test::make_boxes<3>())
    expect_parts_of_force(*mesh);
  // Some blocks of rows are beyond the reach of the lowest level.
  expect_parts_of_force(*test::make_box<2>({60, 12}, {1.5, 0.3}, 0.2));
}

/// Nodes are of the lowest level in their family, families of that of their members.
TEST(LocalSteps, LevelsReachOverAFamily)
{
  const auto     mesh = test::make_box<2>({40, 5}, {1., 0.125}, 0.);
  SteppedBody<2> body(*mesh, "bond based", "energy");
  // Columns of cells of .025 with horizons of 3.01 cells: bounds move by three columns, those of families by
  // six.
  for (LocalIndex i = 0; i < body.body.nodes.size(); ++i)
    {
      const double x = body.body.nodes.position[i][0];
      EXPECT_EQ(body.steps->level_of(i), x < 0.375 ? 0u : x < 0.675 ? 1u : 2u) << x;
    }
  const std::vector<GlobalIndex> expected = {90, 60, 50};
  EXPECT_EQ(body.steps->n_families(), expected);
  EXPECT_TRUE(body.steps->any_up_to(0));
  EXPECT_NEAR(body.steps->share_of_cell_steps(), (90 + 30 + 12.5) / 200., 1e-14);
}

/// Cells of the consistent form are of the lowest level of the nodes that they and the far ends of the bonds
/// in their rows are made of: two columns for the bonds of nodes, then one for polynomials, one across faces,
/// and up to two for bonds, which stand in the row of one of their ends.
TEST(LocalSteps, LevelsReachOverStencils)
{
  const auto     mesh = test::make_box<2>({40, 5}, {1., 0.125}, 0.);
  SteppedBody<2> body(*mesh, "extended ordinary", "consistent");
  for (LocalIndex i = 0; i < body.body.nodes.size(); ++i)
    {
      const double x = body.body.nodes.position[i][0];
      EXPECT_EQ(body.steps->level_of(i), x < 0.35 ? 0u : x < 0.65 ? 1u : 2u) << x;
    }
  const std::vector<GlobalIndex> n = body.steps->n_families();
  EXPECT_GE(n[0], 16u * 5u);
  EXPECT_LE(n[0], 18u * 5u);
  EXPECT_GE(n[0] + n[1], 28u * 5u);
  EXPECT_LE(n[0] + n[1], 30u * 5u);
  EXPECT_EQ(n[0] + n[1] + n[2], 40u * 5u);
}
