// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/models.h>
#include <perideal/operators/weights/calibrated_stretches.h>
#include <perideal/operators/weights/calibration_memo.h>
#include <perideal/operators/weights/canonical_family.h>

#include "bodies.h"
#include "testing.h"

using namespace perideal;

namespace
{
  /// Stretches of a mesh, and how many families were calibrated for them on this rank.
  template <int dim>
  std::pair<CalibratedStretches, unsigned int> calibrated(
    const Mesh<dim> &mesh, CalibrationMemo *memo, const std::function<bool(const LocalIndex)> &is_wanted = {})
  {
    const test::Body<dim> body(mesh, 2.01);
    ModelParameters       parameters;
    parameters.model = "extended ordinary";
    parameters.form  = "energy";
    parameters.resolve(dim);
    const auto       model = create_model<dim>(parameters, 1.);
    unsigned int     n     = 0;
    Calibration<dim> how;
    how.fracture_of = [](const dealii::types::material_id) {
      BondFracture<dim> fracture;
      fracture.energy = 1.;
      return fracture;
    };
    // Asked for once a family that is calibrated.
    how.of_continuum = [&](const dealii::types::material_id, const double) {
      ++n;
      return 1e-3;
    };
    how.law       = SofteningLaw("linear");
    how.memo      = memo;
    how.is_wanted = is_wanted;
    const ElasticConstants own{1., 0.25, dim == 3 ? PlaneAssumption::solid : PlaneAssumption::plane_strain};
    const auto             stretches = calibrate_stretches<dim>(
      *body.families,
      BondList(*body.families),
      *model,
      [&](const dealii::types::material_id) { return ElasticSolid<dim>(own); },
      how);
    return {stretches, n};
  }
} // namespace

/// On a mesh of which a part has changed only families there are calibrated, and all stretches have the bits
/// that they have without a memo.
TEST(CalibrationMemo, KnowsTheFamiliesOfTheMeshBefore)
{
  const auto      mesh  = test::make_box<2>({20, 20}, {1., 1.}, 0.2, MPI_COMM_SELF);
  const auto      finer = test::make_refined_box<2>({20, 20}, {0.2, 0.2}, 0.15, MPI_COMM_SELF);
  CalibrationMemo memo;
  EXPECT_GT(calibrated(*mesh, &memo).second, 0u);
  EXPECT_EQ(calibrated(*mesh, &memo).second, 0u);
  const auto [with, n_with]       = calibrated(*finer, &memo);
  const auto [without, n_without] = calibrated(*finer, nullptr);
  EXPECT_LE(2 * n_with, n_without);
  EXPECT_EQ(with.near, without.near);
  EXPECT_EQ(with.far, without.far);
  EXPECT_EQ(with.first_near, without.first_near);
  // What the last mesh did not need is gone.
  memo.forget_unused();
  EXPECT_EQ(calibrated(*finer, &memo).second, 0u);
  memo.forget_unused();
  const std::size_t n_before = memo.size();
  EXPECT_EQ(calibrated(*finer, &memo).second, 0u);
  EXPECT_LE(memo.size(), n_before);
  EXPECT_GT(calibrated(*mesh, &memo).second, 0u);
}

/// Families that nobody asks for have the least that they can be calibrated to, those that are have what they
/// have if all are.
TEST(CalibrationMemo, CalibratesWhatIsWanted)
{
  const auto mesh           = test::make_box<2>({12, 12}, {1., 1.}, 0.3, MPI_COMM_SELF);
  const auto [all, n_all]   = calibrated<2>(*mesh, nullptr);
  const auto [some, n_some] = calibrated<2>(*mesh, nullptr, [](const LocalIndex i) { return i < 70; });
  unsigned int n_known = 0, n_unknown = 0;
  for (BondIndex slot = 0; slot < all.near.size(); ++slot)
    {
      EXPECT_TRUE(all.is_known(slot));
      n_known += some.is_known(slot) && all.near[slot] > 0 && all.far[slot] > 0;
      n_unknown += !some.is_known(slot);
      for (const auto &[known, given] :
           {std::pair{all.near[slot], some.near[slot]}, {all.far[slot], some.far[slot]}})
        if (given >= 0)
          EXPECT_EQ(given, known);
        else
          EXPECT_LE(-given, known);
    }
  EXPECT_TRUE(all.are_all_known);
  EXPECT_FALSE(some.are_all_known);
  EXPECT_GT(n_known, 0u);
  EXPECT_GT(n_unknown, 0u);
}

/// Images of a family have one canonical family, to the last bit, and members of it that are images.
TEST(CalibrationMemo, ImagesOfAFamilyAreOne)
{
  const auto          mesh = test::make_refined_box<2>({20, 20}, {0.2, 0.2}, 0.15, MPI_COMM_SELF);
  const test::Body<2> body(*mesh, 2.01);
  FamilyView<2>       family;
  unsigned int        n_moved = 0;
  for (LocalIndex i = 0; i < body.families->n_owned(); i += 7)
    {
      family.reinit(*body.families, i);
      const auto canonical = canonical_family(family, true);
      // A quarter turn, of members in another order.
      FamilyView<2> turned = family;
      for (LocalIndex j = 0; j < family.size; ++j)
        {
          const LocalIndex from  = family.size - 1 - j;
          turned.bond[0][j]      = -family.bond[1][from];
          turned.bond[1][j]      = family.bond[0][from];
          turned.volume[j]       = family.volume[from];
          turned.bond_horizon[j] = family.bond_horizon[from];
          turned.member[j]       = family.member[from];
        }
      const auto again = canonical_family(turned, true);
      EXPECT_EQ(again.family.bond, canonical.family.bond);
      EXPECT_EQ(again.family.volume, canonical.family.volume);
      EXPECT_EQ(again.family.bond_horizon, canonical.family.bond_horizon);
      EXPECT_EQ(again.family.length_square, canonical.family.length_square);
      for (LocalIndex k = 0; k < family.size; ++k)
        {
          const LocalIndex j = canonical.member_of[k];
          EXPECT_EQ(canonical.family.member[k], family.member[j]);
          EXPECT_EQ(canonical.family.volume[k], family.volume[j]);
          EXPECT_EQ(std::abs(canonical.family.bond[0][k]) + std::abs(canonical.family.bond[1][k]),
                    std::abs(family.bond[0][j]) + std::abs(family.bond[1][j]));
        }
      // Where images differ, they stay what they are.
      EXPECT_EQ(canonical_family(family, false).family.bond, family.bond);
      n_moved += canonical.family.bond != family.bond;
    }
  EXPECT_GT(n_moved, 0u);
}
