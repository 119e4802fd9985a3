# SPDX-License-Identifier: LGPL-2.1-or-later

perideal_room(fem
  SOURCES
    algebraic_multigrid.cc
    cell_integrals.cc
    displacement_constraints.cc
    displacement_space.cc
    split_vertices.cc
    elastic_fem.cc
    elastic_fem_results.cc
    external_forces.cc
    finite_strain_integrals.cc
    hyperelastic_fem.cc
    hyperelastic_fem_newton.cc
    point_evaluation.cc
    polynomial_multigrid.cc
    support_points.cc
)
