// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/boundary/boundary_faces.h>
#include <perideal/boundary/nodal_strain.h>

#include "bodies.h"
#include "boundary/elastic_field.h"
#include "testing.h"

using namespace perideal;
using namespace elastic_field_test;

namespace
{
  template <int dim>
  void expect_strain_at_nodes()
  {
    const Field<dim> field(0.);
    for (const auto &mesh : test::make_boxes<dim>())
      {
        const Nodes<dim>        nodes(*mesh, NodeParameters{3.01});
        const FaceGradient<dim> gradient(*mesh, nodes, [](const auto) { return 1.; });
        const Loads<dim>        loads = resolve_boundaries(*mesh, Loads<dim>(field.loads()));
        FaceValues<dim>         held(gradient.boundary_points(), loads);
        held.set_time(loads, 1.);
        const auto u = at_nodes(nodes, [&](const auto &x) { return field.displacement(x); });
        for (const auto &prescribed : {FaceValues<dim>(), held})
          {
            const auto strains = compute_nodal_strain(gradient, prescribed, nodes, u);
            ASSERT_EQ(strains.size(), nodes.size());
            for (const auto &strain : strains)
              EXPECT_LE((strain - symmetrize(field.at_origin)).norm(), 1e-10 * field.at_origin.norm());
          }
      }
  }
} // namespace

TEST(NodalStrain, IsExactForLinearFields)
{
  expect_strain_at_nodes<2>();
  expect_strain_at_nodes<3>();
}

/// A prescribed value takes the place of the interpolated one: the strain
/// changes by half their difference times face over volume.
TEST(NodalStrain, HeedsPrescribedFaceValues)
{
  const auto            mesh = test::make_box<2>({4, 4}, {1., 1.}, 0.);
  const Nodes<2>        nodes(*mesh, NodeParameters{3.01});
  const FaceGradient<2> gradient(*mesh, nodes, [](const auto) { return 1.; });
  LoadParameters        text;
  BoundaryConditionText condition;
  condition.name = condition.boundary = "1";
  condition.displacement[1]           = "0.5";
  text.conditions                     = {condition};
  const Loads<2> loads                = resolve_boundaries(*mesh, Loads<2>(text));
  FaceValues<2>  held(gradient.boundary_points(), loads);
  held.set_time(loads, 1.);
  const auto strains =
    compute_nodal_strain(gradient, held, nodes, std::vector<dealii::Tensor<1, 2>>(nodes.size()));
  for (LocalIndex i = 0; i < nodes.size(); ++i)
    {
      EXPECT_NEAR(strains[i][0][1], nodes.position[i][0] > 0.75 ? 0.5 * 0.5 / 0.25 : 0., 1e-14);
      EXPECT_NEAR(strains[i][0][0], 0., 1e-14);
      EXPECT_NEAR(strains[i][1][1], 0., 1e-14);
    }
}
