// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/boundary/gauges.h>
#include <perideal/fem/hyperelastic_fem.h>
#include <perideal/output/summary.h>
#include <perideal/problem/elastic_states.h>
#include <perideal/problem/finite_elements.h>
#include <perideal/recorders/make_recorders.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    /// Solves with finite elements of finite strain along the same load steps, and records them beside the
    /// body: energy, reactions, gauges.
    template <int dim>
    class FiniteElementsRecorder : public Recorder<dim>
    {
    public:
      explicit FiniteElementsRecorder(Problem<dim> &problem)
        : problem(problem)
      {
        if (!problem.parameters.gauges.gauges.empty())
          gauges = std::make_unique<Gauges<dim>>(*problem.body.mesh,
                                                 CellGraph<dim>(*problem.body.mesh, *problem.body.nodes),
                                                 read_gauges<dim>(problem.parameters.gauges));
      }

      void start(Json &summary) override
      {
        const Timings::Scope scope(problem.run.timings, "fem");
        for (const auto &solid : problem.discretisation.compared_solids(problem.body, *problem.body.mesh))
          laws[solid.first] = create_law<dim>(problem.parameters.model.law, solid.second);
        typename HyperelasticFem<dim>::Controls controls;
        controls.tolerance      = problem.parameters.solver.tolerance;
        controls.max_iterations = problem.parameters.solver.newton_iterations;
        controls.halvings       = problem.parameters.solver.step_halvings;
        fem =
          std::make_unique<HyperelasticFem<dim>>(*problem.body.mesh, problem.loading.loads, laws, controls);
        summary["fem"]["unknowns"] = fem->n_dofs();
      }

      void record(const Step<dim> &step, const Record &record) override
      {
        solve(step.time, record.summary);
        ++n_steps;
        const Timings::Scope scope(problem.run.timings, "fem");
        const double         energy = fem->strain_energy();
        record.history.add("fem: strain energy [J]", energy);
        record.summary["fem"]["strain_energy"] = energy;
        record_reactions(record);
        if (gauges)
          record_gauges(record);
      }

      void conclude(const Step<dim> &, const Record &) override
      {
        const Nodes<dim> &nodes = *problem.body.nodes;
        FemSolution<dim>  solution;
        solution.displacement = on_mesh_at_nodes<dim>(problem, *fem);
        solution.n_unknowns   = fem->n_dofs();
        solution.states.emplace();
        for (const auto &gradient :
             in_cells_of_nodes(nodes, [&](const auto &points) { return fem->gradients_in_cells(points); }))
          solution.states->push_back(
            state_by_law(*laws.at(nodes.material[solution.states->size()]), gradient));
        problem.state.comparisons["fem"] = solution.displacement;
        problem.state.fem                = std::move(solution);
      }

      /// Finite elements leave no checkpoints: they take their steps again.
      void register_state(LastingState &state, Json &summary) override
      {
        state.add_value(
          "steps of finite elements",
          [this] { return Json(n_steps); },
          [this, &summary](const Json &read) {
            n_steps = read.get<unsigned int>();
            for (unsigned int k = 1; k <= n_steps; ++k)
              solve(static_cast<double>(k) / problem.parameters.solver.load_steps, summary);
          });
      }

    private:
      void solve(const double time, Json &summary)
      {
        const Timings::Scope scope(problem.run.timings, "fem");
        const auto           step = fem->solve_step(time);
        problem.run.screen << "finite elements: " << step.iterations << " iterations, residual "
                           << short_number(step.residual) << std::endl;
        summary["fem"]["iterations"].push_back(step.iterations);
        summary["fem"]["linear_iterations"].push_back(step.linear_iterations);
      }

      void record_reactions(const Record &record) const
      {
        const char *axes[] = {"x", "y", "z"};
        for (const BoundaryCondition<dim> &condition : problem.loading.loads.conditions)
          if (condition.prescribes_displacement())
            {
              dealii::Tensor<1, dim> reaction;
              for (const auto boundary : condition.boundary_ids)
                reaction += fem->reaction(boundary);
              Json value = Json::array();
              for (int d = 0; d < dim; ++d)
                {
                  record.history.add("fem: reaction of " + condition.name + " along " + axes[d] + " [N]",
                                     reaction[d]);
                  value.push_back(reaction[d]);
                }
              record.summary["fem"]["reactions"][condition.name] = value;
            }
      }

      /// Behind the readings of the same step in the body.
      void record_gauges(const Record &record) const
      {
        const auto readings = gauges->read(fem->evaluate(gauges->points()));
        for (std::size_t k = 0; k < readings.size(); ++k)
          {
            const std::string &name  = gauges->list()[k].name;
            Json              &entry = record.summary["gauges"][name];
            record.history.add("fem: stretch of " + name + " [-]", readings[k].stretch);
            entry["fem"].push_back(readings[k].stretch);
            const double difference =
              std::abs(readings[k].stretch - entry["stretch"].back().template get<double>());
            entry["largest_difference"] = std::max(difference, entry.value("largest_difference", 0.));
          }
      }

      Problem<dim>                         &problem;
      LawsByMaterial<dim>                   laws;
      std::unique_ptr<Gauges<dim>>          gauges;
      unsigned int                          n_steps = 0;
      std::unique_ptr<HyperelasticFem<dim>> fem;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<Recorder<dim>> make_finite_elements_recorder(Problem<dim> &problem, const RunKind &kind)
  {
    if (!kind.has_iterations || !problem.parameters.comparison.fem ||
        !problem.parameters.model.is_correspondence())
      return nullptr;
    return std::make_unique<FiniteElementsRecorder<dim>>(problem);
  }

  PERIDEAL_INSTANTIATE(make_finite_elements_recorder)
} // namespace perideal
