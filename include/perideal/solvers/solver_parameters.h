// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_solvers_solver_parameters_h
#define perideal_solvers_solver_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace perideal
{
  /// Section "Solver".
  struct SolverParameters
  {
    std::string  name           = "static";
    double       tolerance      = 1e-8;
    unsigned int max_iterations = 5000;
    std::string  linear_solver  = "automatic";
    std::string  preconditioner = "automatic";
    std::string  auxiliary_mesh = "automatic";
    unsigned int load_steps     = 1;
    /// Newton iterations of an equilibrium.
    unsigned int newton_iterations = 25;
    /// Times that a load step may be halved before it has failed.
    unsigned int step_halvings = 5;

    /// Of dynamics [s]; step 0: chosen.
    double end_time = 0, time_step = 0;
    /// Part of the largest stable step [-].
    double      time_step_safety = 0.8;
    std::string integrator       = "velocity verlet";
    /// Viscous force over mass and velocity [1/s].
    double damping = 0;
    /// Rate at which motion against the family dies out [1/s].
    double relative_damping = 0;

    bool is_dynamic() const { return name == "dynamics"; }
    bool is_relaxation() const { return name == "dynamic relaxation"; }
    bool is_quasi_static() const { return name == "quasi static"; }
    /// Equilibria of the nonlinear force.
    bool is_nonlinear_static() const { return is_relaxation() || is_quasi_static(); }

    void declare(dealii::ParameterHandler &prm);
    /// @throws InputError on choices that do not go together.
    void check() const;

    /// True when the system is assembled.
    bool assembles() const;
  };
} // namespace perideal

#endif
