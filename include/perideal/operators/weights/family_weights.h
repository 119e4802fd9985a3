// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_weights_family_weights_h
#define perideal_operators_weights_family_weights_h

#include <perideal/operators/weights/bond_weights.h>

#include <deal.II/base/memory_consumption.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

namespace perideal
{
  /// What turns the sums of families into states, by local node, ghosts included.
  template <unsigned int n_sums>
  struct FamilyMaps
  {
    /// map s.
    std::array<double, n_sums> states(const LocalIndex i, const std::array<double, n_sums> &s) const
    {
      if constexpr (n_sums == 0)
        return {};
      else if constexpr (n_sums == 1)
        return {{entries[i][0] * s[0]}};
      else
        return {{entries[i][0] * s[0] + entries[i][1] * s[1], entries[i][1] * s[0] + entries[i][2] * s[1]}};
    }

    /// Entries (0,0), (0,1) = (1,0), (1,1) of each.
    std::vector<std::array<double, 3>> entries;
  };

  /// Sizes that weights for sums, weights for forces, and stiffnesses are given in.
  struct WeightUnits
  {
    double sum = 1, force = 1, stiffness = 1;
  };

  /**
   * Holds the weights of every bond: of each end for each sum, and one stiffness. They stand by slot; where
   * identical families share theirs, by kind of bond.
   */
  template <typename Number, unsigned int n_sums, bool own_force_weights>
  struct SlotWeights
  {
    /// Values of the two ends of every bond.
    struct Ends
    {
      std::vector<Number> near, far;
    };
    using Sums = std::array<Ends, n_sums>;

    /// Where the weights of a slot stand.
    BondIndex at(const BondIndex slot) const { return kind.empty() ? slot : BondIndex(kind[slot]); }

    const Sums &force_weights() const
    {
      if constexpr (own_force_weights)
        return force_weight;
      else
        return sum_weight;
    }

    /// The largest of each on this rank.
    WeightUnits largest() const
    {
      WeightUnits result = {0, 0, 0};
      const auto  raise  = [](double &most, const std::vector<Number> &values) {
        for (const Number value : values)
          most = std::max<double>(most, std::abs(value));
      };
      raise(result.stiffness, stiffness);
      for (const Ends &ends : sum_weight)
        {
          raise(result.sum, ends.near);
          raise(result.sum, ends.far);
        }
      for (const Ends &ends : force_weights())
        {
          raise(result.force, ends.near);
          raise(result.force, ends.far);
        }
      return result;
    }

    /// Takes the weights of another precision, by slot, in units.
    template <typename Other>
    void copy_from(const SlotWeights<Other, n_sums, own_force_weights> &other, const WeightUnits &units)
    {
      const BondIndex n_slots = other.kind.empty() ? other.stiffness.size() : other.kind.size();
      const auto      copy = [&](const std::vector<Other> &from, std::vector<Number> &to, const double unit) {
        to.resize(n_slots);
        for (BondIndex slot = 0; slot < n_slots; ++slot)
          to[slot] = static_cast<Number>(from[other.at(slot)] / unit);
      };
      if constexpr (n_sums > 0)
        for (unsigned int a = 0; a < n_sums; ++a)
          {
            copy(other.sum_weight[a].near, sum_weight[a].near, units.sum);
            copy(other.sum_weight[a].far, sum_weight[a].far, units.sum);
            if (own_force_weights)
              {
                copy(other.force_weight[a].near, force_weight[a].near, units.force);
                copy(other.force_weight[a].far, force_weight[a].far, units.force);
              }
          }
      copy(other.stiffness, stiffness, units.stiffness);
    }

    std::size_t weights_memory() const
    {
      using dealii::MemoryConsumption::memory_consumption;
      std::size_t bytes = memory_consumption(stiffness) + memory_consumption(kind);
      for (const Sums *weights : {&sum_weight, &force_weight})
        for (const Ends &ends : *weights)
          bytes += memory_consumption(ends.near) + memory_consumption(ends.far);
      return bytes;
    }

    Sums sum_weight;
    /// Empty unless the shape has them.
    Sums                force_weight;
    std::vector<Number> stiffness;
    /// The kind of bond at each slot, 0 at padding; empty: weights stand by slot.
    std::vector<LocalIndex> kind;
  };

