// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_reconstruction_monomials_h
#define perideal_reconstruction_monomials_h

#include <perideal/base/symmetric_pairs.h>

#include <array>

namespace perideal
{
  /**
   * The monomials of degree up to three, in the order 1; x, y, z; xx, yy, zz, xy, yz, zx; then the cubic
   * ones. In 2-D 1; x, y; xx, yy, xy; then the cubic ones.
   */
  template <int dim>
  struct Monomials
  {
    static constexpr unsigned int n_quadratic = SymmetricPairs<dim>::n_pairs;
    /// Of degree one and two.
    static constexpr unsigned int n_terms = dim + n_quadratic;
    /// With the constant.
    static constexpr unsigned int n_coefficients = 1 + n_terms;
    static constexpr unsigned int n_cubic        = dim == 2 ? 4 : 10;
    static constexpr unsigned int n              = n_coefficients + n_cubic;

    static constexpr unsigned int degree(const unsigned int m)
    {
      return m == 0 ? 0 : m < 1 + dim ? 1 : m < n_coefficients ? 2 : 3;
    }

    /// Number of the monomial that monomial @p m, at most quadratic, becomes when it is multiplied with axis
    /// @p k.
    static constexpr unsigned int times(const unsigned int m, const unsigned int k)
    {
      return table.times[m][k];
    }

    /// Values at a point [m^degree].
    static void evaluate(const dealii::Tensor<1, dim> &x, std::array<double, n> &value)
    {
      value[0] = 1.;
      for (unsigned int m = 0; m < n_coefficients; ++m)
        for (unsigned int k = 0; k < dim; ++k)
          value[times(m, k)] = value[m] * x[k];
    }

  private:
    struct Table
    {
      std::array<std::array<unsigned int, dim>, n>              exponent = {};
      std::array<std::array<unsigned int, dim>, n_coefficients> times    = {};
    };

    static constexpr Table make_table()
    {
      Table        result;
      unsigned int size = 1;
      for (unsigned int k = 0; k < dim; ++k, ++size)
        result.exponent[size][k] = 1;
      for (unsigned int p = 0; p < n_quadratic; ++p, ++size)
        {
          ++result.exponent[size][SymmetricPairs<dim>::axes(p).first];
          ++result.exponent[size][SymmetricPairs<dim>::axes(p).second];
        }
      for (unsigned int m = 0; m < n_coefficients; ++m)
        for (unsigned int k = 0; k < dim; ++k)
          {
            std::array<unsigned int, dim> wanted = {};
            for (unsigned int d = 0; d < dim; ++d)
              wanted[d] = result.exponent[m][d] + (d == k ? 1 : 0);
            unsigned int found = 0;
            for (; found < size; ++found)
              {
                bool same = true;
                for (unsigned int d = 0; d < dim; ++d)
                  same = same && result.exponent[found][d] == wanted[d];
                if (same)
                  break;
              }
            if (found == size)
              {
                for (unsigned int d = 0; d < dim; ++d)
                  result.exponent[size][d] = wanted[d];
                ++size;
              }
            result.times[m][k] = found;
          }
      return result;
    }

    static constexpr Table table = make_table();
  };
} // namespace perideal

#endif
