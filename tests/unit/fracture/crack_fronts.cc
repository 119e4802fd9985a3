// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/fracture/crack_fronts.h>

#include "bodies.h"
#include "testing.h"

#include <cmath>

using namespace perideal;

namespace
{
  /// A plate of unit cells with horizons of 1.5, in which fronts pass.
  struct Plate
  {
    Plate()
      : mesh(test::make_box<2>({40, 30}, {40., 30.}, 0.))
      , body(*mesh, 1.5)
      , fronts(body.nodes)
      , damage(body.nodes.size(), 0.)
    {
      motion.reinit(2 * body.nodes.size(), 0, MPI_COMM_WORLD);
      fronts.begin(damage);
    }

    /// Lets nodes within half a unit of a place, and less so the next ones, lose bonds.
    void lose_around(const dealii::Point<2> &place)
    {
      for (LocalIndex i = 0; i < damage.size(); ++i)
        damage[i] += 0.1 * std::max(0., 1.2 - body.nodes.position[i].distance(place));
    }

    /// Sets a motion that fades around a place.
    void move_around(const dealii::Point<2> &place)
    {
      for (LocalIndex i = 0; i < damage.size(); ++i)
        for (int d = 0; d < 2; ++d)
          motion.local_element(2 * i + d) += value(body.nodes.position[i], place)[d];
    }

    static dealii::Tensor<1, 2> value(const dealii::Point<2> &point, const dealii::Point<2> &place)
    {
      const double r = point.distance(place);
      return dealii::Tensor<1, 2>({std::exp(-r), (point[1] - place[1]) / (1. + r * r)});
    }

    dealii::Tensor<1, 2> carried_at(const LocalIndex i) const
    {
      return dealii::Tensor<1, 2>({carried.local_element(2 * i), carried.local_element(2 * i + 1)});
    }

    std::unique_ptr<Mesh<2>> mesh;
    test::Body<2>            body;
    CrackFronts<2>           fronts;
    std::vector<double>      damage;
    NodalVector              motion, carried;
  };
} // namespace

TEST(CrackFronts, NothingIsCarriedBeforeAFrontHasMoved)
{
  Plate plate;
  plate.move_around({10.5, 15.5});
  EXPECT_FALSE(plate.fronts.carry(plate.motion, plate.carried));
  plate.lose_around({10.5, 15.5});
  plate.fronts.note(plate.damage);
  EXPECT_FALSE(plate.fronts.carry(plate.motion, plate.carried));
  // One that stays where it is.
  plate.lose_around({10.5, 15.5});
  plate.fronts.note(plate.damage);
  EXPECT_FALSE(plate.fronts.carry(plate.motion, plate.carried));
  // Steps in which nothing is lost.
  plate.fronts.note(plate.damage);
  EXPECT_FALSE(plate.fronts.carry(plate.motion, plate.carried));
}

TEST(CrackFronts, MotionGoesWithEachFrontByItsOwnWay)
{
  Plate                  plate;
  const dealii::Point<2> left(8.5, 10.5), right(30.5, 20.5);
  // To the right by one cell, and up and to the left by one each.
  const dealii::Tensor<1, 2> left_way({1., 0.}), right_way({-1., 1.});
  for (const double step : {0., 1.})
    {
      plate.lose_around(left + step * left_way);
      plate.lose_around(right + step * right_way);
      plate.fronts.note(plate.damage);
    }
  plate.move_around(left + left_way);
  plate.move_around(right + right_way);
  ASSERT_TRUE(plate.fronts.carry(plate.motion, plate.carried));
  unsigned int n_near = 0;
  for (LocalIndex i = 0; i < plate.damage.size(); ++i)
    {
      const auto &x = plate.body.nodes.position[i];
      for (const auto &[place, way] : {std::pair(left, left_way), std::pair(right, right_way)})
        {
          if (x.distance(place + way) > 3.)
            continue;
          // That of two places each, as it stood one way back.
          const auto there = x - way;
          const auto value = Plate::value(there, left + left_way) + Plate::value(there, right + right_way);
          EXPECT_LT((plate.carried_at(i) - value).norm(), 1e-12) << x;
          ++n_near;
        }
      if (std::min(x.distance(left + left_way), x.distance(right + right_way)) > 8.)
        {
          EXPECT_EQ(plate.carried_at(i)[0], plate.motion.local_element(2 * i));
        }
    }
  EXPECT_GT(dealii::Utilities::MPI::sum(n_near, MPI_COMM_WORLD), 40u);
}

TEST(CrackFronts, AFarAwayFrontIsNoneThatMoved)
{
  Plate plate;
  for (const dealii::Point<2> &place : {dealii::Point<2>(5.5, 5.5), dealii::Point<2>(30.5, 20.5)})
    {
      plate.lose_around(place);
      plate.fronts.note(plate.damage);
    }
  EXPECT_FALSE(plate.fronts.carry(plate.motion, plate.carried));
}
