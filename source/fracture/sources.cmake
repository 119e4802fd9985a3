# SPDX-License-Identifier: LGPL-2.1-or-later

perideal_room(fracture
  SOURCES
    crack_branching.cc
    crack_fronts.cc
    crack_path.cc
    crack_tips.cc
    crack_tracker.cc
    domain_integral.cc
    floating_nodes.cc
    fragments.cc
    no_fail_zones.cc
    singular_exponents.cc
)
