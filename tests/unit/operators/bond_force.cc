// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/models.h>
#include <perideal/operators/force/bond_force.h>
#include <perideal/operators/linear/bond_operator.h>
#include <perideal/quadrature/bond_volume.h>

#include "bodies.h"
#include "springs.h"
#include "testing.h"

#include <cmath>
#include <functional>
#include <limits>

using namespace perideal;

namespace
{
  using Variant = std::pair<std::string, std::string>;

  const std::vector<Variant> &force_variants = test::bond_models;

  /// Bonds with tensors pull sideways, which has a moment, and feel rotations.
  bool is_central(const Variant &variant)
  {
    return !ModelChoice(variant.first)->has_bond_tensors;
  }

  /// A body with its nonlinear force.
  template <int dim>
  struct LooseBody
  {
    LooseBody(const Mesh<dim> &mesh, const Variant &variant, const std::string &scheme = "one point")
      : body(mesh, 3.01, "sphere", scheme)
    {
      ModelParameters parameters;
      parameters.model = variant.first;
      parameters.form  = variant.second;
      parameters.resolve(dim);
      const ElasticConstants constants{
        1., 0.3, dim == 3 ? PlaneAssumption::solid : PlaneAssumption::plane_strain};
      weights = weigh_bonds<dim>(
        body.families, *create_model<dim>(parameters, 1.), [&](const dealii::types::material_id) {
          const ElasticConstants own = parameters.constants_of_model(constants);
          return ElasticSolid<dim>(own);
        });
      bonds = create_bond_force<dim>(*weights);
      bonds->initialize(force);
      bonds->initialize(displacement);
    }

    using Function = std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &)>;

    NodalVector field(const Function &function) const
    {
      NodalVector result(force);
      for (LocalIndex i = 0; i < body.nodes.size(); ++i)
        for (int d = 0; d < dim; ++d)
          result.local_element(dim * i + d) = function(body.nodes.position[i])[d];
      return result;
    }

    const NodalVector &force_of(const Function &function)
    {
      displacement = field(function);
      bonds->compute(force, displacement);
      return force;
    }

