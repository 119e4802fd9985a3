# SPDX-License-Identifier: LGPL-2.1-or-later

perideal_room(quadrature
  SOURCES
    adaptive_integration.cc
    bond_volume.cc
    bonds_through_plane.cc
    cell_shares.cc
    gauss_points.cc
    moving_least_squares.cc
    quadrature_parameters.cc
    regular_body.cc
)
