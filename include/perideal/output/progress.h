// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_output_progress_h
#define perideal_output_progress_h

#include <perideal/base/types.h>

#include <cstdint>
#include <iosfwd>
#include <string>

namespace perideal
{
  /// Prints the progress of a solve on one line, at most once a second.
  class ProgressLine
  {
  public:
    ProgressLine(std::ostream &out, const bool is_visible, const std::string &what, const double tolerance);
    ~ProgressLine();

    /// The time left follows from the mean reduction of the residual so far.
    void operator()(const unsigned int iteration, const double residual);

  private:
    std::ostream &out;
    bool          is_visible;
    std::string   what;
    double        tolerance;
    double        start, last_print;
    bool          printed = false;
  };

  /// A line on the terminal that tells how far dynamics have come, once a second.
  class StepLine
  {
  public:
    StepLine(std::ostream &out, const bool is_visible, const unsigned int n_steps);
    ~StepLine();

    void operator()(const unsigned int step, const GlobalIndex broken_bonds);

  private:
    std::ostream &out;
    bool          is_visible;
    unsigned int  n_steps;
    double        start, last_print;
    bool          printed = false;
  };
} // namespace perideal

#endif
