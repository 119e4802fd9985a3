// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/problem/make_gauges.h>
#include <perideal/recorders/make_recorders.h>

namespace perideal
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    /// Records the readings of extensometers: stretch [-] and elongation [m], in the summary of load steps as
    /// lists by step.
    template <int dim>
    class GaugesRecorder : public Recorder<dim>
    {
    public:
      GaugesRecorder(const Problem<dim> &problem, const RunKind &kind)
        : problem(problem)
        , kind(kind)
        , gauges(make_gauges(problem))
      {
      }

      void record(const Step<dim> &, const Record &record) override
      {
        const auto readings = gauges.read(problem.state.unknowns);
        for (std::size_t k = 0; k < readings.size(); ++k)
          {
            const std::string &name = gauges.list()[k].name;
            record.history.add("stretch of " + name + " [-]", readings[k].stretch);
            record.history.add("elongation of " + name + " [m]", readings[k].elongation);
            if (kind.has_motion)
              continue;
            Json &entry = record.summary["gauges"][name];
            entry["stretch"].push_back(readings[k].stretch);
            entry["elongation"].push_back(readings[k].elongation);
          }
      }

      void register_state(LastingState &state, Json &summary) override { state.add_part("gauges", summary); }

    private:
      const Problem<dim> &problem;
      const RunKind       kind;
      const Gauges<dim>   gauges;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<Recorder<dim>> make_gauges_recorder(Problem<dim> &problem, const RunKind &kind)
  {
    if (problem.parameters.gauges.gauges.empty())
      return nullptr;
    return std::make_unique<GaugesRecorder<dim>>(problem, kind);
  }

  PERIDEAL_INSTANTIATE(make_gauges_recorder)
} // namespace perideal
