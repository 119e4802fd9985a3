// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/geometry/cell_in_ball.h>
#include <perideal/quadrature/cell_shares.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <unordered_map>

namespace perideal
{
  namespace
  {
    /// Where a box along the axes lies to a ball, over the ball's radius, rounded to what round-off is above.
    template <int dim>
    struct BoxKey
    {
      /// Offset of the middle and half the size along each axis.
      std::array<std::int64_t, 2 * dim> number;

      bool operator==(const BoxKey &other) const { return number == other.number; }
    };

    template <int dim>
    struct HashOfKey
    {
      std::size_t operator()(const BoxKey<dim> &key) const
      {
        std::uint64_t hash = 0;
        for (const std::int64_t number : key.number)
          {
            hash = (hash ^ static_cast<std::uint64_t>(number)) * 0x9e3779b97f4a7c15ull;
            hash ^= hash >> 29;
          }
        return hash;
      }
    };

    /// Whether a cell is a box along the axes, and its key.
    template <int dim>
    bool find_key(const CellVertices<dim>  &cell,
                  const dealii::Point<dim> &centre,
                  const double              radius,
                  BoxKey<dim>              &key)
    {
      // Shares are as smooth as spheres: they are off by about this.
      constexpr double          unit  = 1e-11;
      const dealii::Point<dim> &lower = cell.front(), &upper = cell.back();
      for (unsigned int v = 0; v < cell.size(); ++v)
        for (int d = 0; d < dim; ++d)
          if (std::abs(cell[v][d] - ((v >> d) & 1u ? upper[d] : lower[d])) > unit * radius)
            return false;
      for (int d = 0; d < dim; ++d)
        {
          const double offset = std::abs(0.5 * (lower[d] + upper[d]) - centre[d]);
          key.number[d]       = std::llround(offset / (unit * radius));
          key.number[dim + d] = std::llround(0.5 * (upper[d] - lower[d]) / (unit * radius));
        }
      return true;
    }

    /// Looks where a cell lies before it asks how much of it is within the ball, and remembers the answers
    /// for boxes, of which regular meshes have few kinds.
    template <int dim>
    class CellShares : public VolumeRule<dim>
    {
    public:
      /// Part of the cell within the ball over the cell [-].
      using Share = std::function<double(
        const CellVertices<dim> &cell, const dealii::Point<dim> &centre, const double radius)>;

      explicit CellShares(const Share &compute)
        : compute(compute)
      {
      }

      double share(const Families<dim> &families, const LocalIndex i, const LocalIndex j) const override
      {
        const CellVertices<dim>  &cell   = families.cell[j];
        const dealii::Point<dim> &centre = families.position[i];
        const double              radius = families.horizon[i];
        const PlaceOfCell         place  = place_of(cell, centre, radius);
        if (place != PlaceOfCell::perhaps_cut)
          return place == PlaceOfCell::inside ? 1. : 0.;
        BoxKey<dim> key;
        if (!find_key(cell, centre, radius, key))
          return tidy(compute(cell, centre, radius));
        const auto at = known.find(key);
        if (at != known.end())
          return at->second;
        const double result = tidy(compute(cell, centre, radius));
        if (known.size() < most_known)
          known[key] = result;
        return result;
      }

    private:
      /// Without round-off at either end.
      static double tidy(const double share)
      {
        return share < VolumeRule<dim>::negligible ? 0. : std::min(1., share);
      }

      /// As many fit into the cache of a processor.
      static constexpr std::size_t most_known = 1u << 14;

      const Share                                                     compute;
      mutable std::unordered_map<BoxKey<dim>, double, HashOfKey<dim>> known;
    };
  } // namespace

  template <int dim>
  std::shared_ptr<const VolumeRule<dim>> create_exact_shares()
  {
    return std::make_shared<CellShares<dim>>(
      [](const CellVertices<dim> &cell, const dealii::Point<dim> &centre, const double radius) {
        return volume_in_ball<dim>(cell, centre, radius) / cell_volume<dim>(cell);
      });
  }

  template <int dim>
  std::shared_ptr<const VolumeRule<dim>> create_adaptive_shares(const IntegrationRule       rule,
                                                                const IntegrationTolerance &tolerance)
  {
    return std::make_shared<CellShares<dim>>([rule, tolerance](const CellVertices<dim>  &cell,
                                                               const dealii::Point<dim> &centre,
                                                               const double              radius) {
      const double density = 1. / cell_volume<dim>(cell);
      const auto   result  = integrate_cell_in_ball<dim>(
        [density](const dealii::Point<dim> &) { return density; }, cell, centre, radius, rule, tolerance);
      // No share is worse than asked for: what integration cannot reach has its closed form.
      return result.converged ? result.value : density * volume_in_ball<dim>(cell, centre, radius);
    });
  }

  PERIDEAL_INSTANTIATE(create_exact_shares)
  PERIDEAL_INSTANTIATE(create_adaptive_shares)

} // namespace perideal
