// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_bond_weights_h
#define perideal_operators_bond_weights_h

#include <perideal/base/types.h>
#include <perideal/materials/linear_model.h>
#include <perideal/neighbourhood/bond_list.h>
#include <perideal/neighbourhood/families.h>

#include <functional>
#include <memory>
#include <vector>

namespace perideal
{
  /// Number of families of all ranks by what became of their weights.
  struct FamilyCounts
  {
    GlobalIndex fallback = 0, singular = 0, indefinite = 0;
  };

  /**
   * What a model made of every family and bond, whatever its family shape. Linear operator
   * and nonlinear force of a scene share it.
   */
  template <int dim>
  class BondWeights
  {
  public:
    virtual ~BondWeights() = default;

    /// Weighs the families of some owned nodes anew, without the bonds that are gone. Collective.
    /// @param is_gone of bonds between an owned node and another local one
    virtual void reweigh(const std::vector<LocalIndex>                                 &nodes,
                         LinearModel<dim>                                              &model,
                         const SolidOf<dim>                                            &solid_of,
                         const std::function<bool(const LocalIndex, const LocalIndex)> &is_gone) = 0;

    virtual std::size_t memory_consumption() const = 0;

    std::shared_ptr<const Families<dim>> families;
    BondList                             bonds;
    FamilyShape                          shape;
    bool                                 symmetric;

    FamilyCounts              counts;
    std::vector<FamilyReport> reports;

  protected:
    BondWeights(const std::shared_ptr<const Families<dim>> &families, const LinearModel<dim> &model)
      : families(families)
      , bonds(*families)
      , shape(model.shape())
      , symmetric(model.is_symmetric())
    {
    }

    /// Receives what a model made of a family, and where its weights go.
    /// @param member the ends of the bonds that the coefficients belong to
    using StoreFamily = std::function<void(const LocalIndex                    i,
                                           const FamilyCoefficients           &coefficients,
                                           const std::vector<LocalIndex>      &member,
                                           const std::vector<BondCursor::End> &ends)>;

    /// Lets the model look at every family of this rank without the bonds that are cut. Fills the reports.
    /// @throws InputError on all ranks where whole families count nothing of their members. Collective.
    void visit_families(LinearModel<dim>         &model,
                        const SolidOf<dim>       &solid_of,
                        const BondPredicate<dim> &is_cut,
                        const StoreFamily        &store);

    /// Counts what the reports say. Collective.
    void count_reports();
  };
} // namespace perideal

#endif
