// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/neighbourhood/bond_list.h>
#include <perideal/neighbourhood/families.h>

#include "bodies.h"
#include "testing.h"

#include <algorithm>
#include <set>

using namespace perideal;

namespace
{
  /// Positions and horizons of all ranks, by global number.
  template <int dim>
  struct AllNodes
  {
    explicit AllNodes(const NodeCloud<dim> &nodes)
    {
      for (const auto &part : dealii::Utilities::MPI::all_gather(nodes.communicator, nodes.position))
        position.insert(position.end(), part.begin(), part.end());
      for (const auto &part : dealii::Utilities::MPI::all_gather(nodes.communicator, nodes.horizon))
        horizon.insert(horizon.end(), part.begin(), part.end());
      for (const auto &part : dealii::Utilities::MPI::all_gather(nodes.communicator, nodes.shape))
        shape.insert(shape.end(), part.begin(), part.end());
    }

    bool share_bond(const std::size_t i, const std::size_t j) const
    {
      const auto   bond  = position[j] - position[i];
      const double reach = std::max(horizon[i], horizon[j]);
      if (shape.empty())
        return i != j && bond.norm_square() <= reach * reach;
      return i != j && ((shape[i] * bond).norm_square() <= 1 || (shape[j] * bond).norm_square() <= 1);
    }

    std::vector<dealii::Point<dim>> position;
    std::vector<double>             horizon;
    /// Empty where horizons are spheres.
    std::vector<dealii::Tensor<2, dim>> shape;
  };

  /// Every family is what trying all pairs gives.
  template <int dim>
  void expect_all_pairs(const NodeCloud<dim> &nodes)
  {
    const Families<dim> families(nodes);
    const AllNodes<dim> all(nodes);
    GlobalIndex         n_directed = 0;
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      {
        std::set<GlobalIndex> expected, found;
        for (GlobalIndex j = 0; j < all.position.size(); ++j)
          if (all.share_bond(families.global_number(i), j))
            expected.insert(j);
        EXPECT_TRUE(std::is_sorted(families.begin(i), families.end(i)));
        for (const LocalIndex *j = families.begin(i); j != families.end(i); ++j)
          {
            found.insert(families.global_number(*j));
            EXPECT_EQ(families.position[*j], all.position[families.global_number(*j)]);
          }
        EXPECT_EQ(found, expected);
        n_directed += expected.size();
      }
    EXPECT_EQ(2 * families.n_bonds(), dealii::Utilities::MPI::sum(n_directed, nodes.communicator));
  }