    test::Body<dim>                   body;
    std::shared_ptr<BondWeights<dim>> weights;
    std::unique_ptr<BondForce<dim>>   bonds;
    NodalVector                       force, displacement;
  };

  /// A field without pattern, of a size.
  template <int dim>
  typename LooseBody<dim>::Function rough_motion(const double size, const unsigned int seed)
  {
    return [=](const dealii::Point<dim> &point) {
      dealii::Tensor<1, dim> value;
      for (int d = 0; d < dim; ++d)
        value[d] = size * test::scatter(point, 5 * seed + d);
      return value;
    };
  }

  template <int dim>
  void for_all(const std::function<void(LooseBody<dim> &, const Variant &)> &property)
  {
    const auto boxes = test::make_boxes<dim>();
    for (const auto &mesh : boxes)
      for (const Variant &variant : force_variants)
        {
          SCOPED_TRACE(variant.first + ", " + variant.second);
          LooseBody<dim> loose(*mesh, variant);
          property(loose, variant);
          // Partial volumes, where spacings differ.
          if (mesh == boxes.back())
            {
              LooseBody<dim> parts(*mesh, variant, "partial volume");
              property(parts, variant);
            }
        }
  }

  /// A rigid rotation by half a radian and a translation.
  template <int dim>
  dealii::Tensor<1, dim> rigid_turn(const dealii::Point<dim> &x)
  {
    dealii::Tensor<1, dim> u;
    const double           c = std::cos(0.5), s = std::sin(0.5);
    u[0] = c * x[0] - s * x[1] - x[0] + 3.;
    u[1] = s * x[0] + c * x[1] - x[1] - 2.;
    return u;
  }

  template <int dim>
  void expect_invariants()
  {
    for_all<dim>([](LooseBody<dim> &loose, const Variant &variant) {
      const double scale = loose.force_of(rough_motion<dim>(1e-2, 1)).linfty_norm();
      ASSERT_GT(scale, 0);

      // Pair forces: momentum; central ones: angular momentum.
      dealii::Tensor<1, dim> sum;
      dealii::Tensor<2, dim> moment;
      for (LocalIndex i = 0; i < loose.body.nodes.size(); ++i)
        {
          dealii::Tensor<1, dim> f, y;
          for (int d = 0; d < dim; ++d)
            {
              f[d] = loose.force.local_element(dim * i + d);
              y[d] = loose.body.nodes.position[i][d] + loose.displacement.local_element(dim * i + d);
            }
          sum += f;
          moment += outer_product(y, f) - outer_product(f, y);
        }
      sum    = dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD);
      moment = dealii::Utilities::MPI::sum(moment, MPI_COMM_WORLD);
      EXPECT_LE(sum.norm(), 1e-12 * scale);
      EXPECT_LE(is_central(variant) ? moment.norm() : 0., 1e-12 * scale);

      // The force is the gradient of the energy, where the model says so.
      if (loose.weights->symmetric)
        {
          const NodalVector f         = loose.force;
          const NodalVector direction = loose.field(rough_motion<dim>(1., 2));
          const NodalVector middle    = loose.displacement;
          const double      h         = 1e-6;
          double            energy[2];
          for (const int side : {0, 1})
            {
              NodalVector u = middle;
              u.add(side == 0 ? -h : h, direction);
              loose.bonds->compute(loose.force, u);
              energy[side] = loose.bonds->strain_energy();
            }
          const double power = f * direction;
          EXPECT_NEAR((energy[1] - energy[0]) / (2 * h), -power, 1e-6 * std::abs(power));
        }

      // At rest exactly nothing pulls.
      EXPECT_EQ(loose.force_of(rough_motion<dim>(0., 1)).linfty_norm(), 0.);

      // At rest, and wherever the body is carried, nothing pulls.
      if (is_central(variant))
        {
          EXPECT_LE(loose.force_of(rigid_turn<dim>).linfty_norm(), 1e-11 * scale);
          EXPECT_NEAR(loose.bonds->strain_energy(), 0., 1e-20);
        }

      // Small displacements: the linear operator.
      const double      small = 1e-8;
      NodalVector       linear(loose.force);
      const NodalVector u = loose.field(rough_motion<dim>(small, 3));
      create_bond_operator<dim>(std::shared_ptr<const BondWeights<dim>>(loose.weights))->vmult(linear, u);
      loose.bonds->compute(loose.force, u);
      loose.force += linear;
      EXPECT_LE(loose.force.linfty_norm(), 1e-5 * linear.linfty_norm()) << variant.first;
    });
  }

  /// What breaking releases, from the broken bonds alone, is what two whole evaluations differ by.
  template <int dim>
  void expect_released_energy()
  {
    for (const auto &mesh : test::make_boxes<dim>())
      for (const Variant &variant : force_variants)
        {
          SCOPED_TRACE(variant.first + ", " + variant.second);
          LooseBody<dim> whole(*mesh, variant), breaking(*mesh, variant);
          const double   spacing = breaking.body.nodes.size() > 0 ? breaking.body.nodes.spacing[0] : 0.;
          const auto     motion =
            rough_motion<dim>(0.05 * dealii::Utilities::MPI::max(spacing, MPI_COMM_WORLD), 4);
          breaking.bonds->set_critical_stretch([](const LocalIndex, const LocalIndex) { return 0.04; });
          whole.force_of(motion);
          breaking.force_of(motion);
          const GlobalIndex n_broken = breaking.bonds->n_broken_now();
          ASSERT_GT(n_broken, 10u);
          ASSERT_LT(n_broken, breaking.body.families->n_bonds());

          const double      dt       = 0.1;
          const NodalVector velocity = whole.field(rough_motion<dim>(1., 5));
          const double      energy   = whole.bonds->strain_energy() - breaking.bonds->strain_energy();
          const double expected = energy - 0.5 * dt * (velocity * breaking.force - velocity * whole.force);
          EXPECT_NEAR(breaking.bonds->released_energy(velocity, dt), expected, 1e-10 * std::abs(energy));

          // For good: back at rest they stay broken, and break no more.
          breaking.bonds->compute(breaking.force, whole.field(rough_motion<dim>(0., 4)));
          EXPECT_EQ(breaking.bonds->n_broken_now(), 0u);
          double damage = 0;
          for (const double share : breaking.bonds->damage())
            damage = std::max(damage, share);
          EXPECT_GT(dealii::Utilities::MPI::max(damage, MPI_COMM_WORLD), 0.05);
          EXPECT_LE(dealii::Utilities::MPI::max(damage, MPI_COMM_WORLD), 1. + 1e-12);
        }
  }
} // namespace

