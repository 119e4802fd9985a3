// SPDX-License-Identifier: LGPL-2.1-or-later
#include "line_of_nodes.h"
#include "output_test.h"

#include <perideal/base/exceptions.h>
#include <perideal/output/checkpoint.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

using namespace perideal;
using namespace output_test;

namespace
{
  constexpr unsigned int n_nodes = 11;

  /// Something of each kind, by global numbers.
  Checkpoint sample_checkpoint(const LineOfNodes &line)
  {
    Checkpoint result;
    result.header    = {{"step", 7}, {"time", 0.1}, {"energy", 1. / 3}, {"name", "plate"}};
    NodeArray &array = result.node_arrays["displacement"];
    array            = {"m", 2, {}};
    for (LocalIndex i = 0; i < line.nodes.n_owned; ++i)
      array.values.insert(array.values.end(), {std::sqrt(1. + line.number[i]), -1. / (1. + line.number[i])});
    result.node_arrays["nothing"] = {"-", 0, {}};
    BondArray &bonds              = result.bond_arrays["plastic stretch"];
    bonds                         = {"-", 1, line.bonds(), {}};
    std::reverse(bonds.bonds.begin(), bonds.bonds.end());
    for (const BondEnds &bond : bonds.bonds)
      bonds.values.push_back(std::exp(double(line.number[bond.near] + line.number[bond.far])));
    result.bond_arrays["none"] = {"m", 3, {}, {}};
    result.sums["work"]        = {line.nodes.n_owned * 1., 0.5 * line.nodes.n_owned};
    return result;
  }

  /// Values of bonds by the global numbers of their ends.
  std::map<std::pair<unsigned int, unsigned int>, double> by_ends(const BondArray   &array,
                                                                  const LineOfNodes &line)
  {
    std::map<std::pair<unsigned int, unsigned int>, double> result;
    for (std::size_t k = 0; k < array.bonds.size(); ++k)
      {
        const auto ends = std::minmax(line.number[array.bonds[k].near], line.number[array.bonds[k].far]);
        result[{ends.first, ends.second}] = array.values[k];
      }
    return result;
  }

  void expect_same(const Checkpoint &read, const Checkpoint &written)
  {
    EXPECT_EQ(read.header, written.header);
    EXPECT_EQ(read.sums.at("work"), written.sums.at("work"));
    for (const auto &[name, array] : written.node_arrays)
      {
        EXPECT_EQ(read.node_arrays.at(name).unit, array.unit);
        EXPECT_EQ(read.node_arrays.at(name).width, array.width);
        EXPECT_EQ(read.node_arrays.at(name).values, array.values);
      }
    for (const auto &[name, array] : written.bond_arrays)
      {
        const BondArray &other = read.bond_arrays.at(name);
        EXPECT_EQ(other.values, array.values);
        ASSERT_EQ(other.bonds.size(), array.bonds.size());
        for (std::size_t k = 0; k < array.bonds.size(); ++k)
          EXPECT_TRUE(other.bonds[k].near == array.bonds[k].near && other.bonds[k].far == array.bonds[k].far);
      }
  }

  /// A directory with a checkpoint of all ranks.
  std::string write_sample(const std::string &name, const LineOfNodes &line)
  {
    const std::string directory = scratch_directory(name);
    if (is_first_rank())
      std::filesystem::create_directories(directory);
    MPI_Barrier(MPI_COMM_WORLD);
    write_checkpoint(directory, sample_checkpoint(line), line.nodes);
    return directory;
  }

