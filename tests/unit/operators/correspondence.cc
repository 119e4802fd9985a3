// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/boundary/boundary_faces.h>
#include <perideal/materials/models.h>
#include <perideal/operators/force/consistent_force.h>
#include <perideal/operators/linear/consistent_operator.h>
#include <perideal/operators/linear/correspondence_tangent.h>

#include <deal.II/base/mpi.h>

#include "bodies.h"
#include "dense_matrix.h"
#include "near_blocks.h"
#include "testing.h"

#include <cmath>

using namespace perideal;

namespace
{
  const char *const forms[] = {"family", "consistent"};

  /// A body of unit modulus with its force and tangent; with the consistent form, all of its boundary has
  /// prescribed values.
  template <int dim>
  struct CorrespondenceBody
  {
    using Gradient = dealii::Tensor<2, dim>;

    CorrespondenceBody(const Mesh<dim>   &mesh,
                       const std::string &form,
                       const std::string &law,
                       const Gradient    &H,
                       const std::string &stabilisation = "5")
      : H(H)
      , body(mesh, 2.015)
    {
      ModelParameters parameters;
      parameters.model         = "correspondence";
      parameters.form          = form;
      parameters.law           = law;
      parameters.stabilisation = stabilisation;
      parameters.resolve(dim);
      const ElasticSolid<dim> solid(
        ElasticConstants{1., 0.33, dim == 3 ? PlaneAssumption::solid : PlaneAssumption::plane_stress});
      laws[0] = create_law<dim>(law, solid);
      LoadParameters text;
      for (unsigned int b = 0; b < 2 * dim; ++b)
        {
          text.conditions.emplace_back();
          text.conditions.back().name = text.conditions.back().boundary = std::to_string(b);
          for (int d = 0; d < dim; ++d)
            text.conditions.back().displacement[d] = test::formula(H, d);
        }
      const Loads<dim> loads    = resolve_boundaries(mesh, Loads<dim>(text));
      const auto       solid_of = [solid](const dealii::types::material_id) { return solid; };
      if (form == "consistent")
        {
          const auto polynomials = std::make_shared<const CellPolynomials<dim>>(mesh, body.nodes);
          const auto faces =
            std::make_shared<const FaceMoments<dim>>(mesh, *polynomials, [](const auto) { return 1.; });
          face_values = std::make_shared<FaceValues<dim>>(faces->boundary_points(), loads);
          face_values->set_time(loads, 1.);
          moments =
            std::make_shared<const GradientMoments<dim>>(polynomials, faces, face_values, MPI_COMM_WORLD);
          const auto bonds = std::make_shared<ConsistentBonds<dim>>(
            body.families, *polynomials, create_consistent<dim>(parameters, 2.015), solid_of);
          force   = std::make_unique<ConsistentForce<dim>>(body.families, moments, bonds, laws);
          tangent = std::make_unique<ConsistentOperator<dim>>(body.families, moments, bonds, solid_of);
        }
      else
        {
          const auto rows = std::make_shared<CorrespondenceRows<dim>>(
            body.families, create_correspondence<dim>(parameters), solid_of);
          force   = std::make_unique<CorrespondenceForce<dim>>(body.families, rows, laws);
          tangent = std::make_unique<CorrespondenceTangent<dim>>(body.families, rows, laws);
        }
      for (NodalVector *vector : {&displacement, &result, &other})
        tangent->initialize(*vector);
    }

    /// u = H x, at the nodes or of means over cells, as it is at prescribed faces.
    void displace()
    {
      for (LocalIndex i = 0; i < body.nodes.size(); ++i)
        for (int d = 0; d < dim; ++d)
          displacement.local_element(dim * i + d) =
            (H * (moments ? moments->cell_polynomials().centroids()[i] : body.nodes.position[i]))[d];
    }

    /// Adds a field without pattern, of a share of the spacing.
    void scatter(const double share)
    {
      for (LocalIndex i = 0; i < body.nodes.size(); ++i)
        for (int d = 0; d < dim; ++d)
          displacement.local_element(dim * i + d) +=
            share * body.nodes.spacing[i] * test::scatter(body.nodes.position[i], d);
    }

