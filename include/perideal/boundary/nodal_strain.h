// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_boundary_nodal_strain_h
#define perideal_boundary_nodal_strain_h

#include <perideal/boundary/face_values.h>
#include <perideal/reconstruction/face_gradient.h>

#include <deal.II/base/symmetric_tensor.h>

#include <vector>

namespace perideal
{
  /**
   * Strain of each owned node, sym G_i u with the face gradient G: the mean over the
   * cell, exact for linear displacements. Where @p prescribed has values they take the place
   * of the interpolated ones, as in the consistent form. Collective.
   * @param displacement of the owned nodes [m]
   */
  template <int dim>
  std::vector<dealii::SymmetricTensor<2, dim>>
  compute_nodal_strain(const FaceGradient<dim>                   &gradient,
                       const FaceValues<dim>                     &prescribed,
                       const Nodes<dim>                          &nodes,
                       const std::vector<dealii::Tensor<1, dim>> &displacement);
} // namespace perideal

#endif
