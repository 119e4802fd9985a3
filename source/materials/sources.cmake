# SPDX-License-Identifier: LGPL-2.1-or-later

perideal_room(materials
  SOURCES
    bond_based.cc
    boundary_compensation.cc
    bulk_strength.cc
    conical_bond_based.cc
    consistent.cc
    correspondence.cc
    elastic_state.cc
    extended_ordinary.cc
    influence_function.cc
    lattice.cc
    linear_model.cc
    models.cc
    moment_conditions.cc
    ordinary.cc
    separation.cc
    tensor_involved.cc
)
