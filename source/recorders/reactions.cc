// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/recorders/make_recorders.h>

#include <cmath>

namespace perideal
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    /// Records the forces of the supports [N] and, along equilibria, the largest so far: what the body bore.
    template <int dim>
    class ReactionsRecorder : public Recorder<dim>
    {
    public:
      ReactionsRecorder(const Loads<dim> &loads, const RunKind &kind)
        : loads(loads)
        , kind(kind)
      {
      }

      void record(const Step<dim> &step, const Record &record) override
      {
        const char *axes[]    = {"x", "y", "z"};
        Json        reactions = Json::object();
        for (std::size_t k = 0; k < loads.conditions.size(); ++k)
          if (loads.conditions[k].prescribes_displacement() || loads.conditions[k].spring.stiffness > 0)
            for (int d = 0; d < dim; ++d)
              {
                const std::string &name  = loads.conditions[k].name;
                const double       force = step.reactions[k][d];
                record.history.add("reaction of " + name + " along " + axes[d] + " [N]", force);
                reactions[name].push_back(force);
                if (kind.has_iterations)
                  enlarge(record.summary["largest_reactions"][name], d, force);
              }
        if (!kind.has_motion)
          record.summary["reactions"] = reactions;
      }

      void register_state(LastingState &state, Json &summary) override
      {
        state.add_part("largest_reactions", summary);
      }

    private:
      static void enlarge(Json &largest, const int d, const double force)
      {
        if (largest.size() <= static_cast<std::size_t>(d))
          largest.push_back(force);
        else if (std::abs(force) > std::abs(largest[d].get<double>()))
          largest[d] = force;
      }

      const Loads<dim> &loads;
      const RunKind     kind;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<Recorder<dim>> make_reactions_recorder(Problem<dim> &problem, const RunKind &kind)
  {
    return std::make_unique<ReactionsRecorder<dim>>(problem.loading.loads, kind);
  }

  PERIDEAL_INSTANTIATE(make_reactions_recorder)
} // namespace perideal
