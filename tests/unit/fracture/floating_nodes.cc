// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/fracture/floating_nodes.h>

#include "bodies.h"
#include "testing.h"

#include <cmath>

using namespace perideal;

namespace
{
  /// A square of 9 x 8 cells that is cut along x = a and, above y = b on the right of it, apart once more.
  struct CutSquare
  {
    CutSquare()
      : mesh(test::make_box<2>({9, 8}, {9., 8.}, 0.))
      , body(*mesh, 2.015)
      , bonds(*body.families)
      , held(2 * body.nodes.size(), 0)
    {
    }

    void hold(const LocalIndex i, const int component) { held[2 * i + component] = 1; }

    std::vector<bool> floating() const
    {
      const auto       &position = body.families->position;
      std::vector<bool> is_lost(bonds.n_slots(), false);
      for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
        for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
          {
            const auto &p = position[i], &q = position[bonds.neighbour[slot]];
            is_lost[slot] = (p[0] - 3.) * (q[0] - 3.) < 0 || (p[0] > 3. && (p[1] - 4.) * (q[1] - 4.) < 0);
          }
      return find_floating_nodes(
        *body.families, bonds, [&](const BondIndex slot) { return is_lost[slot]; }, held);
    }

    /// Which of the pieces a node is in: 0 left, 1 right below, 2 right above.
    int piece(const LocalIndex i) const
    {
      const auto &p = body.nodes.position[i];
      return p[0] < 3. ? 0 : p[1] < 4. ? 1 : 2;
    }

    void expect_loose(const std::vector<bool> &loose) const
    {
      const auto floats = floating();
      ASSERT_EQ(floats.size(), body.nodes.size());
      for (LocalIndex i = 0; i < body.nodes.size(); ++i)
        EXPECT_EQ(floats[i], loose[piece(i)]) << body.nodes.position[i];
    }

    std::unique_ptr<Mesh<2>>  mesh;
    test::Body<2>             body;
    BondList                  bonds;
    std::vector<std::uint8_t> held;
  };
} // namespace

TEST(FloatingNodes, AreThoseThatNoBondsLeadToFromTheSupports)
{
  CutSquare square;
  // One node at the foot of the left piece.
  for (LocalIndex i = 0; i < square.body.nodes.size(); ++i)
    if (square.body.nodes.position[i].distance({0.5, 0.5}) < 1e-9)
      {
        square.hold(i, 0);
        square.hold(i, 1);
      }
  square.expect_loose({false, true, true});
  // A roller does not hold a piece while another one is clamped.
  for (LocalIndex i = 0; i < square.body.nodes.size(); ++i)
    if (square.body.nodes.position[i][0] > 8.)
      square.hold(i, 0);
  square.expect_loose({false, true, true});
}

TEST(FloatingNodes, RollersHoldWhereNothingIsClamped)
{
  CutSquare square;
  for (LocalIndex i = 0; i < square.body.nodes.size(); ++i)
    if (square.body.nodes.position[i].distance({8.5, 7.5}) < 1e-9)
      square.hold(i, 1);
  square.expect_loose({true, true, false});
}

TEST(FloatingNodes, AreNotThereInABodyThatNothingHolds)
{
  CutSquare().expect_loose({false, false, false});
}
