# SPDX-License-Identifier: LGPL-2.1-or-later

perideal_room(application
  SOURCES
    combinations.cc
    command_line.cc
    compare.cc
    conditional_settings.cc
    gate.cc
    new_scene.cc
    plot.cc
    print_parameters.cc
    process_scene.cc
    read_scene.cc
    reference.cc
    rules.cc
    rules_adaptation.cc
    rules_failure.cc
    rules_loads.cc
    rules_model.cc
    rules_output.cc
    rules_quadrature.cc
    rules_solver.cc
    rules_treatments.cc
    sweep.cc
)
