# SPDX-License-Identifier: LGPL-2.1-or-later

perideal_room(nodes
  SOURCES
    boundary_nodes.cc
    cell_keys.cc
    mesh_points.cc
  LOOPS
    cell_graph.cc
    curve_order.cc
    nodes.cc
)
