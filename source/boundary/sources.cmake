# SPDX-License-Identifier: LGPL-2.1-or-later

perideal_room(boundary
  SOURCES
    body_forces.cc
    boundary_faces.cc
    cell_expansion.cc
    dirichlet_nodes.cc
    face_tractions.cc
    face_values.cc
    gauges.cc
    line_to_point.cc
    mirror_layer.cc
    nodal_strain.cc
    point_forces.cc
    published_transfer.cc
    surface_nodes.cc
    surface_planes.cc
    surface_recovery.cc
    taylor_fit.cc
    transfer_functions.cc
)
