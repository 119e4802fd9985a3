// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_weights_equal_families_h
#define perideal_operators_weights_equal_families_h

#include <perideal/materials/linear_model.h>

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace perideal
{
  /**
   * Recognises families that are identical but for the rounding of coordinates: the same bonds, volumes,
   * horizons and material. On structured meshes those inside the body are all one, and those near its surface
   * a few.
   *
   * Members of the different families are numbered; these numbers, from 1, are their codes. Code 0 stands for
   * no member.
   */
  template <int dim>
  class EqualFamilies
  {
  public:
    explicit EqualFamilies(const Families<dim> &families);

    /// The family with this number was seen before, or is new.
    struct Match
    {
      LocalIndex number;
      bool       is_new;
    };

    /// The number of a family, and the codes of its members in their order.
    Match find(const FamilyView<dim>           &family,
               const dealii::types::material_id material,
               std::vector<LocalIndex>         &codes);

    /// Number of different families so far.
    LocalIndex size() const { return static_cast<LocalIndex>(known.size()); }

    /// Whether many of this rank's families are identical to others, by a sample of them.
    static bool are_many(const Families<dim> &families);

  private:
    using Key = std::uint64_t;

    /// A family that was found first.
    struct Known
    {
      double                     volume, horizon;
      dealii::types::material_id material;
      LocalIndex                 n_members, first_code;
      /// Begin of its hash table of members among the cells, and the table's size less one.
      std::size_t   table;
      std::uint32_t mask;
    };
    struct Member
    {
      dealii::Tensor<1, dim> bond;
      double                 volume, horizon;
    };
    /// A cell of a hash table; code 0: free.
    struct Cell
    {
      Key        key  = 0;
      LocalIndex code = 0;
    };

    /// Fills the keys of a family's members: its bonds on a lattice. Returns the same number for the same
    /// keys in any order.
    Key        find_keys(const FamilyView<dim> &family);
    bool       is_equal(const Known                     &other,
                        const FamilyView<dim>           &family,
                        const dealii::types::material_id material,
                        std::vector<LocalIndex>         &codes) const;
    LocalIndex insert(const FamilyView<dim> &family, const dealii::types::material_id material);

    /// What bonds and horizons may differ by, over the horizon [-].
    double tolerance;

    std::vector<Known>                               known;
    std::vector<Member>                              members; // by code less one
    std::vector<Cell>                                cells;
    std::unordered_map<Key, std::vector<LocalIndex>> with_keys;
    // Of the family that is looked at: keys of its members, and these spread over the hash tables.
    std::vector<Key> keys, places;
    LocalIndex       last = 0;
  };

  /**
   * Numbers the different bonds of identical families: a bond is determined by its two ends. Number 0 is no
   * bond, as at padding.
   */
  class BondKinds
  {
  public:
    /// The number of the bond with these codes at its ends.
    LocalIndex of(const LocalIndex near, const LocalIndex far);

    /// A number of its own for a bond of which this rank knows one end.
    LocalIndex of_cut_bond(const LocalIndex near);

    /// Codes of the near and far ends, by number.
    std::vector<std::pair<LocalIndex, LocalIndex>> ends = {{0, 0}};

  private:
    std::unordered_map<std::uint64_t, LocalIndex> number;
    /// By near code, the bond that was asked for last.
    std::vector<std::pair<LocalIndex, LocalIndex>> last;
  };
} // namespace perideal

#endif
