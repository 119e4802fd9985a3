# SPDX-License-Identifier: LGPL-2.1-or-later

perideal_room(operators/linear
  SOURCES
    face_springs.cc
    nodal_springs.cc
    polynomial_response.cc
    surface_cure.cc
    taylor_extension.cc
    zoned_tangent.cc
  LOOPS
    bond_operator.cc
    consistent_operator.cc
    consistent_operator_loops.cc
    consistent_operator_matrix.cc
    correspondence_tangent.cc
    deformed_cells.cc
    family_operator.cc
    family_operator_loops.cc
    family_operator_matrix.cc
    gauss_operator.cc
    tangent_operator.cc
    tensor_operator.cc
)
