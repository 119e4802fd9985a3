// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/models.h>
#include <perideal/operators/force/bond_force.h>

#include "bodies.h"
#include "springs.h"
#include "testing.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace perideal;

namespace
{
  /// A body of unit modulus with its force.
  template <int dim>
  struct SofteningBody
  {
    SofteningBody(const Mesh<dim> &mesh, const std::pair<std::string, std::string> &model_and_form)
      : body(mesh)
    {
      ModelParameters parameters;
      parameters.model = model_and_form.first;
      parameters.form  = model_and_form.second;
      parameters.resolve(dim);
      const ElasticConstants own = parameters.constants_of_model(
        {1., 0.3, dim == 3 ? PlaneAssumption::solid : PlaneAssumption::plane_strain});
      weights = weigh_bonds<dim>(body.families,
                                 *create_model<dim>(parameters, 1.),
                                 [&](const dealii::types::material_id) { return ElasticSolid<dim>(own); });
      bonds   = create_bond_force<dim>(*weights);
      bonds->initialize(force);
    }

    /// A field without pattern, of a size.
    NodalVector scattered(const double size, const unsigned int seed) const
    {
      NodalVector result(force);
      for (LocalIndex i = 0; i < body.nodes.size(); ++i)
        for (int d = 0; d < dim; ++d)
          result.local_element(dim * i + d) = size * test::scatter(body.nodes.position[i], 5 * seed + d);
      return result;
    }

    test::Body<dim>                   body;
    std::shared_ptr<BondWeights<dim>> weights;
    std::unique_ptr<BondForce<dim>>   bonds;
    NodalVector                       force;
  };

  /// Bonds that soften take what they lose from the energy; on trial they do not keep it.
  template <int dim>
  void expect_softening_as_judged(const Mesh<dim> &mesh, const std::pair<std::string, std::string> &variant)
  {
    SofteningBody<dim> whole(mesh, variant), softening(mesh, variant);
    const double       own_spacing = whole.body.nodes.size() > 0 ? whole.body.nodes.spacing[0] : 0.;
    const NodalVector  motion =
      whole.scattered(0.05 * dealii::Utilities::MPI::max(own_spacing, MPI_COMM_WORLD), 4);
    NodalVector rest(motion);
    rest = 0.;
    softening.bonds->set_critical_stretch([](const LocalIndex, const LocalIndex) { return 0.06; },
                                          SofteningLaw("bilinear"),
                                          [](const LocalIndex, const LocalIndex) { return 0.02; });
    whole.bonds->compute(whole.force, motion);

    // Bonds that are not judged bear whatever they must.
    softening.bonds->judge_bonds(Judgement::none);
    softening.bonds->compute(softening.force, motion);
    softening.force -= whole.force;
    EXPECT_LE(softening.force.linfty_norm(), 1e-14 * whole.force.linfty_norm());
    const std::vector<double> utilisation = softening.bonds->utilisation();
    const double              largest =
      utilisation.empty() ? 0. : *std::max_element(utilisation.begin(), utilisation.end());
    EXPECT_GT(dealii::Utilities::MPI::max(largest, MPI_COMM_WORLD), 1.);

    softening.bonds->judge_bonds(Judgement::on_trial);
    NodalVector on_trial(motion);
    softening.bonds->compute(on_trial, motion);
    softening.bonds->compute(softening.force, rest);
    EXPECT_LE(softening.bonds->strain_energy(), 1e-20);
    softening.bonds->judge_bonds(Judgement::for_good);
    softening.bonds->compute(softening.force, motion);
    on_trial -= softening.force;
    EXPECT_EQ(on_trial.linfty_norm(), 0.);
    NodalVector change(softening.force);
    change -= whole.force;
    EXPECT_GT(change.linfty_norm(), 0.01 * whole.force.linfty_norm());

    const double      dt       = 0.1;
    const NodalVector velocity = whole.scattered(1., 5);
    const double      lost     = whole.bonds->strain_energy() - softening.bonds->strain_energy();
    // The paper's form is no gradient of its energy.
    if (variant.second != "paper")
      {
        EXPECT_GT(lost, 0.);
      }
    EXPECT_NEAR(softening.bonds->released_energy(velocity, dt),
                lost - 0.5 * dt * (velocity * change),
                1e-9 * std::abs(lost));

    // The same state takes next to nothing more: limits are rounded.
    softening.bonds->compute(softening.force, motion);
    EXPECT_EQ(softening.bonds->n_broken_now(), 0u);
    EXPECT_NEAR(softening.bonds->released_energy(velocity, dt), 0., 1e-5 * std::abs(lost));

    // What softened stays so where bonds are not judged.
    NodalVector as_it_is(motion);
    softening.bonds->judge_bonds(Judgement::none);
    softening.bonds->compute(as_it_is, motion);
    as_it_is -= softening.force;
    EXPECT_LE(as_it_is.linfty_norm(), 1e-14 * whole.force.linfty_norm());
  }

