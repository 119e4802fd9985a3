# SPDX-License-Identifier: LGPL-2.1-or-later

perideal_room(recorders
  SOURCES
    areal_forces.cc
    boundary_stress.cc
    comparison.cc
    crack_figures.cc
    cracks.cc
    damage.cc
    discretisation_error.cc
    displacements.cc
    energy.cc
    finite_elements.cc
    gauges.cc
    iterations.cc
    line_values.cc
    load_resultants.cc
    make_recorders.cc
    point_values.cc
    probes.cc
    reactions.cc
    recorders.cc
    report.cc
    validity.cc
)
