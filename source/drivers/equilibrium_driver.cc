// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/base/stop_request.h>
#include <perideal/drivers/create_drivers.h>
#include <perideal/drivers/failed_step.h>
#include <perideal/drivers/load_control.h>
#include <perideal/drivers/load_steps.h>
#include <perideal/drivers/tangent_system.h>
#include <perideal/output/progress.h>
#include <perideal/output/summary.h>
#include <perideal/solvers/dynamic_relaxation.h>

#include <algorithm>

namespace perideal
{
  namespace
  {
    RunKind kind_of(const SolverParameters &solver)
    {
      return {false, true, solver.is_quasi_static()};
    }

    /// Equilibria of the nonlinear force along load steps, with failure, by Newton's method or dynamic
    /// relaxation.
    template <int dim>
    class EquilibriumDriver : public Driver<dim>
    {
    public:
      explicit EquilibriumDriver(Problem<dim> &problem)
        : Driver<dim>(problem, kind_of(problem.parameters.solver))
        , solver(problem.parameters.solver)
      {
      }

    private:
      using Driver<dim>::problem;
      using Driver<dim>::recorders;
      using Driver<dim>::resumed;

      void prepare_scene() override { problem.failure.prepare(problem.body); }

      void prepare() override
      {
        problem.find_motions();
        problem.solve_comparisons(false);
        problem.weigh();
        problem.solve_comparisons(false);
        problem.make_force();
        solver_report["name"] = "dynamic relaxation";
        if (solver.is_quasi_static())
          set_up_tangent();
        problem.make_failure();
      }

      void set_up_tangent()
      {
        const Timings::Scope scope(problem.run.timings, "setup");
        const Timings::Scope part(problem.run.timings, "setup: preconditioner");
        tangent               = std::make_unique<TangentSystem<dim>>(problem, solver_report);
        solver_report["name"] = "quasi static, " + tangent->name();
      }

      std::string describe() const override
      {
        const std::string steps = solver.is_controlled() ?
                                    ", control by " + name_of(solver.control) :
                                    " in " + std::to_string(solver.n_load_steps()) + " load step(s)";
        if (!solver.is_quasi_static())
          return "solver      dynamic relaxation" + steps + '\n';
        return "solver      quasi static, Newton's method" + steps +
               (tangent ? ", tangents by " + tangent->name() : "") + '\n';
      }

      nlohmann::ordered_json skipped() const override
      {
        nlohmann::ordered_json result = {
          {"mass and velocity (statics)", 2 * dim * problem.body.nodes->n_global}};
        if (!solver.is_quasi_static())
          result["matrix, preconditioner (relaxation)"] = 1;
        return result;
      }

      std::size_t memory_consumption() const override
      {
        return Driver<dim>::memory_consumption() + (tangent ? tangent->memory_consumption() : 0);
      }

      std::string last_step() const override { return "load step " + std::to_string(done); }

      void make_path()
      {
        typename EquilibriumPath<dim>::Controls controls;
        controls.tolerance      = solver.tolerance;
        controls.bonds_break    = can_break(problem.parameters);
        controls.max_iterations = solver.is_quasi_static() ? solver.newton_iterations : solver.max_iterations;
        Loading<dim> &loading   = problem.loading;
        if (solver.is_controlled())
          {
            auto made  = tangent->create_controlled_newton(LoadControl<dim>::control_of(problem), controls);
            controlled = made.get();
            path       = std::move(made);
            control =
              std::make_unique<LoadControl<dim>>(problem, *controlled, this->adaptation.finest_cell());
            return;
          }
        // A crack that needs no more load would run through large cells within one step.
        if (problem.parameters.adaptation.is_by_need())
          controls.wants_mesh = [this] {
            const Timings::Scope part(problem.run.timings, "solve: adaptation");
            return steps->may_change_mesh() && this->adaptation.is_due_within(done, steps->time());
          };
        if (solver.is_quasi_static())
          path = tangent->create_newton(controls);
        else
          path = std::make_unique<DynamicRelaxation<dim>>(
            *problem.force, *problem.system, loading.supports->held(), loading.loads, controls);
        steps = std::make_unique<LoadSteps<dim>>(problem, *path);
      }

      StepsEnd advance() override
      {
        recorders->summary()["solver"] = solver_report;
        progress                       = std::make_unique<ProgressBar>(
          problem.run.screen.get_stream(), problem.run.is_watched, "load steps");
        make_path();
        path->register_state(problem.lasting);
        if (control)
          control->register_state(problem.lasting);
        else
          steps->register_state(problem.lasting);
        if (resumed)
          {
            resume();
            if (!this->mesh_has_changed && !looks_within_steps() && this->adaptation.is_due(done, time()))
              return StepsEnd::mesh_changes;
          }
        const unsigned int interval = problem.parameters.checkpoints.steps;
        const StopRequest  stop;
        while (!is_done())
          {
            if (!take_load_step(done + 1))
              return StepsEnd::mesh_changes;
            ++done;
            const bool stops  = stop.is_there(problem.run.communicator);
            const bool is_due = stops || (interval > 0 && done % interval == 0);
            if (is_done() ? problem.parameters.checkpoints.at_end && !control : is_due)
              this->save_checkpoint(done, time());
            if (stops && !is_done())
              return StepsEnd::stopped;
            if (!is_done() && !looks_within_steps() && this->adaptation.is_due(done, time()))
              return StepsEnd::mesh_changes;
          }
        return StepsEnd::done;
      }

