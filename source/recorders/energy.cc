// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/output/summary.h>
#include <perideal/recorders/make_recorders.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    /// Records energies [J] and the error of their balance. That of a row is over the energy until then,
    /// which is small at first; in the summary of motions it is the worst over the largest energy of the run.
    template <int dim>
    class EnergyRecorder : public Recorder<dim>
    {
    public:
      EnergyRecorder(const RunKind &kind, const bool with_contact, const bool with_zone)
        : kind(kind)
        , with_contact(with_contact)
        , with_zone(with_zone)
      {
      }

      void record(const Step<dim> &step, const Record &record) override
      {
        const EnergyBudget &energy = step.energy;
        History            &row    = record.history;
        if (kind.has_motion)
          row.add("kinetic energy [J]", energy.kinetic);
        row.add("strain energy [J]", energy.strain);
        if (with_contact)
          row.add("contact energy [J]", energy.contact);
        const bool is_nonlinear = kind.has_motion || kind.has_iterations;
        if (is_nonlinear)
          row.add("dissipated energy [J]", energy.dissipated);
        if (with_zone)
          row.add("switched energy [J]", energy.switched);
        if (kind.has_motion)
          row.add("damped energy [J]", energy.damped);
        row.add("external work [J]", energy.external);
        if (is_nonlinear)
          row.add("drift [-]", step.energy_error);

        if (!kind.has_motion)
          drift = step.energy_error;
        else
          {
            largest = std::max({largest, std::abs(energy.external), energy.kinetic + energy.strain});
            if (!(std::abs(energy.imbalance()) <= std::abs(worst)))
              worst = energy.imbalance();
            drift = largest > 0 ? worst / largest : 0.;
          }
        Json summary      = Json::object();
        summary["strain"] = energy.strain;
        if (kind.has_motion)
          {
            summary["kinetic"] = energy.kinetic;
            summary["contact"] = energy.contact;
          }
        if (is_nonlinear)
          summary["dissipated"] = energy.dissipated;
        if (with_zone)
          summary["switched"] = energy.switched;
        if (kind.has_motion)
          summary["damped"] = energy.damped;
        summary["external"]      = energy.external;
        summary["drift"]         = drift;
        record.summary["energy"] = summary;
        if (!kind.has_motion)
          return;
        Json momentum = Json::array(), angular = Json::array();
        for (int d = 0; d < dim; ++d)
          momentum.push_back(step.momentum.linear[d]);
        for (int d = dim == 2 ? 2 : 0; d < 3; ++d)
          angular.push_back(step.momentum.angular[d]);
        record.summary["momentum"]         = momentum;
        record.summary["angular_momentum"] = angular;
      }

      std::string describe(const Json &summary, const bool) const override
      {
        if (!kind.has_motion || !summary.contains("energy"))
          return {};
        const Json &energy = summary.at("energy");
        const auto  number = [&](const char *part) {
          const Json &value = energy.at(part);
          return value.is_number() ? short_number(value.get<double>()) : std::string("-");
        };
        std::string text = "energy      " + number("kinetic") + " J kinetic, " + number("strain") +
                           " J strain, " + number("dissipated") + " J dissipated, " + number("external") +
                           " J external work; energy balance error " + number("drift") + '\n';
        if (!(std::abs(drift) <= 0.01))
          text += "warning     the energy balance error exceeds 1 %: take a smaller time step, or a form "
                  "that has an "
                  "energy\n";
        return text;
      }

      void register_state(LastingState &state, Json &summary) override
      {
        state.add_value("worst error of energy", worst);
        state.add_value("largest energy of rows", largest);
        state.add_part("energy", summary);
      }

    private:
      const RunKind kind;
      const bool    with_contact, with_zone;
      /// [J]
      double worst = 0, largest = 0;
      /// [-]
      double drift = 0;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<Recorder<dim>> make_energy_recorder(Problem<dim> &problem, const RunKind &kind)
  {
    return std::make_unique<EnergyRecorder<dim>>(
      kind, kind.has_motion && has_contact(problem.parameters), has_fracture_zone(problem.parameters));
  }

  PERIDEAL_INSTANTIATE(make_energy_recorder)
} // namespace perideal
