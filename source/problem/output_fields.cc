// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/registry.h>
#include <perideal/problem/elastic_states.h>
#include <perideal/problem/output_fields.h>
#include <perideal/problem/problem.h>
#include <perideal/problem/vertex_displacement.h>

#include <algorithm>
#include <functional>

namespace perideal
{
  namespace
  {
    /// What a field is made from.
    enum class Source
    {
      state,
      strain
    };

    template <int dim>
    struct Field
    {
      /// Of its values; empty: each has its own.
      const char *unit;
      void (*add)(const Problem<dim> &, FieldSink<dim> &);
      Source source = Source::state;
    };

    template <int dim>
    void add_displacement(const Problem<dim> &problem, FieldSink<dim> &output)
    {
      const std::string name = "displacement";
      if (MeshPoints<dim> *points = output.points())
        {
          open_cracks(problem, *points);
          output.add_at_points(name, vertex_displacement(problem, *points));
        }
      else
        output.add_displacement(name, problem.state.displacement);
    }

    template <int dim>
    void add_comparison(const Problem<dim> &problem, const std::string &name, FieldSink<dim> &output)
    {
      const auto solution = problem.state.comparisons.find(name);
      if (solution != problem.state.comparisons.end())
        output.add_vector(name + "_displacement", solution->second);
    }

    template <int dim>
    void add_error(const Problem<dim> &problem, FieldSink<dim> &output)
    {
      for (const auto &solution : problem.state.comparisons)
        {
          NodalField<dim> error = problem.state.displacement;
          for (LocalIndex i = 0; i < error.size(); ++i)
            error[i] -= solution.second[i];
          output.add_vector("error_against_" + solution.first, error);
        }
    }

    /// A number of each family.
    template <int dim, typename Value>
    void add_family_scalar(const Problem<dim> &problem,
                           const std::string  &name,
                           const Value        &value,
                           FieldSink<dim>     &output)
    {
      std::vector<double> values(problem.body.nodes->size());
      for (LocalIndex i = 0; i < values.size(); ++i)
        values[i] = value(i);
      output.add_scalar(name, values);
    }

    template <int dim>
    void add_state_tensor(const Problem<dim>           &problem,
                          const std::string            &name,
                          dealii::SymmetricTensor<2, 3> ElasticState::*tensor,
                          FieldSink<dim>                              &output)
    {
      std::vector<dealii::SymmetricTensor<2, 3>> values;
      for (const ElasticState &state : elastic_states(problem))
        values.push_back(state.*tensor);
      output.add_tensor(name, values);
    }

    template <int dim, typename Value>
    void add_state_scalar(const Problem<dim> &problem,
                          const std::string  &name,
                          const Value        &value,
                          FieldSink<dim>     &output)
    {
      std::vector<double> values;
      for (const ElasticState &state : elastic_states(problem))
        values.push_back(value(state));
      output.add_scalar(name, values);
    }

    template <int dim>
    void add_fem_stress(const Problem<dim> &problem, FieldSink<dim> &output)
    {
      if (!problem.state.fem || !problem.state.fem->states)
        return;
      std::vector<dealii::SymmetricTensor<2, 3>> values;
      for (const ElasticState &state : *problem.state.fem->states)
        values.push_back(state.stress);
      output.add_tensor("fem_stress", values);
    }

    /// What the stress of the bonds is off from that of the finite elements.
    template <int dim>
    void add_stress_error(const Problem<dim> &problem, FieldSink<dim> &output)
    {
      if (!problem.state.fem || !problem.state.fem->states)
        return;
      std::vector<dealii::SymmetricTensor<2, 3>> values;
      for (const ElasticState &state : elastic_states(problem))
        values.push_back(state.stress - (*problem.state.fem->states)[values.size()].stress);
      output.add_tensor("stress_error", values);
    }

    /// Whatever lasts from step to step and may be shown, number by number.
    template <int dim>
    void add_lasting_state(const Problem<dim> &problem, FieldSink<dim> &output)
    {
      const std::size_t n_nodes = problem.body.nodes->size();
      for (const auto &field : problem.lasting.fields())
        {
          const std::vector<double> values = field.get();
          std::string               name   = field.name;
          std::replace(name.begin(), name.end(), ' ', '_');
          // Nodes of the cells come first.
          for (unsigned int c = 0; c < field.width; ++c)
            {
              std::vector<double> component(n_nodes);
              for (std::size_t i = 0; i < n_nodes; ++i)
                component[i] = values[field.width * i + c];
              output.add_scalar(field.width == 1 ? name : name + "_" + std::to_string(c), component);
            }
        }
    }