      /// Whether the path asks for another mesh itself.
      bool looks_within_steps() const
      {
        return steps && can_break(problem.parameters) && !problem.force->softening_bonds().softens();
      }
      /// At the last equilibrium.
      double time() const { return control ? controlled->time() : steps->time(); }
      bool   is_done() const { return is_done_after(done); }
      bool   is_done_after(const unsigned int number) const
      {
        return control ? control->is_done() : number == solver.n_load_steps();
      }

      /// Returns false where the mesh is to change first.
      bool take_load_step(const unsigned int number)
      {
        Step<dim> step;
        step.number                             = number;
        recorders->summary()["solver"]["steps"] = number;
        step.search                             = control ? follow(step) : search(step);
        if (step.search.wants_mesh)
          {
            this->adaptation.keep(done, time());
            return false;
          }
        step.time              = time();
        step.is_last           = is_done_after(number);
        problem.state.unknowns = path->displacement;
        problem.store_displacement();
        measure(step);
        recorders->observe(step);
        recorders->record(step);
        if (!step.search.converged)
          throw ComputationError(describe_failed_step(solver, number, time(), step.search, path->n_broken()));
        if (step.is_last)
          recorders->conclude(step);
        recorders->write_fields(step);
        return true;
      }

      EquilibriumStep search(Step<dim> &step)
      {
        const Timings::Scope  scope(problem.run.timings, "solve");
        const EquilibriumStep result = steps->next(
          step.number,
          step.halvings,
          [&](const std::string &what, const double t, const unsigned int iteration, const double r) {
            show(what, t / steps->end_of(solver.n_load_steps()), iteration, r);
          });
        progress->clear();
        return result;
      }

      /// Goes on by what is controlled.
      EquilibriumStep follow(Step<dim> &step)
      {
        const Timings::Scope  scope(problem.run.timings, "solve");
        std::string           what;
        const EquilibriumStep result = control->next(
          step.halvings,
          [&](const std::string &attempt) {
            what = "load step " + std::to_string(step.number) +
                   " from t = " + short_number(controlled->time()) + ", " + attempt + ", " +
                   std::to_string(path->n_broken()) + " broken bonds";
          },
          [&](const unsigned int iteration, const double r) {
            show(what, control->share_done(), iteration, r);
          });
        progress->clear();
        return result;
      }

      /// Shows an iteration: on a terminal by a bar, else, of Newton's method, by a line.
      void
      show(const std::string &what, const double share, const unsigned int iteration, const double residual)
      {
        const std::string text =
          what + ": iteration " + std::to_string(iteration) + ", residual " + short_number(residual);
        if (problem.run.is_watched)
          progress->update(share, text);
        else if (solver.is_quasi_static())
          problem.run.screen << text << std::endl;
      }

      void apply_loads(const double time)
      {
        problem.apply_loads(time);
        problem.free_motions.project(problem.state.external_force);
      }

      /// Energies and supports of the equilibrium.
      void measure(Step<dim> &step)
      {
        step.energy = path->energy();
        step.energy.external += steps ? steps->work() : 0.;
        step.energy_error = this->energy_error(step.energy, step.energy.strain);
        step.n_broken     = path->n_broken();
        step.newly_broken = step.search.broken;
        step.n_floating   = path->n_floating();
        step.reactions    = problem.loading.supports->reactions(path->reaction(), path->face_reaction());
      }

      void resume()
      {
        done              = resumed->template get<unsigned int>("step");
        const double time = resumed->template get<double>("time");
        if (steps)
          steps->go_on_from(time);
        {
          const Timings::Scope scope(problem.run.timings, "setup");
          this->resume_checkpoint();
          apply_loads(time);
          path->resume(problem.state.external_force, time);
        }
        if (this->mesh_has_changed)
          come_to_rest(time);
      }

      /// Finds the equilibrium of the state of the mesh before.
      void come_to_rest(const double time)
      {
        const Timings::Scope  scope(problem.run.timings, "solve");
        const double          before = path->energy().switched;
        const EquilibriumStep search =
          path->come_to_rest(problem.state.external_force, time, [&](const unsigned int k, const double r) {
            show("load step " + std::to_string(done) + ", on the changed mesh", 0., k, r);
          });
        progress->clear();
        if (!search.converged)
          throw ComputationError(describe_failed_step(solver, done, time, search, path->n_broken()));
        this->adaptation.note_switched(path->energy().switched - before);
        problem.state.unknowns = path->displacement;
        problem.store_displacement();
      }

      const SolverParameters               &solver;
      std::unique_ptr<TangentSystem<dim>>   tangent;
      std::unique_ptr<EquilibriumPath<dim>> path;
      /// Where the loads are an unknown: the path, and its steps.
      ControlledNewton<dim>            *controlled = nullptr;
      std::unique_ptr<LoadControl<dim>> control;
      /// Else its load steps.
      std::unique_ptr<LoadSteps<dim>> steps;
      std::unique_ptr<ProgressBar>    progress;
      nlohmann::ordered_json          solver_report;
      unsigned int                    done = 0; // load steps
    };
  } // namespace

  template <int dim>
  std::unique_ptr<Driver<dim>> create_equilibrium_driver(Problem<dim> &problem)
  {
    return std::make_unique<EquilibriumDriver<dim>>(problem);
  }

  PERIDEAL_INSTANTIATE(create_equilibrium_driver)
} // namespace perideal
