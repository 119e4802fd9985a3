# SPDX-License-Identifier: LGPL-2.1-or-later

perideal_room(operators/system
  SOURCES
    assembled_matrix.cc
    stable_time_step.cc
  LOOPS
    auxiliary_elements.cc
    auxiliary_space.cc
    block_jacobi.cc
    constrained_operator.cc
    null_space.cc
)
