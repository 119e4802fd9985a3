// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_reconstruction_boundary_point_h
#define perideal_reconstruction_boundary_point_h

#include <perideal/base/types.h>

#include <deal.II/base/point.h>
#include <deal.II/base/types.h>

namespace perideal
{
  /// A quadrature point on a face at the boundary of the body, at a cell of this rank.
  template <int dim>
  struct BoundaryPoint
  {
    /// Node of the cell.
    LocalIndex node;
    /// Consecutive number of the face among the boundary faces of this rank.
    unsigned int               face;
    dealii::types::boundary_id boundary;
    dealii::Point<dim>         point;
    /// Outward normal times the area that the point stands for, in 2-D length
    /// times thickness [m^2].
    dealii::Tensor<1, dim> area;
  };
} // namespace perideal

#endif
