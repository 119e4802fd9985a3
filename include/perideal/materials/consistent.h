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
  /// names it, with the stabilisation of Consistent; unless a model follows a law, of linear statics.
  FormTraits consistent_form();

  /// Declares Material/Stabilisation.
  void declare_stabilisation(dealii::ParameterHandler &prm, ModelParameters &parameters);

  /**
   * The consistent form: the energy of the solid in strains that come from the faces of the
   * mesh, and bonds that hold what these do not explain. The unknown of a node is the mean of the
   * displacement over its cell. Each cell fits a quadratic to the means around it; a face takes the mean of
   * the two polynomials at it, or what is prescribed there; and by the divergence theorem the faces give a
   * cell the mean eps of its strain and the first moment H of its gradient (GradientMoments). With M = int (x
   * - x_i) (x) (x - x_i),
   *
   *     U = sum_i [ V_i W(eps_i) + 1/2 (M_i^-1)_km eps(H_ik) : C : eps(H_im) ]
   *         + 1/2 sum_bonds (b_ij + b_ji) [ xi.(u_j - u_i) - 1/2 xi.(eps_i + eps_j) xi ]^2,
   *
   * the first two terms being the integral of the energy of a linear strain, mean and variance, and u_i the
   * value of the polynomial at the centroid. Quadratic displacements leave the bonds at rest on any mesh, and
   * with loads by the same means (tractions and body forces that act on the polynomials and their smoothed
   * means) they are in exact equilibrium. Smooth fields converge with order about four, 3.5 where surfaces
   * are in the way. The bonds suppress displacements that faces do not see, such as checkerboards; 12
   * neighbours do in 2-D and 32 in 3-D.
   *
   * At finite strain, by any law W of the continuum, the energy of a cell is that of F = I + G at points with
   * the second moments of the cell (CellPoints), and bonds compare squares of lengths with Green's strain,
   *
   *     r_ij = 1/2 (|y_j - y_i|^2 - |xi|^2) - 1/2 xi.(E_i + E_j) xi,
   *
   * which uniform deformations and rotations leave at zero. At rest its tangent is the linear form.
   *
   * The extended ordinary model is the isotropic case: W = kappa/2 tr(eps)^2 + mu |dev eps|^2, XOSB (22). The
   * weight of a bond is the spherical one of XOSB (28), with distances measured in the shape of the horizon:
   * where that follows the cells, bonds along a cell's long and short side weigh alike. Bonds between
   * different materials do not exist: the faces join those, each side with a polynomial of its own.
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

    /// What a family adds to the stiffness of a bond, b_ij = 2 s mu V_i V_j wd/|xi|^2.
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
