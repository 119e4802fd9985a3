# SPDX-License-Identifier: LGPL-2.1-or-later

perideal_room(neighbourhood
  SOURCES
    precrack.cc
    whole_families.cc
  LOOPS
    bond_list.cc
    components.cc
    connected_parts.cc
    families.cc
    halo.cc
    point_tree.cc
)
