// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_materials_consistent_h
#define perideal_materials_consistent_h

#include <perideal/materials/influence_function.h>

#include <deal.II/base/symmetric_tensor.h>

namespace perideal
{
  /// Bulk and shear modulus [Pa] by material id.
  struct Moduli
  {
    double bulk_modulus = 0, shear_modulus = 0;
  };

  /**
   * The consistent form of extended ordinary state-based peridynamics: the
   * energy of XOSB (22) with the strain of the family taken from the face
   * gradient G of the mesh in place of weighted sums over bonds,
   *
   *     U = sum_i V_i [ W(eps_i) + s mu sum_j wd_ij (e_ij - n.eps_i xi)^2 V_j ],
   *     eps_i = sym G_i u,    W(eps) = kappa/2 tr(eps)^2 + mu |dev eps|^2.
   *
   * The bonds resist only what the strain of their family does not explain,
   * which is zero under uniform strain: forces are then those of W alone, and
   * the face gradient makes them vanish inside and equal the tractions at
   * surfaces. No multipliers are needed; wd is the spherical weight of XOSB (28).
   * Bonds between different materials do not exist: the faces join those.
   */
  template <int dim>
  class Consistent
  {
  public:
    /// Stabilisation s and influence function of the smallest errors, found on
    /// plates with a hole: larger s spoils coarse meshes, smaller s the surface of the hole.
    static constexpr double      best_stabilisation = dim == 2 ? 0.9 : 0.4;
    static constexpr const char *best_influence     = "cubic spline";

    /// @param stabilisation s [-]
    /// @param thickness of a two-dimensional body [m], 1 in 3-D
    Consistent(const InfluenceFunction &influence, const double stabilisation, const double thickness);

    /// The part of a bond's stiffness that both its families share, omega V_i V_j/|xi|^2 [m^4].
    /// @param bond_horizon the larger horizon of the bond's ends [m]
    double bond_share(const double length_square,
                      const double bond_horizon,
                      const double volume,
                      const double other_volume) const;

    /// The part of one family: times bond_share() it is b = 2 s mu V_i V_j wd/|xi|^2,
    /// so that a bond stores b/2 (xi.(u_j-u_i) - xi.eps xi)^2.
    double family_share(const double shear_modulus, const double horizon) const;

    /// sigma = dW/d eps [Pa].
    static dealii::SymmetricTensor<2, dim> stress(const dealii::SymmetricTensor<2, dim> &strain,
                                                  const Moduli                          &moduli)
    {
      const double lambda = moduli.bulk_modulus - 2. * moduli.shear_modulus / dim;
      auto         result = 2. * moduli.shear_modulus * strain;
      for (int d = 0; d < dim; ++d)
        result[d][d] += lambda * trace(strain);
      return result;
    }

  private:
    InfluenceFunction influence;
    double            stabilisation, thickness;
  };
} // namespace perideal

#endif
