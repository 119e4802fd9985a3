// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_force_lost_volumes_h
#define perideal_operators_force_lost_volumes_h

#include <perideal/neighbourhood/bond_list.h>
#include <perideal/quadrature/bond_volume.h>

#include <deal.II/base/memory_consumption.h>

#include <memory>
#include <vector>

namespace perideal
{
  /// Knows how much volume of the families of owned nodes is behind bonds that were lost [m^3].
  template <int dim>
  class LostVolumes
  {
  public:
    LostVolumes(const std::shared_ptr<const Families<dim>> &families, const BondList &bonds)
      : families(families)
      , whole(families->n_owned(), 0.)
    {
      for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
        for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
          if (bonds.neighbour[slot] != i)
            add(whole, i, bonds.neighbour[slot]);
      broken = cut = std::vector<double>(whole.size(), 0.);
    }

    /// Adds a share of the volumes behind a bond to those of its owned ends.
    void
    add(std::vector<double> &volume, const LocalIndex i, const LocalIndex j, const double share = 1.) const
    {
      volume[i] += share * counted_volume(*families, i, j);
      if (j < families->n_owned())
        volume[j] += share * counted_volume(*families, j, i);
    }

    /// Returns a volume over that of the whole family, by owned node [-].
    std::vector<double> share(const std::vector<double> &volume) const
    {
      std::vector<double> result(volume.size());
      for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = whole[i] > 0 ? volume[i] / whole[i] : 0.;
      return result;
    }

    std::size_t memory_consumption() const
    {
      return 3 * dealii::MemoryConsumption::memory_consumption(whole);
    }

  private:
    std::shared_ptr<const Families<dim>> families;
    std::vector<double>                  whole;

  public:
    /// Behind bonds that broke, and behind those that were cut.
    std::vector<double> broken, cut;
  };
} // namespace perideal

#endif
