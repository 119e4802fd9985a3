// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/weights/correspondence_rows.h>

#include <algorithm>

// The Hessian of CorrespondenceRows: blocks on the diagonal and assembly. With g_aB = sum_k c_k^a_B u_k^a and
// z_m = u_m - u_i - g xi_m, family i contributes
//
//     V A_aBcD c_k^a_B c_l^c_D  +  delta_ac sum_m b_m r_mk^a r_ml^a,   r_mk^a = dz_m^a/du_k^a.

namespace perideal
{
  template <int dim>
  typename CorrespondenceRows<dim>::DenseRow CorrespondenceRows<dim>::dense_row(const LocalIndex i) const
  {
    DenseRow row;
    row.column.push_back(i);
    row.c.resize(1 + of_family.first[i + 1] - of_family.first[i]);
    for (BondIndex k = of_family.first[i]; k < of_family.first[i + 1]; ++k)
      {
        row.column.push_back(of_family.member[k]);
        row.c[row.column.size() - 1] = of_family.c[k];
        row.c[0] -= of_family.c[k];
      }
    return row;
  }

  namespace
  {
    /// c_k A c_l of two columns.
    template <int dim>
    dealii::Tensor<2, dim> between(const dealii::Tensor<1, dim> &c_k,
                                   const dealii::Tensor<4, dim> &A,
                                   const dealii::Tensor<1, dim> &c_l)
    {
      dealii::Tensor<2, dim> result;
      for (int a = 0; a < dim; ++a)
        for (int c = 0; c < dim; ++c)
          for (int B = 0; B < dim; ++B)
            for (int D = 0; D < dim; ++D)
              result[a][c] += c_k[B] * A[a][B][c][D] * c_l[D];
      return result;
    }
  } // namespace

  template <int dim>
  std::vector<dealii::Tensor<2, dim>>
  CorrespondenceRows<dim>::jacobi_blocks(const TangentOf &tangent_of) const
  {
    // One vector for each column of the blocks.
    std::vector<NodalVector> columns(dim);
    for (NodalVector &column : columns)
      column.reinit(layout);
    const auto place = [&](const LocalIndex k) {
      return k < n_owned() ? dim * k : ghost_number[k - n_owned()];
    };
    for (LocalIndex i = 0; i < n_owned(); ++i)
      {
        const DenseRow               row = dense_row(i);
        const dealii::Tensor<4, dim> A   = families->volume[i] * tangent_of(i);
        // sum_m b_m of 1, xi, xi (x) xi
        double                 sum = 0;
        dealii::Tensor<1, dim> first_moment;
        dealii::Tensor<2, dim> second_moment;
        for (BondIndex k = of_family.first[i]; k < of_family.first[i + 1]; ++k)
          {
            const auto bond = families->position[of_family.member[k]] - families->position[i];
            sum += of_family.penalty[k];
            first_moment += of_family.penalty[k] * bond;
            second_moment += of_family.penalty[k] * outer_product(bond, bond);
          }
        for (std::size_t k = 0; k < row.column.size(); ++k)
          {
            dealii::Tensor<2, dim> block = between(row.c[k], A, row.c[k]);
            const LocalIndex       j     = row.column[k];
            double                 own   = 0;
            dealii::Tensor<1, dim> mixed;
            if (j == i)
              {
                own   = sum;
                mixed = first_moment;
              }
            else
              {
                const auto begin = of_family.member.begin() + of_family.first[i],
                           end   = of_family.member.begin() + of_family.first[i + 1];
                const auto found = std::lower_bound(begin, end, j);
                if (found != end && *found == j)
                  {
                    own   = of_family.penalty[found - of_family.member.begin()];
                    mixed = -own * (families->position[j] - families->position[i]);
                  }
              }
            for (int a = 0; a < dim; ++a)
              block[a][a] += own + 2. * (mixed * row.c[k]) + row.c[k] * (second_moment * row.c[k]);
            for (int a = 0; a < dim; ++a)
              for (int c = 0; c < dim; ++c)
                columns[c].local_element(place(j) + a) += block[a][c];
          }
      }
    std::vector<dealii::Tensor<2, dim>> result(n_owned());
    for (int c = 0; c < dim; ++c)
      {
        columns[c].compress(dealii::VectorOperation::add);
        for (LocalIndex i = 0; i < n_owned(); ++i)
          for (int a = 0; a < dim; ++a)
            result[i][a][c] = columns[c].local_element(dim * i + a);
      }
    return result;
  }

  template <int dim>
  void CorrespondenceRows<dim>::assemble(const TangentOf &tangent_of, const AddBlock &add) const
  {
    std::vector<GlobalIndex> unknowns;
    std::vector<double>      values;
    for (LocalIndex i = 0; i < n_owned(); ++i)
      {
        const DenseRow               row       = dense_row(i);
        const dealii::Tensor<4, dim> A         = families->volume[i] * tangent_of(i);
        const std::size_t            n         = row.column.size();
        const BondIndex              n_members = of_family.first[i + 1] - of_family.first[i];
        const std::size_t self = std::find(row.column.begin(), row.column.end(), i) - row.column.begin();
        unknowns.clear();
        for (const LocalIndex j : row.column)
          for (int a = 0; a < dim; ++a)
            unknowns.push_back(dim * families->global_number(j) + a);
        values.assign(dim * n * dim * n, 0.);
        const auto entry =
          [&](const std::size_t k, const int a, const std::size_t l, const int c) -> double & {
          return values[(dim * k + a) * dim * n + dim * l + c];
        };
        for (std::size_t k = 0; k < n; ++k)
          for (std::size_t l = 0; l < n; ++l)
            {
              const auto block = between(row.c[k], A, row.c[l]);
              for (int a = 0; a < dim; ++a)
                for (int c = 0; c < dim; ++c)
                  entry(k, a, l, c) = block[a][c];
            }
        for (BondIndex m = 0; m < n_members; ++m)
          {
            const LocalIndex  j    = of_family.member[of_family.first[i] + m];
            const auto        bond = families->position[j] - families->position[i];
            const std::size_t far  = std::find(row.column.begin(), row.column.end(), j) - row.column.begin();
            for (int a = 0; a < dim; ++a)
              {
                std::vector<double> r(n);
                for (std::size_t k = 0; k < n; ++k)
                  r[k] = -(row.c[k] * bond);
                r[far] += 1.;
                r[self] -= 1.;
                for (std::size_t k = 0; k < n; ++k)
                  for (std::size_t l = 0; l < n; ++l)
                    entry(k, a, l, a) += of_family.penalty[of_family.first[i] + m] * r[k] * r[l];
              }
          }
        add(unknowns, values);
      }
  }

  PERIDEAL_INSTANTIATE_CLASS(CorrespondenceRows)
} // namespace perideal
