// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_base_symmetric_pairs_h
#define perideal_base_symmetric_pairs_h

#include <perideal/base/lanes.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <utility>

namespace perideal
{
  /**
   * Symmetric tensors as vectors of pairs: strain (xx, yy, 2xy) in 2-D, (xx, yy, zz, 2xy, 2yz, 2zx) in 3-D,
   * and products xi (x) xi and stress without the twos, so that their scalar product is that of the tensors.
   */
  template <int dim>
  struct SymmetricPairs
  {
    static constexpr unsigned int n_pairs = dim * (dim + 1) / 2;
    static constexpr unsigned int n_parts = dim - 1;

    using Pairs = std::array<double, n_pairs>;
    /// A vector of pairs as loops over bonds read it: 2-D one record (xx, yy, xy, 0), 3-D two: (xx, yy, zz,
    /// 0), (xy, yz, zx, 0).
    using PairRecord = std::array<NodeRecord, n_parts>;

    /// The axes (a, b) that pair @p k stands for.
    static constexpr std::pair<unsigned int, unsigned int> axes(const unsigned int k)
    {
      return k < dim ? std::make_pair(k, k) : std::make_pair(k - dim, (k - dim + 1) % dim);
    }

    /// The pair that stands for two axes.
    static constexpr unsigned int number_of(const unsigned int a, const unsigned int b)
    {
      unsigned int k = 0;
      while (!(axes(k).first == a && axes(k).second == b) && !(axes(k).first == b && axes(k).second == a))
        ++k;
      return k;
    }

    template <typename Record>
    static auto &pair(Record &record, const unsigned int k)
    {
      return dim == 2 ? record[0].value[k] : record[k / 3].value[k % 3];
    }

    /// xi (x) xi of a bond.
    static Pairs products(const dealii::Tensor<1, dim> &bond)
    {
      Pairs result;
      for (unsigned int k = 0; k < n_pairs; ++k)
        result[k] = bond[axes(k).first] * bond[axes(k).second];
      return result;
    }

    static dealii::Tensor<1, dim> dot(const std::array<dealii::Tensor<1, dim>, n_pairs> &row,
                                      const Pairs                                       &pairs)
    {
      dealii::Tensor<1, dim> result;
      for (unsigned int k = 0; k < n_pairs; ++k)
        result += pairs[k] * row[k];
      return result;
    }
  };
} // namespace perideal

#endif
