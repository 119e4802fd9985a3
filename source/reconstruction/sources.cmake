# SPDX-License-Identifier: LGPL-2.1-or-later

perideal_room(reconstruction
  SOURCES
    corner_fit.cc
    elastic_fit.cc
    family_fit.cc
    family_quadratics.cc
    point_interpolation.cc
  LOOPS
    cell_moments.cc
    cell_polynomials.cc
    face_gradient.cc
    face_moments.cc
    linear_interpolation.cc
    polynomial_closure.cc
    quadratic_fit.cc
)
