// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/boundary/surface_planes.h>
#include <perideal/treatments/treatments.h>

#include "bodies.h"
#include "moments.h"
#include "testing.h"

using namespace perideal;

namespace
{
  template <typename Value>
  Value sum(const Value &value)
  {
    return dealii::Utilities::MPI::sum(value, MPI_COMM_WORLD);
  }

  /// A box that is held at its lower end along x and loaded on other sides.
  template <int dim>
  struct Scene
  {
    Scene()
      : mesh(make_mesh())
      , body(*mesh)
      , faces(find_boundary_faces(*mesh, body.nodes))
    {
      parameters.conditions.resize(3);
      const char *names[] = {"held", "pulled", "pressed"};
      for (unsigned int k = 0; k < 3; ++k)
        {
          parameters.conditions[k].name     = names[k];
          parameters.conditions[k].boundary = std::to_string(k);
        }
      for (int d = 0; d < dim; ++d)
        parameters.conditions[0].displacement[d] = "1e-3*t";
      // Along the normals, which the line-to-point force needs.
      parameters.conditions[1].traction = {{"2+0*y", "0", dim == 3 ? "0" : ""}};
      parameters.conditions[2].pressure = "3";
      loads                             = resolve_boundaries(*mesh, Loads<dim>(parameters));
      bonds.families                    = body.families;
      bonds.moments  = test::make_moments(*mesh, body.nodes, std::make_shared<const FaceValues<dim>>());
      bonds.solid_of = [](const auto) {
        return ElasticSolid<dim>(ElasticConstants{1., 0.25, PlaneAssumption::plane_strain});
      };
    }

    static std::unique_ptr<Mesh<dim>> make_mesh()
    {
      if constexpr (dim == 2)
        return test::make_box<2>({9, 7}, {0.9, 0.7}, 0.);
      else
        return test::make_box<3>({7, 6, 6}, {0.7, 0.6, 0.6}, 0.);
    }

    TreatedBody<dim> treated() { return {*mesh, body.nodes, faces, loads, parameters, timings}; }

    std::unique_ptr<Mesh<dim>>     mesh;
    test::Body<dim>                body;
    std::vector<BoundaryFace<dim>> faces;
    LoadParameters                 parameters;
    Loads<dim>                     loads;
    TreatedBonds<dim>              bonds;
    Timings                        timings{MPI_COMM_WORLD};
  };

  /// Whatever spreads tractions over nodes, those that claim balance leave their resultant as it is.
  template <int dim>
  void expect_resultants()
  {
    Scene<dim>       scene;
    Resultant<dim>   applied;
    dealii::IndexSet owned(dim * scene.body.nodes.n_global);
    owned.add_range(dim * scene.body.nodes.first_global,
                    dim * (scene.body.nodes.first_global + scene.body.nodes.size()));
    NodalVector displacement(owned, MPI_COMM_WORLD);
    visit_faces(scene.loads.conditions[2], scene.faces, [&](const BoundaryFace<dim> &face) {
      const auto part = integrate_traction<dim>(scene.loads.conditions[2], face, 1., dealii::Point<dim>());
      applied.force += part.force;
      applied.moment += part.moment;
    });
    applied                 = {sum(applied.force), sum(applied.moment)};
    unsigned int n_balanced = 0;
    for (const std::string &name : names_of<TractionTreatment>())
      {
        SCOPED_TRACE(name);
        scene.parameters.traction_treatment =
          dealii::Patterns::Tools::Convert<TractionTreatment>::to_value(name);
        if (scene.parameters.traction_treatment == TractionTreatment::automatic)
          continue;
        const auto treatment = create_tractions<dim>(scene.treated(), scene.bonds);
        if (!treatment->keep_balance() || !treatment->are_nodal_forces())
          continue;
        ++n_balanced;
        const auto part = treatment->resultant(2, 1., displacement);
        EXPECT_LE((sum(part.force) - applied.force).norm(), 1e-12 * applied.force.norm());
      }
    EXPECT_EQ(n_balanced, 3u);
  }

  /// Every treatment of displacements holds the body in one way, and says in which.
  template <int dim>
  void expect_held()
  {
    Scene<dim> scene;
    for (const std::string &name : names_of<DisplacementTreatment>())
      {
        SCOPED_TRACE(name);
        scene.parameters.displacement_treatment =
          dealii::Patterns::Tools::Convert<DisplacementTreatment>::to_value(name);
        if (scene.parameters.displacement_treatment == DisplacementTreatment::automatic)
          continue;
        const auto supports = create_supports<dim>(scene.treated());
        supports->make_face_values(scene.bonds.moments->faces().boundary_points());
        EXPECT_EQ(supports->describe().find(name), 0u);
        EXPECT_EQ(supports->images()->n_real(), supports->unknowns().size());
        EXPECT_EQ(supports->held().mask().size(), dim * supports->unknowns().size());

        const double n_held     = supports->held().entries().size();
        const double n_at_faces = supports->face_values()->entries().size();
        EXPECT_EQ(sum(n_held) > 0, supports->hold_nodes());
        EXPECT_EQ(sum(n_at_faces) > 0, !supports->hold_nodes());
        EXPECT_EQ(supports->unknowns().n_global > scene.body.nodes.n_global,
                  supports->surface_nodes() != nullptr);

        RigidBodyMotions<dim> motions(dealii::Point<dim>(), 1.);
        EXPECT_FALSE(motions.free_motions(MPI_COMM_WORLD).empty());
        supports->hold(motions);
        EXPECT_TRUE(motions.free_motions(MPI_COMM_WORLD).empty());
      }
  }
} // namespace

TEST(Treatments, KeepTheResultantsOfTractions)
{
  expect_resultants<2>();
  expect_resultants<3>();
}

TEST(Treatments, HoldTheBody)
{
  expect_held<2>();
  expect_held<3>();
}

/// Force and moment of the tractions on a side, by midpoints, which are exact for linear tractions.
TEST(LayerTractions, AreExactForLinearTractions)
{
  Scene<2> scene;
  scene.parameters.conditions[1].traction = {{"2", "3*y", ""}};
  scene.parameters.conditions[2].pressure = "";
  scene.parameters.conditions[2].traction = {{"", "-4*t", ""}};
  scene.loads                             = resolve_boundaries(*scene.mesh, Loads<2>(scene.parameters));
  const auto       treatment              = load_by_layer<2>(scene.treated(), scene.bonds);
  dealii::IndexSet owned(2 * scene.body.nodes.n_global);
  owned.add_range(2 * scene.body.nodes.first_global,
                  2 * (scene.body.nodes.first_global + scene.body.nodes.size()));
  NodalVector force(owned, MPI_COMM_WORLD);
  treatment->add_tractions(scene.loads, 0.5, force);
  const auto total = treatment->add_up(force);
  // 2 over a height of 0.7; 3 y over it, and -2 over a width of 0.9.
  EXPECT_NEAR(sum(total.force)[0], 1.4, 1e-13);
  EXPECT_NEAR(sum(total.force)[1], 1.5 * 0.7 * 0.7 - 1.8, 1e-13);
}
