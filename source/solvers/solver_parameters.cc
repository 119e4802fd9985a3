// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/input_errors.h>
#include <perideal/solvers/solver_parameters.h>

#include <cmath>

namespace perideal
{
  void SolverParameters::declare(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Solver");
    prm.add_parameter(
      "Name",
      name,
      "What is solved: static: equilibrium under the final loads; quasi static: equilibria under Load "
      "steps, geometrically nonlinear, in which bonds break where a fracture energy or critical stretch is "
      "given, by Newton's method; dynamic relaxation: the same by a damped motion; dynamics: motion from "
      "t = 0 to End time, explicit, otherwise as these");
    prm.add_parameter(
      "Tolerance",
      tolerance,
      "Residual over the first residual at which a linear solve ends, or over the norm of loads "
      "or reactions at which an equilibrium of quasi static or dynamic relaxation does, 0 < tolerance <= "
      "0.01 "
      "[-]; the error of displacements may be many times as large",
      Double());
    prm.add_parameter(
      "Maximum iterations",
      max_iterations,
      "Iterations after which a linear solve has failed, or an equilibrium of dynamic relaxation; there they "
      "are counted anew after every break",
      Integer(1));
    prm.add_parameter(
      "Newton iterations",
      newton_iterations,
      "Iterations after which an equilibrium of quasi static has failed, > 0; they are counted "
      "anew after every break, under Control other than loads also where a tenth of the residual is left",
      Integer(1));
    prm.add_parameter(
      "Step halvings",
      step_halvings,
      "Times that a load step of quasi static that fails is halved, or a part of it that fails again; 0: it "
      "fails at once; where bonds soften under Control other than loads, the path jumps instead",
      Integer(0, 30));
    prm.add_parameter(
      "Linear solver",
      linear_solver,
      "automatic: cg where the operator is symmetric, else gmres, as while bonds soften whose model has sums "
      "over families; cg, gmres: deal.II's, matrix-free; trilinos cg, trilinos gmres, direct: Trilinos' on "
      "the assembled matrix, for small problems. Either cg takes the secant of bonds that soften where their "
      "tangent is not symmetric");
    prm.add_parameter(
      "Preconditioner",
      preconditioner,
      "automatic: auxiliary or block jacobi, whichever is estimated to take less work; auxiliary: block "
      "Jacobi plus multigrid on the finite-element matrix of the same body, in few iterations at any "
      "size; block jacobi: inverted diagonal blocks; none. The assembled solvers take block jacobi or none");
    prm.add_parameter(
      "Auxiliary mesh",
      auxiliary_mesh,
      "Where the finite elements of the auxiliary preconditioner live; along precracks they open. same: "
      "on the cells of the mesh; parent: on the cells before the last refinement, fewer by 4 (2-D) or 8 "
      "(3-D) but for those that a precrack divides; automatic: whichever is estimated to take less work");
    prm.add_parameter("Load steps",
                      load_steps,
                      "Number of equilibria at t = 1/n, 2/n, ..., 1; formulas of t make the loads grow",
                      Integer(1));
    prm.add_parameter(
      "Last load step",
      last_load_step,
      "Number of the load step after which quasi static and dynamic relaxation end, at t = number "
      "/ Load steps, earlier or later than 1; 0: Load steps. A run that goes on from a checkpoint "
      "may have another",
      Integer(0));
    prm.add_parameter(
      "Control",
      control,
      "What grows by prescribed amounts in quasi static. loads: their formulas of t; gauge: the elongation "
      "of "
      "Control gauge, by Control end over Load steps; dissipated energy: what softening bonds take, by "
      "Control step, wherever a crack would run away under loads. In the last two t is an unknown, the load "
      "factor, and falls where equilibrium asks for it (snap-back)");
    prm.add_parameter(
      "Control gauge", control_gauge, "Name of the gauge that is controlled; empty: the only one there is");
    prm.add_parameter(
      "Control end",
      control_end,
      "Elongation of the gauge [m], > 0, or dissipated energy [J], at which the run ends; 0: "
      "dissipated energy goes on until t = 1, or until a thousandth of the strain energy is left",
      Double(0));
    prm.add_parameter("Control step",
                      control_step,
                      "Largest dissipated energy of a load step [J]; 0: the fracture energy of one cell "
                      "of the crack in 2-D, of a row of them in 3-D",
                      Double(0));
    prm.add_parameter("End time",
                      end_time,
                      "When dynamics end, > 0 [s]; where the solver is dynamics the scene must give it",
                      Double());
    prm.add_parameter("Time step",
                      time_step,
                      "Step of dynamics >= 0 [s]; 0: the largest stable one times Time step safety",
                      Double());
    prm.add_parameter("Time step safety",
                      time_step_safety,
                      "Part of the largest stable step that is taken, 0 < safety <= 1 [-]",
                      Double());
    prm.add_parameter("Local step ratio",
                      local_step_ratio,
                      "How many times longer than the shortest step the longest is, that of larger cells: a "
                      "power of two, 1 to 64 [-]; 1: all take the same",
                      Integer(1, 64));
    prm.add_parameter(
      "Integrator",
      integrator,
      "velocity verlet: initial velocities are those at t = 0; symplectic euler: those half a "
      "step before; central differences both");
    prm.add_parameter("Damping", damping, "Viscous force over mass and velocity, >= 0 [1/s]", Double());
    prm.add_parameter("Relative damping",
                      relative_damping,
                      "Rate at which the motion of a node against its family dies out, >= 0 [1/s]; rigid "
                      "motions are not damped",
                      Double());
    prm.leave_subsection();
  }

  void SolverParameters::check() const
  {
    InputErrorCollector errors;
    const auto          check_range = [&](const bool fits, const char *parameter, const char *allowed) {
      if (!fits)
        errors.add(InputError("the value is out of range")
                     .parameter(std::string("Solver/") + parameter)
                     .allowed(allowed));
    };
    check_range(
      !is_dynamic() || (end_time > 0 && std::isfinite(end_time)), "End time", "a time > 0 in dynamics");
    check_range(time_step >= 0 && std::isfinite(time_step), "Time step", "a time > 0, or 0: chosen");
    check_range(time_step_safety > 0 && time_step_safety <= 1, "Time step safety", "0 < safety <= 1");
    check_range(
      (local_step_ratio & (local_step_ratio - 1)) == 0, "Local step ratio", "1, 2, 4, 8, 16, 32 or 64");
    check_range(damping >= 0 && std::isfinite(damping), "Damping", "a number >= 0");
    check_range(
      relative_damping >= 0 && std::isfinite(relative_damping), "Relative damping", "a number >= 0");
    // At 0.9 displacements were found 12 times too small.
    if (!(tolerance > 0 && tolerance <= 0.01))
      errors.add(InputError("the tolerance is out of range")
                   .parameter("Solver/Tolerance")
                   .allowed("0 < tolerance <= 0.01"));
    errors.raise();
  }

  bool SolverParameters::assembles() const
  {
    return linear_solver == LinearSolverName::direct || linear_solver == LinearSolverName::trilinos_cg ||
           linear_solver == LinearSolverName::trilinos_gmres;
  }

  bool SolverParameters::takes_cg() const
  {
    return linear_solver == LinearSolverName::cg || linear_solver == LinearSolverName::trilinos_cg;
  }
} // namespace perideal
