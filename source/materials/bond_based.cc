// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/materials/bond_based.h>
#include <perideal/materials/models.h>
#include <perideal/materials/ordinary.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace perideal
{
  template <int dim>
  BondBased<dim>::BondBased(const double thickness, const std::vector<double> &stiffening)
    : thickness(thickness)
    , stiffening(stiffening)
  {
  }

  template <int dim>
  void BondBased<dim>::compute(const FamilyView<dim> &family, FamilyCoefficients &coefficients)
  {
    // T = c e/|xi|, a half of it from either family; as stiffness eps xi with eps = |xi| e
    // the bond pulls with stiffness |xi|^2 e.
    const double modulus = micromodulus(family.bulk_modulus, family.horizon, thickness) *
                           (stiffening.empty() ? 1. : stiffening[family.node]);
    for (LocalIndex j = 0; j < family.size; ++j)
      coefficients.stiffness[j] = 0.5 * modulus * family.node_volume * family.volume[j] /
                                  (family.length_square[j] * std::sqrt(family.length_square[j]));
  }

  template <int dim>
  double BondBased<dim>::sphere_moment(const double horizon)
  {
    using dealii::numbers::PI;
    return dim == 3 ? PI * std::pow(horizon, 4) : 2. * PI / 3. * std::pow(horizon, 3);
  }

  template <int dim>
  double BondBased<dim>::micromodulus(const double bulk_modulus, const double horizon, const double thickness)
  {
    return 2. * dim * dim * bulk_modulus / (thickness * sphere_moment(horizon));
  }

  template <int dim>
  PairForce<dim> spring_force(const std::function<double(const double)>  &micromodulus,
                              const typename LinearModel<dim>::Kinematics kinematics)
  {
    using Vector = dealii::Tensor<1, dim>;
    if (kinematics == LinearModel<dim>::Kinematics::linear)
      return [micromodulus](const Vector &xi, const Vector &eta) {
        const double length = xi.norm();
        return micromodulus(length) * (xi * eta) / (length * length * length) * xi;
      };
    return [micromodulus](const Vector &xi, const Vector &eta) {
      // |xi + eta| - |xi|, without the cancellation.
      const Vector y      = xi + eta;
      const double before = xi.norm(), after = y.norm();
      const double stretch = (2. * xi + eta) * eta / ((before + after) * before);
      return micromodulus(before) * stretch / after * y;
    };
  }

  template <int dim>
  PairForce<dim> BondBased<dim>::pair_force(const ElasticSolid<dim>                    &solid,
                                            const double                                horizon,
                                            const typename LinearModel<dim>::Kinematics kinematics) const
  {
    const double c = micromodulus(solid.isotropic().bulk_modulus(), horizon, thickness);
    return spring_force<dim>([c](const double) { return c; }, kinematics);
  }

  namespace
  {
    template <int dim>
    std::unique_ptr<LinearModel<dim>>
    create(const ModelParameters &, const double thickness, const std::vector<double> &stiffening)
    {
      return std::make_unique<BondBased<dim>>(thickness, stiffening);
    }

    void declare(dealii::ParameterHandler &prm, ModelParameters &parameters)
    {
      prm.add_parameter("Boundary compensation",
                        parameters.boundary_compensation,
                        "Bond based: how bonds near the surface are stiffened, so that an expansion stores "
                        "as much energy there as inside: none; numerical: by what the quadrature makes of a "
                        "family in a regular body over what it makes of this one; sphere: by the integral "
                        "over the sphere over that, which makes up for the quadrature's error inside the "
                        "body too; closed form: by the depth below the planes of the surface");
      prm.add_parameter("Compensation of a bond",
                        parameters.compensation_of_a_bond,
                        "Which factor a bond has: mean: that of both ends; neighbour: that of the far end, "
                        "as published, which leaves forces without balance (Scheme = gauss points)");
    }
  } // namespace

  namespace models
  {
    ModelTraits bond_based()
    {
      FormTraits form;
      form.shape                      = BondBased<2>::family_shape();
      form.create                     = {&create<2>, &create<3>};
      form.bonds_know_only_their_ends = true;
      form.is_made_for_each_family    = false;

      ModelTraits result;
      result.name                 = "bond based";
      result.meaning              = "springs, whose Poisson's ratio is 1/4 (plane stress 1/3)";
      result.forms                = {form};
      result.poisson_ratio        = &BondBased<2>::poisson_ratio;
      result.critical_stretch     = &ordinary_critical_stretch;
      result.corrects_surfaces    = false;
      result.has_one_micromodulus = true;
      result.declare              = &declare;
      return result;
    }
  } // namespace models

  PERIDEAL_INSTANTIATE(spring_force)
  PERIDEAL_INSTANTIATE_CLASS(BondBased)
} // namespace perideal
