// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/finite.h>
#include <perideal/base/instantiate.h>
#include <perideal/parameters/point_text.h>
#include <perideal/problem/output_fields.h>
#include <perideal/recorders/make_recorders.h>
#include <perideal/recorders/point_values.h>

#include <algorithm>
#include <set>

namespace perideal
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    template <int dim>
    std::vector<typename PointValues<dim>::NamedPoint> points_of(const ProbeParameters &parameters)
    {
      std::vector<typename PointValues<dim>::NamedPoint> result;
      for (const ProbeText &probe : parameters.probes)
        {
          const std::string parameter = "Probes/" + probe.name + "/Point";
          result.push_back({parameter, read_point<dim>(probe.point, parameter)});
        }
      return result;
    }

    /// Records fields at points of the body, in the summary of load steps as lists by step.
    template <int dim>
    class ProbesRecorder : public Recorder<dim>
    {
    public:
      ProbesRecorder(const Problem<dim> &problem, const RunKind &kind)
        : problem(problem)
        , kind(kind)
        , probes(problem.parameters.probes.probes)
        , values(problem, points_of<dim>(problem.parameters.probes))
      {
      }

      void record(const Step<dim> &, const Record &record) override
      {
        // Each field once, whatever the number of its probes.
        std::set<std::string> fields;
        for (const ProbeText &probe : probes)
          for (const std::string &field : probe.field_names())
            fields.insert(field);
        for (const std::string &field : fields)
          {
            add_output_fields(problem, {field}, values);
            const auto columns = values.take();
            for (std::size_t p = 0; p < probes.size(); ++p)
              if (const auto names = probes[p].field_names();
                  std::find(names.begin(), names.end(), field) != names.end())
                for (const auto &column : columns)
                  add(probes[p].name, column.name, output_field_unit(field), column.values[p], record);
          }
      }

      void register_state(LastingState &state, Json &summary) override { state.add_part("probes", summary); }

    private:
      void add(const std::string &probe,
               const std::string &name,
               const std::string &unit,
               const double       value,
               const Record      &record) const
      {
        record.history.add(name + " at " + probe + " [" + unit + "]", value);
        if (!kind.has_motion)
          record.summary["probes"][probe][name].push_back(number_or_null(value));
      }

      const Problem<dim>           &problem;
      const RunKind                 kind;
      const std::vector<ProbeText> &probes;
      PointValues<dim>              values;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<Recorder<dim>> make_probes_recorder(Problem<dim> &problem, const RunKind &kind)
  {
    if (problem.parameters.probes.probes.empty())
      return nullptr;
    return std::make_unique<ProbesRecorder<dim>>(problem, kind);
  }

  PERIDEAL_INSTANTIATE(make_probes_recorder)
} // namespace perideal
