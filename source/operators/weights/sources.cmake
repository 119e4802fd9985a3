# SPDX-License-Identifier: LGPL-2.1-or-later

perideal_room(operators/weights
  SOURCES
    bond_weights.cc
    calibrated_stretches.cc
    calibration_memo.cc
    canonical_family.cc
    cell_reach.cc
    equal_families.cc
  LOOPS
    consistent_bonds.cc
    correspondence_rows.cc
    correspondence_rows_matrix.cc
    family_weights.cc
    gradient_moments.cc
    gradient_moments_faces.cc
    gradient_moments_loops.cc
    gradient_rows.cc
    gradient_rows_exchange.cc
    gradient_rows_sides.cc
    tensor_weights.cc
)
