// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/fem/algebraic_multigrid.h>
#include <perideal/fem/displacement_constraints.h>
#include <perideal/fem/hyperelastic_fem.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/trilinos_solver.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

// HyperelasticFem: Newton's method.

namespace perideal
{
  template <int dim>
  NodalVector HyperelasticFem<dim>::residual() const
  {
    NodalVector result(fields.balance);
    for (const auto index : space.unknowns.locally_owned_dofs())
      if (held.is_constrained(index))
        result(index) = 0.;
    return result;
  }

  template <int dim>
  typename HyperelasticFem<dim>::Norms HyperelasticFem<dim>::measure()
  {
    const NodalVector free  = residual();
    NodalVector       bound = fields.balance;
    bound -= free;
    return {free.l2_norm(), std::max({bound.l2_norm(), fields.external_force.l2_norm(), path.largest_load})};
  }

  template <int dim>
  void HyperelasticFem<dim>::assemble_tangent(const Constraints &increments, NodalVector &right_hand_side)
  {
    const unsigned int         n = space.element.n_dofs_per_cell();
    FiniteStrainIntegrals<dim> integrals(space.geometry, space.element, thickness);
    dealii::FullMatrix<double> matrix(n, n);
    dealii::Vector<double>     nothing(n);
    stiffness       = 0.;
    right_hand_side = 0.;
    for_each_cell([&](const Cell &cell, const auto &law, const auto &indices, const auto &values) {
      integrals.reinit(cell, values);
      integrals.tangent(law, matrix);
      increments.distribute_local_to_global(matrix, nothing, indices, stiffness, right_hand_side);
    });
    stiffness.compress(dealii::VectorOperation::add);
    right_hand_side.compress(dealii::VectorOperation::add);

    // A displacement is rounded by eps |u|, and every force by what the stiffness makes of that.
    double squares = 0;
    for (const auto index : space.unknowns.locally_owned_dofs())
      squares += std::pow(stiffness.diag_element(index), 2);
    squares = dealii::Utilities::MPI::sum(squares, space.unknowns.get_communicator());
    path.rounding =
      std::numeric_limits<double>::epsilon() * fields.displacement.linfty_norm() * std::sqrt(squares);
  }

  template <int dim>
  void
  HyperelasticFem<dim>::solve_linear(const NodalVector &right_hand_side, const double tolerance, Step &step)
  {
    const unsigned int    largest_number_of_iterations = 300;
    dealii::SolverControl control(largest_number_of_iterations, tolerance * right_hand_side.l2_norm());
    fields.correction = 0.;
    try
      {
        const AlgebraicMultigrid<dim> multigrid(space.geometry, space.unknowns, held, stiffness, true);
        dealii::SolverCG<NodalVector> cg(control);
        cg.solve(stiffness, fields.correction, right_hand_side, multigrid);
        step.linear_iterations += control.last_step();
      }
    catch (const dealii::SolverControl::NoConvergence &)
      {
        // The tangent of a body near a limit of stability is not positive definite.
        dealii::TrilinosWrappers::SolverDirect direct(control);
        direct.solve(stiffness, fields.correction, right_hand_side);
        ++step.linear_iterations;
      }
  }

  template <int dim>
  bool HyperelasticFem<dim>::search(const double norm)
  {
    const unsigned int max_trials = 20;
    // Share of the slope at the start by which a step may go too far.
    const double      overshoot = 0.5;
    const NodalVector start     = fields.displacement;
    const double      slope     = fields.correction * fields.balance;
    double            share     = 1.;
    for (unsigned int trial = 0; trial < max_trials; ++trial)
      {
        fields.displacement = start;
        fields.displacement.add(share, fields.correction);
        fields.displacement.update_ghost_values();
        compute_balance();
        const double now = residual().l2_norm(), slope_now = fields.correction * residual();
        const bool   is_finite = std::isfinite(now);
        if (is_finite && (now <= (1 - 1e-4 * share) * norm || now <= path.rounding ||
                          (slope > 0 && slope_now >= -overshoot * slope)))
          return true;
        // Towards where the slope vanishes.
        share *= is_finite && slope > 0 ? std::max(slope / (slope - slope_now), 0.1) : 0.25;
      }
    fields.displacement = start;
    fields.displacement.update_ghost_values();
    compute_balance();
    return false;
  }

  template <int dim>
  std::string HyperelasticFem<dim>::iterate(const bool moving, const Norms &norms, Step &step)
  {
    const Constraints constraints = increments(moving);
    NodalVector       right_hand_side(fields.balance);
    assemble_tangent(constraints, right_hand_side);
    right_hand_side += residual();

    // The residual goes with the square of what the linear solve leaves.
    const double norm     = right_hand_side.l2_norm();
    const double relative = norms.reference > 0 ? norm / norms.reference : 1.;
    const double tolerance =
      std::max({std::min(1e-3, 0.1 * relative), 0.1 * controls.tolerance / relative, 1e-12});
    solve_linear(right_hand_side, std::min(tolerance, 0.5), step);
    constraints.distribute(fields.correction);
    if (!moving)
      return search(norm) ? "" : "no part of a step lowers the residual";
    fields.displacement += fields.correction;
    fields.displacement.update_ghost_values();
    compute_balance();
    return std::isfinite(fields.balance.l2_norm()) ? "" : "the prescribed displacements fold the body";
  }

  template <int dim>
  std::string HyperelasticFem<dim>::find_equilibrium(const double time, Step &step)
  {
    prescribe(time);
    make_external_force(time);
    compute_balance();
    double distance = 0;
    for (const auto index : space.unknowns.locally_owned_dofs())
      if (is_held(held, index))
        distance = std::max(distance, std::abs(held.get_inhomogeneity(index) - fields.displacement(index)));
    bool moving = dealii::Utilities::MPI::max(distance, space.unknowns.get_communicator()) > 0;

    Norms norms = measure();
    for (unsigned int iteration = 0;
         moving || norms.residual > std::max(controls.tolerance * norms.reference, path.rounding);
         ++iteration)
      {
        if (iteration == controls.max_iterations)
          return "it did not converge";
        ++step.iterations;
        const std::string problem = iterate(moving, norms, step);
        if (!problem.empty())
          return problem;
        moving        = false;
        norms         = measure();
        step.residual = norms.reference > 0 ? norms.residual / norms.reference : 0.;
      }
    path.largest_load = norms.reference;
    return "";
  }

  template <int dim>
  typename HyperelasticFem<dim>::Step HyperelasticFem<dim>::solve_step(const double time)
  {
    Step        step;
    NodalVector start = fields.displacement;
    for (double part = time - path.time;;)
      {
        const double      next    = path.time + part > time - 1e-3 * part ? time : path.time + part;
        const std::string problem = find_equilibrium(next, step);
        if (problem.empty())
          {
            path.time = next;
            if (next == time)
              return step;
            start = fields.displacement;
          }
        else if (step.halvings < controls.halvings)
          {
            ++step.halvings;
            part *= 0.5;
            fields.displacement = start;
            fields.displacement.update_ghost_values();
          }
        else
          {
            std::ostringstream text;
            text << "Newton's method of the finite elements stopped at t = " << next << " after "
                 << step.iterations << " iterations at a relative residual of " << step.residual
                 << ", not at " << controls.tolerance << ", since " << problem
                 << "\n  advice: raise Solver/Load steps, with loads that grow with t";
            throw ComputationError(text.str());
          }
      }
  }

  PERIDEAL_INSTANTIATE_CLASS(HyperelasticFem)
} // namespace perideal
