# SPDX-License-Identifier: LGPL-2.1-or-later

perideal_room(drivers
  SOURCES
    adaptive_run.cc
    create_driver.cc
    driver.cc
    driver_check.cc
    driver_checkpoint.cc
    dynamics_driver.cc
    equilibrium_driver.cc
    failed_step.cc
    floating_nodes.cc
    heating.cc
    initial_motion.cc
    load_control.cc
    load_steps.cc
    mesh_adaptation.cc
    motion_check.cc
    motion_forces.cc
    motion_steps.cc
    preconditioning.cc
    static_driver.cc
    tangent_system.cc
)
