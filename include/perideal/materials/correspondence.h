// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_materials_correspondence_h
#define perideal_materials_correspondence_h

#include <perideal/materials/influence_function.h>
#include <perideal/materials/linear_model.h>

#include <deal.II/base/tensor.h>

#include <functional>
#include <string>
#include <vector>

namespace perideal
{
  /**
   * Non-ordinary state-based peridynamics by correspondence, in the variational form of VNOSB (15): total
   * Lagrangian, the internal force being the gradient of
   *
   *     U = sum_i V_i [ W(F_i) + beta_i/2 sum_j w_ij V_j |z_ij|^2 ],    F_i = I + G_i u,
   *     z_ij = (u_j - u_i) - (G_i u) xi_ij,                            (21), (22)
   *     beta_i = alpha/|K_i|,   |K_i| the square root of the sum of its squared eigenvalues,   (23)
   *
   * with any law W of the continuum. z is what a linear field does not explain: without its penalty, motions
   * that G_i does not see (VNOSB fig. 2) cost nothing. A rigid rotation is a linear field, and costs nothing
   * with it.
   *
   * The gradient is that of the family,
   *
   *     G_i u = [ sum_j w_ij V_j (u_j - u_i) (x) xi_ij ] K_i^-1,   K_i = sum_j w_ij V_j xi_ij (x) xi_ij (3),
   * (6);
   *
   * bonds that broke are left out of both sums (20). Under it, sum_j w_ij V_j z_ij (x) xi_ij vanishes, and
   * the penalty adds nothing to the stress. (2) as printed pairs the stress of a neighbour with the shape
   * tensor of the node; the gradient of U pairs it with the neighbour's, as (11) does.
   *
   * With gradients from faces the same laws are the consistent form at finite strain
   * (materials/consistent.h).
   */
  template <int dim>
  class Correspondence
  {
  public:
    /// @param stabilisation alpha over Young's modulus [-]; 0: motions that G does not see are free
    Correspondence(const InfluenceFunction &influence, const double stabilisation);

    bool is_stabilised() const { return stabilisation > 0; }

    /// What alpha is a multiple of [Pa]: Young's modulus; without isotropy that of the isotropic solid whose
    /// shear modulus is Consistent::stabilising_modulus(), for the same reason.
    static double penalty_modulus(const ElasticSolid<dim> &solid);

    /// What a family makes of its members.
    struct Weights
    {
      /// c_j [1/m] of G_i u = sum_j (u_j - u_i) (x) c_j.
      std::vector<dealii::Tensor<1, dim>> gradient;
      /// V_i beta_i w_ij V_j [N/m].
      std::vector<double> penalty;
      /// Without: the bonds that are left span no space, and G_i u is zero. What they still hold, they hold
      /// by the penalty.
      bool has_gradient = true;
    };

    /// Weighs a family.
    /// @param modulus penalty_modulus() of its node [Pa]
    /// @param is_gone of members by place in the view; they weigh nothing, while beta stays that of all
    void compute(const FamilyView<dim>                         &family,
                 const double                                   modulus,
                 const std::function<bool(const LocalIndex k)> &is_gone,
                 Weights                                       &weights) const;

  private:
    InfluenceFunction influence;
    double            stabilisation;
  };
} // namespace perideal

#endif
