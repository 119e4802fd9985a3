// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/child_process.h>
#include <perideal/base/exceptions.h>

#include "testing.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

using namespace perideal;
using namespace perideal::test;

namespace
{
  void no_watch(const double) {}
} // namespace

TEST(ChildProcess, TellsWhatWasPrintedAndHowItEnded)
{
  const ChildResult result = run_child({"sh", "-c", "echo out; echo err >&2; exit 7"}, no_watch);
  EXPECT_TRUE(result.not_started.empty());
  EXPECT_EQ(result.status, 7);
  EXPECT_EQ(result.out, "out\n");
  EXPECT_EQ(result.err, "err\n");
  EXPECT_EQ(run_child({"sh", "-c", "kill -9 $$"}, no_watch).status, 128 + SIGKILL);
}

TEST(ChildProcess, PrintsAsMuchAsItLikes)
{
  const ChildResult result = run_child({"sh", "-c", "head -c 1000000 /dev/zero"}, no_watch);
  EXPECT_EQ(result.out.size(), 1000000u) << "more than a pipe holds";
}

TEST(ChildProcess, TellsWhatCannotBeStarted)
{
  EXPECT_FALSE(run_child({"/absent/program"}, no_watch).not_started.empty());
}

TEST(ChildProcess, DoesNotTakeItselfForARank)
{
  setenv("OMPI_OF_A_TEST", "1", 1);
  EXPECT_EQ(run_child({"sh", "-c", "env"}, no_watch).out.find("OMPI_OF_A_TEST"), std::string::npos);
  unsetenv("OMPI_OF_A_TEST");
}

TEST(ChildProcess, IsEndedWithWhatItStarted)
{
  const TemporaryDirectory directory;
  const std::string        file = directory.write("number", "");
  EXPECT_THROW(run_child({"sh", "-c", "sleep 100 & echo $! > " + file + "; wait"},
                         [&](const double seconds) {
                           if (seconds > 0.1 && std::filesystem::file_size(file) > 0)
                             throw Stopped("enough");
                         }),
               Stopped);
  std::string number;
  std::ifstream(file) >> number;
  ASSERT_FALSE(number.empty());
  // What was killed has no command any more, or is gone, as soon as the system comes to it.
  const auto command = [&number]() {
    std::string text;
    std::ifstream("/proc/" + number + "/cmdline") >> text;
    return text;
  };
  for (unsigned int i = 0; i < 200 && !command().empty(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_TRUE(command().empty()) << command();
}
