// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_problem_run_h
#define perideal_problem_run_h

#include <perideal/base/timing.h>

#include <deal.II/base/conditional_ostream.h>

#include <nlohmann/json.hpp>

#include <map>
#include <string>
#include <vector>

namespace perideal
{
  /// What a run is told besides its parameters.
  struct RunContext
  {
    /// The command as typed, for summary.json.
    std::string command;
    /// Directory of the `.prm` file, where relative mesh files may lie.
    std::string scene_directory;
    /// Every parameter as used, for summary.json.
    nlohmann::ordered_json parameters;
    /// Defaults of the parameters that have another value, by path.
    nlohmann::ordered_json changed_from;
  };

  /// What a run has come to on the meshes before, where they adapt.
  struct EarlierRun
  {
    std::map<std::string, double> seconds;
    nlohmann::ordered_json        adaptation;
    std::vector<std::string>      warnings;
  };

  /// The surroundings of a run: what was asked for, its ranks, its screen and its clock.
  struct Run
  {
    Run(const RunContext &context, MPI_Comm communicator);
    ~Run();

    /// What the run on the next mesh goes on from. Collective.
    EarlierRun record() const { return {timings.seconds(), adaptation, warnings}; }

    /// Goes on from the run on the mesh before: its seconds and what it said count.
    void go_on(const EarlierRun &earlier);

    /// Prints a line that begins with "warning", once, and keeps it for summary.json.
    void warn(const std::string &text);

    const RunContext context;
    MPI_Comm         communicator;
    /// Standard output of the first rank.
    dealii::ConditionalOStream screen;
    /// Whether that is a terminal, for bars that show how far the run has come.
    const bool is_watched;
    Timings    timings;
    /// What was found on the meshes before this one, where it was adapted; for summary.json.
    nlohmann::ordered_json   adaptation;
    std::vector<std::string> warnings;
  };
} // namespace perideal

#endif
