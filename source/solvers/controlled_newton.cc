// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/finite.h>
#include <perideal/base/instantiate.h>
#include <perideal/solvers/controlled_newton.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace perideal
{
  namespace
  {
    /// How far a step may be from the amount asked for: of a gauge, and of dissipated energy, which is a
    /// length of steps more than a result.
    constexpr double of_gauge = 1e-3, of_dissipation = 0.02;
    /// Share of that which an iteration may be off: one at constant loads does not lead to an equilibrium
    /// from which a crack would run on.
    constexpr double of_iteration = 2e-3;
    /// What solves with the secant and the tangent may leave of the residual: the secant itself leaves about
    /// .6 of it, the tangent little.
    constexpr double of_secant = 0.2, of_tangent = 0.01;
    /// The least that is asked of a solve with the secant for the loads, over these.
    constexpr double least_left = 1e-6;
    /// Iterations by the secant at first where dissipated energy is controlled, after which the tangent
    /// mostly leads on, and where it does not.
    constexpr unsigned int first_secants = 8, more_secants = 5;
    /// Trials of an iteration by the tangent, each half as long as the one before: where a gauge is
    /// controlled, and dissipated energy, of which secants know more.
    constexpr unsigned int n_by_gauge = 4, n_by_dissipation = 2;
    /// What the residual after such an iteration may be over that before.
    constexpr double largest_left = 0.9;
    /// How often the iterations of an attempt that jumps are counted anew.
    constexpr unsigned int most_in_jump = 20;
    constexpr unsigned int endless      = std::numeric_limits<unsigned int>::max();
    /// Readings of what is controlled that find a change of t.
    constexpr unsigned int most_readings = 5;
  } // namespace

  template <int dim>
  void ControlledNewton<dim>::initialize()
  {
    for (NodalVector *vector :
         {&external, &later, &of_loads, &by_unit.secant, &by_unit.tangent, &first_residual})
      vector->reinit(this->residual);
    this->bonds.initialize(start.displacement);
    fronts.begin(this->bonds.damage());
  }

  template <int dim>
  void ControlledNewton<dim>::register_state(LastingState &state)
  {
    NewtonSolver<dim>::register_state(state);
    state.add_node_array("displacement by unit loads", "m", dim, by_unit.secant);
    state.add_node_array("displacement by unit loads, by the tangent", "m", dim, by_unit.tangent);
    state.add_value("controlled amount", previous.amount);
    state.add_value("change of what is controlled by unit load factor", previous.by_time);
    if (!control.gauge)
      fronts.register_state(state);
  }

  template <int dim>
  void ControlledNewton<dim>::resume(const NodalVector &loads, const double time)
  {
    NewtonSolver<dim>::resume(loads, time);
    now              = time;
    previous.reading = control.gauge ? control.gauge(displacement) : 0.;
    fronts.begin(this->bonds.damage());
  }

  template <int dim>
  double ControlledNewton<dim>::may_miss(const double amount) const
  {
    return (control.gauge ? of_gauge : of_dissipation) * std::abs(amount);
  }

  template <int dim>
  double ControlledNewton<dim>::changed() const
  {
    return control.gauge ? control.gauge(displacement) - previous.reading : this->dissipated_since(external);
  }

  template <int dim>
  void ControlledNewton<dim>::place(const double share, const double time_change)
  {
    displacement = start.displacement;
    displacement.add(share, this->correction, time_change, *by_unit.used);
    now = start.time + time_change;
    held.set_boundary_values(this->loads, now, displacement);
    if (this->face_values != nullptr)
      this->face_values->set_time(this->loads, now);
    control.loads_at(now, external);
    this->compute_forces();
  }

  template <int dim>
  EquilibriumStep
  ControlledNewton<dim>::advance(const double amount, const Progress &progress, const Patience &patience)
  {
    this->start_in_place();
    this->increment              = 0.;
    this->breaks.in_step         = false;
    const bool           is_near = predict(amount);
    EquilibriumStep      result;
    std::optional<Start> with_cells;
    const bool           softens   = this->bonds.softening_bonds().softens();
    unsigned int         n_secants = softens && !control.gauge && !is_near ? first_secants : 0;
    // Since the residual fell to a tenth, and to a half.
    unsigned int since_tenth = 0, since_half = 0;
    double       tenth_of = std::numeric_limits<double>::max(), half_of = tenth_of;
    const auto   begin_anew = [&] {
      since_tenth = since_half = 0;
      half_of                  = std::numeric_limits<double>::max();
    };
    while (true)
      {
        const auto   norms     = this->measure(external);
        const double reference = std::sqrt(std::max({norms.reaction, norms.load, last.largest_load}));
        const double residual = std::sqrt(norms.residual), change = changed();
        result.residuals.push_back(reference > 0 ? residual / reference : (residual > 0 ? 1. : 0.));
        progress(result.iterations, result.residuals.back());
        if (!is_finite(reference + residual + change))
          return result;
        if (residual <= std::max(this->controls.tolerance * reference, this->rounding.force) &&
            std::abs(change - amount) <= may_miss(amount))
          {
            if (this->controls.bonds_break && this->extend_bonds())
              {
                if (!with_cells)
                  with_cells = Start{displacement, now};
                begin_anew();
                continue;
              }
            const GlobalIndex n_broken = this->controls.bonds_break ? this->judge(external) : 0;
            result.broken += n_broken;
            // The work along a long way is not exact: so much may seem to be dissipated where nothing is.
            if (!control.gauge && !this->breaks.in_segment)
              {
                result.problem = "no bond softens any more";
                return result;
              }
            // Bonds that soften have carried by then what they carry once they are judged.
            if (softens || n_broken == 0)
              {
                last.note(norms);
                this->balance(external, this->force, this->bonds.strain_energy());
                keep_step(change, with_cells);
                result.converged = true;
                return result;
              }
            begin_anew();
            continue;
          }
        if (residual < 0.1 * tenth_of)
          {
            tenth_of    = residual;
            since_tenth = 0;
          }
        if (residual < 0.5 * half_of)
          {
            half_of    = residual;
            since_half = 0;
          }
        if (since_tenth++ == this->controls.max_iterations || since_half++ == patience.iterations)
          {
            if (!softens || !patience.may_jump ||
                result.iterations > most_in_jump * this->controls.max_iterations)
              return result;
            // There is no equilibrium nearby: a part of the crack jumps.
            if (this->extend_bonds() && !with_cells)
              with_cells = Start{displacement, now};
            result.broken += this->judge(external);
            this->compute_residual(external);
            n_secants = endless;
            begin_anew();
            tenth_of = half_of;
          }
        ++result.iterations;
        if (n_secants > 0)
          --n_secants;
        else if (correct(amount, Slope::tangent, result))
          continue;
        else if (softens)
          {
            n_secants = more_secants - 1;
            result.problem.clear();
          }
        if (!softens || !correct(amount, Slope::secant, result))
          return result;
      }
  }

  template <int dim>
  EquilibriumStep ControlledNewton<dim>::load(const double time, const Progress &progress)
  {
    this->may_jump               = false;
    this->breaks.most_dissipated = most_by_loads;
    EquilibriumStep result       = jump(time, progress);
    this->may_jump               = true;
    this->breaks.most_dissipated = std::numeric_limits<double>::infinity();
    return result;
  }

  template <int dim>
  EquilibriumStep ControlledNewton<dim>::jump(const double time, const Progress &progress)
  {
    const double before = this->energy().dissipated;
    control.loads_at(time, external);
    EquilibriumStep result = this->step(external, time, progress);
    if (result.converged)
      {
        now = time;
        keep_amount(control.gauge ? changed() : this->energy().dissipated - before);
      }
    return result;
  }

  template <int dim>
  bool ControlledNewton<dim>::correct(const double amount, const Slope slope, EquilibriumStep &result)
  {
    const bool secant = slope == Slope::secant, searches = !secant && this->bonds.softening_bonds().softens();
    this->linearise(slope);
    start = {displacement, now};
    prepare_loads();
    const double norm   = this->residual.l2_norm();
    by_unit.used        = secant ? &by_unit.secant : &by_unit.tangent;
    const double of_all = of_loads.l2_norm();
    // The error of y counts by the change of t, which is about that of the iteration before.
    const double of_time =
      secant ? std::max(std::abs(now), control.small_time) : std::abs(previous.iteration);
    const double most = (secant ? of_secant : of_tangent) * (of_time > 0 ? norm / of_time : of_all);
    if (!solve(*by_unit.used,
               of_loads,
               std::max(secant ? most : std::min(most, of_tangent * of_all), least_left * of_all),
               result))
      return false;
    // As the secant has it, loads in proportion to t displace by t times what they do at t = 1.
    this->correction = 0.;
    if (secant)
      {
        this->correction.add(now, *by_unit.used);
        for (std::size_t k = 0; k < held.mask().size(); ++k)
          if (!held.mask()[k])
            this->correction.local_element(k) -= displacement.local_element(k);
      }
    if (!solve(this->correction, this->residual, (secant ? 2. * of_secant : of_tangent) * norm, result))
      return false;
    const double time_change = find_time_change(amount);
    if (std::isfinite(time_change))
      previous.iteration = time_change;
    const unsigned int n_trials = control.gauge ? n_by_gauge : n_by_dissipation;
    double             share    = 1.;
    for (unsigned int trial = 0; std::isfinite(time_change) && trial < n_trials; ++trial, share *= 0.5)
      {
        if (trial > 0)
          place(share, share * time_change);
        this->compute_residual(external);
        if (!searches || this->residual.l2_norm() <= largest_left * norm)
          return true;
      }
    if (!std::isfinite(time_change))
      result.problem = "the controlled quantity does not change with the loads";
    place(0., 0.);
    this->compute_residual(external);
    return false;
  }

  template <int dim>
  bool ControlledNewton<dim>::solve(NodalVector       &solution,
                                    const NodalVector &source,
                                    const double       residual,
                                    EquilibriumStep   &result)
  {
    this->system.vmult(first_residual, solution);
    first_residual.sadd(-1., source);
    const double first = first_residual.l2_norm();
    if (first <= residual)
      return true;
    const LinearSolve solving = this->linear.solve(solution, source, residual / first);
    result.linear_iterations += solving.iterations;
    if (!solving.converged)
      result.problem = "the linear solver (" + this->linear.name() + ") did not converge";
    return solving.converged;
  }

  template <int dim>
  void ControlledNewton<dim>::prepare_loads()
  {
    const double step    = control.small_time;
    this->held_increment = displacement;
    held.set_boundary_values(this->loads, now + step, this->held_increment);
    this->held_increment -= displacement;
    if (this->face_values != nullptr)
      this->face_values->prepare(this->loads, now + step);
    this->force_of_supports(of_loads);
    if (this->face_values != nullptr)
      this->face_values->prepare(this->loads, now);
    control.loads_at(now + step, later);
    later -= external;
    const auto &is_held = held.mask();
    for (std::size_t k = 0; k < is_held.size(); ++k)
      if (!is_held[k])
        of_loads.local_element(k) += later.local_element(k);
    of_loads *= 1. / step;
    this->null_space.project(of_loads);
  }

  template <int dim>
  double ControlledNewton<dim>::find_time_change(const double amount)
  {
    const auto miss = [&](const double time_change) {
      place(1., time_change);
      return changed() - amount;
    };
    const double enough      = of_iteration * may_miss(amount);
    double       time_change = 0., missed = miss(time_change);
    // By secants, where bonds soften at other loads than those where they were linearised.
    double next = previous.by_time == 0. ? control.small_time : -missed / previous.by_time;
    for (unsigned int k = 0; k <= most_readings && std::abs(missed) > enough; ++k)
      {
        next = std::clamp(next, -control.large_time, control.large_time);
        if (!std::isfinite(next) || next == time_change)
          {
            previous.by_time = 0.;
            return next;
          }
        const double now = miss(next);
        previous.by_time = (now - missed) / (next - time_change);
        time_change      = next;
        missed           = now;
        next             = time_change - missed / previous.by_time;
      }
    return time_change;
  }

  PERIDEAL_INSTANTIATE_CLASS(ControlledNewton)
} // namespace perideal