  /// What reading says; empty: nothing.
  std::string complaint(const std::string &directory, const CheckpointNodes &nodes)
  {
    try
      {
        read_checkpoint(directory, nodes);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  }

  /// The first rank writes a whole file, all wait.
  void overwrite(const std::string &path, const std::string &bytes)
  {
    MPI_Barrier(MPI_COMM_WORLD);
    if (is_first_rank())
      std::ofstream(path, std::ios::binary) << bytes;
    MPI_Barrier(MPI_COMM_WORLD);
  }
} // namespace

TEST(Checkpoint, AsManyRanksReadTheSameBits)
{
  const LineOfNodes line(n_nodes, MPI_COMM_WORLD);
  const std::string directory = write_sample("checkpoint_same", line);
  expect_same(read_checkpoint(directory, line.nodes), sample_checkpoint(line));
}

TEST(Checkpoint, OtherNumbersOfRanksReadTheSame)
{
  const LineOfNodes of_all(n_nodes, MPI_COMM_WORLD), alone(n_nodes, MPI_COMM_SELF);
  const std::string directory = write_sample("checkpoint_fewer", of_all);
  const Checkpoint  fewer = read_checkpoint(directory, alone.nodes), expected = sample_checkpoint(alone);
  EXPECT_EQ(fewer.node_arrays.at("displacement").values, expected.node_arrays.at("displacement").values);
  EXPECT_EQ(by_ends(fewer.bond_arrays.at("plastic stretch"), alone),
            by_ends(expected.bond_arrays.at("plastic stretch"), alone));
  EXPECT_EQ(fewer.sums.at("work"), expected.sums.at("work"));

  const std::string other = scratch_directory("checkpoint_more");
  if (is_first_rank())
    {
      std::filesystem::create_directories(other);
      write_checkpoint(other, expected, alone.nodes);
    }
  MPI_Barrier(MPI_COMM_WORLD);
  const Checkpoint more = read_checkpoint(other, of_all.nodes), mine = sample_checkpoint(of_all);
  EXPECT_EQ(more.node_arrays.at("displacement").values, mine.node_arrays.at("displacement").values);
  EXPECT_EQ(by_ends(more.bond_arrays.at("plastic stretch"), of_all),
            by_ends(mine.bond_arrays.at("plastic stretch"), of_all));
  EXPECT_EQ(dealii::Utilities::MPI::sum(more.sums.at("work")[0], MPI_COMM_WORLD), n_nodes);
}

TEST(Checkpoint, FlippedBitsAreRefusedOrHarmless)
{
  const LineOfNodes line(n_nodes, MPI_COMM_WORLD);
  const std::string directory = write_sample("checkpoint_bits", line);
  std::mt19937      random(20);
  unsigned int      refused = 0;
  testing::internal::CaptureStderr();
  for (const auto &[file, n_flips] : {std::pair("checkpoint_0.h5", 100u), std::pair("checkpoint.json", 20u)})
    {
      const std::string path = directory + "/" + file, whole = read_text(path);
      for (unsigned int flip = 0; flip < n_flips; ++flip)
        {
          std::string       damaged = whole;
          const std::size_t bit     = random() % (8 * whole.size());
          damaged[bit / 8] ^= char(1 << bit % 8);
          overwrite(path, damaged);
          try
            {
              expect_same(read_checkpoint(directory, line.nodes), sample_checkpoint(line));
            }
          catch (const InputError &error)
            {
              ++refused;
              EXPECT_EQ(std::string(error.what()).find("json.exception"), std::string::npos);
            }
        }
      overwrite(path, whole);
    }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_GT(refused, 20u);
  EXPECT_EQ(complaint(directory, line.nodes), "");
}

TEST(Checkpoint, DamageIsToldByFileAndTable)
{
  const LineOfNodes line(n_nodes, MPI_COMM_WORLD);
  const std::string directory = write_sample("checkpoint_damage", line);
  const std::string path      = directory + "/checkpoint_0.h5";
  const std::string whole     = read_text(path);
  // Eight bytes that no other table and no time stamp of HDF5 has.
  const double value = std::sqrt(5.);
  std::string  bytes(sizeof(value), 0), damaged = whole;
  std::memcpy(bytes.data(), &value, sizeof(value));
  damaged[damaged.find(bytes) + 3] ^= 4;
  overwrite(path, damaged);
  for (const char *word :
       {"checkpoint_0.h5", "'node arrays/displacement'", "is damaged", "Checkpoints/Restart"})
    EXPECT_NE(complaint(directory, line.nodes).find(word), std::string::npos)
      << complaint(directory, line.nodes);
  for (const std::size_t kept : {std::size_t(0), std::size_t(100), whole.size() / 2, whole.size() - 1})
    {
      overwrite(path, whole.substr(0, kept));
      for (const char *word : {"checkpoint_0.h5", "cannot be read", "Checkpoints/Restart"})
        EXPECT_NE(complaint(directory, line.nodes).find(word), std::string::npos)
          << kept << " bytes: " << complaint(directory, line.nodes);
    }
}

TEST(Checkpoint, PointersThatSayNothingAreRefused)
{
  const LineOfNodes line(n_nodes, MPI_COMM_WORLD);
  const std::string directory = write_sample("checkpoint_pointer", line);
  for (const char *text : {"null",
                           "{\"file\": null}",
                           "{\"file\": 3, \"checksum\": 4}",
                           "{\"file\": \"checkpoint_0.h5\", \"checksum\": \"4\"}",
                           "{",
                           ""})
    {
      overwrite(directory + "/checkpoint.json", text);
      EXPECT_NE(complaint(directory, line.nodes).find("checkpoint.json is damaged"), std::string::npos)
        << text;
    }
}

TEST(Checkpoint, EntriesOfAnotherTypeAreInputErrors)
{
  Checkpoint checkpoint;
  checkpoint.header = {{"step", "seven"}, {"time", nullptr}, {"energy", 2.}};
  EXPECT_EQ(checkpoint.get<double>("energy"), 2.);
  EXPECT_THROW(checkpoint.get<unsigned int>("step"), InputError);
  EXPECT_THROW(checkpoint.get<double>("time"), InputError);
  EXPECT_THROW(checkpoint.get<double>("absent"), InputError);
}

TEST(Checkpoint, OtherMeshesAreRefused)
{
  const LineOfNodes line(n_nodes, MPI_COMM_WORLD), longer(n_nodes + 3, MPI_COMM_WORLD);
  const std::string directory = write_sample("checkpoint_mesh", line);
  EXPECT_NE(complaint(directory, longer.nodes).find("another mesh"), std::string::npos);
  EXPECT_NE(complaint(scratch_directory("checkpoint_absent"), line.nodes).find("no checkpoint"),
            std::string::npos);
}

TEST(Checkpoint, AFullDiskLeavesTheLastOne)
{
  const LineOfNodes line(n_nodes, MPI_COMM_WORLD);
  const std::string directory = write_sample("checkpoint_full", line);
  testing::internal::CaptureStderr();
  {
    if (is_first_rank())
      std::filesystem::create_symlink("/dev/full", directory + "/checkpoint_1.h5");
    EXPECT_THROW(write_checkpoint(directory, sample_checkpoint(line), line.nodes), ComputationError);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  expect_same(read_checkpoint(directory, line.nodes), sample_checkpoint(line));
}
