// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_boundary_balanced_transfer_h
#define perideal_boundary_balanced_transfer_h

#include <perideal/boundary/transfer_functions.h>

namespace perideal
{
  /**
   * Tractions through the transfer function G of PDBC (3.16) without its factor and without L, such that
   * the nodes carry force F and moment M of every face exactly:
   *
   *     f_i = q_ik V_i [ F / Q_k + omega x (x_i - c_k) ],
   *     omega = I_k^-1 ( M - (c_k - x_k) x F ),   I_k = sum_i q_ik V_i ( |r_i|^2 1 - r_i r_i^T ),
   *
   * with the centroid c_k of the nodes, weighted by q_ik V_i, and r_i = x_i - c_k. F and M, about the
   * centroid x_k of the face, are integrals over it. For a uniform traction along the normal of a straight
   * side away from corners omega is zero. Nodes along a line carry no moment about it: there the inverse is
   * the pseudo-inverse.
   */
  template <int dim>
  class BalancedTransfer
  {
  public:
    /// Collective.
    explicit BalancedTransfer(TransferFunctions<dim> functions);

    void add_tractions(const Loads<dim> &loads, const double time, NodalVector &force) const;

  private:
    /// Of the nodes of a face: their centroid, from that of the face [m], and the inverse of I [1/m^5].
    struct Carriers
    {
      dealii::Tensor<1, 3> centroid;
      dealii::Tensor<2, 3> inverse_inertia;
    };

    TransferFunctions<dim> functions;
    std::vector<Carriers>  carriers;
  };
} // namespace perideal

#endif
