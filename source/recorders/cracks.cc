// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/fracture/crack_tracker.h>
#include <perideal/output/summary.h>
#include <perideal/recorders/crack_figures.h>
#include <perideal/recorders/make_recorders.h>

namespace perideal
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    /// Follows the cracks that the scene names: their tips and what drives them by step, and their paths at
    /// the end.
    template <int dim>
    class CracksRecorder : public Recorder<dim>
    {
    public:
      CracksRecorder(const Problem<dim> &problem, const RunKind &kind)
        : problem(problem)
        , kind(kind)
        , tracker(problem.parameters.cracks, *problem.body.nodes)
        , figures(problem, tracker, kind)
      {
      }

      void start(Json &) override
      {
        tracker.start(problem.force ? problem.force->cut_share() :
                                      std::vector<double>(problem.body.nodes->size(), 0.));
      }

      void observe(const Step<dim> &step, const Record &) override
      {
        if (problem.force && (step.newly_broken > 0 || kind.has_iterations))
          tracker.update(step.time, total_damage(*problem.force));
      }

      void record(const Step<dim> &step, const Record &record) override
      {
        // Bonds may soften without a break.
        if (step.n_broken != n_collected || kind.has_iterations)
          tracker.collect();
        n_collected        = step.n_broken;
        const char *axes[] = {"x", "y", "z"};
        for (const auto &tip : tracker.tips(step.time))
          {
            for (int d = 0; d < dim; ++d)
              record.history.add(std::string("tip ") + axes[d] + " of " + tip.name + " [m]", tip.position[d]);
            record.history.add("reach of " + tip.name + " [m]", tip.reach);
            record.history.add("speed of " + tip.name + " [m/s]", tip.speed);
          }
        figures.record(step, record.history);
      }

      void finish(Json &summary) override
      {
        summary["cracks"] = tracker.describe();
        figures.describe(summary["cracks"]);
        for (auto &crack : summary["cracks"])
          if (n_collected > 0 && crack["first_time"].is_null())
            crack["note"] = "no bond broke where this crack is looked for, " + std::to_string(n_collected) +
                            " broke elsewhere: move its Origin to the tip from which it grows";
        tracker.write_paths(problem.parameters.output_directory);
      }

      std::string describe(const Json &summary, const bool) const override
      {
        std::string text;
        if (!summary.contains("cracks"))
          return text;
        for (const auto &crack : summary["cracks"].items())
          {
            const Json       &of_crack = crack.value();
            const std::string begin    = "crack       " + crack.key() + ": ";
            if (const std::string length = CrackFigures<dim>::in_words(of_crack); !length.empty())
              text += begin + length + '\n';
            if (!kind.has_motion)
              continue;
            if (of_crack.contains("note"))
              text += begin + of_crack["note"].get<std::string>() + '\n';
            else
              text += begin + "from " + number(of_crack["first_time"]) + " s on, reach " +
                      number(of_crack["reach"]) + " m, angle " + number(of_crack["angle"]) +
                      " degrees, speed " + number(of_crack["speed"]) + " m/s" + describe_branching(of_crack) +
                      '\n';
          }
        return text;
      }

      void register_state(LastingState &state, Json &) override { tracker.register_state(state); }

    private:
      static std::string number(const Json &value)
      {
        return value.is_number() ? short_number(value.get<double>()) : "-";
      }

      static std::string describe_branching(const Json &crack)
      {
        if (!crack.contains("branching"))
          return {};
        const Json &branching = crack["branching"];
        if (branching.is_null())
          return "; no branches";
        return "; " + std::to_string(branching["branches"].get<unsigned int>()) + " branches from " +
               number(branching["reach"]) + " m, " + number(branching["time"]) + " s, " +
               number(branching["full_angle"]) + " degrees between the outermost";
      }

      const Problem<dim> &problem;
      const RunKind       kind;
      CrackTracker<dim>   tracker;
      CrackFigures<dim>   figures;
      /// Broken bonds when the cracks were last looked at.
      GlobalIndex n_collected = 0;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<Recorder<dim>> make_cracks_recorder(Problem<dim> &problem, const RunKind &kind)
  {
    if (problem.parameters.cracks.cracks.empty())
      return nullptr;
    return std::make_unique<CracksRecorder<dim>>(problem, kind);
  }

  PERIDEAL_INSTANTIATE(make_cracks_recorder)
} // namespace perideal
