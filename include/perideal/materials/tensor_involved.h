// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_materials_tensor_involved_h
#define perideal_materials_tensor_involved_h

#include <perideal/materials/linear_model.h>

#include <deal.II/base/symmetric_tensor.h>

#include <string>
#include <vector>

namespace perideal
{
  /**
   * Tensor-involved bond-based peridynamics (Tian et al.; "TIPD"): solids of any symmetry by bonds
   * alone, whose micromodulus is a tensor,
   *
   *     f = D : (xi (x) xi) / |xi|^3  eta,      eta = u_j - u_i                       (14), (44)
   *
   * Its limit for small horizons is div C : grad u when, with the moments of the family,
   *
   *     1/2 D_ikcd M_cdpq = S_ikpq,   S_ikpq = (C_ipkq + C_iqkp)/2,
   *     M_cdpq = sum_j xi_c xi_d xi_p xi_q V_j / |xi|^3 .
   *
   * In a full sphere M = M_0 (dd + dd + dd), M_0 = pi d^3 h/12 (2-D, thickness h) or pi d^4/15 (3-D), and
   *
   *     D_ikcd = ( S_ikcd - S_ikaa delta_cd/(dim+2) ) / M_0,
   *
   * which are the tables (32), (34) and, less its misprints, (52) of the paper.
   *
   * D is symmetric in (i, k) and in (c, d). Bonds resist rotations with C_ipkq - S_ikpq, which is of no
   * effect inside a body but is at its surface: see micromodulus_defect().
   */
  template <int dim>
  class TensorInvolved : public LinearModel<dim>
  {
  public:
    /// Whose moments D is made for.
    enum class Moments
    {
      /// Those of a full sphere, as published: errors stay as the mesh is refined.
      sphere,
      /// Those of the family as its nodes stand: second order on regular meshes.
      family
    };

    /// @param thickness of a two-dimensional body [m], 1 in 3-D
    TensorInvolved(const Moments moments, const double thickness);

    static FamilyShape family_shape() { return {0, false, true}; }

    FamilyShape shape() const override { return family_shape(); }
    bool        is_symmetric() const override { return true; }
    void        compute(const FamilyView<dim> &family, FamilyCoefficients &coefficients) override;

    /// Only of the form made for full spheres. Linear always, as TensorForce is.
    PairForce<dim> pair_force(const ElasticSolid<dim>                    &solid,
                              const double                                horizon,
                              const typename LinearModel<dim>::Kinematics kinematics) const override;

    /// S of the stiffness C, S[i][k][p][q] [Pa].
    static dealii::SymmetricTensor<4, dim> symmetrised(const dealii::SymmetricTensor<4, dim> &stiffness);

    /// D M_0 of a full sphere, D[i][k][c][d] [Pa].
    static dealii::SymmetricTensor<4, dim> micromodulus(const dealii::SymmetricTensor<4, dim> &stiffness);

    /// C_ipkq - S_ikpq, [i][p][k][q] [Pa]: the energy of a uniform gradient that the bonds lack, which is
    /// that of a null Lagrangian (its Euler-Lagrange equations are empty) and so acts at surfaces only.
    static dealii::Tensor<4, dim> micromodulus_defect(const dealii::SymmetricTensor<4, dim> &stiffness);

  private:
    /// The tensor D of a family, made for its moments; tells whether it could be.
    bool family_micromodulus(const FamilyView<dim> &family, dealii::SymmetricTensor<4, dim> &d) const;

    /// The tensor D of a full sphere [N/m^7].
    dealii::SymmetricTensor<4, dim> sphere_micromodulus(const dealii::SymmetricTensor<4, dim> &stiffness,
                                                        const double                           horizon) const;

    Moments moments;
    double  thickness;
  };

  /**
   * The critical stretch of tensor-involved bonds (TIPD eqs. 41 and 54, and for any symmetry):
   *
   *     3-D: s0^2 = 2 G0 / (3 B horizon),   2-D: s0^2 = pi G0 / (3 B horizon),
   *     B = ((dim+1) lambda + (dim+3) mu)/(dim+2),
   *
   * B being what a full sphere of bonds resists a stretch with, on the mean over the directions. That depends
   * on the traces of the stiffness only, which the nearest isotropic solid has in common with an anisotropic
   * one; there, a crack takes more than G0 across stiff directions and less across soft ones.
   *
   * @param constants of the nearest isotropic solid
   */
  double tensor_critical_stretch(const ElasticConstants &constants,
                                 const double            fracture_energy,
                                 const double            horizon);
} // namespace perideal

#endif
