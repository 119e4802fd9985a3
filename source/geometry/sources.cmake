# SPDX-License-Identifier: LGPL-2.1-or-later

perideal_room(geometry
  SOURCES
    body_rays.cc
    cell_in_ball.cc
    cell_sections.cc
    facets.cc
)