TEST(BondForce, BalancesFollowsTheEnergyAndLinearises)
{
  expect_invariants<2>();
  expect_invariants<3>();
}

TEST(BondForce, TellsWhatBreakingReleases)
{
  expect_released_energy<2>();
  expect_released_energy<3>();
}

/// Cut bonds carry nothing: the halves of a body that is cut through move freely.
TEST(BondForce, CutsBondsApartFromDamage)
{
  const auto mesh = test::make_box<2>({8, 7}, {1., 1.}, 0.2);
  for (const Variant &variant : force_variants)
    {
      LooseBody<2> loose(*mesh, variant);
      loose.bonds->cut(
        [](const dealii::Point<2> &a, const dealii::Point<2> &b) { return (a[0] < 0.5) != (b[0] < 0.5); });
      const auto apart = [](const dealii::Point<2> &x) {
        return dealii::Tensor<1, 2>(dealii::Point<2>(x[0] < 0.5 ? 0. : 0.3, 0.));
      };
      EXPECT_LE(loose.force_of(apart).linfty_norm(), 1e-13);
      for (const double share : loose.bonds->damage())
        EXPECT_EQ(share, 0.);
      double cut = 0;
      for (const double share : loose.bonds->cut_share())
        cut = std::max(cut, share);
      EXPECT_GT(dealii::Utilities::MPI::max(cut, MPI_COMM_WORLD), 0.3);
    }
}

/// Damage is the share of the volume that bonds count: those that count nothing at one end do no damage
/// there.
TEST(BondForce, CountsPartialVolumesInDamage)
{
  const auto   mesh = test::make_refined_box<2>({6, 5}, {0.4, 0.5}, 0.3);
  LooseBody<2> loose(*mesh, force_variants[0], "partial volume"),
    gone(*mesh, force_variants[0], "partial volume");
  const auto &families = *loose.body.families;
  gone.bonds->cut([](const dealii::Point<2> &, const dealii::Point<2> &) { return true; });
  for (const double share : gone.bonds->cut_share())
    EXPECT_NEAR(share, 1., 1e-14);

  const auto is_cut = [](const dealii::Point<2> &a, const dealii::Point<2> &b) {
    return (a[0] < 0.55) != (b[0] < 0.55);
  };
  loose.bonds->cut(is_cut);
  const auto cut      = loose.bonds->cut_share();
  double     n_spared = 0;
  for (LocalIndex i = 0; i < families.n_owned(); ++i)
    {
      double       gone_volume = 0, volume = 0;
      unsigned int n_gone = 0;
      for (const LocalIndex *j = families.begin(i); j != families.end(i); ++j)
        {
          const double counted = volume_share(families, i, *j) * families.volume[*j];
          volume += counted;
          if (is_cut(families.position[i], families.position[*j]))
            {
              gone_volume += counted;
              ++n_gone;
            }
        }
      EXPECT_NEAR(cut[i], gone_volume / volume, 1e-13);
      n_spared += n_gone > 0 && gone_volume == 0;
    }
  EXPECT_GT(dealii::Utilities::MPI::sum(n_spared, MPI_COMM_WORLD), 0.);
}

/// A force that is told not to judge breaks nothing, however far bonds are stretched, until it is told to.
TEST(BondForce, BreaksOnlyWhenItJudges)
{
  const auto mesh = test::make_box<2>({8, 7}, {1., 1.}, 0.2);
  for (const Variant &variant : force_variants)
    {
      LooseBody<2> loose(*mesh, variant), whole(*mesh, variant);
      loose.bonds->set_critical_stretch([](const LocalIndex, const LocalIndex) { return 0.04; });
      loose.bonds->judge_bonds(Judgement::on_trial);
      const auto motion = rough_motion<2>(0.01, 6);
      loose.force_of(motion);
      EXPECT_EQ(loose.bonds->n_broken_now(), 0u);
      loose.force -= whole.force_of(motion);
      EXPECT_EQ(loose.force.linfty_norm(), 0.);
      loose.bonds->judge_bonds(Judgement::for_good);
      loose.force_of(motion);
      EXPECT_GT(loose.bonds->n_broken_now(), 0u);
    }
}