  /// Families that list a share have the members within it and the ghosts of whole ones; the whole families
  /// of some nodes have every bond of these, and no other.
  template <int dim>
  void expect_families_of_some(const Mesh<dim> &mesh, const std::string &shape, const std::string &scheme)
  {
    const test::Body<dim> body(mesh, 2.51, shape, scheme);
    const Families<dim>  &all = *body.families, listed(body.nodes, all.volume_rule, 0.6);
    ASSERT_EQ(listed.ghost_number, all.ghost_number);
    EXPECT_LT(listed.n_bonds(), all.n_bonds());
    EXPECT_TRUE(all.is_whole(0));
    EXPECT_FALSE(listed.is_whole(0));
    std::vector<bool> chosen(all.n_local());
    for (LocalIndex i = 0; i < all.n_local(); ++i)
      chosen[i] = test::scatter(all.position[i], 3) > 0.5;
    const auto        some = listed.whole_families(chosen);
    std::vector<bool> said_by_owners(chosen);
    std::fill(said_by_owners.begin() + all.n_owned(), said_by_owners.end(), false);
    const auto near = listed.with_members(said_by_owners);
    for (LocalIndex i = 0; i < all.n_owned(); ++i)
      {
        std::vector<LocalIndex> expected;
        for (const LocalIndex *j = all.begin(i); j != all.end(i); ++j)
          if (chosen[i] || chosen[*j])
            expected.push_back(*j);
        EXPECT_EQ(std::vector<LocalIndex>(some->begin(i), some->end(i)), expected);
        EXPECT_EQ(some->is_whole(i), chosen[i]);
        EXPECT_EQ(near[i], chosen[i] || !expected.empty());
        for (const LocalIndex *j = listed.begin(i); j != listed.end(i); ++j)
          EXPECT_TRUE(std::binary_search(all.begin(i), all.end(i), *j));
        for (LocalIndex j = 0; j < all.n_local(); ++j)
          EXPECT_EQ(all.are_members(i, j) && i != j, std::binary_search(all.begin(i), all.end(i), j));
      }
    // Of half of the body, those that no bond joins to the other half.
    double middle = 0;
    for (LocalIndex i = 0; i < all.n_owned(); ++i)
      middle += all.position[i][0];
    middle = dealii::Utilities::MPI::sum(middle, MPI_COMM_WORLD) /
             dealii::Utilities::MPI::sum(static_cast<double>(all.n_owned()), MPI_COMM_WORLD);
    std::vector<bool> half(all.n_local());
    for (LocalIndex i = 0; i < all.n_local(); ++i)
      half[i] = all.position[i][0] < middle;
    const auto   inside   = listed.with_all_members(half);
    unsigned int n_halves = 0, n_inside = 0;
    for (LocalIndex i = 0; i < all.n_owned(); ++i)
      {
        EXPECT_EQ(inside[i],
                  half[i] && std::all_of(all.begin(i), all.end(i), [&](const auto j) { return half[j]; }));
        n_halves += half[i];
        n_inside += inside[i];
      }
    EXPECT_LT(dealii::Utilities::MPI::sum(n_inside, MPI_COMM_WORLD),
              dealii::Utilities::MPI::sum(n_halves, MPI_COMM_WORLD));
    EXPECT_GT(dealii::Utilities::MPI::sum(n_inside, MPI_COMM_WORLD), 0u);
    // All ranks have said the same of their ghosts.
    NodalVector marks(all.make_partitioner(1));
    for (LocalIndex i = 0; i < all.n_owned(); ++i)
      marks.local_element(i) = near[i] ? 1. : 0.;
    marks.update_ghost_values();
    for (LocalIndex i = 0; i < all.n_local(); ++i)
      EXPECT_EQ(near[i], marks.local_element(i) > 0);
  }

  /// A box whose cells grow along x, so that horizons differ by @p ratio.
  template <int dim>
  NodeCloud<dim>
  graded_nodes(const std::vector<unsigned int> &cells, const double ratio, const std::string &horizon_shape)
  {
    dealii::Point<dim> size;
    for (int d = 0; d < dim; ++d)
      size[d] = 1;
    const auto mesh = test::make_box<dim>(cells, size, 0.2);
    dealii::GridTools::transform(
      [&](dealii::Point<dim> vertex) {
        vertex[0] = (std::pow(ratio, vertex[0]) - 1) / (ratio - 1);
        return vertex;
      },
      mesh->triangulation);
    Nodes<dim> nodes(*mesh, NodeParameters{2.2, choice_of<HorizonShape>(horizon_shape)});
    EXPECT_EQ(nodes.shape.empty(), horizon_shape == "sphere");
    return nodes;
  }
} // namespace

TEST(Families, MatchAllPairs2D)
{
  for (const auto &mesh : test::make_boxes<2>())
    expect_all_pairs<2>(Nodes<2>(*mesh, NodeParameters{3.01}));
  expect_all_pairs<2>(graded_nodes<2>({30, 6}, 40., "sphere"));
  expect_all_pairs<2>(graded_nodes<2>({30, 6}, 40., "cell"));
}

TEST(Families, MatchAllPairs3D)
{
  for (const auto &mesh : test::make_boxes<3>())
    expect_all_pairs<3>(Nodes<3>(*mesh, NodeParameters{3.01}));
  expect_all_pairs<3>(graded_nodes<3>({14, 4, 4}, 10., "sphere"));
  expect_all_pairs<3>(graded_nodes<3>({14, 4, 4}, 10., "cell"));
}

