// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_application_sweep_h
#define perideal_application_sweep_h

#include <perideal/application/command_line.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace perideal
{
  /// A parameter and the values that it takes, one a run.
  struct SweptParameter
  {
    std::string              path;
    std::vector<std::string> values;
  };

  /// Reads "Section/Name=value, value", or "Section/Name=value; value" where values hold commas themselves.
  /// @throws InputError on texts of another form
  SweptParameter read_swept_parameter(const std::string &text);

  /// One run of a sweep.
  struct SweptRun
  {
    /// Of each swept parameter.
    std::vector<std::string> values;
    /// What the run left in summary.json; an object without entries where it left none.
    nlohmann::ordered_json summary;
  };

  /// Table of a sweep: header, then a row a run: values, status, nodes, strain energy, relative errors (l2)
  /// with the order at which each falls with the size of the cells, seconds. The order is that between a run
  /// and the one before it, where only one parameter changed and with it the number of nodes.
  std::vector<std::vector<std::string>> sweep_table(const std::vector<SweptParameter> &parameters,
                                                    const std::vector<SweptRun>       &runs);

  /**
   * Runs the scene for each combination of the values, the last parameter's changing fastest, each in a
   * directory of its own within Output directory; prints the table, writes it to sweep.csv there, and draws
   * sweep.svg. A run that fails does not keep the others from being done. Collective.
   *
   * @throws InputError before the first run where one of them would be refused; ComputationError at the end
   *   where a run has failed; Stopped
   */
  void run_sweep(const CommandLine &command_line);
} // namespace perideal

#endif
