// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_linear_cell_block_h
#define perideal_operators_linear_cell_block_h

#include <perideal/operators/weights/gradient_rows.h>

#include <deal.II/base/symmetric_tensor.h>

namespace perideal
{
  /// What the block of two columns of a cell's energy takes of the cell.
  template <int dim>
  struct CellEnergy
  {
    /// [m^3], and [1/m^5] the inverse of int (x - x_i) (x) (x - x_i).
    double                 volume;
    dealii::Tensor<2, dim> inverse_moment;
    /// [Pa]
    dealii::Tensor<4, dim> stiffness;

    /// K_ab = sum_lm C_albm [ V G_l G_m + sum_kn (M^-1)_kn H_kl H_nm ] of the columns k and m of its row
    /// [N/m].
    dealii::Tensor<2, dim>
    block_of(const typename GradientRows<dim>::Row &row, const std::size_t k, const std::size_t m) const
    {
      dealii::Tensor<2, dim> result, product;
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int b = 0; b < dim; ++b)
          {
            if (row.n_patterns > 1 || (a == 0 && b == 0))
              product = volume * outer_product(row.gradient_of(a)[k], row.gradient_of(b)[m]) +
                        transpose(row.moment_of(a)[k]) * (inverse_moment * row.moment_of(b)[m]);
            double sum = 0.;
            for (unsigned int l = 0; l < dim; ++l)
              for (unsigned int n = 0; n < dim; ++n)
                sum += stiffness[a][l][b][n] * product[l][n];
            result[a][b] = sum;
          }
      return result;
    }
  };
} // namespace perideal

#endif