    NodalVector direction(const unsigned int seed) const
    {
      NodalVector field(result);
      for (LocalIndex i = 0; i < body.nodes.size(); ++i)
        for (int d = 0; d < dim; ++d)
          field.local_element(dim * i + d) = test::scatter(body.nodes.position[i], 7 * seed + d);
      return field;
    }

    /// The force of form "family".
    CorrespondenceForce<dim> &of_family() { return dynamic_cast<CorrespondenceForce<dim> &>(*force); }

    const Gradient                              H;
    test::Body<dim>                             body;
    std::shared_ptr<const GradientMoments<dim>> moments;
    LawsByMaterial<dim>                         laws;
    std::shared_ptr<FaceValues<dim>>            face_values;
    std::unique_ptr<BondForce<dim>>             force;
    std::unique_ptr<TangentOperator<dim>>       tangent;
    NodalVector                                 displacement, result, other;
  };

  template <int dim>
  dealii::Tensor<2, dim> stretch_and_shear()
  {
    dealii::Tensor<2, dim> H;
    H[0][0]             = 0.3;
    H[1][1]             = -0.1;
    H[0][1]             = 0.1;
    H[dim - 1][0]       = 0.15;
    H[dim - 1][dim - 1] = -0.05;
    return H;
  }

  template <int dim>
  dealii::Tensor<2, dim> turn(const double angle)
  {
    dealii::Tensor<2, dim> H;
    H[0][0] = H[1][1] = std::cos(angle) - 1.;
    H[1][0]           = std::sin(angle);
    H[0][1]           = -H[1][0];
    return H;
  }

  /// Calls check(body) for both gradients, all laws and boxes of every kind.
  template <int dim, typename Check>
  void for_all_bodies(const dealii::Tensor<2, dim> &H, const Check &check)
  {
    for (const auto &mesh : test::make_boxes<dim>())
      for (const char *form : forms)
        for (const std::string &law : LawChoice::list().names())
          {
            SCOPED_TRACE(std::string(form) + ", " + law + ", " +
                         std::to_string(mesh->triangulation.n_global_active_cells()) + " cells");
            CorrespondenceBody<dim> body(*mesh, form, law, H);
            check(body);
          }
  }

  template <int dim>
  void expect_tangent_of_energy()
  {
    constexpr double step = 1e-5;
    for_all_bodies<dim>(stretch_and_shear<dim>(), [](auto &b) {
      b.displace();
      b.scatter(0.05);
      b.force->compute(b.result, b.displacement);
      b.tangent->linearise(*b.force);
      const NodalVector at = b.displacement, force = b.result, d = b.direction(1), e = b.direction(2);

      // The force against the energy, the tangent against the force, along a direction.
      b.displacement.add(step, d);
      b.force->compute(b.result, b.displacement);
      const double more = b.force->strain_energy();
      b.displacement.add(-2 * step, d);
      b.force->compute(b.other, b.displacement);
      const double less = b.force->strain_energy();
      b.displacement    = at;
      EXPECT_NEAR(-(force * d), (more - less) / (2 * step), 1e-7 * force.l2_norm() * d.l2_norm());
      b.other.sadd(0.5 / step, -0.5 / step, b.result);
      b.tangent->vmult(b.result, d);
      const double size = b.result.l2_norm();
      NodalVector  change(b.result);
      change -= b.other;
      // Differences leave the square of the step.
      EXPECT_LT(change.l2_norm(), 1e-7 * size);

      // Symmetry, and the diagonal by unit vectors.
      b.tangent->vmult(b.other, e);
      EXPECT_NEAR(b.result * e, b.other * d, 1e-12 * size * e.l2_norm());
      const auto blocks = b.tangent->jacobi_blocks();
      const auto range  = b.result.get_partitioner()->local_range();
      for (GlobalIndex node = 0; node < b.result.size() / dim; node += 7)
        {
          dealii::Tensor<2, dim> of_diagonal;
          const bool             mine = dim * node >= range.first && dim * node < range.second;
          const LocalIndex       i    = mine ? (dim * node - range.first) / dim : 0;
          for (int c = 0; c < dim; ++c)
            {
              NodalVector unit(b.result);
              unit = 0.;
              if (mine)
                unit(dim * node + c) = 1.;
              b.tangent->vmult(b.other, unit);
              for (int a = 0; mine && a < dim; ++a)
                of_diagonal[a][c] = b.other.local_element(dim * i + a);
            }
          if (!mine)
            continue;
          if (b.moments)
            test::expect_preconditions(blocks[i], of_diagonal);
          else
            {
              EXPECT_LE((blocks[i] - of_diagonal).norm(), 1e-11 * size);
            }
        }
    });
  }

