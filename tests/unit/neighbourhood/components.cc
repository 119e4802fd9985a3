// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/neighbourhood/components.h>

#include <deal.II/base/mpi.h>

#include "bodies.h"
#include "testing.h"

#include <map>
#include <set>

using namespace perideal;

namespace
{
  constexpr unsigned int n = 12;

  /// The component of each column and row of n x n unit cells; links join where @p join says so of two cells.
  template <typename Join>
  std::map<std::pair<int, int>, GlobalIndex> components_of_square(const Join &join)
  {
    const auto          mesh = test::make_box<2>({n, n}, {double(n), double(n)}, 0.);
    const test::Body<2> body(*mesh, 1.5);
    const auto         &families = *body.families;
    const auto          cell_of  = [&](const LocalIndex i) {
      return std::make_pair(int(families.position[i][0]), int(families.position[i][1]));
    };
    const auto found = find_components<2>(
      families, BondList(families), [&](const LocalIndex i, const LocalIndex j, const BondIndex) {
        return join(cell_of(i), cell_of(j));
      });
    std::map<std::pair<int, int>, GlobalIndex> mine, result;
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      {
        EXPECT_LE(found[i], families.global_number(i));
        mine[cell_of(i)] = found[i];
      }
    for (const auto &of_rank : dealii::Utilities::MPI::all_gather(families.communicator, mine))
      result.insert(of_rank.begin(), of_rank.end());
    EXPECT_EQ(result.size(), n * n);
    return result;
  }

  template <typename Map>
  std::size_t count_values(const Map &map)
  {
    std::set<GlobalIndex> values;
    for (const auto &entry : map)
      values.insert(entry.second);
    return values.size();
  }

  using Cell = std::pair<int, int>;

  bool is_above(const Cell &a, const Cell &b)
  {
    return a.first == b.first && std::abs(a.second - b.second) == 1;
  }
} // namespace

TEST(Components, HoldWhatLinksJoin)
{
  Components components(6);
  const bool is_last = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) + 1 ==
                       dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  std::set<std::pair<unsigned int, unsigned int>> links;
  if (is_last)
    links = {{1, 4}, {5, 2}};
  components.join(2, 4);
  components.join_all(links, MPI_COMM_WORLD);
  const auto numbered = components.number();
  EXPECT_EQ(numbered.first, (std::vector<unsigned int>{0, 1, 1, 2, 1, 1}));
  EXPECT_EQ(numbered.second, 3u);
}

TEST(Components, OfNodesCrossRanks)
{
  // Every cell for itself, columns, and a snake through all of them, which comes to each rank again and
  // again.
  EXPECT_EQ(count_values(components_of_square([](const Cell &, const Cell &) { return false; })), n * n);

  const auto columns = components_of_square(is_above);
  EXPECT_EQ(count_values(columns), n);
  for (const auto &[cell, component] : columns)
    EXPECT_EQ(component, columns.at({cell.first, 0}));

  const auto snake = components_of_square([](const Cell &a, const Cell &b) {
    const int at = std::min(a.first, b.first) % 2 == 0 ? 0 : int(n) - 1;
    return is_above(a, b) || (a.second == at && b.second == at);
  });
  EXPECT_EQ(count_values(snake), 1u);
  EXPECT_EQ(snake.begin()->second, 0u);
}