  /**
   * Holds the weights of models of one family shape: of each bond, for each sum, the
   * weight of either end, and one stiffness.
   */
  template <int dim, unsigned int n_sums, bool own_force_weights>
  class FamilyWeights : public BondWeights<dim>, public SlotWeights<double, n_sums, own_force_weights>
  {
  public:
    /// Weighs every family. Collective.
    FamilyWeights(const std::shared_ptr<const Families<dim>> &families,
                  LinearModel<dim>                           &model,
                  const SolidOf<dim>                         &solid_of,
                  const Weighing<dim>                        &how);

    void reweigh(const std::vector<LocalIndex>                                 &nodes,
                 LinearModel<dim>                                              &model,
                 const SolidOf<dim>                                            &solid_of,
                 const std::function<bool(const LocalIndex, const LocalIndex)> &is_gone) override;

    std::shared_ptr<BondWeights<dim>> scaled(const std::vector<double> &share) const override;

    std::size_t memory_consumption() const override;

    using Slots = SlotWeights<double, n_sums, own_force_weights>;
    using Slots::at;
    using Slots::force_weight;
    using Slots::force_weights;
    using Slots::kind;
    using Slots::stiffness;
    using Slots::sum_weight;
    using typename Slots::Ends;
    using typename Slots::Sums;

    std::array<double, n_sums> states(const LocalIndex i, const std::array<double, n_sums> &s) const
    {
      return map.states(i, s);
    }

    /// What the families of either end add to the stiffness; kept where weights will change.
    Ends               end_stiffness;
    bool               will_change;
    FamilyMaps<n_sums> map;
    /// Coefficients of the squared sum in the strain energy by owned node; only of
    /// models with own force weights.
    std::vector<double> energy;

  private:
    /// Room for the weights of so many slots or kinds of bonds.
    void make_room(const BondIndex n);
    void
    weigh_families(LinearModel<dim> &model, const SolidOf<dim> &solid_of, const BondPredicate<dim> &is_cut);
    /// The same where identical families share their weights.
    void weigh_different_families(LinearModel<dim> &model, const SolidOf<dim> &solid_of);
    /// What the families' owners made of far ends, and what follows from both ends. Collective.
    void join_ends();
    void import_maps();
    /// @param member the ends of the bonds that the coefficients belong to
    void store(const LocalIndex                    i,
               const FamilyCoefficients           &coefficients,
               const std::vector<LocalIndex>      &member,
               const std::vector<BondCursor::End> &ends);
  };

  /// Weighs every family with the model. Collective.
  /// @param solid_of by material id; every material of the nodes is listed.
  template <int dim>
  std::shared_ptr<BondWeights<dim>> weigh_bonds(const std::shared_ptr<const Families<dim>> &families,
                                                LinearModel<dim>                           &model,
                                                const SolidOf<dim>                         &solid_of,
                                                const Weighing<dim>                        &how = {});

  /// Calls a macro with every family shape there is: dim, n_sums, own_force_weights.
#define PERIDEAL_FOR_FAMILY_SHAPES(CALL)                                                                     \
  CALL(2, 0, false)                                                                                          \
  CALL(2, 1, false)                                                                                          \
  CALL(2, 1, true)                                                                                           \
  CALL(2, 2, false)                                                                                          \
  CALL(3, 0, false)                                                                                          \
  CALL(3, 1, false)                                                                                          \
  CALL(3, 1, true)                                                                                           \
  CALL(3, 2, false)

  /// Calls visit(n_sums, own_force_weights) with a shape as constants of the types
  /// std::integral_constant.
  template <typename Visit>
  auto visit_family_shape(const FamilyShape &shape, const Visit &visit)
  {
    using std::integral_constant;
    if (shape.n_sums == 0)
      return visit(integral_constant<unsigned int, 0>(), std::false_type());
    if (shape.n_sums == 1 && !shape.own_force_weights)
      return visit(integral_constant<unsigned int, 1>(), std::false_type());
    if (shape.n_sums == 1)
      return visit(integral_constant<unsigned int, 1>(), std::true_type());
    AssertThrow(shape.n_sums == 2 && !shape.own_force_weights, dealii::ExcNotImplemented());
    return visit(integral_constant<unsigned int, 2>(), std::false_type());
  }
} // namespace perideal

#endif
