// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/linear/bond_blocks.h>

#include <algorithm>

namespace perideal
{
  template <int dim>
  BondBlocks<dim>::Ends::Ends(const typename GradientRows<dim>::Row &row)
    : column(row.column)
    , pattern(row.pattern)
    , numbers(row.value)
  {
    numbers.reserve((1 + dim * row.n_patterns) * size());
    for (unsigned int p = 0; p < row.n_patterns; ++p)
      for (unsigned int l = 0; l < dim; ++l)
        for (const dealii::Tensor<1, dim> &gradient : row.gradient[p])
          numbers.push_back(gradient[l]);
  }

  template <int dim>
  void BondBlocks<dim>::Ends::fill(const double                  sign,
                                   const BondDirections<dim>    &directions,
                                   const dealii::Tensor<1, dim> &end,
                                   const unsigned int            component,
                                   std::vector<double>          &result) const
  {
    const std::size_t n     = size();
    const double     *value = numbers.data();
    result.resize(n);
    double *to = result.data();
    if (component == dim)
      {
        for (std::size_t k = 0; k < n; ++k)
          to[k] = sign * value[k];
        return;
      }
    const double *gradient = value + (1 + dim * pattern[component]) * n;
    const double  pull     = sign * directions.pull[component];
    const auto    bond     = -0.5 * end[component] * directions.bond;
    for (std::size_t k = 0; k < n; ++k)
      {
        double sum = pull * value[k];
        for (unsigned int l = 0; l < dim; ++l)
          sum += bond[l] * gradient[l * n + k];
        to[k] = sum;
      }
  }

  template <int dim>
  BondBlocks<dim>::BondBlocks(std::vector<dealii::Tensor<2, dim>> &blocks)
    : blocks(blocks)
    , place(blocks.size(), nowhere)
  {
  }

  template <int dim>
  void BondBlocks<dim>::start(const Ends &cell)
  {
    near = &cell;
    for (std::size_t k = 0; k < near->size(); ++k)
      place[near->column[k]] = k;
    for (auto &sum : sums)
      sum.assign(near->size(), 0.);
  }

  template <int dim>
  void BondBlocks<dim>::add_at(const LocalIndex column, const typename Symmetric::Pairs &block)
  {
    for (unsigned int p = 0; p < Symmetric::n_pairs; ++p)
      {
        const auto [a, b] = Symmetric::axes(p);
        blocks[column][a][b] += block[p];
        if (a != b)
          blocks[column][b][a] += block[p];
      }
  }

  template <int dim>
  void BondBlocks<dim>::add(const BondDirections<dim> &directions,
                            const double               stiffness,
                            const double               tension,
                            const Ends                &far)
  {
    // Bodies at rest do not ask for p_j - p_i alone.
    const unsigned int n_components = tension == 0. ? dim : dim + 1;
    for (unsigned int c = 0; c < n_components; ++c)
      {
        near->fill(-1., directions, directions.near, c, of_bond[c]);
        far.fill(1., directions, directions.far, c, of_far[c]);
      }
    const auto product = [&](const auto &row, const unsigned int pair, const std::size_t k) {
      const auto [a, b] = Symmetric::axes(pair);
      double result     = stiffness * row[a][k] * row[b][k];
      if (a == b && n_components > dim)
        result += tension * row[dim][k] * row[dim][k];
      return result;
    };
    for (std::size_t k = 0; k < far.size(); ++k)
      if (const LocalIndex at = place[far.column[k]]; at != nowhere)
        {
          for (unsigned int c = 0; c < n_components; ++c)
            of_bond[c][at] += of_far[c][k];
        }
      else
        {
          typename Symmetric::Pairs block;
          for (unsigned int p = 0; p < Symmetric::n_pairs; ++p)
            block[p] = product(of_far, p, k);
          add_at(far.column[k], block);
        }
    for (unsigned int p = 0; p < Symmetric::n_pairs; ++p)
      for (std::size_t k = 0; k < near->size(); ++k)
        sums[p][k] += product(of_bond, p, k);
  }

  template <int dim>
  void BondBlocks<dim>::finish()
  {
    for (std::size_t k = 0; k < near->size(); ++k)
      {
        typename Symmetric::Pairs block;
        for (unsigned int p = 0; p < Symmetric::n_pairs; ++p)
          block[p] = sums[p][k];
        add_at(near->column[k], block);
        place[near->column[k]] = nowhere;
      }
  }

  PERIDEAL_INSTANTIATE_CLASS(BondBlocks)
} // namespace perideal
