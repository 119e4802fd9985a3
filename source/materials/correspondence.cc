// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/materials/consistent.h>
#include <perideal/materials/correspondence.h>
#include <perideal/materials/models.h>

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>

namespace perideal
{
  namespace
  {
    /// The smallest eigenvalue of a shape tensor, over that of the whole family, with which its inverse is
    /// still one: a half family keeps about half, bonds along a line none.
    constexpr double least_share = 0.05;

    /// By Jacobi's method: the closed formula is no number where rounding makes equal values complex.
    template <int dim>
    double smallest_eigenvalue(const dealii::SymmetricTensor<2, dim> &tensor)
    {
      return dealii::eigenvectors(tensor, dealii::SymmetricTensorEigenvectorMethod::jacobi).back().first;
    }
  } // namespace

  template <int dim>
  Correspondence<dim>::Correspondence(const InfluenceFunction &influence, const double stabilisation)
    : influence(influence)
    , stabilisation(stabilisation)
  {
  }

  template <int dim>
  double Correspondence<dim>::penalty_modulus(const ElasticSolid<dim> &solid)
  {
    const ElasticConstants &nearest = solid.isotropic();
    return solid.is_isotropic() ?
             nearest.young_modulus :
             2. * (1. + nearest.poisson_ratio) * Consistent<dim>::stabilising_modulus(solid);
  }

  template <int dim>
  void Correspondence<dim>::compute(const FamilyView<dim>                         &family,
                                    const double                                   modulus,
                                    const std::function<bool(const LocalIndex k)> &is_gone,
                                    Weights                                       &weights) const
  {
    const auto bond = [&](const LocalIndex k) {
      dealii::Tensor<1, dim> xi;
      for (int d = 0; d < dim; ++d)
        xi[d] = family.bond[d][k];
      return xi;
    };
    weights.gradient.assign(family.size, dealii::Tensor<1, dim>());
    weights.penalty.assign(family.size, 0.);

    // w_ij V_j, and K of all members and of those that are left.
    dealii::SymmetricTensor<2, dim> whole, shape;
    for (LocalIndex k = 0; k < family.size; ++k)
      {
        const double weight =
          family.volume[k] *
          influence.value(std::sqrt(family.length_square[k]), family.horizon, family.bond_horizon[k]);
        const auto share = weight * symmetrize(outer_product(bond(k), bond(k)));
        whole += share;
        if (is_gone && is_gone(k))
          continue;
        shape += share;
        weights.penalty[k] = weight;
      }
    weights.has_gradient = smallest_eigenvalue(shape) > least_share * smallest_eigenvalue(whole);
    const dealii::Tensor<2, dim> inverse =
      weights.has_gradient ? dealii::Tensor<2, dim>(invert(shape)) : dealii::Tensor<2, dim>();
    // beta V_i
    const double factor = whole.norm() > 0 ? family.node_volume * stabilisation * modulus / whole.norm() : 0.;
    for (LocalIndex k = 0; k < family.size; ++k)
      {
        weights.gradient[k] = weights.penalty[k] * (inverse * bond(k));
        weights.penalty[k] *= factor;
      }
  }

  namespace
  {
    void declare(dealii::ParameterHandler &prm, ModelParameters &parameters)
    {
      prm.add_parameter(
        "Law", parameters.law, "Correspondence: stress by deformation: " + meanings_of<LawTraits>());
    }
  } // namespace

  namespace models
  {
    ModelTraits correspondence()
    {
      FormTraits consistent = consistent_form(), family;
      // Its tangents serve statics and load steps.
      family.solvers = {true, false, false};
      family.name    = "family";
      family.meaning = "the deformation gradient by the bonds of the family, as published";
      family.defaults.influence_function = "gaussian";
      family.defaults.stabilisation      = {{5., 5.}};

      ModelTraits result;
      result.name          = "correspondence";
      result.meaning       = "non-ordinary, the stresses of any Law, at large strain too";
      result.forms         = {consistent, family};
      result.default_forms = {
        consistent.name, consistent.name, family.name, family.name, "energy", "extended ordinary"};
      result.takes_any_symmetry = true;
      result.has_law            = true;
      result.declare            = &declare;
      return result;
    }
  } // namespace models

  PERIDEAL_INSTANTIATE_CLASS(Correspondence)
} // namespace perideal
