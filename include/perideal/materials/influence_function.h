// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_materials_influence_function_h
#define perideal_materials_influence_function_h

#include <string>
#include <vector>

namespace perideal
{
  /**
   * How much a bond counts by its length: omega(s), s = |xi|/horizon.
   */
  class InfluenceFunction
  {
  public:
    /// @param name constant | inverse | gaussian | cubic spline
    /// @throws InputError on another name.
    explicit InfluenceFunction(const std::string &name);

    static std::vector<std::string> names();

    /// omega of a bond in the family of a node.
    /// @param length of the bond [m]
    /// @param own_horizon the node's [m]
    /// @param bond_horizon the larger horizon of the bond's ends [m]
    double value(const double length, const double own_horizon, const double bond_horizon) const
    {
      return function(length / (fades_out ? bond_horizon : own_horizon));
    }

    /// Weighted volume of a full sphere, in 2-D of a disc of unit thickness:
    /// m = int omega |xi|^2 dV (XOSB eq. 25).
    template <int dim>
    double weighted_volume(const double horizon) const
    {
      double power = horizon * horizon;
      for (int d = 0; d < dim; ++d)
        power *= horizon;
      return unit_weighted_volume[dim - 2] * power;
    }

  private:
    double (*function)(const double);
    /// Functions that fade towards the horizon are scaled with the bond's, so
    /// that bonds longer than the node's own horizon (union rule) count; the
    /// others have no scale but the node's own.
    bool fades_out;
    /// Weighted volumes at horizon 1, in 2-D and 3-D.
    double unit_weighted_volume[2];
  };
} // namespace perideal

#endif
