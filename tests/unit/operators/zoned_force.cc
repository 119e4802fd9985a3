// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/models.h>
#include <perideal/operators/force/zoned_force.h>
#include <perideal/operators/linear/zoned_tangent.h>
#include <perideal/output/checkpoint.h>
#include <perideal/output/lasting_state.h>
#include <perideal/parameters/elastic_constants.h>

#include "bodies.h"
#include "moments.h"
#include "testing.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

using namespace perideal;

namespace
{
  /// Says which share of its strength a stress takes of a node.
  using Utilisation = std::function<double(const LocalIndex, const dealii::SymmetricTensor<2, 3> &)>;

  /// A box of unit modulus in the consistent form, with bonds where it is strained most.
  template <int dim>
  struct ZonedBox
  {
    explicit ZonedBox(const double       begins,
                      MPI_Comm           communicator = MPI_COMM_WORLD,
                      const bool         all_at_once  = false,
                      const Utilisation &utilisation  = {})
      : mesh(make_mesh(communicator))
      , body(*mesh, 3.01)
      , solid(ElasticConstants{1., 0.3, dim == 2 ? PlaneAssumption::plane_strain : PlaneAssumption::solid})
    {
      ModelParameters parameters;
      parameters.model = "extended ordinary";
      parameters.form  = "consistent";
      parameters.resolve(dim);
      const auto solid_of = [this](const dealii::types::material_id) { return solid; };
      const auto moments  = test::make_moments(*mesh, body.nodes, std::make_shared<const FaceValues<dim>>());
      const auto bonds    = std::make_shared<ConsistentBonds<dim>>(
        body.families, moments->cell_polynomials(), create_consistent<dim>(parameters, 3.01), solid_of);
      cells = std::make_shared<ConsistentOperator<dim>>(body.families, moments, bonds, solid_of);
      LawsByMaterial<dim> laws;
      laws[0] = create_law<dim>(LawChoice("Saint Venant-Kirchhoff"), solid);
      force   = std::make_unique<ZonedForce<dim>>(
        std::make_unique<ConsistentForce<dim>>(body.families, moments, bonds, laws),
        body.families,
        [this,
         solid_of,
         model = std::shared_ptr<LinearModel<dim>>(create_model<dim>(parameters.in_zone(), 1.))](
          const auto &families) {
          return weigh_bonds<dim>(families, *model, solid_of, {{}, true, false});
        },
        std::vector<std::pair<dealii::Point<dim>, double>>(),
        all_at_once);
      const SofteningLaw law("linear", static_cast<bool>(utilisation));
      force->set_limits({[begins, law](const Families<dim> &, BondForce<dim> &made) {
                           made.set_critical_stretch([begins](const auto, const auto) { return 3. * begins; },
                                                     law,
                                                     [begins](const auto, const auto) { return begins; });
                         },
                         [begins](const LocalIndex) { return begins; },
                         {utilisation, [begins](const LocalIndex) { return std::make_pair(begins, 0.3); }}});
      tangent = std::make_unique<ZonedTangent<dim>>(cells);
      force->initialize(value);
    }

    /// A pull along the first axis that is largest in the middle, and something without pattern.
    NodalVector pulled(const double strain, const double rough) const
    {
      NodalVector result(value);
      for (LocalIndex i = 0; i < body.nodes.size(); ++i)
        {
          const auto x = body.nodes.position[i];
          for (int d = 0; d < dim; ++d)
            result.local_element(dim * i + d) = rough * test::scatter(x, d);
          result.local_element(dim * i) +=
            strain * 4. * std::tanh(0.5 * (x[0] - 0.5 * length)) * (1. + 0.1 * x[1] / width);
        }
      return result;
    }

    static constexpr double length = 64., width = dim == 2 ? 8. : 4.;

    static std::unique_ptr<Mesh<dim>> make_mesh(MPI_Comm communicator)
    {
      dealii::Point<dim>        size;
      std::vector<unsigned int> cells(dim, width);
      for (int d = 0; d < dim; ++d)
        size[d] = width;
      size[0] = cells[0] = length;
      return test::make_box<dim>(cells, size, 0.1, communicator);
    }

