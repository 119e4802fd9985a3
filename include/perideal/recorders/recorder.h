// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_recorders_recorder_h
#define perideal_recorders_recorder_h

#include <perideal/output/history.h>
#include <perideal/output/lasting_state.h>
#include <perideal/problem/step.h>

#include <nlohmann/json.hpp>

#include <string>

namespace perideal
{
  /// Where recorders write: the row of the history that a step makes, and the summary of the run.
  struct Record
  {
    History                &history;
    nlohmann::ordered_json &summary;
  };

  /**
   * One thing that is recorded of a run: energies, reactions, gauges, cracks. It adds its columns to the
   * history and its part to summary.json, and registers what it must remember. A recorder reads the problem
   * and the step, and knows neither the solver nor the driver.
   */
  template <int dim>
  class Recorder
  {
  public:
    virtual ~Recorder() = default;

    /// Looks at the body before the first step, with precracks cut. Collective.
    virtual void start(nlohmann::ordered_json &) {}

    /// Looks at every step, before record() or without it: most steps of dynamics leave no row, and a load
    /// step that fails leaves none. Must be cheap where nothing broke. Collective.
    virtual void observe(const Step<dim> &, const Record &) {}

    /// Adds its columns and its part of the summary. Collective.
    virtual void record(const Step<dim> &, const Record &) {}

    /// Brings the state up to date before fields are written. Collective.
    virtual void prepare_fields(const Step<dim> &) {}

    /// Does what only the last step of a run that came to its end asks for. Collective.
    virtual void conclude(const Step<dim> &, const Record &) {}

    /// Writes files of its own when the run ends, however it does. Collective.
    virtual void finish(nlohmann::ordered_json &) {}

    /// Returns lines for the screen about the end of a run, by its summary and whether it came to its end.
    virtual std::string describe(const nlohmann::ordered_json &, const bool /*is_done*/) const { return {}; }

    /// Registers what a run that goes on must know; the summary, as far as it has come, must outlive the
    /// state.
    virtual void register_state(LastingState &, nlohmann::ordered_json & /*summary*/) {}
  };
} // namespace perideal

#endif
