// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_parameters_softening_h
#define perideal_parameters_softening_h

#include <perideal/parameters/listed.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace perideal
{
  /// What a law of softening says of itself, in softening.cc.
  struct SofteningTraits
  {
    /// Name, and for lists of parameters the rest of "NAME: ...".
    std::string name, meaning;

    /// How the force of a bond falls as it opens: openings over that which a constant force would need for
    /// the fracture energy, and forces over the largest, from {0, 1} to a force of 0, straight lines between.
    /// The area below is 1. Empty: bonds break at once.
    std::vector<std::pair<double, double>> curve = {};
  };

  using Softening = Listed<SofteningTraits>;
  /// @cond
  template <>
  const Registry<SofteningTraits> &Softening::list();
  /// @endcond

  /**
   * Tells what is left of a bond by its largest stretch so far. Up to a first stretch s_0 it is elastic. From
   * there on its force is f times the largest, k s_0, and the stretch
   *
   *     s = s_0 f(x) + x s_d^2/(2 s_0),
   *
   * an elastic and an open part, with the law f of the opening x. It unloads towards its origin, with a share
   * g = f s_0/s of its stiffness, and takes k s_d^2/2 until it breaks: as much as when it broke at once at
   * s_d.
   */
  class SofteningLaw
  {
    using Curve = std::vector<std::pair<double, double>>;

  public:
    /// @param waits whether bonds begin to soften no earlier than they are told to
    explicit SofteningLaw(const Softening &softening = "none", const bool waits = false);

    /// False where bonds break at once.
    bool softens() const { return !curve.empty(); }

    bool waits() const { return is_told; }

    /// Whether bonds with these stretches soften: a law softens, and they would not snap back.
    bool is_stable(const double first, const double brittle_square) const
    {
      return softens() && least * first * first <= brittle_square * (1. + 1e-6);
    }

    /// Returns the stretch at which a bond that softens is broken.
    double last(const double first, const double brittle_square) const
    {
      return 0.5 * brittle_square / first * curve.back().first;
    }

    /// Returns g [-], 0 where the bond is broken.
    /// @param stretch s > s_0 @param first s_0 @param brittle_square s_d^2, both stable
    double carried(const double stretch, const double first, const double brittle_square) const
    {
      return look_at(stretch, first, brittle_square).carried;
    }

    /// Returns the stretch at which a bond that opens bears a share of its largest force.
    /// @param borne 0 < f < 1 @param first s_0 @param brittle_square s_d^2, both stable
    double stretch_bearing(const double borne, const double first, const double brittle_square) const;

    /// Stretches that grow, over a scale: s = scale unit.
    struct Growing
    {
      /// In ascending order, and one over each, which is looked at beyond s_0 only.
      const double *unit, *inverse;
      unsigned int  n;
    };

    /// Sets g of stretches that grow [-]: 1 up to s_0, 0 where the bond is broken.
    /// @param scale of the stretches; where it is not above 0 the bond stays whole
    void look_along(const Growing &stretches,
                    const double   scale,
                    const double   first,
                    const double   brittle_square,
                    double        *result) const;

    /// Returns dg/ds [-] where the stretch is the largest so far.
    double slope(const double stretch, const double first, const double brittle_square) const
    {
      return look_at(stretch, first, brittle_square).slope;
    }

  private:
    struct Point
    {
      double carried, slope;
    };
    double stretch_at(const Curve::value_type &point, const double first, const double brittle_square) const
    {
      return first * point.second + 0.5 * brittle_square / first * point.first;
    }
    Point look_at(const double stretch, const double first, const double brittle_square) const;

    Curve curve;
    bool  is_told = false;
    /// The least (s_d/s_0)^2 with which stretches grow as bonds open [-].
    double least = 1.;
  };
} // namespace perideal

#endif