    std::unique_ptr<Mesh<dim>>               mesh;
    test::Body<dim>                          body;
    ElasticSolid<dim>                        solid;
    std::shared_ptr<ConsistentOperator<dim>> cells;
    std::unique_ptr<ZonedForce<dim>>         force;
    std::unique_ptr<ZonedTangent<dim>>       tangent;
    NodalVector                              value;
  };

  /// In a zone of whole bonds the force is the gradient of the energy, and the tangent that of the force.
  template <int dim>
  void expect_energy_force_and_tangent()
  {
    ZonedBox<dim>     box(0.04);
    ZonedForce<dim>  &force = *box.force;
    const NodalVector at    = box.pulled(0.012, 1e-4);
    // Where bonds are not judged the force stays the same, unless it is told to change.
    force.judge_bonds(Judgement::on_trial);
    force.compute(box.value, at);
    EXPECT_FALSE(force.fracture_zone().is_there());
    EXPECT_TRUE(force.extend_bonds(at));
    EXPECT_TRUE(force.fracture_zone().is_there());
    EXPECT_FALSE(force.extend_bonds(at));
    EXPECT_LT(force.fracture_zone().n_nodes(), box.mesh->triangulation.n_global_active_cells());
    force.compute(box.value, at);
    const NodalVector there = box.value;

    // Forces of bonds are in single precision.
    const double      step      = 1e-4;
    const NodalVector direction = box.pulled(0.3, 1.);
    const auto        after     = [&](const double share) {
      NodalVector u(at);
      u.add(share * step, direction);
      force.compute(box.value, u);
      return force.strain_energy();
    };
    const double slope = (after(1.) - after(-1.)) / (2. * step);
    EXPECT_NEAR(-(there * direction), slope, 1e-5 * std::abs(slope));

    after(1.);
    NodalVector difference = box.value;
    after(-1.);
    difference -= box.value;
    difference *= -1. / (2. * step);
    force.compute(box.value, at);
    box.tangent->linearise(force);
    NodalVector product(box.value);
    box.tangent->vmult(product, direction);
    difference -= product;
    EXPECT_LE(difference.l2_norm(), 2e-3 * product.l2_norm());
  }

  /// The zone appears, and what that changes is booked.
  template <int dim>
  void expect_growth_to_be_booked()
  {
    ZonedBox<dim>     whole(1e3), growing(0.04);
    const NodalVector at = whole.pulled(0.012, 0.), velocity = whole.pulled(1., 0.3);
    whole.force->compute(whole.value, at);
    EXPECT_FALSE(whole.force->fracture_zone().is_there());
    growing.force->compute(growing.value, at);
    EXPECT_TRUE(growing.force->fracture_zone().is_there());
    NodalVector change(growing.value);
    change -= whole.value;
    const double before = whole.force->strain_energy(), lost = before - growing.force->strain_energy();
    EXPECT_NEAR(
      growing.force->switched_energy(velocity, 0.1), lost - 0.05 * (velocity * change), 1e-6 * before);
    // Both forms store the same but for what the strain varies within a family, and at the surfaces.
    EXPECT_LE(std::abs(lost), 0.2 * before);
    growing.force->compute(growing.value, at);
    EXPECT_EQ(growing.force->switched_energy(velocity, 0.1), 0.);
  }

  /// Where the zone is and what it does do not depend on how the body is divided among ranks.
  template <int dim>
  void expect_same_zone_on_ranks()
  {
    ZonedBox<dim> shared(0.04), alone(0.04, MPI_COMM_SELF);
    for (ZonedBox<dim> *box : {&shared, &alone})
      for (const double strain : {0.004, 0.009, 0.012})
        box->force->compute(box->value, box->pulled(strain, 1e-4));
    EXPECT_EQ(shared.force->fracture_zone().n_nodes(), alone.force->fracture_zone().n_nodes());
    EXPECT_NEAR(
      shared.force->strain_energy(), alone.force->strain_energy(), 1e-9 * alone.force->strain_energy());
    const auto  &chi = shared.force->fracture_zone().share(), &of_all = alone.force->fracture_zone().share();
    const double size = alone.value.linfty_norm();
    for (LocalIndex i = 0; i < shared.body.families->n_local(); ++i)
      for (LocalIndex j = 0; j < alone.body.nodes.size(); ++j)
        if (shared.body.families->position[i].distance(alone.body.nodes.position[j]) < 1e-9)
          {
            EXPECT_NEAR(chi[i], of_all[j], 1e-12);
            for (int d = 0; i < shared.body.nodes.size() && d < dim; ++d)
              EXPECT_NEAR(
                shared.value.local_element(dim * i + d), alone.value.local_element(dim * j + d), 1e-6 * size);
          }
  }

