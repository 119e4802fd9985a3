// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/finite.h>
#include <perideal/base/instantiate.h>
#include <perideal/output/summary.h>
#include <perideal/recorders/make_recorders.h>

namespace perideal
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    /// Records what linear solves or the search for equilibria took: lists by step in the summary, residuals
    /// as series of the history.
    template <int dim>
    class IterationsRecorder : public Recorder<dim>
    {
    public:
      explicit IterationsRecorder(const RunKind &kind)
        : kind(kind)
      {
      }

      void observe(const Step<dim> &step, const Record &record) override
      {
        const EquilibriumStep &search = step.search;
        Json                  &solver = record.summary["solver"];
        solver["iterations"].push_back(search.iterations);
        solver["converged"] = search.converged;
        if (kind.has_iterations)
          solver["halvings"].push_back(step.halvings);
        if (kind.has_linear_iterations)
          solver["linear_iterations"].push_back(search.linear_iterations);
        if (kind.has_linear_iterations || !kind.has_iterations)
          solver["residuals"].push_back(numbers_or_null(search.residuals));
        record.history.add_series("residuals of step " + std::to_string(step.number), search.residuals);
      }

      void record(const Step<dim> &step, const Record &record) override
      {
        if (!kind.has_iterations)
          return;
        record.history.add("iterations", step.search.iterations);
        if (kind.has_linear_iterations)
          record.history.add("linear iterations", step.search.linear_iterations);
        record.history.add("residual [-]", step.search.residuals.back());
      }

      std::string describe(const Json &summary, const bool is_done) const override
      {
        if (!is_done)
          return {};
        return "solved      " + summary.at("solver").at("iterations").back().dump() +
               " iterations, strain energy " +
               short_number(summary.at("energy").at("strain").template get<double>()) + " J\n";
      }

      void register_state(LastingState &state, Json &summary) override
      {
        state.add_value(
          "iterations",
          [&summary] {
            Json result = Json::object();
            for (const char *list : lists)
              if (summary.at("solver").contains(list))
                result[list] = summary.at("solver").at(list);
            return result;
          },
          [&summary](const Json &read) { summary["solver"].update(read); });
      }

    private:
      static constexpr const char *lists[] = {"halvings", "iterations", "linear_iterations", "residuals"};

      const RunKind kind;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<Recorder<dim>> make_iterations_recorder(Problem<dim> &, const RunKind &kind)
  {
    return kind.has_motion ? nullptr : std::make_unique<IterationsRecorder<dim>>(kind);
  }

  PERIDEAL_INSTANTIATE(make_iterations_recorder)
} // namespace perideal