/// Families that a cut has left lopsided meet the moment conditions again, as those at a surface do: each
/// half of a body that is cut through is a body of its own, and the cut bonds count as cut.
TEST(BondForce, WeighsFamiliesAfterTheCut)
{
  const auto whole  = test::make_box<2>({12, 8}, {1.2, 0.8}, 0.);
  const auto half   = test::make_box<2>({6, 8}, {0.6, 0.8}, 0.);
  const auto is_cut = [](const dealii::Point<2> &a, const dealii::Point<2> &b) {
    return (a[0] < 0.6) != (b[0] < 0.6);
  };
  const test::Body<2> whole_body(*whole), half_body(*half);
  for (const std::string form : {"energy", "paper"})
    {
      SCOPED_TRACE(form);
      ModelParameters parameters;
      parameters.form        = form;
      parameters.multipliers = Multipliers::after_the_cut;
      parameters.resolve(2);
      const auto solid_of = [](const dealii::types::material_id) {
        return ElasticSolid<2>(ElasticConstants::of_moduli(1., 0.6, PlaneAssumption::plane_strain));
      };
      const auto weights =
        weigh_bonds<2>(whole_body.families, *create_model<2>(parameters, 1.), solid_of, {is_cut});
      const auto expected = weigh_bonds<2>(half_body.families, *create_model<2>(parameters, 1.), solid_of);
      // The right half is the mirror image of the left one.
      EXPECT_EQ(weights->counts.fallback, 2 * expected->counts.fallback);
      EXPECT_GT(expected->counts.fallback, 0u);
      EXPECT_LT(expected->counts.fallback, 48u);

      auto               bonds    = create_bond_force<2>(*weights);
      const auto         alone    = create_bond_force<2>(*expected);
      GlobalIndex        n_cut    = 0;
      const Families<2> &families = *whole_body.families;
      for (LocalIndex i = 0; i < families.n_owned(); ++i)
        for (const LocalIndex *j = families.begin(i); j != families.end(i); ++j)
          n_cut += is_cut(families.position[i], families.position[*j]);
      n_cut = dealii::Utilities::MPI::sum(n_cut, MPI_COMM_WORLD) / 2;
      EXPECT_GT(n_cut, 0u);
      EXPECT_EQ(bonds->cut(is_cut), n_cut);

      // A deformation of the left half pulls there as in the body that is nothing else.
      const auto motion = [](const dealii::Point<2> &x, const int d) {
        return 1e-2 * test::scatter(x, 7 + d);
      };
      NodalVector force, displacement, force_alone, displacement_alone;
      for (NodalVector *vector : {&force, &displacement})
        bonds->initialize(*vector);
      for (NodalVector *vector : {&force_alone, &displacement_alone})
        alone->initialize(*vector);
      for (LocalIndex i = 0; i < whole_body.nodes.size(); ++i)
        for (int d = 0; d < 2; ++d)
          if (whole_body.nodes.position[i][0] < 0.6)
            displacement.local_element(2 * i + d) = motion(whole_body.nodes.position[i], d);
      for (LocalIndex i = 0; i < half_body.nodes.size(); ++i)
        for (int d = 0; d < 2; ++d)
          displacement_alone.local_element(2 * i + d) = motion(half_body.nodes.position[i], d);
      bonds->compute(force, displacement);
      alone->compute(force_alone, displacement_alone);
      EXPECT_NEAR(bonds->strain_energy(), alone->strain_energy(), 1e-9 * alone->strain_energy());
      EXPECT_NEAR(force.l2_norm(), force_alone.l2_norm(), 1e-9 * force_alone.l2_norm());
    }
}

