// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/drivers/create_drivers.h>
#include <perideal/drivers/preconditioning.h>
#include <perideal/output/progress.h>
#include <perideal/output/summary.h>

#include <algorithm>
#include <iostream>

namespace perideal
{
  namespace
  {
    /// Linear statics: one operator and one preconditioner for all load steps.
    template <int dim>
    class StaticDriver : public Driver<dim>
    {
    public:
      explicit StaticDriver(Problem<dim> &problem)
        : Driver<dim>(problem, RunKind())
      {
      }

    private:
      using Driver<dim>::problem;
      using Driver<dim>::recorders;

      void prepare_scene() override { problem.failure.prepare(problem.body); }

      void prepare() override
      {
        // An estimate of the error takes the same.
        if (!problem.system)
          {
            problem.find_motions();
            problem.solve_comparisons(true);
            problem.weigh();
          }
        problem.solve_comparisons(true);
        if (!solver)
          make_solver();
        solver->set_tolerance(problem.parameters.solver.tolerance);
      }

      void make_solver()
      {
        const Timings::Scope scope(problem.run.timings, "setup");
        const Timings::Scope part(problem.run.timings, "setup: preconditioner");
        preconditioning = std::make_unique<Preconditioning<dim>>(
          problem, problem.parameters.solver.load_steps, solver_report);
        solver                = preconditioning->create_solver(problem.parameters.solver, *problem.system);
        solver_report["name"] = solver->name();
      }

      bool solve_to(const double tolerance) override
      {
        make_solver();
        solver->set_tolerance(tolerance);
        Step<dim> step;
        step.time = 1.;
        solve(step);
        return step.search.converged;
      }

      std::string describe() const override
      {
        return solver ?
                 "solver      " + name_of(problem.parameters.solver.name) + ", " + solver->name() + '\n' :
                 "";
      }

      nlohmann::ordered_json skipped() const override
      {
        return {{"mass and velocity (statics)", 2 * dim * problem.body.nodes->n_global},
                {"set-ups of further load steps (linear)", problem.parameters.solver.load_steps - 1}};
      }

      StepsEnd advance() override
      {
        recorders->summary()["solver"] = solver_report;
        const unsigned int n_steps     = problem.parameters.solver.load_steps;
        for (unsigned int number = 1; number <= n_steps; ++number)
          {
            Step<dim> step;
            step.number                             = number;
            step.time                               = static_cast<double>(number) / n_steps;
            step.is_last                            = number == n_steps;
            recorders->summary()["solver"]["steps"] = number;
            solve(step);
            recorders->observe(step);
            check_convergence(step);
            measure(step);
            recorders->record(step);
            if (step.is_last)
              {
                // Stresses of the last step and the like take memory of their own.
                solver.reset();
                preconditioning.reset();
                recorders->conclude(step);
              }
            recorders->write_fields(step);
          }
        return StepsEnd::done;
      }

      void solve(Step<dim> &step)
      {
        const Timings::Scope scope(problem.run.timings, "solve");
        problem.apply_loads(step.time);
        State<dim> &state = problem.state;
        NodalVector residual, correction;
        problem.system->initialize(residual);
        problem.system->initialize(correction);
        problem.system->residual(residual, state.external_force, state.unknowns);
        problem.free_motions.project(residual);

        const double tolerance = problem.parameters.solver.tolerance;
        ProgressBar  progress(
          problem.run.screen.get_stream(), problem.run.is_watched, "solving t = " + short_number(step.time));
        const LinearSolve result =
          solver->solve(correction, residual, [&](const unsigned int iteration, const double r) {
            progress.update(share_of_iteration(r, tolerance),
                            "iteration " + std::to_string(iteration) + ", residual " + short_number(r));
          });
        state.unknowns += correction;
        step.search.iterations = result.iterations;
        step.search.converged  = result.converged;
        step.search.residuals  = result.residuals;
        is_indefinite          = result.indefinite;
        problem.store_displacement();
      }

      /// @throws ComputationError where the solver stopped before the tolerance.
      void check_convergence(const Step<dim> &step) const
      {
        if (step.search.converged)
          return;
        const std::string advice =
          is_indefinite ?
            "the operator is not positive definite: some motion of the nodes sets energy free. "
            "Where cell sizes jump, take Quadrature/Scheme = partial volume; else Material/Model = "
            "extended ordinary, or another Nodes/Horizon factor" :
            "see the residuals in history.h5; raise Solver/Maximum iterations, enlarge "
            "Nodes/Horizon factor, take another Solver/Preconditioner, or check the scene with "
            "--check";
        throw ComputationError(
          "the linear solver (" + solver->name() + ") stopped at t = " + short_number(step.time) + " after " +
          std::to_string(step.search.iterations) + " iterations at a relative residual of " +
          short_number(step.search.residuals.back()) + ", not at " +
          short_number(problem.parameters.solver.tolerance) + "\n  advice: " + advice);
      }

      /// Energies and supports of the equilibrium.
      void measure(Step<dim> &step) const
      {
        const State<dim> &state   = problem.state;
        auto              balance = problem.loading.supports->balance(
          {*problem.system, state.unknowns, state.external_force, step.time});
        step.reactions       = std::move(balance.reactions);
        step.energy.strain   = balance.strain_energy;
        step.energy.external = balance.external_work;
        if (balance.external_work != 0)
          step.energy_error = (balance.external_work - balance.strain_energy) / balance.external_work;
      }

      /// Whether the last solve met a motion that sets energy free.
      bool                                  is_indefinite = false;
      std::unique_ptr<Preconditioning<dim>> preconditioning;
      std::unique_ptr<LinearSolver<dim>>    solver;
      nlohmann::ordered_json                solver_report;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<Driver<dim>> create_static_driver(Problem<dim> &problem)
  {
    return std::make_unique<StaticDriver<dim>>(problem);
  }

  PERIDEAL_INSTANTIATE(create_static_driver)
} // namespace perideal
