// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_reconstruction_corner_fit_h
#define perideal_reconstruction_corner_fit_h

#include <perideal/nodes/mesh_points.h>

#include <vector>

namespace perideal
{
  /**
   * Returns at the corners of an owned cell the linear field that has the value of its node there and fits
   * those of the cells around it best, by least squares,
   *
   *     v(x) = v_i + G (x - x_i),   G = [sum_j w_j (v_j - v_i) (x) (x_j - x_i)] [sum_j w_j (x_j - x_i) (x)
   *     (x_j - x_i)]^+,   w_j = 1/|x_j - x_i|^2,
   *
   * from its side of cracks alone. Linear fields are reproduced; across directions in which no cell lies the
   * field is constant.
   * @param values at local nodes of the graph, ghosts included
   */
  template <int dim>
  CornerValues<dim> fit_at_corners(const MeshPoints<dim>                     &points,
                                   const LocalIndex                           node,
                                   const std::vector<dealii::Tensor<1, dim>> &values);
} // namespace perideal

#endif
