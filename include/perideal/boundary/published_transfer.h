// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_boundary_published_transfer_h
#define perideal_boundary_published_transfer_h

#include <perideal/boundary/transfer_functions.h>

namespace perideal
{
  /**
   * Boundary conditions through transfer functions as published, PDBC (2.17) and (4.1), by component. The
   * faces that hold a component make its dOmega_u, all others, loaded or free, its dOmega_p, and with
   * y = x + u the force on node i is
   *
   *     V_i [ chi sum_{k in u} L_ik (y_k - y_i) A_k + chi/(chi-1) sum_{k in p} (G_ik t_k + L_ik y_i) A_k ].
   *
   * The sums of L over u and over p cancel, (2.5): what depends on u_i is one spring for each component,
   * of the stiffness V_i chi^2/(chi-1) sum_{k in u} L_ik A_k.
   *
   * What is misprinted: chi = 3.59 comes from a bar in 1-D (appendix C), and the factor chi/(chi-1) stands
   * before the whole traction, so that external forces come out 39 % too large; and lambda, 1 with the
   * unit N/m^11, makes of L whatever the unit of length is: 3e-21 of the traction in metres, 3e+12 times
   * the traction in millimetres (a plate of 1 m by 0.5 m with 100 cells along it). The treatment "transfer"
   * has neither.
   */
  template <int dim>
  class PublishedTransfer
  {
  public:
    /// @param chi neither 0 nor 1 [-]
    /// @param lambda 0: no L, and no sums for it [N/m^11]
    /// Collective.
    PublishedTransfer(TransferFunctions<dim> functions,
                      const Loads<dim>      &loads,
                      const double           chi,
                      const double           lambda);

    void add_tractions(const Loads<dim> &loads, const double time, NodalVector &force) const;

    /// Adds what L makes of places: of those of held faces, and of the nodes' own at rest [N].
    void add_places(const Loads<dim> &loads, const double time, NodalVector &force) const;

    /// Springs of the owned nodes, by dim*node + component [N/m]; empty where no component has both held
    /// faces and others, or lambda is 0.
    const std::vector<double> &springs() const { return stiffness; }

  private:
    void make_springs();

    TransferFunctions<dim> functions;
    double                 chi, lambda;
    /// By dim*face + component: the condition that holds it, or -1.
    std::vector<int>    holder;
    std::vector<double> stiffness;
  };
} // namespace perideal

#endif
