// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_linear_cell_block_h
#define perideal_operators_linear_cell_block_h

#include <perideal/operators/weights/gradient_rows.h>

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <array>

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
      if (row.is_closed())
        return closed_block_of(row, k, m);
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

  private:
    /// Mean gradient and moments of the gradient.
    using Strains = std::array<dealii::Tensor<2, dim>, 1 + dim>;

    /// What component b of a column of a closed row makes of them.
    static Strains
    strains_by(const typename GradientRows<dim>::Row &row, const std::size_t k, const unsigned int b)
    {
      Strains    result;
      const auto moments = row.moments_by(k, b);
      result[0]          = row.gradient_by(k, b);
      std::copy(moments.begin(), moments.end(), result.begin() + 1);
      return result;
    }

    /// The same of closed rows, in which all components of a column strain the cell in all components.
    dealii::Tensor<2, dim> closed_block_of(const typename GradientRows<dim>::Row &row,
                                           const std::size_t                      k,
                                           const std::size_t                      m) const
    {
      std::array<Strains, dim> stress, strain;
      for (unsigned int b = 0; b < dim; ++b)
        {
          strain[b]          = strains_by(row, m, b);
          const auto by_near = strains_by(row, k, b);
          stress[b][0]       = volume * dealii::double_contract<2, 0, 3, 1>(stiffness, by_near[0]);
          for (unsigned int c = 0; c < dim; ++c)
            {
              dealii::Tensor<2, dim> mean;
              for (unsigned int d = 0; d < dim; ++d)
                mean += inverse_moment[c][d] * by_near[1 + d];
              stress[b][1 + c] = dealii::double_contract<2, 0, 3, 1>(stiffness, mean);
            }
        }
      dealii::Tensor<2, dim> result;
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int b = 0; b < dim; ++b)
          for (unsigned int s = 0; s < 1 + dim; ++s)
            result[a][b] += dealii::scalar_product(stress[a][s], strain[b][s]);
      return result;
    }
  };
} // namespace perideal

#endif
