// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/input_errors.h>
#include <perideal/base/instantiate.h>
#include <perideal/drivers/load_control.h>
#include <perideal/output/progress.h>
#include <perideal/output/summary.h>
#include <perideal/problem/make_gauges.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace perideal
{
  namespace
  {
    /// Iterations of a step that is found easily, after which the next one is longer.
    constexpr unsigned int few_iterations = 14;
    constexpr double       growth         = 1.5;
    /// Iterations in which the residual has to fall by half where a gauge is controlled, in the first try of
    /// a step; twice as many in each shorter one. Where the tangent does not lead on, iterations mostly
    /// creep, and half the step takes few: the notched beam of .7 mm took 18,300 linear iterations without a
    /// limit, and 12,700 so. Where dissipated energy is controlled, residuals rise before they fall.
    constexpr unsigned int first_patience = 8;
    /// Share of the largest step from which on dissipated energy is controlled.
    constexpr double noticed = 0.02;
    /// Share of the largest step that may be missing at the end of one.
    constexpr double nearly_there = 0.03;
    /// Shortest load step over the largest.
    constexpr double shortest = 0.02;
    /// Strain energy over the largest at which a body bears nothing any more.
    constexpr double nothing_left = 1e-3;
  } // namespace

  template <int dim>
  typename ControlledNewton<dim>::Control LoadControl<dim>::control_of(Problem<dim> &problem)
  {
    const SolverParameters                 &solver = problem.parameters.solver;
    typename ControlledNewton<dim>::Control control;
    control.loads_at = [&problem](const double time, NodalVector &force) {
      problem.apply_loads(time);
      problem.free_motions.project(problem.state.external_force);
      force = problem.state.external_force;
    };
    control.small_time = 1e-3 / solver.load_steps;
    control.large_time = 1. / solver.load_steps;
    if (solver.control != LoadControlName::gauge)
      return control;
    const auto gauges = std::make_shared<const Gauges<dim>>(make_gauges(problem));
    const auto found =
      std::find_if(gauges->list().begin(), gauges->list().end(), [&](const Gauge<dim> &gauge) {
        return solver.control_gauge.empty() || gauge.name == solver.control_gauge;
      });
    const std::size_t number = found - gauges->list().begin();
    AssertIndexRange(number, gauges->list().size());
    control.gauge = [gauges, number](const NodalVector &displacement) {
      return gauges->read(displacement)[number].elongation;
    };
    control.large_time = 1.;
    return control;
  }

  template <int dim>
  LoadControl<dim>::LoadControl(Problem<dim> &problem, ControlledNewton<dim> &path, const double cell)
    : solver(problem.parameters.solver)
    , problem(problem)
    , path(path)
    , largest_time_step(1. / solver.load_steps)
    , largest_amount(solver.control == LoadControlName::gauge ? solver.control_end / solver.load_steps :
                     solver.control_step > 0                  ? solver.control_step :
                                                                default_amount(cell))
    , time_step(largest_time_step)
    , amount(largest_amount)
    , by_loads(solver.control == LoadControlName::dissipated_energy)
  {
    if (by_loads)
      path.limit_dissipation(growth * largest_amount);
  }

  template <int dim>
  double LoadControl<dim>::default_amount(const double cell) const
  {
    const Body<dim> &body   = problem.body;
    double           volume = std::accumulate(body.nodes->volume.begin(), body.nodes->volume.end(), 0.);
    volume                  = dealii::Utilities::MPI::sum(volume, problem.run.communicator);
    double energy           = 0;
    for (const auto id : body.mesh->material_ids)
      energy = std::max(energy, body.properties_of(id).mean_fracture_energy());
    if (dim == 2)
      return energy * std::sqrt(cell / body.mesh->thickness) * body.mesh->thickness;
    return energy * std::cbrt(cell) * std::cbrt(volume);
  }

  template <int dim>
  EquilibriumStep LoadControl<dim>::next(unsigned int                                  &n_failed,
                                         const Announce                                &announce,
                                         const typename EquilibriumPath<dim>::Progress &progress)
  {
    EquilibriumStep result;
    for (unsigned int patience = first_patience;; patience *= 2)
      {
        EquilibriumStep now = attempt(patience, announce, progress);
        now.add_before(result);
        result = now;
        if (result.converged || !shorten())
          break;
        ++n_failed;
        path.go_back();
      }
    return result;
  }

  template <int dim>
  EquilibriumStep LoadControl<dim>::attempt(const unsigned int                             patience,
                                            const Announce                                &announce,
                                            const typename EquilibriumPath<dim>::Progress &progress)
  {
    EquilibriumStep result;
    const bool      by_gauge = solver.control == LoadControlName::gauge;
    if (by_loads || (jumps && !by_gauge))
      {
        const double target = std::min(1., path.time() + time_step);
        announce((jumps ? "by a jump to t = " : "to t = ") + short_number(target));
        result = jumps ? path.jump(target, progress) : path.load(target, progress);
      }
    else
      {
        double left = solver.control_end > 0 ? solver.control_end - reached : amount, wanted = amount;
        if (by_gauge)
          left = largest_amount * (std::floor(reached / largest_amount + nearly_there) + 1.) - reached;
        else
          wanted = std::min(amount, path.energy().strain);
        const double target = wanted > (1. - nearly_there) * left ? left : wanted;
        announce((jumps    ? "by a jump, gauge by " :
                  by_gauge ? "gauge by " :
                             "dissipated energy by ") +
                 short_number(target));
        typename ControlledNewton<dim>::Patience of_attempt;
        if (by_gauge)
          of_attempt = {jumps ? first_patience : patience, jumps};
        result = path.advance(target, progress, of_attempt);
        // What was the rest of a step is halved itself.
        if (!result.converged)
          amount = std::min(amount, target);
      }
    if (result.converged)
      lengthen(result.iterations);
    return result;
  }

  template <int dim>
  void LoadControl<dim>::lengthen(const unsigned int iterations)
  {
    reached += path.amount();
    tried_loads    = false;
    largest_energy = std::max(largest_energy, path.energy().strain);
    if (jumps)
      {
        jumps = false;
        if (solver.control == LoadControlName::gauge)
          return;
        by_loads = path.amount() < noticed * largest_amount;
        amount   = largest_amount;
        return;
      }
    if (by_loads)
      {
        by_loads = path.amount() < noticed * largest_amount;
        if (iterations <= few_iterations)
          time_step = std::min(largest_time_step, 2. * time_step);
        return;
      }
    if (iterations <= few_iterations)
      amount = std::min(largest_amount, growth * amount);
    if (solver.control == LoadControlName::dissipated_energy &&
        path.time_change() >= (1. - 1e-3) * largest_time_step)
      {
        by_loads  = true;
        time_step = largest_time_step;
      }
  }

  template <int dim>
  bool LoadControl<dim>::shorten()
  {
    if (by_loads)
      {
        time_step *= 0.5;
        if (time_step > shortest * largest_time_step)
          return true;
        by_loads = false;
        return true;
      }
    const double least = std::ldexp(largest_amount, -static_cast<int>(solver.step_halvings));
    if (jumps)
      return false;
    if (solver.control == LoadControlName::dissipated_energy && !tried_loads && amount > path.energy().strain)
      {
        by_loads = tried_loads = true;
        time_step              = largest_time_step;
        return true;
      }
    if (0.5 * amount >= least)
      {
        amount *= 0.5;
        return true;
      }
    jumps     = true;
    time_step = largest_time_step;
    return true;
  }

  template <int dim>
  bool LoadControl<dim>::is_done() const
  {
    const double end = solver.control_end;
    if (end > 0 && reached >= end - nearly_there * largest_amount)
      return true;
    if (solver.control == LoadControlName::gauge)
      return false;
    return path.time() >= 1. || path.energy().strain < nothing_left * largest_energy;
  }

  template <int dim>
  void LoadControl<dim>::register_state(LastingState &state)
  {
    state.add_value("load step by loads", by_loads);
    state.add_value("load step", time_step);
    state.add_value("load step of what is controlled", amount);
    state.add_value("controlled until now", reached);
    state.add_value("largest strain energy", largest_energy);
  }

  PERIDEAL_INSTANTIATE_CLASS(LoadControl)
} // namespace perideal