  /// Bonds that never break, as those of zones without failure, carry all of their force however far they
  /// open.
  template <int dim>
  void expect_whole_without_limit(const Mesh<dim> &mesh, const std::pair<std::string, std::string> &variant)
  {
    SofteningBody<dim> whole(mesh, variant), endless(mesh, variant);
    const double       own_spacing = whole.body.nodes.size() > 0 ? whole.body.nodes.spacing[0] : 0.;
    const NodalVector  motion =
      whole.scattered(0.05 * dealii::Utilities::MPI::max(own_spacing, MPI_COMM_WORLD), 4);
    endless.bonds->set_critical_stretch(
      [](const LocalIndex, const LocalIndex) { return std::numeric_limits<double>::infinity(); },
      SofteningLaw("linear"),
      [](const LocalIndex, const LocalIndex) { return 1e-4; });
    endless.bonds->judge_bonds(Judgement::for_good);
    whole.bonds->compute(whole.force, motion);
    endless.bonds->compute(endless.force, motion);
    endless.force -= whole.force;
    EXPECT_LE(endless.force.linfty_norm(), 1e-14 * whole.force.linfty_norm());
    EXPECT_FALSE(endless.bonds->softening_bonds().any_now(MPI_COMM_WORLD));
  }

  /// A bond of which it is known only what it bears takes the place on its own law where that is left, and
  /// stays whole where it could not soften.
  void expect_what_bonds_bear(const SofteningLaw &law)
  {
    constexpr double                     first = 0.02, limit = 0.06, borne = 0.7;
    const std::unique_ptr<const Mesh<2>> mesh = test::make_box<2>({8, 8}, {1., 1.}, 0.2);
    SofteningBody<2>                     body(*mesh, {"extended ordinary", "energy"});
    const BondList                      &list  = body.bonds->bond_list();
    const LocalIndex                     other = list.neighbour[list.row[0] + 1];
    body.bonds->set_critical_stretch(
      [&](const LocalIndex i, const LocalIndex j) {
        return std::min(i, j) == 0 && std::max(i, j) == other ? std::numeric_limits<double>::infinity() :
                                                                limit;
      },
      law,
      [](const LocalIndex, const LocalIndex) { return first; });
    BondMemory memory;
    for (BondIndex slot = list.row[0]; slot < list.row[1]; ++slot)
      if (list.neighbour[slot] != 0)
        memory.add({0, list.neighbour[slot]}, SoftenedBond::bearing(borne, first));
    body.bonds->restore(memory);
    const SofteningBonds &bonds   = body.bonds->softening_bonds();
    const double          stretch = law.stretch_bearing(borne, first, limit * limit);
    EXPECT_GT(stretch, first);
    for (BondIndex slot = list.row[0]; slot < list.row[1]; ++slot)
      if (const LocalIndex j = list.neighbour[slot]; j != 0)
        {
          const double share = j == other ? 1. : borne * first / stretch;
          EXPECT_NEAR(bonds.share(slot), share, 1e-6);
        }

    // Nobody is stretched: what had softened counts, beyond 1 by what it lost.
    NodalVector rest(body.force);
    body.bonds->compute(body.force, rest);
    EXPECT_NEAR(body.bonds->utilisation()[0], 2. - borne, 1e-5);
    EXPECT_EQ(body.bonds->utilisation().back(), 0.);
  }

  /// Limits of bonds, half of each unless both ends were asked for.
  template <int dim>
  struct LimitsOnDemand
  {
    double limit(const LocalIndex i, const LocalIndex j) const
    {
      const auto &position = body.body.families->position;
      return 0.02 + 0.01 * test::scatter(dealii::Point<dim>(position[i] + position[j]), 7);
    }
    bool   is_known(const LocalIndex i, const LocalIndex j) const { return asked[i] && asked[j]; }
    double told(const LocalIndex i, const LocalIndex j) const
    {
      return (is_known(i, j) ? 1. : 0.5) * limit(i, j);
    }

    /// What owners want to know counts. Collective.
    void find_out(const std::vector<bool> &nodes)
    {
      NodalVector marks(body.body.families->make_partitioner(1));
      for (LocalIndex i = 0; i < body.body.nodes.size(); ++i)
        marks.local_element(i) = nodes[i] ? 1. : 0.;
      marks.update_ghost_values();
      for (LocalIndex i = 0; i < asked.size(); ++i)
        asked[i] = marks.local_element(i) > 0;
      const auto told_of = [this](const LocalIndex i, const LocalIndex j) { return told(i, j); };
      body.bonds->set_critical_stretch(
        told_of,
        law,
        [told_of](const LocalIndex i, const LocalIndex j) { return 0.5 * told_of(i, j); },
        {[this](const LocalIndex i, const LocalIndex j) { return is_known(i, j); },
         [this](const std::vector<bool> &more) { find_out(more); }});
    }

