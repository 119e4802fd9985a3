// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/spread_bits.h>
#include <perideal/operators/weights/equal_families.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace perideal
{
  namespace
  {
    /// The lattice has this many lines a horizon: finer than cells, coarser than rounding.
    constexpr double lines_per_horizon = 1024.;
    /// Bits of one direction of a lattice point, and the middle of its range.
    constexpr int    bits   = 21;
    constexpr double middle = 1 << (bits - 1);
  } // namespace

  template <int dim>
  EqualFamilies<dim>::EqualFamilies(const Families<dim> &families)
  {
    double largest = 0, smallest_horizon = std::numeric_limits<double>::max();
    for (const dealii::Point<dim> &x : families.position)
      for (int d = 0; d < dim; ++d)
        largest = std::max(largest, std::abs(x[d]));
    for (const double horizon : families.horizon)
      smallest_horizon = std::min(smallest_horizon, horizon);
    // Centroids are sums over the vertices and quadrature points of cells.
    tolerance = 64. * std::numeric_limits<double>::epsilon() * (1. + largest / smallest_horizon);
  }

  template <int dim>
  typename EqualFamilies<dim>::Key EqualFamilies<dim>::find_keys(const FamilyView<dim> &family)
  {
    keys.assign(family.size, 0);
    const double scale = lines_per_horizon / family.horizon;
    for (int d = 0; d < dim; ++d)
      {
        const double *bond = family.bond[d].data();
        for (LocalIndex m = 0; m < family.size; ++m)
          {
            // Bonds to cells with larger horizons may be long: far ones share the outermost line.
            const double line = std::min(std::max(bond[m] * scale + middle + 0.5, 0.), 2. * middle - 1.);
            keys[m] |= static_cast<Key>(static_cast<std::int32_t>(line)) << (bits * d);
          }
      }
    places.resize(family.size);
    Key result = spread_bits(family.size);
    for (LocalIndex m = 0; m < family.size; ++m)
      {
        places[m] = spread_bits(keys[m]);
        result += places[m];
      }
    return result;
  }

  template <int dim>
  bool EqualFamilies<dim>::is_equal(const Known                     &other,
                                    const FamilyView<dim>           &family,
                                    const dealii::types::material_id material,
                                    std::vector<LocalIndex>         &codes) const
  {
    const double length = tolerance * other.horizon;
    // Volumes are products of as many lengths, spacings, which may be a sixth of the horizon.
    const double share = 6. * dim * tolerance;
    if (other.n_members != family.size || other.material != material ||
        std::abs(other.horizon - family.horizon) > length ||
        std::abs(other.volume - family.node_volume) > share * other.volume)
      return false;
    codes.resize(family.size);
    for (LocalIndex m = 0; m < family.size; ++m)
      {
        const Cell   *table = cells.data() + other.table;
        std::uint32_t at    = places[m] & other.mask;
        while (table[at].code != 0 && table[at].key != keys[m])
          at = (at + 1) & other.mask;
        if (table[at].code == 0)
          return false;
        const Member &member = members[table[at].code - 1];
        double        miss   = std::abs(member.horizon - family.bond_horizon[m]);
        for (int d = 0; d < dim; ++d)
          miss = std::max(miss, std::abs(member.bond[d] - family.bond[d][m]));
        if (miss > length || std::abs(member.volume - family.volume[m]) > share * member.volume)
          return false;
        codes[m] = table[at].code;
      }
    return true;
  }

  template <int dim>
  LocalIndex EqualFamilies<dim>::insert(const FamilyView<dim>           &family,
                                        const dealii::types::material_id material)
  {
    std::uint32_t size = 8;
    while (size < 2 * family.size)
      size *= 2;
    known.push_back({family.node_volume,
                     family.horizon,
                     material,
                     family.size,
                     static_cast<LocalIndex>(members.size() + 1),
                     cells.size(),
                     size - 1});
    cells.resize(cells.size() + size);
    Cell *table = cells.data() + known.back().table;
    for (LocalIndex m = 0; m < family.size; ++m)
      {
        Member member;
        for (int d = 0; d < dim; ++d)
          member.bond[d] = family.bond[d][m];
        member.volume  = family.volume[m];
        member.horizon = family.bond_horizon[m];
        members.push_back(member);
        std::uint32_t at = places[m] & (size - 1);
        while (table[at].code != 0)
          at = (at + 1) & (size - 1);
        table[at] = {keys[m], static_cast<LocalIndex>(members.size())};
      }
    return static_cast<LocalIndex>(known.size() - 1);
  }

  template <int dim>
  typename EqualFamilies<dim>::Match EqualFamilies<dim>::find(const FamilyView<dim>           &family,
                                                              const dealii::types::material_id material,
                                                              std::vector<LocalIndex>         &codes)
  {
    const Key all = find_keys(family);
    // Neighbours on the curve are mostly alike.
    if (last < known.size() && is_equal(known[last], family, material, codes))
      return {last, false};
    std::vector<LocalIndex> &candidates = with_keys[all];
    for (const LocalIndex number : candidates)
      if (is_equal(known[number], family, material, codes))
        {
          last = number;
          return {number, false};
        }
    last = insert(family, material);
    candidates.push_back(last);
    codes.resize(family.size);
    for (LocalIndex m = 0; m < family.size; ++m)
      codes[m] = known[last].first_code + m;
    return {last, true};
  }

  template <int dim>
  bool EqualFamilies<dim>::are_many(const Families<dim> &families)
  {
    constexpr LocalIndex    n_samples = 256;
    EqualFamilies           sample(families);
    FamilyView<dim>         view;
    std::vector<LocalIndex> codes;
    std::vector<LocalIndex> whole;
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      if (families.is_whole(i))
        whole.push_back(i);
    const LocalIndex n = std::min(n_samples, static_cast<LocalIndex>(whole.size()));
    for (LocalIndex k = 0; k < n; ++k)
      {
        const LocalIndex i = whole[static_cast<GlobalIndex>(k) * whole.size() / n];
        view.reinit(families, i);
        sample.find(view, families.material[i], codes);
      }
    return 4 * sample.size() <= 3 * n;
  }

  LocalIndex BondKinds::of(const LocalIndex near, const LocalIndex far)
  {
    if (near == 0 && far == 0)
      return 0;
    if (near >= last.size())
      last.resize(near + 1, {0, 0});
    if (last[near].second == 0 || last[near].first != far)
      {
        const auto place =
          number.insert({static_cast<std::uint64_t>(near) << 32 | far, static_cast<LocalIndex>(ends.size())});
        if (place.second)
          ends.emplace_back(near, far);
        last[near] = {far, place.first->second};
      }
    return last[near].second;
  }

  LocalIndex BondKinds::of_cut_bond(const LocalIndex near)
  {
    ends.emplace_back(near, 0);
    return static_cast<LocalIndex>(ends.size() - 1);
  }

  PERIDEAL_INSTANTIATE_CLASS(EqualFamilies)
} // namespace perideal
