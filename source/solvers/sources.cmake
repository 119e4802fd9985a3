# SPDX-License-Identifier: LGPL-2.1-or-later

perideal_room(solvers
  SOURCES
    controlled_newton.cc
    controlled_prediction.cc
    dynamic_relaxation.cc
    equilibrium_balance.cc
    equilibrium_path.cc
    explicit_dynamics.cc
    linear_solver.cc
    newton.cc
    newton_softening.cc
    preconditioner_choice.cc
    solver_parameters.cc
    sub_steps.cc
    tangent_solver.cc
)
