// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/rendezvous.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

using namespace perideal;

TEST(Rendezvous, RanksThatComeAreAwaited)
{
  const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  std::this_thread::sleep_for(std::chrono::milliseconds(50 * rank));
  EXPECT_TRUE(all_ranks_arrive(MPI_COMM_WORLD, 60.));
}

TEST(Rendezvous, RanksThatStayAwayAreGivenUp)
{
  MPI_Comm communicator;
  MPI_Comm_dup(MPI_COMM_WORLD, &communicator);
  const bool is_alone = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1;
  const bool is_first = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  // What was begun must be ended some time: the others come late. A single rank waits for nobody.
  if (is_first)
    {
      EXPECT_EQ(all_ranks_arrive(communicator, 0.1), is_alone);
    }
  MPI_Barrier(MPI_COMM_WORLD);
  if (!is_first)
    {
      EXPECT_TRUE(all_ranks_arrive(communicator, 60.));
    }
}
