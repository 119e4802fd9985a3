// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/finite.h>
#include <perideal/base/instantiate.h>
#include <perideal/output/errors.h>
#include <perideal/output/profiles.h>
#include <perideal/parameters/point_text.h>
#include <perideal/problem/elastic_states.h>
#include <perideal/recorders/line_values.h>
#include <perideal/recorders/make_recorders.h>

#include <cmath>

namespace perideal
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    template <int dim>
    using Profiles = std::vector<std::pair<std::string, std::unique_ptr<Profile<dim>>>>;

    /// Beginning and end of a line.
    /// @throws InputError on what are no two points.
    template <int dim>
    std::pair<dealii::Point<dim>, dealii::Point<dim>> ends_of(const LineText &line)
    {
      const std::string section = "Comparison/" + line.name;
      const std::pair   result{read_point<dim>(line.from, section + "/From"),
                             read_point<dim>(line.to, section + "/To")};
      if (result.first == result.second)
        throw InputError("the line has no length").parameter(section + "/To").given(line.to);
      return result;
    }

    template <int dim>
    void check_lines(const Mesh<dim> &mesh, const Nodes<dim> &nodes, const std::vector<LineText> &lines)
    {
      for (const LineText &line : lines)
        {
          const auto [from, to] = ends_of<dim>(line);
          const auto   found    = LineProfile<dim>(mesh, nodes, from, to).local_nodes().size();
          const double all      = dealii::Utilities::MPI::sum(static_cast<double>(found), nodes.communicator);
          if (all == 0)
            throw InputError("the line passes through no cell of the body")
              .parameter("Comparison/" + line.name)
              .given(line.from + " to " + line.to);
        }
    }

    /// @throws InputError on all ranks where a line misses the body, or a boundary is unknown. Collective.
    template <int dim>
    Profiles<dim> make_profiles(const Body<dim> &body)
    {
      const ComparisonParameters &parameters = body.parameters.comparison;
      Profiles<dim>               profiles;
      for (const std::string &name : parameters.profiles)
        profiles.emplace_back(
          name,
          std::make_unique<BoundaryProfile<dim>>(
            *body.mesh, *body.nodes, body.mesh->boundary_id(name, "Comparison/Profiles")));
      check_lines(*body.mesh, *body.nodes, parameters.lines);
      for (const LineText &line : parameters.lines)
        {
          const auto [from, to] = ends_of<dim>(line);
          profiles.emplace_back(line.name,
                                std::make_unique<LineProfile<dim>>(*body.mesh, *body.nodes, from, to));
        }
      return profiles;
    }

    /// The exact solution by component.
    /// @throws InputError where it lacks one.
    template <int dim>
    std::array<SpaceTimeFunction<dim>, dim> read_exact(const ComparisonParameters &parameters)
    {
      std::array<SpaceTimeFunction<dim>, dim> result;
      const char                             *axes[] = {"x", "y", "z"};
      for (int d = 0; d < dim && parameters.has_exact(); ++d)
        {
          const std::string path = std::string("Comparison/Exact u_") + axes[d];
          result[d]              = SpaceTimeFunction<dim>(parameters.exact[d], path);
          if (!result[d].is_present())
            throw InputError("the exact solution lacks a component")
              .parameter(path)
              .allowed("a formula for every component, or none at all");
        }
      return result;
    }

    /**
     * Holds the displacement of the last step against finite elements, a reference and an exact solution, and
     * the finite elements against the two others: errors for summary.json, profile_NAME.csv.
     */
    template <int dim>
    class ComparisonRecorder : public Recorder<dim>
    {
    public:
      ComparisonRecorder(Problem<dim> &problem, const RunKind &kind, const bool solves_fem)
        : problem(problem)
        , parameters(problem.parameters.comparison)
        , kind(kind)
        , solves_fem(solves_fem)
        , exact(read_exact<dim>(parameters))
        , profiles(make_profiles(problem.body))
      {
        std::vector<typename LineValues<dim>::Line> lines;
        for (const LineText &line : parameters.lines)
          {
            const auto [from, to] = ends_of<dim>(line);
            lines.push_back({line.name, from, to, line.points});
          }
        if (!lines.empty())
          line_values = std::make_unique<LineValues<dim>>(problem, lines);
      }

      void prepare_fields(const Step<dim> &step) override
      {
        if (kind.has_motion && parameters.has_exact())
          problem.state.comparisons["exact"] = exact_at_nodes(step.time);
      }

      void conclude(const Step<dim> &step, const Record &record) override
      {
        if (solves_fem)
          {
            if (!problem.state.fem)
              problem.solve_fem(step.time);
            record.summary["fem"] = {{"iterations", Json::array({problem.state.fem->iterations})},
                                     {"unknowns", problem.state.fem->n_unknowns}};
          }
        if (parameters.has_exact())
          problem.state.comparisons["exact"] = exact_at_nodes(step.time);
        const Timings::Scope scope(problem.run.timings, "output");
        record.summary["errors"] = compare();
      }

    private:
      /// Errors of the stress against that of the finite elements, and the largest von Mises stress of both.
      Json stress_errors() const
      {
        using Stress       = std::vector<dealii::SymmetricTensor<2, 3>>;
        const auto  states = elastic_states(problem);
        const auto &nodes  = *problem.body.nodes;
        Stress      own, fem;
        double      own_peak = 0, fem_peak = 0;
        for (LocalIndex i = 0; i < nodes.size(); ++i)
          {
            own.push_back(states[i].stress);
            fem.push_back((*problem.state.fem->states)[i].stress);
            if (is_given(i))
              continue;
            own_peak = std::max(own_peak, states[i].von_mises());
            fem_peak = std::max(fem_peak, (*problem.state.fem->states)[i].von_mises());
          }
        const auto errors = field_errors(nodes, own, fem, [&](const LocalIndex i) { return is_given(i); });
        const auto of_all = [&](const double peak) {
          return dealii::Utilities::MPI::max(peak, problem.run.communicator);
        };
        return {{"l2", number_or_null(errors.l2)},
                {"max", number_or_null(errors.max)},
                {"largest_von_mises", of_all(own_peak)},
                {"largest_von_mises_of_fem", of_all(fem_peak)}};
      }

      /// Displacements of held layers are data and no result.
      bool is_given(const LocalIndex i) const { return problem.loading.supports->held().in_collar(i); }

      NodalField<dim> exact_at_nodes(const double time) const
      {
        const Nodes<dim> &nodes = *problem.body.nodes;
        NodalField<dim>   result(nodes.size());
        for (LocalIndex i = 0; i < result.size(); ++i)
          for (int d = 0; d < dim; ++d)
            result[i][d] = exact[d].value(nodes.position[i], time);
        problem.free_motions.remove_mean(nodes, result);
        return result;
      }

      /// @throws ComputationError on all ranks when a field is not finite on one. Collective.
      void check_finite(const std::string &name, const NodalField<dim> &field) const
      {
        double sum = 0;
        for (const auto &u : field)
          for (int d = 0; d < dim; ++d)
            sum += std::abs(u[d]);
        require_finite(dealii::Utilities::MPI::sum(sum, problem.run.communicator),
                       "the displacement of " + name);
      }

      /// Errors over a reference that is zero are null.
      Json errors_of(const NodalField<dim> &field, const NodalField<dim> &reference) const
      {
        const char       *components[] = {"u_x", "u_y", "u_z"};
        const Nodes<dim> &nodes        = *problem.body.nodes;
        const auto        errors =
          field_errors(nodes, field, reference, [&](const LocalIndex i) { return is_given(i); });
        Json result = {{"l2", number_or_null(errors.l2)}, {"max", number_or_null(errors.max)}};
        for (const auto &profile : profiles)
          {
            const auto along = profile_errors(nodes, profile.second->local_nodes(), field, reference);
            for (int d = 0; d < dim; ++d)
              result["profiles"][profile.first][components[d]] = number_or_null(along[d]);
          }
        return result;
      }

      Json compare() const
      {
        const auto &solutions = problem.state.comparisons;
        Json        result    = Json::object();
        check_finite("the body", problem.state.displacement);
        for (const auto &solution : solutions)
          check_finite(solution.first, solution.second);
        for (const auto &solution : solutions)
          result[solution.first] = errors_of(problem.state.displacement, solution.second);
        // The finite elements' own error, beside which ours is to be read.
        if (solutions.count("fem") > 0)
          for (const char *truth : {"reference", "exact"})
            if (solutions.count(truth) > 0)
              result["fem"][std::string("own error against ") + truth] =
                errors_of(solutions.at("fem"), solutions.at(truth));

        if (problem.state.fem && problem.state.fem->states && has_elastic_states(problem))
          result["fem"]["stress"] = stress_errors();

        for (const auto &profile : profiles)
          {
            std::vector<typename Profile<dim>::NamedField> fields = {
              {"perideal", problem.state.displacement}};
            fields.insert(fields.end(), solutions.begin(), solutions.end());
            profile.second->write(problem.parameters.output_directory + "/profile_" + profile.first + ".csv",
                                  fields);
          }
        if (line_values)
          line_values->write(problem.parameters.output_directory);
        return result;
      }

      Problem<dim>                                 &problem;
      const ComparisonParameters                   &parameters;
      const RunKind                                 kind;
      const bool                                    solves_fem;
      const std::array<SpaceTimeFunction<dim>, dim> exact;
      const Profiles<dim>                           profiles;
      std::unique_ptr<LineValues<dim>>              line_values;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<Recorder<dim>> make_comparison_recorder(Problem<dim> &problem, const RunKind &kind)
  {
    // Along nonlinear equilibria of the correspondence model, another recorder takes finite elements along.
    const bool has_fem = problem.parameters.comparison.fem &&
                         !(kind.has_iterations && problem.parameters.model.is_correspondence());
    return std::make_unique<ComparisonRecorder<dim>>(problem, kind, has_fem);
  }

  PERIDEAL_INSTANTIATE(make_comparison_recorder)
} // namespace perideal