  /// While bonds soften and break, families that are made on demand do what all families do.
  template <int dim>
  void expect_families_on_demand_to_do()
  {
    ZonedBox<dim>     demand(0.01), all(0.01, MPI_COMM_WORLD, true);
    const GlobalIndex n_nodes = demand.mesh->triangulation.n_global_active_cells();
    EXPECT_EQ(demand.force->whole_families().nodes, 0u);
    EXPECT_EQ(all.force->whole_families().nodes, n_nodes);
    GlobalIndex n_broken = 0;
    for (const double strain : {0.002, 0.003, 0.01, 0.03, 0.06, 0.02})
      {
        for (ZonedBox<dim> *box : {&demand, &all})
          box->force->compute(box->value, box->pulled(strain, 1e-4));
        const double size = all.value.linfty_norm(), energy = all.force->strain_energy();
        for (LocalIndex i = 0; i < dim * all.body.nodes.size(); ++i)
          EXPECT_NEAR(demand.value.local_element(i), all.value.local_element(i), 1e-6 * size);
        EXPECT_NEAR(demand.force->strain_energy(), energy, 1e-6 * energy);
        EXPECT_NEAR(demand.force->switched_energy(all.value, 0.),
                    all.force->switched_energy(all.value, 0.),
                    1e-6 * energy);
        EXPECT_EQ(demand.force->n_broken_now(), all.force->n_broken_now());
        n_broken += all.force->n_broken_now();
        const auto damage = demand.force->damage(), of_all = all.force->damage();
        for (LocalIndex i = 0; i < damage.size(); ++i)
          EXPECT_NEAR(damage[i], of_all[i], 1e-12);
      }
    EXPECT_GT(n_broken, 0u);
    EXPECT_LT(demand.force->whole_families().nodes, n_nodes);
    EXPECT_GT(demand.force->whole_families().nodes, demand.force->fracture_zone().n_nodes());
  }
  /// Utilisation by the largest principal stress of a box of unit modulus.
  Utilisation largest_stress_over(const double strength)
  {
    return [strength](const LocalIndex, const dealii::SymmetricTensor<2, 3> &stress) {
      return dealii::eigenvalues(stress)[0] / strength;
    };
  }

  /// Bonds that wait for a stress stay whole beyond the stretch at which they would soften.
  template <int dim>
  void expect_bonds_to_wait()
  {
    ZonedBox<dim> never(0.01, MPI_COMM_WORLD, false, [](const auto, const auto &) { return 0.; });
    ZonedBox<dim> by_stretch(0.01), by_stress(0.01, MPI_COMM_WORLD, false, largest_stress_over(0.01));
    double        whole = 0, by_both = 0;
    for (ZonedBox<dim> *box : {&never, &by_stretch, &by_stress})
      for (const double strain : {0.004, 0.007, 0.015})
        box->force->compute(box->value, box->pulled(strain, 0.));
    const auto largest = [](const ZonedBox<dim> &box) {
      const auto   damage = box.force->damage();
      const double here   = damage.empty() ? 0. : *std::max_element(damage.begin(), damage.end());
      return dealii::Utilities::MPI::max(here, MPI_COMM_WORLD);
    };
    EXPECT_EQ(largest(never), 0.);
    whole   = largest(by_stretch);
    by_both = largest(by_stress);
    EXPECT_GT(whole, 0.2);
    // Calibrated alike; at the middle the pull is held across, where a stretch begins as under a uniaxial
    // one.
    EXPECT_NEAR(by_both, whole, 0.5 * whole);
  }

