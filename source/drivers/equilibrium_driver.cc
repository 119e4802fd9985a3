// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/base/stop_request.h>
#include <perideal/drivers/create_drivers.h>
#include <perideal/drivers/failed_step.h>
#include <perideal/drivers/heating.h>
#include <perideal/drivers/load_control.h>
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
        , heating(problem)
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
        if (!solver.is_quasi_static())
          {
            path = std::make_unique<DynamicRelaxation<dim>>(
              *problem.force, *problem.system, loading.supports->held(), loading.loads, controls);
            return;
          }
        if (!solver.is_controlled())
          {
            path = tangent->create_newton(controls);
            return;
          }
        auto made  = tangent->create_controlled_newton(LoadControl<dim>::control_of(problem), controls);
        controlled = made.get();
        path       = std::move(made);
        control    = std::make_unique<LoadControl<dim>>(problem, *controlled, this->adaptation.finest_cell());
      }

      StepsEnd advance() override
      {
        recorders->summary()["solver"] = solver_report;
        progress                       = std::make_unique<ProgressBar>(
          problem.run.screen.get_stream(), problem.run.is_watched, "load steps");
        make_path();
        path->register_state(problem.lasting);
        if (problem.loading.expansion)
          problem.lasting.add_value("work of heating", work_of_heating);
        if (control)
          control->register_state(problem.lasting);
        heating.begin_cold();
        if (resumed)
          {
            resume();
            if (!this->mesh_has_changed && this->adaptation.is_due(done, time()))
              return StepsEnd::mesh_changes;
          }
        const unsigned int interval = problem.parameters.checkpoints.steps;
        const StopRequest  stop;
        while (!is_done())
          {
            take_load_step(done + 1);
            ++done;
            const bool stops  = stop.is_there(problem.run.communicator);
            const bool is_due = stops || (interval > 0 && done % interval == 0);
            if (is_done() ? problem.parameters.checkpoints.at_end && !control : is_due)
              this->save_checkpoint(done, time());
            if (stops && !is_done())
              return StepsEnd::stopped;
            if (!is_done() && this->adaptation.is_due(done, time()))
              return StepsEnd::mesh_changes;
          }
        return StepsEnd::done;
      }

      double time_of(const std::uint64_t number) const
      {
        return static_cast<double>(number) / solver.load_steps;
      }
      /// At the last equilibrium.
      double time() const { return control ? controlled->time() : time_of(done); }
      bool   is_done() const { return control ? control->is_done() : done == solver.n_load_steps(); }

      void take_load_step(const unsigned int number)
      {
        Step<dim> step;
        step.number                             = number;
        recorders->summary()["solver"]["steps"] = number;
        const double reached                    = control ? follow(step) : search(step);
        problem.state.unknowns                  = path->displacement;
        problem.store_displacement();
        measure(step);
        recorders->observe(step);
        recorders->record(step);
        if (!step.search.converged)
          throw ComputationError(
            describe_failed_step(solver, number, reached, step.search, path->n_broken()));
        if (step.is_last)
          recorders->conclude(step);
        recorders->write_fields(step);
      }

      /// Goes to the end of a load step, after a failure in halves. Returns the time reached or sought last.
      double search(Step<dim> &step)
      {
        const double end  = time_of(step.number);
        double       time = time_of(step.number - 1), part = end - time;
        step.time    = end;
        step.is_last = step.number == solver.n_load_steps();
        while (time < end)
          {
            const double    next = std::min(end, time + part) > end - 1e-3 * part ? end : time + part;
            EquilibriumStep now  = find_equilibrium(step.number, time, next);
            now.add_before(step.search);
            step.search = now;
            if (now.converged)
              time = next;
            else if (step.halvings == solver.step_halvings || !solver.is_quasi_static())
              break;
            else
              {
                ++step.halvings;
                part *= 0.5;
                path->restore();
                heating.go_back(path->displacement);
                problem.run.screen << "load step " << step.number << " from t = " << short_number(time)
                                   << " is halved" << std::endl;
              }
          }
        return std::min(end, time + part);
      }

      /// Goes on by what is controlled. Returns the time reached.
      double follow(Step<dim> &step)
      {
        const Timings::Scope scope(problem.run.timings, "solve");
        std::string          what;
        step.search = control->next(
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
        step.time    = controlled->time();
        step.is_last = control->is_done();
        return step.time;
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

      /// Goes on from the equilibrium of one time to that of another; as often as bonds take the place of
      /// cells on the way, for loads act on nodes there.
      EquilibriumStep find_equilibrium(const std::uint64_t number, const double from, const double time)
      {
        const Timings::Scope scope(problem.run.timings, "solve");
        EquilibriumStep      result;
        unsigned int         version = 0;
        do
          {
            version             = problem.force->version();
            EquilibriumStep now = approach_equilibrium(number, from, time);
            now.add_before(result);
            result = now;
          }
        while (result.converged && problem.force->version() != version);
        return result;
      }

      EquilibriumStep approach_equilibrium(const std::uint64_t number, const double from, const double time)
      {
        const std::string what = "load step " + std::to_string(number) + " of " +
                                 std::to_string(solver.n_load_steps()) + ", " +
                                 std::to_string(path->n_broken()) + " broken bonds";
        const double end = time_of(solver.n_load_steps());
        heating.remember();
        apply_loads(time);
        heating.take_loads();
        EquilibriumStep result =
          path->step(problem.state.external_force, time, [&](const unsigned int iteration, const double r) {
            show(what, (from + (time - from) * share_of_iteration(r, solver.tolerance)) / end, iteration, r);
          });
        progress->clear();
        if (result.converged)
          work_of_heating += heating.work();
        return result;
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
        step.energy.external += work_of_heating;
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
      std::unique_ptr<ProgressBar>      progress;
      nlohmann::ordered_json            solver_report;
      unsigned int                      done = 0; // load steps
      Heating<dim>                      heating;
      double                            work_of_heating = 0; // [J]
    };
  } // namespace

  template <int dim>
  std::unique_ptr<Driver<dim>> create_equilibrium_driver(Problem<dim> &problem)
  {
    return std::make_unique<EquilibriumDriver<dim>>(problem);
  }

  PERIDEAL_INSTANTIATE(create_equilibrium_driver)
} // namespace perideal