  template <int dim>
  void expect_rigid_motions_cost_nothing()
  {
    for_all_bodies<dim>(turn<dim>(0.), [](auto &b) {
      b.displace();
      b.force->compute(b.result, b.displacement);
      EXPECT_EQ(b.result.linfty_norm(), 0.);
    });
    for_all_bodies<dim>(turn<dim>(1.), [](auto &b) {
      if (b.laws.begin()->second->is_linear())
        return;
      b.displace();
      b.force->compute(b.result, b.displacement);
      EXPECT_LT(b.result.linfty_norm(), 1e-13);
      // Of the neo-Hookean law, the difference of numbers like 1.
      EXPECT_LT(b.force->strain_energy(), 1e-15);
    });
  }

  template <int dim>
  void expect_patch()
  {
    // A uniform gradient on any mesh leaves no force, and the supports that of the stress.
    for (const auto &mesh : test::make_boxes<dim>())
      for (const std::string &law : LawChoice::list().names())
        {
          CorrespondenceBody<dim> b(*mesh, "consistent", law, stretch_and_shear<dim>());
          b.displace();
          b.force->compute(b.result, b.displacement);
          const auto stress = b.laws.at(0)->stress(stretch_and_shear<dim>());
          double     volume = 0;
          for (const double v : b.body.nodes.volume)
            volume += v;
          EXPECT_LT(b.result.linfty_norm(), 1e-13 * stress.norm());
          EXPECT_NEAR(b.force->strain_energy(),
                      dealii::Utilities::MPI::sum(volume, MPI_COMM_WORLD) *
                        b.laws.at(0)->energy(stretch_and_shear<dim>()),
                      1e-12);
          const auto forces = b.force->support_forces();
          for (std::size_t e = 0; e < forces.size(); ++e)
            {
              const auto &point = b.moments->faces().boundary_points()[b.face_values->entries()[e].point];
              EXPECT_LT((forces[e] - stress * point.area).norm(), 1e-12 * point.area.norm());
            }
        }
  }
} // namespace

TEST(Correspondence, ForceAndTangentAreDerivativesOfTheEnergy)
{
  expect_tangent_of_energy<2>();
  expect_tangent_of_energy<3>();
}

TEST(Correspondence, RigidMotionsCostNothing)
{
  expect_rigid_motions_cost_nothing<2>();
  expect_rigid_motions_cost_nothing<3>();
}

TEST(Correspondence, ConsistentFormMeetsUniformGradients)
{
  expect_patch<2>();
  expect_patch<3>();
}

TEST(Correspondence, PiecesAddUpToTheTangent)
{
  for_all_bodies<2>(stretch_and_shear<2>(), [](auto &b) {
    b.displace();
    b.force->compute(b.result, b.displacement);
    b.tangent->linearise(*b.force);
    const NodalVector d = b.direction(3);
    b.tangent->vmult(b.result, d);
    // The direction, whole on every rank.
    dealii::Vector<double> whole(d.size()), product(d.size());
    const GlobalIndex      first = d.get_partitioner()->local_range().first;
    for (std::size_t k = 0; k < d.locally_owned_size(); ++k)
      whole(first + k) = d.local_element(k);
    dealii::Utilities::MPI::sum(whole, MPI_COMM_WORLD, whole);
    test::dense_matrix(*b.tangent).vmult(product, whole);
    for (std::size_t k = 0; k < d.locally_owned_size(); ++k)
      b.other.local_element(k) = product(first + k) - b.result.local_element(k);
    EXPECT_LT(b.other.linfty_norm(), 1e-12 * b.result.linfty_norm());
  });
}

