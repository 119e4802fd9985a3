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

    static std::vector<std::string> form_names() { return {"one point", "moment corrected", "surface cure"}; }

    FamilyShape shape() const override { return {0, false, true}; }
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
} // namespace perideal

#endif
