// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_force_continuum_force_h
#define perideal_operators_force_continuum_force_h

#include <perideal/base/types.h>
#include <perideal/parameters/expanded_law.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <vector>

namespace perideal
{
  /// What forces have in common whose nodes follow laws of the continuum.
  template <int dim>
  class ContinuumForce
  {
  public:
    virtual ~ContinuumForce() = default;

    /// The displacement gradient of owned nodes at the last compute() of the force [-]. Collective.
    virtual std::vector<dealii::Tensor<2, dim>> gradients() const = 0;

    /// The law of an owned node; in a cell that would expand freely that of its mean expansion.
    virtual ExpandedLaw<dim> law(const LocalIndex i) const = 0;

    /// Cauchy stresses of owned nodes at the last compute() [Pa]. Collective.
    std::vector<dealii::SymmetricTensor<2, 3>> cauchy_stresses() const
    {
      std::vector<dealii::SymmetricTensor<2, 3>> result;
      for (const auto &gradient : gradients())
        result.push_back(law(result.size()).cauchy_stress(gradient));
      return result;
    }
  };
} // namespace perideal

#endif