TEST(Correspondence, PenaltyLeavesRigidMotionsAlone)
{
  // VNOSB fig. 2 on 24 x 24 points: the fourth eigenvalue over the largest, without the penalty and with
  // alpha = 5 E, as an independent prototype finds them.
  const auto mesh = test::make_box<2>({24, 24}, {1., 1.}, 0.);
  for (const auto &expected : {std::make_pair("0", 1.25e-5), std::make_pair("5", 7.28e-4)})
    {
      const CorrespondenceBody<2> b(
        *mesh, "family", "linear elastic", dealii::Tensor<2, 2>(), expected.first);
      const auto values = test::spectrum(*b.tangent);
      ASSERT_EQ(values.size(), 2 * 24 * 24u);
      const double largest = values[values.size() - 1];
      EXPECT_LT(std::abs(values[2]), 1e-12 * largest);
      EXPECT_NEAR(values[3] / largest, expected.second, 0.01 * expected.second);
    }
}

TEST(Correspondence, BondsBreakByTheMeanStressOfTheirEnds)
{
  // Pulled until every bond is at 1.05 of its strength: those within reach of a plane may break, do so
  // together, and their energy goes.
  const auto           mesh = test::make_box<2>({12, 6}, {1., 0.5}, 0.);
  dealii::Tensor<2, 2> H;
  H[0][0] = 1e-3;
  H[1][1] = -0.33e-3;
  CorrespondenceBody<2> b(*mesh, "family", "linear elastic", H);
  b.displace();
  const auto   stress   = b.laws.at(0)->cauchy_stress(H);
  const double strength = stress[0][0] / 1.05;
  const auto  &position = b.body.families->position;
  const auto   crosses  = [&](const LocalIndex i, const LocalIndex j) {
    return (position[i][0] - 0.5) * (position[j][0] - 0.5) < 0;
  };
  b.of_family().set_strength([&](const auto, const auto &s) { return s[0][0] / strength; }, crosses);
  b.force->judge_bonds(Judgement::on_trial);
  b.force->compute(b.result, b.displacement);
  const double before = b.force->strain_energy();
  EXPECT_EQ(b.force->n_broken_now(), 0u);
  b.force->judge_bonds(Judgement::for_good);
  b.force->compute(b.result, b.displacement);
  // 2.015 spacings: 6 bonds between neighbouring columns, 2 x 5 diagonal ones, 2 x 6 two columns apart.
  EXPECT_EQ(b.force->n_broken_now(), 6u + 10u + 12u);
  const NodalVector none(b.result.get_partitioner());
  EXPECT_NEAR(b.force->released_energy(none, 0.), before - b.force->strain_energy(), 1e-12 * before);
  // Both halves are free of each other, and of force under motions of their own.
  for (LocalIndex i = 0; i < b.body.nodes.size(); ++i)
    b.displacement.local_element(2 * i) = position[i][0] > 0.5 ? 0.1 : 0.;
  for (LocalIndex i = 0; i < b.body.nodes.size(); ++i)
    b.displacement.local_element(2 * i + 1) = 0.;
  b.force->compute(b.result, b.displacement);
  EXPECT_LT(b.result.linfty_norm(), 1e-15);
  EXPECT_EQ(b.of_family().n_without_gradient(), 0u);
}

TEST(Correspondence, NodesThatHangByALineOfBondsBearNoStress)
{
  const auto            mesh = test::make_box<2>({8, 8}, {1., 1.}, 0.);
  CorrespondenceBody<2> b(*mesh, "family", "Saint Venant-Kirchhoff", stretch_and_shear<2>());
  const auto           &position = b.body.families->position;
  // The node nearest to the middle keeps its bonds along x only.
  const dealii::Point<2> hanging(0.4375, 0.4375);
  b.force->cut([&](const dealii::Point<2> &p, const dealii::Point<2> &q) {
    return (p.distance(hanging) < 1e-9 || q.distance(hanging) < 1e-9) && std::abs(p[1] - q[1]) > 1e-9;
  });
  b.displace();
  b.force->compute(b.result, b.displacement);
  EXPECT_EQ(b.of_family().n_without_gradient(), 1u);
  const auto gradients = b.of_family().gradients();
  for (LocalIndex i = 0; i < gradients.size(); ++i)
    EXPECT_NEAR((gradients[i] -
                 (position[i].distance(hanging) < 1e-9 ? dealii::Tensor<2, 2>() : stretch_and_shear<2>()))
                  .norm(),
                0.,
                1e-12);
}
