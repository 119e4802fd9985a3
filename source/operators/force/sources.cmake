# SPDX-License-Identifier: LGPL-2.1-or-later

perideal_room(operators/force
  SOURCES
    breaking_bonds.cc
    breaking_bonds_limits.cc
    breaking_bonds_start.cc
    contact_parameters.cc
    fracture_zone.cc
    intact_gradients.cc
    rest_regions.cc
    softening_bonds.cc
    stress_onset.cc
    zoned_force.cc
  LOOPS
    consistent_force.cc
    contact_force.cc
    contact_lists.cc
    correspondence_force.cc
    family_force.cc
    family_force_energy.cc
    family_force_failure.cc
    family_force_loops.cc
    family_force_reweigh.cc
    local_steps.cc
    relative_damping.cc
    tensor_force.cc
)
