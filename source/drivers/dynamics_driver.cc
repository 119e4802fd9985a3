// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/base/stop_request.h>
#include <perideal/base/text.h>
#include <perideal/drivers/create_drivers.h>
#include <perideal/drivers/heating.h>
#include <perideal/drivers/initial_motion.h>
#include <perideal/drivers/motion_check.h>
#include <perideal/drivers/motion_forces.h>
#include <perideal/drivers/motion_steps.h>
#include <perideal/output/progress.h>
#include <perideal/output/summary.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  namespace
  {
    RunKind motion()
    {
      RunKind kind;
      kind.has_motion = true;
      return kind;
    }

    /// Explicit dynamics: a fixed step, forces without a matrix.
    template <int dim>
    class DynamicsDriver : public Driver<dim>
    {
    public:
      explicit DynamicsDriver(Problem<dim> &problem)
        : Driver<dim>(problem, motion())
        , solver(problem.parameters.solver)
        , initial(problem.parameters.initial)
        , motion_check(problem)
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
        problem.weigh();
        prepare_damping();
        problem.make_force();
        problem.make_failure();
        const Timings::Scope scope(problem.run.timings, "setup");
        steps.make_local(problem);
        forces.make_contact(problem);
        problem.keep_force();
        const Nodes<dim> &nodes = *problem.body.nodes;
        for (LocalIndex i = 0; i < nodes.size(); ++i)
          mass.push_back(problem.body.density_of(nodes.material[i]) * nodes.volume[i]);
      }

      void prepare_damping() override
      {
        forces.make_damping(problem);
        choose_time_step();
      }

      double damping() const override { return solver.damping + forces.largest_rate(); }

      void choose_time_step()
      {
        const Timings::Scope scope(problem.run.timings, "setup");
        // A mesh that adapts keeps the step that its smallest cells will take.
        const bool adapts = problem.parameters.adaptation.is_by_need();
        steps.choose(solver,
                     this->largest_stable_step() * (adapts ? this->adaptation.smallest_share() : 1.),
                     forces.largest_rate() > solver.damping ? "Solver/Relative damping" : "Solver/Damping");
        if (resumed)
          steps.resume(solver, resumed->template get<double>("time step"));
        if (const auto change = this->mesh_has_changed ? steps.divide(solver) : ""; !change.empty())
          problem.run.warn(change);
        steps.choose_levels(problem,
                            [&](const std::vector<bool> &moves) { return this->largest_stable_step(moves); });
        if (steps.shortest() > steps.stable)
          problem.run.warn("the time step " + short_number(steps.shortest()) +
                           " s is larger than the largest stable one, " + short_number(steps.stable) + " s");
      }

      std::string describe() const override
      {
        std::string text;
        if (has_contact(problem.parameters))
          text += "contact     of nodes without a bond, nearer than " +
                  short_number(problem.parameters.contact.distance) + " spacings\n";
        if (steps.size > 0)
          text += "time        " + short_number(solver.end_time) + " s in " + std::to_string(steps.number) +
                  " steps of " + short_number(steps.size) + " s, " +
                  (steps.local ? "of small cells down to " + short_number(steps.shortest()) + " s, " : "") +
                  integrator() + '\n';
        return text;
      }

      nlohmann::ordered_json skipped() const override
      {
        nlohmann::ordered_json result = {{"matrix, preconditioner (explicit)", 1}};
        if (!has_contact(problem.parameters))
          result[can_break(problem.parameters) ? "contact (off)" : "contact (nothing can break)"] = 1;
        if (forces.contact && forces.contact->n_searches() > 0)
          result["nodes left out of the search for contacts"] = forces.contact->n_left_out();
        if (problem.force)
          result["bonds at rest"] = 1. - problem.force->share_computed();
        if (steps.local)
          result["cell steps of larger cells (local steps)"] = 1. - steps.local->share_of_cell_steps();
        return result;
      }

      std::size_t memory_consumption() const override
      {
        return Driver<dim>::memory_consumption() +
               (forces.contact ? forces.contact->memory_consumption() : 0) +
               (steps.local ? steps.local->memory_consumption() : 0);
      }

      std::string closing_lines() const override { return forces.describe(recorders->summary()); }

      std::string last_step() const override
      {
        return "step " + std::to_string(dynamics->step()) + ", t = " + short_number(dynamics->time()) + " s";
      }

      std::string integrator() const { return name_of(solver.integrator); }

      void make_dynamics()
      {
        using Start = typename ExplicitDynamics<dim>::Start;
        dynamics    = std::make_unique<ExplicitDynamics<dim>>(*problem.force,
                                                           problem.loading.supports->held(),
                                                           problem.loading.loads,
                                                           mass,
                                                           solver.damping,
                                                           steps.size,
                                                           solver.integrator == Integrator::velocity_verlet ?
                                                                Start::velocity_verlet :
                                                                Start::symplectic_euler);
        forces.act_on(*dynamics);
        if (steps.local)
          dynamics->take_sub_steps(steps.local);
        initial.set(problem, *dynamics);
      }

      void check_loads() override
      {
        problem.force->initialize(problem.state.external_force);
        problem.loading.check_finite(solver.end_time);
      }

      StepsEnd advance() override
      {
        recorders->summary()["solver"] = {{"name", "explicit dynamics, " + integrator()},
                                          {"time_step", steps.size},
                                          {"stable_time_step", steps.stable}};
        if (steps.local)
          recorders->summary()["solver"]["local_steps"] = steps.figures();
        make_dynamics();
        register_state();
        const bool is_restart = resumed && !this->mesh_has_changed;
        if (resumed)
          {
            this->resume_checkpoint();
            // Which tells the steps of the earlier mesh.
            steps.resume(solver, steps.size / steps.parts);
            dynamics->divide_steps(steps.parts);
          }
        if (is_restart && mesh_is_due())
          return StepsEnd::mesh_changes;
        initial.move_supports(problem, this->mesh_has_changed, *dynamics);
        apply_forces();
        const bool        loads_change = problem.loading.loads.forces_depend_on_time();
        const auto        interval     = problem.parameters.checkpoints.steps;
        auto             &screen       = problem.run.screen;
        const StopRequest stop;
        // Where bonds take the place of cells, loads act on nodes.
        unsigned int version = problem.force->version();
        ProgressBar  progress(screen.get_stream(), problem.run.is_watched, "moving");
        const auto   first = dynamics->step();
        for (std::uint64_t n = first; n <= steps.number; ++n)
          {
            if (n == steps.number && n > first && problem.parameters.checkpoints.at_end)
              save();
            {
              const Timings::Scope scope(problem.run.timings, "solve");
              if ((loads_change || problem.force->version() != version) && n > 0)
                {
                  heating.remember();
                  apply_forces();
                  heating.take_loads();
                }
              version = problem.force->version();
              dynamics->evaluate(problem.state.external_force);
              dynamics->add_work(heating.work());
              if (n == first && this->mesh_has_changed)
                this->adaptation.note_switched(dynamics->switch_mesh(imbalance));
              if (this->adaptation.looks_at(n + 1))
                imbalance = dynamics->energy().imbalance();
            }
            observe(n);
            if (const auto share = static_cast<double>(n) / steps.number; progress.is_due() || n == first)
              progress.update(share,
                              "step " + std::to_string(n) + " of " + std::to_string(steps.number) + ", " +
                                grouped(dynamics->n_broken()) + " broken bonds");
            if (n == steps.number)
              break;
            {
              const Timings::Scope scope(problem.run.timings, "solve");
              dynamics->advance();
            }
            const bool stops = stop.is_there(problem.run.communicator);
            if (stops || (interval > 0 && (n + 1) % interval == 0))
              save();
            if (stops)
              return StepsEnd::stopped;
            if (mesh_is_due())
              return StepsEnd::mesh_changes;
          }
        return StepsEnd::done;
      }

      bool mesh_is_due()
      {
        return dynamics->step() < steps.number &&
               this->adaptation.is_due_in_motion(dynamics->step(), dynamics->time(), dynamics->displacement);
      }

      void apply_forces() { problem.loading.external_force(dynamics->time(), problem.state.external_force); }

      /// Hands the present step to the recorders: rows and frames at their times.
      void observe(const std::uint64_t n)
      {
        // Beside cells there are bonds only where they may break.
        const bool all_broke = !has_fracture_zone(problem.parameters) && dynamics->n_broken_now() > 0 &&
                               dynamics->n_broken() == problem.discretisation.families->n_bonds();
        const std::size_t frames = problem.parameters.frames;
        Step<dim>         step;
        step.number       = n;
        step.time         = dynamics->time();
        step.n_broken     = dynamics->n_broken();
        step.newly_broken = dynamics->n_broken_now();
        step.is_last      = n == steps.number;

        recorders->observe(step);
        recorders->summary()["solver"]["steps"] = n;
        const bool row = n % problem.parameters.history_steps == 0 || step.is_last || all_broke;
        const auto at  = [&](const std::size_t frame) {
          return std::round(double(frame) * steps.number / frames);
        };
        const bool frame = recorders->n_frames() < frames && n >= at(recorders->n_frames() + 1);
        if (row || frame)
          measure(step);
        if (row)
          {
            const Timings::Scope scope(problem.run.timings, "energy");
            step.energy_error = this->energy_error(step.energy, step.energy.kinetic);
            recorders->record(step);
            forces.record(recorders->summary());
          }
        if (all_broke)
          throw ComputationError(
            "every bond is broken at step " + std::to_string(n) + ", t = " + short_number(step.time) +
            " s\n  likely cause: a critical stretch or fracture energy that is too small, or "
            "loads that are too large");
        while (recorders->n_frames() < frames && n >= at(recorders->n_frames() + 1))
          recorders->write_fields(step);
        if (step.is_last)
          recorders->conclude(step);
      }

      /// Energies, supports and momentum; @throws ComputationError where the motion is none.
      void measure(Step<dim> &step)
      {
        const Timings::Scope scope(problem.run.timings, "energy");
        step.energy = dynamics->energy();
        motion_check.look(*dynamics, step.energy, this->largest_energy, steps.stable);
        store();
        step.reactions = problem.loading.supports->reactions(dynamics->reaction(), dynamics->face_reaction());
        step.momentum  = {dynamics->momentum(), dynamics->angular_momentum()};
      }

      void store()
      {
        State<dim>      &state = problem.state;
        const LocalIndex size  = problem.body.nodes->size();
        state.unknowns         = dynamics->displacement;
        state.displacement.resize(size);
        state.velocity.resize(size);
        for (LocalIndex i = 0; i < size; ++i)
          for (int d = 0; d < dim; ++d)
            {
              state.displacement[i][d] = dynamics->displacement.local_element(dim * i + d);
              state.velocity[i][d]     = dynamics->velocity.local_element(dim * i + d);
            }
      }

      void register_state()
      {
        LastingState &state = problem.lasting;
        state.add_value("time step", steps.size);
        state.add_value("energy imbalance", imbalance);
        dynamics->register_state(state);
        if (forces.contact)
          {
            state.add_part("contact", recorders->summary());
            if (problem.parameters.adaptation.is_by_need())
              forces.contact->register_state(state);
          }
      }

      void save()
      {
        this->save_checkpoint(dynamics->step(), dynamics->time());
        // The run that goes on makes its lists anew; this one does so too, for the same order of sums.
        if (forces.contact)
          forces.contact->forget_lists();
      }

      const SolverParameters                &solver;
      const InitialMotion<dim>               initial;
      MotionForces<dim>                      forces;
      std::vector<double>                    mass;
      MotionSteps                            steps;
      std::unique_ptr<ExplicitDynamics<dim>> dynamics;
      MotionCheck<dim>                       motion_check;
      Heating<dim>                           heating;
      /// Of the energies at the last step before a look at the mesh [J].
      double imbalance = 0;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<Driver<dim>> create_dynamics_driver(Problem<dim> &problem)
  {
    return std::make_unique<DynamicsDriver<dim>>(problem);
  }

  PERIDEAL_INSTANTIATE(create_dynamics_driver)
} // namespace perideal
