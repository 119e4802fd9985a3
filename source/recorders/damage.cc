// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/text.h>
#include <perideal/fracture/fragments.h>
#include <perideal/output/summary.h>
#include <perideal/recorders/make_recorders.h>

namespace perideal
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    /// Records broken bonds, when the first one broke, the pieces that the body falls into and the nodes that
    /// came loose.
    template <int dim>
    class DamageRecorder : public Recorder<dim>
    {
    public:
      DamageRecorder(const Problem<dim> &problem, const RunKind &kind)
        : problem(problem)
        , kind(kind)
        , breaks(can_break(problem.parameters))
      {
      }

      void start(Json &summary) override
      {
        if (problem.failure.no_fail_zones)
          summary["damage"]["no_fail_nodes"] = problem.failure.n_no_fail_nodes;
        if (!problem.failure.precracks.empty())
          summary["damage"]["cut_bonds"] = problem.failure.n_cut_bonds;
      }

      void observe(const Step<dim> &step, const Record &record) override
      {
        if (step.n_broken > 0 && !record.summary["damage"].contains("first_break_time"))
          record.summary["damage"]["first_break_time"] = step.time;
      }

      void record(const Step<dim> &step, const Record &record) override
      {
        n_floating = step.n_floating;
        record.history.add("broken bonds", step.n_broken);
        if (breaks || kind.has_motion)
          record.summary["damage"]["broken_bonds"] = step.n_broken;
        if (!breaks || kind.has_motion)
          return;
        Json &damage             = record.summary["damage"];
        damage["floating_nodes"] = step.n_floating;
        if (step.newly_broken > 0 || !damage.contains("fragments"))
          damage["fragments"] = fragments();
      }

      void conclude(const Step<dim> &, const Record &record) override
      {
        if (breaks && kind.has_motion)
          record.summary["damage"]["fragments"] = fragments();
      }

      void finish(Json &summary) override
      {
        if (n_floating > 0)
          summary["damage"]["floating_nodes"] = n_floating;
      }

      std::string describe(const Json &summary, const bool) const override
      {
        std::string text;
        const Json  damage = summary.value("damage", Json::object());
        if (n_floating > 0)
          text +=
            "warning     " + grouped(n_floating) +
            " nodes are disconnected from the supports and held by weak springs: their displacement under a "
            "load is that of the springs\n";
        if (damage.contains("cut_bonds"))
          text += "precracks   " + grouped(damage["cut_bonds"].get<GlobalIndex>()) + " cut bonds\n";
        if (damage.value("broken_bonds", GlobalIndex(0)) > 0)
          {
            text += "damage      " + grouped(damage["broken_bonds"].get<GlobalIndex>()) +
                    " broken bonds, the first at " + short_number(damage["first_break_time"].get<double>()) +
                    (kind.has_motion ? " s" : "");
            if (damage.contains("fragments"))
              text += "; " + std::to_string(damage["fragments"].size()) + " piece(s)";
            text += '\n';
          }
        return text;
      }

      void register_state(LastingState &state, Json &summary) override { state.add_part("damage", summary); }

    private:
      Json fragments() const
      {
        return find_fragments(*problem.discretisation.families,
                              problem.force->body_bonds(),
                              problem.body.nodes->spacing,
                              total_damage(*problem.force),
                              problem.parameters.cracks.damage);
      }

      const Problem<dim> &problem;
      const RunKind       kind;
      const bool          breaks;
      GlobalIndex         n_floating = 0;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<Recorder<dim>> make_damage_recorder(Problem<dim> &problem, const RunKind &kind)
  {
    if (!kind.has_motion && !kind.has_iterations)
      return nullptr;
    return std::make_unique<DamageRecorder<dim>>(problem, kind);
  }

  PERIDEAL_INSTANTIATE(make_damage_recorder)
} // namespace perideal