    SofteningBody<dim> &body;
    SofteningLaw        law;
    std::vector<bool>   asked;
  };

  /// Bonds whose limits are found out when they come near them fail as if they had been known.
  template <int dim>
  void expect_the_same_on_demand(const Mesh<dim>                           &mesh,
                                 const std::pair<std::string, std::string> &variant,
                                 const SofteningLaw                        &law)
  {
    SofteningBody<dim>  known(mesh, variant), on_demand(mesh, variant);
    LimitsOnDemand<dim> limits{on_demand, law, std::vector<bool>(on_demand.body.families->n_local(), false)};
    limits.find_out(limits.asked);
    const auto limit_of = [&](const LocalIndex i, const LocalIndex j) { return limits.limit(i, j); };
    known.bonds->set_critical_stretch(
      limit_of, law, [&](const LocalIndex i, const LocalIndex j) { return 0.5 * limit_of(i, j); });
    // The farther to the right, the more.
    NodalVector motion = known.scattered(1., 4), force(motion);
    for (LocalIndex i = 0; i < known.body.nodes.size(); ++i)
      for (int d = 0; d < dim; ++d)
        motion.local_element(dim * i + d) *=
          0.1 * known.body.nodes.spacing[i] * std::pow(known.body.nodes.position[i][0] / 4., 8);
    double n_broken = 0;
    for (const double share : {0.1, 0.4, 0.7, 1.})
      for (const Judgement judgement : {Judgement::on_trial, Judgement::for_good})
        {
          NodalVector now(motion);
          now *= share;
          for (auto *body : {&known, &on_demand})
            {
              body->bonds->judge_bonds(judgement);
              body->bonds->compute(body->force, now);
            }
          force = known.force;
          force -= on_demand.force;
          EXPECT_LE(force.linfty_norm(), 1e-6 * known.force.linfty_norm());
          EXPECT_EQ(known.bonds->n_broken_now(), on_demand.bonds->n_broken_now());
          n_broken += known.bonds->n_broken_now();
          const NodalVector velocity = known.scattered(1., 5);
          EXPECT_NEAR(known.bonds->released_energy(velocity, 0.),
                      on_demand.bonds->released_energy(velocity, 0.),
                      1e-6 * known.bonds->strain_energy());
        }
    EXPECT_GT(n_broken, 0);
    const std::vector<double> damage = known.bonds->damage(), same = on_demand.bonds->damage();
    for (std::size_t i = 0; i < damage.size(); ++i)
      EXPECT_NEAR(damage[i], same[i], 1e-6);
    // Most of the body is not asked for.
    const auto         begin = limits.asked.begin();
    const unsigned int n     = dealii::Utilities::MPI::sum<unsigned int>(
      std::count(begin, begin + known.body.nodes.size(), true), MPI_COMM_WORLD);
    EXPECT_GT(n, 0u);
    EXPECT_LT(n, dealii::Utilities::MPI::sum(known.body.nodes.size(), MPI_COMM_WORLD));
  }
} // namespace

TEST(SofteningForce, FindsOutLimitsOnDemand)
{
  for (const auto &variant : test::bond_models)
    for (const char *law : {"none", "bilinear"})
      {
        SCOPED_TRACE(variant.first + ", " + variant.second + ", softening " + law);
        expect_the_same_on_demand<2>(
          *test::make_box<2>({40, 4}, {4., 0.4}, 0.2, MPI_COMM_WORLD), variant, SofteningLaw(law));
      }
}

TEST(SofteningForce, TakesUpWhatBondsBear)
{
  for (const char *law : {"linear", "bilinear", "exponential"})
    {
      SCOPED_TRACE(law);
      expect_what_bonds_bear(SofteningLaw(law));
    }
}

TEST(SofteningForce, SoftensAsFarAsItIsJudged)
{
  for (const auto &variant : test::bond_models)
    {
      SCOPED_TRACE(variant.first + ", " + variant.second);
      for (const auto &mesh : test::make_boxes<2>())
        expect_softening_as_judged<2>(*mesh, variant);
      for (const auto &mesh : test::make_boxes<3>())
        expect_softening_as_judged<3>(*mesh, variant);
    }
}

TEST(SofteningForce, LeavesBondsThatNeverBreak)
{
  for (const auto &variant : test::bond_models)
    {
      SCOPED_TRACE(variant.first + ", " + variant.second);
      for (const auto &mesh : test::make_boxes<2>())
        expect_whole_without_limit<2>(*mesh, variant);
    }
}
