# SPDX-License-Identifier: LGPL-2.1-or-later

perideal_room(treatments
  SOURCES
    face_value.cc
    layer.cc
    line_to_point.cc
    mirror.cc
    published_transfer.cc
    reference.cc
    supports.cc
    surface_nodes.cc
    taylor_ghosts.cc
    tractions.cc
    transfer.cc
    treatments.cc
)
