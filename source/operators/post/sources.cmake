# SPDX-License-Identifier: LGPL-2.1-or-later

perideal_room(operators/post
  SOURCES
    areal_force_density.cc
    error_estimate.cc
    mirror_reactions.cc
    partial_stress.cc
)