  /// Which bonds a stress starts, and when, does not depend on how the body is divided among ranks.
  template <int dim>
  void expect_same_onset_on_ranks()
  {
    ZonedBox<dim> shared(0.01, MPI_COMM_WORLD, false, largest_stress_over(0.01));
    ZonedBox<dim> alone(0.01, MPI_COMM_SELF, false, largest_stress_over(0.01));
    for (ZonedBox<dim> *box : {&shared, &alone})
      for (const double strain : {0.004, 0.007, 0.012, 0.02})
        box->force->compute(box->value, box->pulled(strain, 1e-4));
    const double energy = alone.force->strain_energy();
    EXPECT_NEAR(shared.force->strain_energy(), energy, 1e-6 * energy);
    const auto damage = shared.force->damage(), of_all = alone.force->damage();
    double     most = 0;
    for (LocalIndex i = 0; i < damage.size(); ++i)
      for (LocalIndex j = 0; j < of_all.size(); ++j)
        if (shared.body.families->position[i].distance(alone.body.nodes.position[j]) < 1e-9)
          {
            EXPECT_NEAR(damage[i], of_all[j], 1e-5);
            most = std::max(most, damage[i]);
          }
    EXPECT_GT(dealii::Utilities::MPI::max(most, MPI_COMM_WORLD), 0.2);
  }
  /// A run that goes on has the bonds that were started, and where they begin.
  template <int dim>
  void expect_started_bonds_to_last()
  {
    const auto    criterion = largest_stress_over(0.01);
    ZonedBox<dim> before(0.01, MPI_COMM_SELF, false, criterion), after(0.01, MPI_COMM_SELF, false, criterion);
    for (const double strain : {0.004, 0.007})
      before.force->compute(before.value, before.pulled(strain, 1e-4));
    const unsigned int                       rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    const perideal::test::TemporaryDirectory of_test;
    const std::string                        directory = of_test.path(std::to_string(rank));
    std::filesystem::create_directories(directory);
    CheckpointNodes nodes{{}, before.body.nodes.size(), before.body.nodes.n_global, MPI_COMM_SELF};
    for (LocalIndex i = 0; i < nodes.n_owned; ++i)
      nodes.key.push_back(i);
    LastingState saved, resumed;
    before.force->register_state(saved);
    after.force->register_state(resumed);
    Checkpoint checkpoint;
    checkpoint.header = {{"step", 1}, {"time", 0.}};
    saved.save(checkpoint);
    write_checkpoint(directory, checkpoint, nodes);
    resumed.resume(read_checkpoint(directory, nodes));
    after.force->compute(after.value, after.pulled(0.007, 1e-4));
    for (const double strain : {0.012, 0.02})
      for (ZonedBox<dim> *box : {&before, &after})
        box->force->compute(box->value, box->pulled(strain, 1e-4));
    EXPECT_EQ(before.force->damage(), after.force->damage());
    EXPECT_EQ(before.force->strain_energy(), after.force->strain_energy());
  }
} // namespace

TEST(ZonedForce, StartedBondsLast2D)
{
  expect_started_bonds_to_last<2>();
}
TEST(ZonedForce, StartedBondsLast3D)
{
  expect_started_bonds_to_last<3>();
}
TEST(ZonedForce, BondsWaitForAStress2D)
{
  expect_bonds_to_wait<2>();
}
TEST(ZonedForce, BondsWaitForAStress3D)
{
  expect_bonds_to_wait<3>();
}
TEST(ZonedForce, SameOnsetOnAnyNumberOfRanks2D)
{
  expect_same_onset_on_ranks<2>();
}
TEST(ZonedForce, SameOnsetOnAnyNumberOfRanks3D)
{
  expect_same_onset_on_ranks<3>();
}
TEST(ZonedForce, FamiliesOnDemandDoWhatAllDo2D)
{
  expect_families_on_demand_to_do<2>();
}
TEST(ZonedForce, FamiliesOnDemandDoWhatAllDo3D)
{
  expect_families_on_demand_to_do<3>();
}
TEST(ZonedForce, SameOnAnyNumberOfRanks2D)
{
  expect_same_zone_on_ranks<2>();
}
TEST(ZonedForce, SameOnAnyNumberOfRanks3D)
{
  expect_same_zone_on_ranks<3>();
}
TEST(ZonedForce, FollowsItsEnergyAndHasItsTangent2D)
{
  expect_energy_force_and_tangent<2>();
}
TEST(ZonedForce, FollowsItsEnergyAndHasItsTangent3D)
{
  expect_energy_force_and_tangent<3>();
}
TEST(ZonedForce, BooksWhatGrowthChanges2D)
{
  expect_growth_to_be_booked<2>();
}
TEST(ZonedForce, BooksWhatGrowthChanges3D)
{
  expect_growth_to_be_booked<3>();
}
