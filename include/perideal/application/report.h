// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_application_report_h
#define perideal_application_report_h

#include <perideal/application/scene_parameters.h>
#include <perideal/application/scene_state.h>

#include <nlohmann/json.hpp>

#include <iosfwd>
#include <map>
#include <string>
#include <vector>

namespace perideal
{
  /// The parts of summary.json that describe the discretisation: mesh, nodes,
  /// bonds, neighbours, model. Collective.
  template <int dim>
  nlohmann::ordered_json describe_discretisation(const SceneParameters &parameters,
                                                 const SceneState<dim> &scene);

  /// Whether bonds of the scene may break.
  bool can_break(const SceneParameters &parameters);

  /// Whether nodes repel each other that come too close.
  bool has_contact(const SceneParameters &parameters);

  /// What the scene does not need, by name, with the amount saved.
  template <int dim>
  nlohmann::ordered_json list_skipped(const SceneParameters &parameters, const SceneState<dim> &scene);

  /// Lines that say what will be done. Collective.
  template <int dim>
  std::string banner(const SceneParameters &parameters, const SceneState<dim> &scene);

  /// Table of seconds by phase.
  std::string timing_table(const std::map<std::string, double> &seconds);

  /// Table of errors from the "errors" part of summary.json.
  std::string error_table(const nlohmann::ordered_json &errors);

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

  /// What of the tractions arrives at the nodes, on one line; empty where there are none.
  /// @param loads as in summary.json
  std::string describe_loads(const nlohmann::ordered_json &loads);

  /// Energies, damage and cracks at the end of dynamics, and a warning where the energy does not
  /// balance. @param summary as in summary.json
  std::string describe_motion(const nlohmann::ordered_json &summary);

  /// Broken bonds and pieces; empty where nothing broke. @param unit of the time of the first break
  std::string describe_damage(const nlohmann::ordered_json &summary, const std::string &unit);

  /// What a run says that was asked to stop, and how to go on. @param step the last one, with its time
  std::string describe_stop(const std::string &step);
} // namespace perideal

#endif