    /// The list of fields: a new one is one line here.
    template <int dim>
    const Registry<Field<dim>> &fields()
    {
      using Scene  = const Problem<dim> &;
      using Output = FieldSink<dim> &;
      static const Registry<Field<dim>> list(
        "Output/Fields",
        {{"displacement", {"m", [](Scene s, Output o) { add_displacement(s, o); }}},
         {"velocity",
          {"m/s",
           [](Scene s, Output o) {
             if (!s.state.velocity.empty())
               o.add_vector("velocity", s.state.velocity);
           }}},
         {"damage",
          {"-",
           [](Scene s, Output o) {
             if (s.force)
               o.add_scalar("damage", s.force->damage());
           }}},
         {"precracks",
          {"-",
           [](Scene s, Output o) {
             if (s.force)
               o.add_scalar("precracks", s.force->cut_share());
           }}},
         {"fem", {"m", [](Scene s, Output o) { add_comparison(s, "fem", o); }}},
         {"reference", {"m", [](Scene s, Output o) { add_comparison(s, "reference", o); }}},
         {"exact", {"m", [](Scene s, Output o) { add_comparison(s, "exact", o); }}},
         {"error", {"m", [](Scene s, Output o) { add_error(s, o); }}},
         {"dilatation",
          {"-",
           [](Scene s, Output o) {
             const auto dilatation = s.force ? s.force->dilatation() : s.discretisation.bonds->dilatation();
             add_family_scalar(
               s, "dilatation", [&](LocalIndex i) { return dilatation[i]; }, o);
           }}},
         {"strain",
          {"-",
           [](Scene s, Output o) { add_state_tensor(s, "strain", &ElasticState::strain, o); },
           Source::strain}},
         {"stress",
          {"Pa",
           [](Scene s, Output o) { add_state_tensor(s, "stress", &ElasticState::stress, o); },
           Source::strain}},
         {"von mises",
          {"Pa",
           [](Scene s, Output o) {
             add_state_scalar(s, "von_mises_stress", std::mem_fn(&ElasticState::von_mises), o);
           },
           Source::strain}},
         {"principal stress",
          {"Pa",
           [](Scene s, Output o) {
             add_state_scalar(
               s, "largest_principal_stress", std::mem_fn(&ElasticState::largest_principal), o);
             add_state_scalar(
               s, "smallest_principal_stress", std::mem_fn(&ElasticState::smallest_principal), o);
           },
           Source::strain}},
         {"triaxiality",
          {"-",
           [](Scene s, Output o) {
             add_state_scalar(s, "triaxiality", std::mem_fn(&ElasticState::triaxiality), o);
           },
           Source::strain}},
         {"strain energy density",
          {"J/m^3",
           [](Scene s, Output o) {
             add_state_scalar(s, "strain_energy_density", std::mem_fn(&ElasticState::energy_density), o);
           },
           Source::strain}},
         {"fem stress", {"Pa", [](Scene s, Output o) { add_fem_stress(s, o); }}},
         {"stress error", {"Pa", [](Scene s, Output o) { add_stress_error(s, o); }, Source::strain}},
         {"state", {"", [](Scene s, Output o) { add_lasting_state(s, o); }}},
         {"volume", {"m^3", [](Scene s, Output o) { o.add_scalar("volume", s.body.nodes->volume); }}},
         {"horizon", {"m", [](Scene s, Output o) { o.add_scalar("horizon", s.body.nodes->horizon); }}},
         {"material",
          {"-",
           [](Scene s, Output o) {
             add_family_scalar(
               s, "material", [&](LocalIndex i) { return double(s.body.nodes->material[i]); }, o);
           }}},
         {"neighbours",
          {"-",
           [](Scene s, Output o) {
             add_family_scalar(
               s, "neighbours", [&](LocalIndex i) { return double(s.discretisation.families->size(i)); }, o);
           }}},
         // 1: spherical or compromised weights, 2: a moment condition missed, 4: negative deviatoric weights
         // met.
         {"family status", {"-", [](Scene s, Output o) {
                              const auto status = [&](LocalIndex i) {
                                const FamilyReport &report = s.discretisation.reports[i];
                                return double(report.fallback + 2 * report.singular + 4 * report.indefinite);
                              };
                              add_family_scalar(s, "family_status", status, o);
                            }}}});
      return list;
    }
  } // namespace

  std::vector<std::string> output_field_names()
  {
    return fields<2>().names();
  }

  std::string output_field_unit(const std::string &name)
  {
    return fields<2>().get(name).unit;
  }

  bool needs_strain(const std::vector<std::string> &names)
  {
    return std::any_of(names.begin(), names.end(), [](const std::string &name) {
      return fields<2>().get(name).source == Source::strain;
    });
  }

  template <int dim>
  void add_output_fields(const Problem<dim>             &problem,
                         const std::vector<std::string> &names,
                         FieldSink<dim>                 &output)
  {
    for (const std::string &name : names)
      fields<dim>().get(name).add(problem, output);
  }

  PERIDEAL_INSTANTIATE(add_output_fields)
} // namespace perideal
