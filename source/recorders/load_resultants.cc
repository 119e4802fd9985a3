// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/output/summary.h>
#include <perideal/recorders/make_recorders.h>

namespace perideal
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    /// Records, at the last load step, what the loads add up to and what the nodes get of them.
    template <int dim>
    class LoadResultantsRecorder : public Recorder<dim>
    {
    public:
      explicit LoadResultantsRecorder(const Problem<dim> &problem)
        : problem(problem)
      {
      }

      void conclude(const Step<dim> &step, const Record &record) override
      {
        const State<dim> &state = problem.state;
        if (state.external_force.l2_norm() > 0)
          record.summary["loads"] =
            problem.loading.resultants(state.unknowns, state.external_force, step.time);
      }

      std::string describe(const Json &summary, const bool) const override
      {
        if (!summary.contains("loads"))
          return {};
        std::string sum, text, separator = "loads       nodes get of the tractions: ";
        for (const Json &component : summary["loads"].at("total").at("applied").at("force"))
          sum += (sum.empty() ? "" : ", ") + short_number(component.get<double>());
        sum =
          "loads       add up to (" + sum + ") N" +
          (dim == 2 ? " over the thickness of " + short_number(problem.body.mesh->thickness) + " m\n" : "\n");
        for (const auto &condition : summary["loads"].at("conditions").items())
          if (condition.value().contains("ratio"))
            {
              text += separator + condition.key() + ' ' +
                      short_number(100 * condition.value()["ratio"].get<double>()) + " %";
              separator = ", ";
            }
        return sum + (text.empty() ? text : text + '\n');
      }

    private:
      const Problem<dim> &problem;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<Recorder<dim>> make_load_resultants_recorder(Problem<dim> &problem, const RunKind &kind)
  {
    return kind.has_motion ? nullptr : std::make_unique<LoadResultantsRecorder<dim>>(problem);
  }

  PERIDEAL_INSTANTIATE(make_load_resultants_recorder)
} // namespace perideal
