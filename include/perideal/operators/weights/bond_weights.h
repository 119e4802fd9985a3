// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_weights_bond_weights_h
#define perideal_operators_weights_bond_weights_h

#include <perideal/base/types.h>
#include <perideal/materials/linear_model.h>
#include <perideal/neighbourhood/bond_list.h>
#include <perideal/neighbourhood/families.h>

#include <functional>
#include <memory>
#include <vector>

namespace perideal
{
  /// Number of families of all ranks by what became of their weights, and of those that were weighed: all but
  /// those equal to another on their rank.
  struct FamilyCounts
  {
    GlobalIndex fallback = 0, singular = 0, indefinite = 0, different = 0;
  };

  /// Chooses how bonds are weighed.
  template <int dim>
  struct Weighing
  {
    /// Tells which bonds are cut: they get no weights, and the families are weighed without them; empty:
    /// none.
    BondPredicate<dim> is_cut = {};
    /// Whether reweigh() will be called.
    bool will_change = false;
    /// Whether identical families are weighed once and share their weights, where many are identical; not
    /// where bonds are cut or weights will change.
    bool share_equal_families = true;
  };

  /**
   * Holds the weights that a model gives to every family and bond, whatever its family shape; none to
   * families that do not list all members. The linear operator and the nonlinear force of a scene share them.
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

    /// Returns the same with a share of the energy of each family, of weights that will change and whose
    /// forces follow from an energy.
    /// @param share by local node
    virtual std::shared_ptr<BondWeights<dim>> scaled(const std::vector<double> &share) const;

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

    /// Receives a family with its solid, and where the weights of its neighbours go.
    using VisitFamily =
      std::function<void(const FamilyView<dim> &family, const std::vector<BondCursor::End> &ends)>;

    /// Visits every whole family of this rank without the bonds that are cut.
    /// @throws InputError on all ranks where whole families count nothing of their members. Collective.
    void
    visit_families(const SolidOf<dim> &solid_of, const BondPredicate<dim> &is_cut, const VisitFamily &visit);

    /// Lets the model look at a family, and keeps its report.
    void weigh(LinearModel<dim> &model, const FamilyView<dim> &family, FamilyCoefficients &coefficients);

    /// Number of families that were weighed at first.
    LocalIndex n_weighed = 0;

    /// Counts what the reports say. Collective.
    void count_reports();
  };
} // namespace perideal

#endif
