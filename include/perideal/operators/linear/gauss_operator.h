// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_linear_gauss_operator_h
#define perideal_operators_linear_gauss_operator_h

#include <perideal/operators/linear/bond_operator.h>
#include <perideal/quadrature/gauss_points.h>

#include <memory>
#include <vector>

namespace perideal
{
  /// How bonds near the surface are stiffened.
  struct Stiffening
  {
    /// Compensation factors by local node, ghosts included; empty: none.
    std::vector<double> factor;
    /// Whether a bond has that of its far end, as printed in (3.62), and not the mean of both.
    bool of_neighbour = false;
  };

  /**
   * Applies the linear force of bond-based peridynamics with its integral taken at the Gauss points of cells
   * (QUAD (3.15), with the volume once):
   *
   *     F_i = -V_i sum_j sum_g c beta_g V_g xi (xi . (u_g - u_i))/|xi|^3,    xi = x_g - x_i,
   *
   * over the cells j that the horizon cuts, the node's own among them. c beta_g is the mean of what the
   * horizons of i and j make of it. A point acts on nodes and no node on points: momentum is kept up to the
   * quadrature's error, and K is not symmetric.
   */
  template <int dim>
  class GaussOperator : public BondOperator<dim>
  {
  public:
    /// @param modulus micromodulus c by local node, ghosts included [N/m^6]
    /// @throws InputError on all ranks where no bond of a family counts. Collective.
    GaussOperator(const std::shared_ptr<const Families<dim>>    &families,
                  const std::shared_ptr<const GaussPoints<dim>> &points,
                  const std::vector<double>                     &modulus,
                  const Stiffening                              &stiffening);

    void vmult(NodalVector &force, const NodalVector &displacement) const override;
    std::vector<dealii::Tensor<2, dim>> jacobi_blocks() const override;
    void assemble(const typename BondOperator<dim>::AddBlock &add) const override;

    /// Springs have no dilatation of their own: 0.
    std::vector<double> dilatation() const override { return std::vector<double>(families->n_owned(), 0.); }
    bool                is_symmetric() const override { return false; }
    std::size_t         memory_consumption() const override;

  private:
    /// The bonds from a node to the n points of one cell: xi, and c beta V/|xi|^3.
    template <unsigned int n>
    struct Bonds
    {
      alignas(32) double xi[dim][n];
      alignas(32) double weight[n];
    };
    template <unsigned int n>
    void weigh(const LocalIndex i, const LocalIndex j, Bonds<n> &bonds) const;

    // The loops, for the numbers of points that cells can have.
    template <unsigned int n>
    GlobalIndex count_empty_families() const;
    template <unsigned int n>
    void sum_forces(NodalVector &force, const NodalVector &displacement) const;
    template <unsigned int n>
    void sum_blocks(NodalVector &blocks) const;
    template <unsigned int n>
    void assemble_cells(const typename BondOperator<dim>::AddBlock &add) const;

    std::shared_ptr<const Families<dim>>    families;
    std::shared_ptr<const GaussPoints<dim>> points;
    /// Half the micromodulus of either end, and the factor of the far end, by local node.
    std::vector<double> half_modulus, far_factor;
    /// Work space of vmult().
    mutable NodalVector at_points;
  };
} // namespace perideal

#endif