/// A node of which every bond is cut has no weights and no force.
TEST(BondForce, WeighsFamiliesOfNothing)
{
  const auto          mesh = test::make_box<2>({5, 5}, {1., 1.}, 0.1);
  const test::Body<2> body(*mesh);
  ModelParameters     parameters;
  parameters.form        = "energy";
  parameters.multipliers = Multipliers::after_the_cut;
  parameters.resolve(2);
  const auto all   = [](const dealii::Point<2> &, const dealii::Point<2> &) { return true; };
  const auto bonds = create_bond_force<2>(*weigh_bonds<2>(
    body.families,
    *create_model<2>(parameters, 1.),
    [](const dealii::types::material_id) {
      return ElasticSolid<2>(ElasticConstants::of_moduli(1., 0.6, PlaneAssumption::plane_strain));
    },
    {all}));
  EXPECT_EQ(bonds->cut(all), body.families->n_bonds());
  NodalVector force, displacement;
  bonds->initialize(force);
  bonds->initialize(displacement);
  for (std::size_t k = 0; k < displacement.locally_owned_size(); ++k)
    displacement.local_element(k) = 0.01 * k;
  bonds->compute(force, displacement);
  EXPECT_EQ(force.linfty_norm(), 0.);
  EXPECT_EQ(bonds->strain_energy(), 0.);
}

/// What has not moved is left out, and the forces are the same.
TEST(BondForce, LeavesOutWhatIsAtRest)
{
  const auto mesh = test::make_box<2>({600, 6}, {100., 1.}, 0.2);
  for (const Variant &variant : force_variants)
    {
      LooseBody<2> pulled(*mesh, variant), shifted(*mesh, variant);
      const auto   bump = [](const dealii::Point<2> &x) {
        dealii::Tensor<1, 2> u;
        if (x[0] < 20.)
          u[1] = 0.01 * std::sin(x[0] * x[1]);
        return u;
      };
      pulled.force_of(bump);
      // The same deformation of a body of which every node moves.
      shifted.force_of(
        [&](const dealii::Point<2> &x) { return bump(x) + dealii::Tensor<1, 2>(dealii::Point<2>(1., 0.)); });
      shifted.force -= pulled.force;
      EXPECT_LE(shifted.force.linfty_norm(), 1e-12 * pulled.force.linfty_norm());
      EXPECT_LE(pulled.bonds->share_computed(), 0.5);
      EXPECT_GE(pulled.bonds->share_computed(), 0.15);
      EXPECT_EQ(shifted.bonds->share_computed(), 1.);
    }
}

/// A body measured in kilometres and other units of stress has the same forces: weights are rounded to single
/// precision alike.
TEST(BondForce, RoundsAlikeInAllUnits)
{
  const double length = 1e-3, stress = 3e-7;
  const auto   mesh     = test::make_box<2>({9, 8}, {1., 0.9}, 0.2),
             small_mesh = test::make_box<2>({9, 8}, {1., 0.9}, 0.2);
  dealii::GridTools::scale(length, small_mesh->triangulation);
  const test::Body<2> body(*mesh), small_body(*small_mesh);
  for (const auto &variant : {std::pair<std::string, std::string>("bond based", ""),
                              {"ordinary", ""},
                              {"extended ordinary", "paper"},
                              {"extended ordinary", "energy"},
                              {"tensor involved", "moment corrected"}})
    {
      SCOPED_TRACE(variant.first + " " + variant.second);
      ModelParameters parameters;
      parameters.model = variant.first;
      parameters.form  = variant.second;
      parameters.resolve(2);
      const auto weigh = [&](const test::Body<2> &of, const double unit) {
        const auto solid = parameters.constants_of_model({unit, 0.25, PlaneAssumption::plane_strain});
        return create_bond_force<2>(*weigh_bonds<2>(
          of.families, *create_model<2>(parameters, 1.), [&](const dealii::types::material_id) {
            return ElasticSolid<2>(solid);
          }));
      };
      const auto  bonds = weigh(body, 1.), small_bonds = weigh(small_body, stress);
      NodalVector force, displacement, small_force;
      for (NodalVector *vector : {&force, &displacement, &small_force})
        bonds->initialize(*vector);
      for (LocalIndex i = 0; i < body.nodes.size(); ++i)
        for (int d = 0; d < 2; ++d)
          displacement.local_element(2 * i + d) = 0.02 * test::scatter(body.nodes.position[i], d);
      bonds->compute(force, displacement);
      const double energy = bonds->strain_energy();
      displacement *= length;
      small_bonds->compute(small_force, displacement);
      // Of unit thickness both.
      EXPECT_NEAR(small_bonds->strain_energy() / (stress * length * length), energy, 1e-11 * energy);
      small_force /= stress * length;
      small_force -= force;
      EXPECT_LT(small_force.linfty_norm(), 1e-11 * force.linfty_norm());
    }
}