TEST(Families, RegularLatticeHasTheKnownSize)
{
  // 28 lattice points within 3.01 spacings in the plane, 122 in space.
  const auto       mesh = test::make_box<2>({12, 12}, {1., 1.}, 0.);
  const test::Body body(*mesh);
  EXPECT_EQ(body.families->statistics().max, 28u);
  const auto          block = test::make_box<3>({8, 8, 8}, {1., 1., 1.}, 0.);
  const test::Body<3> solid(*block);
  EXPECT_EQ(solid.families->statistics().max, 122u);
}

TEST(Families, AreWholeOfChosenNodes)
{
  const auto square = test::make_box<2>({14, 9}, {14., 9.}, 0.3);
  expect_families_of_some<2>(*square, "sphere", "one point");
  expect_families_of_some<2>(*square, "cell", "one point");
  expect_families_of_some<2>(*square, "sphere", "partial volume");
  expect_families_of_some<3>(*test::make_box<3>({6, 5, 4}, {6., 5., 4.}, 0.2), "sphere", "one point");
}

TEST(BondList, HoldsEveryBondOnceAndItsCursorFindsIt)
{
  const auto          mesh = test::make_box<2>({9, 8}, {1., 1.}, 0.3);
  const test::Body<2> body(*mesh);
  const auto         &families = *body.families;
  const BondList      bonds(families);

  std::vector<BondCursor::End> ends;
  BondCursor                   cursor(bonds);
  std::vector<unsigned int>    visits(bonds.n_slots(), 0);
  for (LocalIndex i = 0; i < families.n_owned(); ++i)
    {
      EXPECT_EQ((bonds.row[i + 1] - bonds.row[i]) % BondList::n_lanes, 0u);
      cursor.find(i, families.begin(i), families.end(i), ends);
      ASSERT_EQ(ends.size(), families.size(i));
      for (LocalIndex k = 0; k < ends.size(); ++k)
        {
          const LocalIndex j   = families.begin(i)[k];
          const LocalIndex row = ends[k].is_near ? i : j;
          EXPECT_GE(ends[k].slot, bonds.row[row]);
          EXPECT_LT(ends[k].slot, bonds.row[row + 1]);
          EXPECT_EQ(bonds.neighbour[ends[k].slot], ends[k].is_near ? j : i);
          ++visits[ends[k].slot];
        }
    }
  for (LocalIndex i = 0; i < families.n_owned(); ++i)
    for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
      {
        const LocalIndex   j        = bonds.neighbour[slot];
        const unsigned int expected = j == i ? 0 : (j < families.n_owned() ? 2 : 1);
        EXPECT_EQ(visits[slot], expected);
      }
}

TEST(BondList, CutBondsLearnTheirFarEnds)
{
  const auto          mesh = test::make_box<3>({6, 5, 5}, {1., 1., 1.}, 0.2);
  const test::Body<3> body(*mesh);
  const auto         &families = *body.families;
  const BondList      bonds(families);
  const auto          value = [&](const LocalIndex from, const LocalIndex to) {
    return 1e4 * families.global_number(from) + families.global_number(to);
  };
  std::vector<double> near(bonds.n_slots(), 0.), far(bonds.n_slots(), -1.);
  for (LocalIndex i = 0; i < families.n_owned(); ++i)
    for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
      near[slot] = value(i, bonds.neighbour[slot]);
  exchange_cut_bonds(families, bonds, {near.data()}, {far.data()});
  for (LocalIndex i = 0; i < families.n_owned(); ++i)
    for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
      if (bonds.neighbour[slot] >= families.n_owned())
        EXPECT_EQ(far[slot], value(bonds.neighbour[slot], i));
      else
        EXPECT_EQ(far[slot], -1.);
}
