// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_weights_tensor_weights_h
#define perideal_operators_weights_tensor_weights_h

#include <perideal/base/lanes.h>
#include <perideal/operators/weights/family_weights.h>

#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <vector>

namespace perideal
{
  /// The stiffness tensor of every bond, by component and slot [N/m]; zero at padding.
  template <typename Number, int dim>
  struct BondTensors
  {
    static constexpr unsigned int n_components = dealii::SymmetricTensor<2, dim>::n_independent_components;

    dealii::SymmetricTensor<2, dim> at(const BondIndex slot) const
    {
      dealii::SymmetricTensor<2, dim> result;
      for (unsigned int p = 0; p < n_components; ++p)
        result.access_raw_entry(p) = component[p][slot];
      return result;
    }

    void set(const BondIndex slot, const dealii::SymmetricTensor<2, dim> &tensor)
    {
      for (unsigned int p = 0; p < n_components; ++p)
        component[p][slot] = static_cast<Number>(tensor.access_raw_entry(p));
    }

    /// tensor times eta of the four bonds from @p slot on; both by component of the vectors, the rest zero.
    PERIDEAL_INLINE void multiply(const BondIndex slot, const Lanes (&eta)[4], Lanes (&force)[4]) const
    {
      for (Lanes &values : force)
        values = Lanes{};
      for (unsigned int p = 0; p < n_components; ++p)
        {
          Lanes entry;
          load(entry, component[p].data() + slot);
          force[row(p)] += entry * eta[column(p)];
          if (row(p) != column(p))
            force[column(p)] += entry * eta[row(p)];
        }
    }

    /// Axes of component p in the order of dealii::SymmetricTensor: the diagonal, then (0,1), (0,2), (1,2).
    static constexpr unsigned int row(const unsigned int p) { return p < dim ? p : p == dim + 2 ? 1 : 0; }
    static constexpr unsigned int column(const unsigned int p) { return p < dim ? p : p == dim ? 1 : 2; }

    std::size_t tensors_memory() const
    {
      std::size_t bytes = 0;
      for (const auto &values : component)
        bytes += dealii::MemoryConsumption::memory_consumption(values);
      return bytes;
    }

    std::array<std::vector<Number>, n_components> component;
  };

  /// What a model with bond tensors made of every bond.
  template <int dim>
  class TensorWeights : public BondWeights<dim>, public BondTensors<double, dim>
  {
  public:
    /// Weighs every family. Collective.
    TensorWeights(const std::shared_ptr<const Families<dim>> &families,
                  LinearModel<dim>                           &model,
                  const SolidOf<dim>                         &solid_of,
                  const BondPredicate<dim>                   &is_cut);

    /// Not for this model: its families have no multipliers.
    void reweigh(const std::vector<LocalIndex> &,
                 LinearModel<dim> &,
                 const SolidOf<dim> &,
                 const std::function<bool(const LocalIndex, const LocalIndex)> &) override
    {
      AssertThrow(false, dealii::ExcNotImplemented());
    }

    std::size_t memory_consumption() const override
    {
      return this->bonds.memory_consumption() + this->tensors_memory();
    }

  private:
    /// What the owners of far ends made of the bonds that the partition cuts. Collective.
    void add_far_ends();
  };
} // namespace perideal

#endif
