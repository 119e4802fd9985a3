// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_materials_consistent_h
#define perideal_materials_consistent_h

#include <perideal/materials/influence_function.h>
#include <perideal/materials/linear_model.h>
#include <perideal/materials/traits.h>

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>

namespace perideal
{
  /// The form of any model whose strains come from the faces of the mesh, as Material/Form = consistent
  /// names it: of linear statics, with the stabilisation of Consistent.
  FormTraits consistent_form();

  /// Declares Material/Stabilisation.
  void declare_stabilisation(dealii::ParameterHandler &prm, ModelParameters &parameters);

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
   * surfaces. No multipliers are needed; wd is the spherical weight of XOSB (28), with
   * distances measured in the shape of the horizon: where that follows the cells,
   * bonds along a cell's long and short side weigh alike.
   * Bonds between different materials do not exist: the faces join those.
   */
  template <int dim>
  class Consistent
  {
  public:
    /// @param stabilisation s [-]
    /// @param horizon_factor horizon over spacing [-]
    Consistent(const InfluenceFunction &influence, const double stabilisation, const double horizon_factor);

    /// The modulus mu [Pa] that bonds of a solid stabilise with: its shear modulus, and without isotropy half
    /// the stiffness against the strain that it resists least (the smallest eigenvalue of C on symmetric
    /// tensors), which is the same for isotropic solids with a Poisson's ratio >= 0. With more, bonds that
    /// resist all strains alike would stiffen the soft ones: laminates have then twice the error of finite
    /// elements, with this half of it.
    static double stabilising_modulus(const ElasticSolid<dim> &solid);

    /// What a family adds to the stiffness of a bond, b = 2 s mu V_i V_j wd/|xi|^2: with
    /// r = xi.(u_j-u_i) - xi.eps_i xi it stores b/2 r^2.
    /// @param distance_square of the other end in the family's horizon, 1 at its rim [-];
    ///   beyond it the bond is the other family's alone: counted in both, the long bonds
    ///   between large and small cells would be far too stiff for the small ones.
    /// @param other_volume of the bond's other end [m^3]
    double bond_stiffness(const double length_square,
                          const double distance_square,
                          const double other_volume,
                          const double shear_modulus) const
    {
      return distance_square > 1. ?
               0. :
               factor * shear_modulus * other_volume * influence.value(std::sqrt(distance_square), 1., 1.) *
                 distance_square / (length_square * length_square);
    }

  private:
    InfluenceFunction influence;
    double            factor;
  };
} // namespace perideal

#endif
