// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/materials/models.h>
#include <perideal/materials/ordinary.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace perideal
{
  template <int dim>
  void spherical_weights(const FamilyView<dim>   &family,
                         const InfluenceFunction &influence,
                         const double             thickness,
                         std::vector<double>     &hydrostatic)
  {
    hydrostatic.resize(family.size);
    const double factor = dim / (influence.template weighted_volume<dim>(family.horizon) * thickness);
    for (LocalIndex j = 0; j < family.size; ++j)
      hydrostatic[j] =
        factor * influence.value(std::sqrt(family.length_square[j]), family.horizon, family.bond_horizon[j]);
  }

  template <int dim>
  Ordinary<dim>::Ordinary(const InfluenceFunction &influence, const double thickness)
    : influence(influence)
    , thickness(thickness)
  {
  }

  template <int dim>
  void Ordinary<dim>::compute(const FamilyView<dim> &family, FamilyCoefficients &coefficients)
  {
    // theta = sum_j wh |xi| e V_j                                  (XOSB eq. 26)
    // t     = kappa wh |xi| theta + 2 mu wd (e - theta |xi|/dim)   (XOSB eq. 17)
    // with wd = (dim+2)/2 wh, so that the two theta terms share one weight.
    //
    // The energy is half the sum of kappa theta^2 and (dim+2) mu (sum_j wh e^2 V_j - theta^2/dim). Of all e
    // with one theta, e ~ |xi| has the least: both together are positive for
    //
    //     kappa + mu (dim+2)/dim (1/r - 1) > 0,    r = 1/dim sum_j wh |xi|^2 V_j.
    //
    // r is about 1 in a whole family and less at surfaces. Where cells grow fast, small nodes have many
    // members beyond their own horizon, and r may be a hundred: such families get the weights of a whole one.
    const double mu = family.shear_modulus, kappa = family.bulk_modulus;
    spherical_weights(family, influence, thickness, weights);
    double whole = 0;
    for (LocalIndex j = 0; j < family.size; ++j)
      whole += weights[j] * family.length_square[j] * family.volume[j] / dim;
    if (kappa + mu * (dim + 2) / dim * (1. / whole - 1.) <= 0)
      {
        for (double &weight : weights)
          weight /= whole;
        coefficients.report.fallback = true;
      }
    for (LocalIndex j = 0; j < family.size; ++j)
      {
        coefficients.sum[0][j] = weights[j] * family.volume[j];
        coefficients.stiffness[j] =
          mu * (dim + 2) * family.node_volume * weights[j] * family.volume[j] / family.length_square[j];
      }
    coefficients.map = {{family.node_volume * (kappa - mu * (dim + 2) / dim), 0., 0.}};
  }

  double ordinary_critical_stretch(const ElasticConstants &constants,
                                   const double            fracture_energy,
                                   const double            horizon)
  {
    using dealii::numbers::PI;
    const double kappa = constants.bulk_modulus(), mu = constants.shear_modulus();
    const double stiffness = constants.assumption == PlaneAssumption::solid ?
                               3. * mu + std::pow(0.75, 4) * (kappa - 5. * mu / 3.) :
                               6. * mu / PI + 16. / (9. * PI * PI) * (kappa - 2. * mu);
    return std::sqrt(fracture_energy / (stiffness * horizon));
  }

  namespace
  {
    template <int dim>
    std::unique_ptr<LinearModel<dim>>
    create(const ModelParameters &parameters, const double thickness, const std::vector<double> &)
    {
      return std::make_unique<Ordinary<dim>>(InfluenceFunction(parameters.influence_function), thickness);
    }
  } // namespace

  namespace models
  {
    ModelTraits ordinary()
    {
      FormTraits form;
      form.shape                   = Ordinary<2>::family_shape();
      form.create                  = {&create<2>, &create<3>};
      form.is_made_for_each_family = false;

      ModelTraits result;
      result.name              = "ordinary";
      result.meaning           = "state-based peridynamics without corrections";
      result.forms             = {form};
      result.critical_stretch  = &ordinary_critical_stretch;
      result.corrects_surfaces = false;
      return result;
    }
  } // namespace models

  PERIDEAL_INSTANTIATE(spherical_weights)
  PERIDEAL_INSTANTIATE_CLASS(Ordinary)
} // namespace perideal
