// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_recorders_recorders_h
#define perideal_recorders_recorders_h

#include <perideal/output/field_output.h>
#include <perideal/recorders/make_recorders.h>

#include <memory>
#include <string>
#include <vector>

namespace perideal
{
  /// How a run ended.
  enum class RunStatus
  {
    done,
    stopped,
    failed
  };

  /// What a run tells of itself at its end besides what recorders know.
  struct RunReport
  {
    RunStatus status = RunStatus::done;
    /// What it did without, by name with the amount saved.
    nlohmann::ordered_json skipped;
    /// Memory of the operators of this rank [B].
    std::size_t operator_bytes = 0;
    /// Lines for the screen.
    std::string lines;
  };

  /// All recorders of a run, with the files that they share: history, fields, summary.json.
  template <int dim>
  class Recorders
  {
  public:
    /// Makes the recorders; opens no file yet. Collective.
    /// @throws InputError on what cannot be recorded.
    Recorders(Problem<dim> &problem, const RunKind &kind);

    /// Opens history and fields, those of the run that this one goes on from included. Collective.
    /// @param last_row of the history to keep; negative: none
    /// @param resumed what this run goes on from; null: nothing
    /// @throws InputError where the history is not that of the run it goes on from.
    void open(const double last_row, const Checkpoint *resumed);

    /// Whether there are files that finish() must complete.
    bool is_open() const { return history != nullptr; }

    /// Shows a step to the recorders, whether it leaves a row or not. Collective.
    void observe(const Step<dim> &step);

    /// Adds a row to the history and brings the summary up to date. Collective.
    void record(const Step<dim> &step);

    /// Writes fields, numbered from 1. Collective.
    void write_fields(const Step<dim> &step);

    /// Lets recorders do what the last step asks for. Collective.
    void conclude(const Step<dim> &step);

    /// Completes all files and prints what came of the run. Collective.
    void finish(const RunReport &report);

    /// Completes the files of this rank alone, where other ranks may not come along.
    void abandon() noexcept;

    /// Registers what the recorders and their files must remember.
    void register_state(LastingState &state);

    /// Number of field files so far.
    std::size_t n_frames() const { return frame_times.size(); }

    /// summary.json as far as it has come, for what the driver tells of its solver.
    nlohmann::ordered_json &summary() { return result; }

  private:
    /// Fields of a state that no write_fields() has seen, which may show what went wrong.
    void write_last_fields();

    Problem<dim>                               &problem;
    const RunKind                               kind;
    std::vector<std::unique_ptr<Recorder<dim>>> recorders;
    std::unique_ptr<History>                    history;
    std::unique_ptr<FieldOutput<dim>>           fields;
    nlohmann::ordered_json                      result;
    /// Of the field files so far, and of the last row [s].
    std::vector<double> frame_times;
    double              last_time = -1;
  };
} // namespace perideal

#endif
