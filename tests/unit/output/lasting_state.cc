// SPDX-License-Identifier: LGPL-2.1-or-later
#include "line_of_nodes.h"
#include "output_test.h"

#include <perideal/base/exceptions.h>
#include <perideal/output/lasting_state.h>

#include <gtest/gtest.h>

using namespace perideal;
using namespace output_test;

namespace
{
  constexpr unsigned int n_in_line = 13;

  /// A law with memory: a number for each node and one for some of the bonds.
  struct SofteningLaw
  {
    explicit SofteningLaw(const LineOfNodes &line)
      : line(line)
      , largest_strain(line.nodes.n_owned)
    {
    }

    void register_state(LastingState &state)
    {
      state.add_node_array("largest strain", "-", 1, largest_strain, LastingState::Show::as_field);
      state.add_bond_array(
        "softened stretch",
        "-",
        1,
        [this] {
          BondArray array;
          for (const auto &[ends, stretch] : softened)
            {
              array.bonds.push_back({line.local(ends.first), line.local(ends.second)});
              array.values.push_back(stretch);
            }
          return array;
        },
        [this](const BondArray &array) {
          for (std::size_t k = 0; k < array.bonds.size(); ++k)
            {
              const auto ends =
                std::minmax(line.number[array.bonds[k].near], line.number[array.bonds[k].far]);
              softened[{ends.first, ends.second}] = array.values[k];
            }
        });
      state.add_value("softened bonds", n_softened);
      state.add_sum("softening work", work);
    }

    void load()
    {
      for (LocalIndex i = 0; i < largest_strain.size(); ++i)
        largest_strain[i] = 1. / (3. + line.number[i]);
      for (const BondEnds &bond : line.bonds())
        {
          const auto ends = std::minmax(line.number[bond.near], line.number[bond.far]);
          if (ends.first % 3 == 1)
            softened[{ends.first, ends.second}] = 0.1 * ends.first;
        }
      n_softened = 4;
      work       = line.nodes.n_owned;
    }

    const LineOfNodes                                      &line;
    std::vector<double>                                     largest_strain;
    std::map<std::pair<unsigned int, unsigned int>, double> softened;
    GlobalIndex                                             n_softened = 0;
    double                                                  work       = 0;
  };

  /// The same law on the other ranks after a restart.
  void check_restart(const std::string &directory, const LineOfNodes &before, const LineOfNodes &after)
  {
    if (dealii::Utilities::MPI::this_mpi_process(before.nodes.communicator) == 0)
      std::filesystem::create_directories(directory);
    MPI_Barrier(before.nodes.communicator);
    LastingState state;
    SofteningLaw law(before);
    law.register_state(state);
    law.load();
    Checkpoint checkpoint;
    checkpoint.header = {{"step", 1}, {"time", 0.}};
    state.save(checkpoint);
    write_checkpoint(directory, checkpoint, before.nodes);

    LastingState other_state;
    SofteningLaw other(after), expected(after);
    other.register_state(other_state);
    expected.load();
    other_state.resume(read_checkpoint(directory, after.nodes));
    EXPECT_EQ(other.largest_strain, expected.largest_strain);
    EXPECT_EQ(other.softened, expected.softened);
    EXPECT_EQ(other.n_softened, expected.n_softened);
    EXPECT_EQ(dealii::Utilities::MPI::sum(other.work, after.nodes.communicator), n_in_line);
    ASSERT_EQ(other_state.fields().size(), 1u);
    EXPECT_EQ(other_state.fields()[0].name, "largest strain");
    EXPECT_EQ(other_state.fields()[0].get(), expected.largest_strain);
  }
} // namespace

TEST(LastingState, MemoryComesBackOnAnyNumberOfRanks)
{
  const LineOfNodes of_all(n_in_line, MPI_COMM_WORLD), alone(n_in_line, MPI_COMM_SELF);
  check_restart(scratch_directory("state_all_all"), of_all, of_all);
  check_restart(scratch_directory("state_all_one"), of_all, alone);
}

TEST(LastingState, MemoryOfOneRankComesBackOnAll)
{
  const LineOfNodes of_all(n_in_line, MPI_COMM_WORLD), alone(n_in_line, MPI_COMM_SELF);
  const std::string directory = scratch_directory("state_one_all");
  if (is_first_rank())
    check_restart(directory, alone, alone);
  MPI_Barrier(MPI_COMM_WORLD);
  LastingState state;
  SofteningLaw law(of_all), expected(of_all);
  law.register_state(state);
  expected.load();
  state.resume(read_checkpoint(directory, of_all.nodes));
  EXPECT_EQ(law.largest_strain, expected.largest_strain);
  EXPECT_EQ(law.softened, expected.softened);
}

TEST(LastingState, WhatIsMissingOrOtherIsAnInputError)
{
  LastingState        state;
  std::vector<double> values(3);
  state.add_node_array("damage", "-", 1, values);
  Checkpoint checkpoint;
  EXPECT_THROW(state.resume(checkpoint), InputError);
  checkpoint.node_arrays["damage"] = {"-", 2, std::vector<double>(6)};
  EXPECT_THROW(state.resume(checkpoint), InputError);
  checkpoint.node_arrays["damage"] = {"-", 1, {1, 2, 3, 4}};
  state.resume(checkpoint);
  EXPECT_EQ(values, (std::vector<double>{1, 2, 3}));

  LastingState values_only;
  double       energy = 0;
  values_only.add_value("energy", energy);
  checkpoint.header["energy"] = "much";
  EXPECT_THROW(values_only.resume(checkpoint), InputError);
}

TEST(LastingState, NamesStandForOneThing)
{
  LastingState state;
  double       energy = 0;
  state.add_value("energy", energy);
  EXPECT_THROW(state.add_sum("energy", energy), dealii::ExceptionBase);
}
