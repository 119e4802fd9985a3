// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/materials/extended_ordinary.h>
#include <perideal/materials/models.h>
#include <perideal/materials/ordinary.h>

#include <algorithm>

namespace perideal
{
  namespace
  {
    /// A weight counts as negative when it is so beyond round-off of the spherical one.
    bool any_negative(const std::vector<double> &weights, const std::vector<double> &spherical)
    {
      for (std::size_t j = 0; j < weights.size(); ++j)
        if (weights[j] < -1e-12 * spherical[j])
          return true;
      return false;
    }

    /// Spherical deviatoric weights times one factor, so that at least the trace
    /// of the moment conditions holds: sum_j wd |xi|^2 V_j = dim (dim+2)/2.
    template <int dim>
    std::vector<double> scaled_to_trace(const FamilyView<dim> &family, std::vector<double> weights)
    {
      double trace = 0;
      for (LocalIndex j = 0; j < family.size; ++j)
        trace += weights[j] * family.length_square[j] * family.volume[j];
      for (double &weight : weights)
        weight *= dim * (dim + 2) / (2. * trace);
      return weights;
    }
  } // namespace

  template <int dim>
  ExtendedOrdinary<dim>::ExtendedOrdinary(const Form               form,
                                          const InfluenceFunction &influence,
                                          const double             thickness,
                                          const Negative           negative)
    : form(form)
    , influence(influence)
    , thickness(thickness)
    , negative(negative)
  {
  }

  template <int dim>
  FamilyReport ExtendedOrdinary<dim>::weigh(const FamilyView<dim> &family,
                                            std::vector<double>   &wh,
                                            std::vector<double>   &wd)
  {
    spherical_weights(family, influence, thickness, spherical);
    spherical_deviatoric = spherical;
    for (double &weight : spherical_deviatoric)
      weight *= (dim + 2) / 2.;
    wh = spherical;
    wd = spherical_deviatoric;

    // w = ws + lambda.monomials                                   (35), (55)
    hydrostatic_conditions.reinit(family);
    deviatoric_conditions.reinit(family);
    const double missed_h = hydrostatic_conditions.correct(wh);
    double       missed_d = deviatoric_conditions.correct(wd);

    FamilyReport report;
    report.indefinite = any_negative(wd, spherical_deviatoric);
    if (negative == Negative::spherical)
      {
        report.fallback = report.indefinite || any_negative(wh, spherical) ||
                          std::max(missed_h, missed_d) > MomentConditions<dim, 4>::tolerance;
        if (report.fallback)
          {
            wh       = spherical;
            wd       = spherical_deviatoric;
            missed_d = 1.;
          }
      }
    else if (form == Form::paper)
      report.fallback = any_negative(wh, spherical);
    else if (report.indefinite && deviatoric_conditions.correct_nonnegative(spherical_deviatoric, wd))
      missed_d = 0.;
    else if (report.indefinite)
      {
        report.fallback = true;
        missed_d        = 1.;
        wd              = scaled_to_trace(family, spherical_deviatoric);
      }
    report.singular = std::max(missed_h, missed_d) > MomentConditions<dim, 4>::tolerance;
    return report;
  }

  template <int dim>
  void ExtendedOrdinary<dim>::compute(const FamilyView<dim> &family, FamilyCoefficients &coefficients)
  {
    coefficients.report = weigh(family, wh, wd);
    if (form == Form::paper)
      compute_paper(family, coefficients);
    else
      compute_energy(family, coefficients);
  }

  template <int dim>
  void ExtendedOrdinary<dim>::compute_paper(const FamilyView<dim> &family,
                                            FamilyCoefficients    &coefficients) const
  {
    // t = kappa wh |xi| theta + 2 mu wd (e - theta |xi|/dim)      (70)
    // theta always has the corrected weight; the force has the spherical ones
    // in a fallback family.
    // W = kappa theta^2/2 + mu sum_j wd (e - theta |xi|/dim)^2 V_j in these terms:
    // V W = theta sum_j force_weight_j eps_j + sum_j stiffness_j eps_j^2/2 + c theta^2.
    const double mu = family.shear_modulus, kappa = family.bulk_modulus;
    double       s       = 0;
    const auto  &force_h = coefficients.report.fallback ? spherical : wh;
    const auto  &force_d = coefficients.report.fallback ? spherical_deviatoric : wd;
    for (LocalIndex j = 0; j < family.size; ++j)
      {
        const double volumes            = family.node_volume * family.volume[j];
        coefficients.sum[0][j]          = wh[j] * family.volume[j];
        coefficients.force_weight[0][j] = volumes * (kappa * force_h[j] - 2. * mu / dim * force_d[j]);
        coefficients.stiffness[j]       = 2. * mu * volumes * force_d[j] / family.length_square[j];
        s += force_d[j] * family.length_square[j] * family.volume[j];
      }
    coefficients.map    = {{1., 0., 0.}};
    coefficients.energy = family.node_volume * (mu * s / (dim * dim) - 0.5 * kappa);
  }

  template <int dim>
  void ExtendedOrdinary<dim>::compute_energy(const FamilyView<dim> &family,
                                             FamilyCoefficients    &coefficients) const
  {
    // t = wh |xi| (kappa theta - 2 mu q/dim) + 2 mu wd (e - theta |xi|/dim),
    // q = sum_j wd e^d |xi| V_j = h - theta s/dim,
    // h = sum_j wd |xi| e V_j,  s = sum_j wd |xi|^2 V_j:
    // sums (theta, h), states A = V (kappa theta - 2 mu q/dim), B = -2 mu V theta/dim.
    const double mu = family.shear_modulus, kappa = family.bulk_modulus;
    double       s = 0;
    for (LocalIndex j = 0; j < family.size; ++j)
      {
        coefficients.sum[0][j] = wh[j] * family.volume[j];
        coefficients.sum[1][j] = wd[j] * family.volume[j];
        coefficients.stiffness[j] =
          2. * mu * family.node_volume * wd[j] * family.volume[j] / family.length_square[j];
        s += wd[j] * family.length_square[j] * family.volume[j];
      }
    const double coupling = -2. * mu * family.node_volume / dim;
    coefficients.map      = {{family.node_volume * kappa - coupling * s / dim, coupling, 0.}};
  }

  namespace
  {
    template <int dim, bool as_published>
    std::unique_ptr<LinearModel<dim>>
    create(const ModelParameters &parameters, const double thickness, const std::vector<double> &)
    {
      using Model = ExtendedOrdinary<dim>;
      return std::make_unique<Model>(as_published ? Model::Form::paper : Model::Form::energy,
                                     InfluenceFunction(parameters.influence_function),
                                     thickness,
                                     parameters.after_the_cut() ? Model::Negative::spherical :
                                                                  Model::Negative::by_form);
    }

    void declare(dealii::ParameterHandler &prm, ModelParameters &parameters)
    {
      prm.add_parameter(
        "Multipliers",
        parameters.multipliers,
        "Multipliers of the extended ordinary model where precracks cut bonds: intact: those of "
        "the whole families; after the cut: those of what is left of them, with spherical "
        "weights in families where any weight would be negative; recomputed: the same again and again as "
        "bonds break (energy form in dynamics; slower, and the energy is kept less well)");
    }
  } // namespace

  namespace models
  {
    ModelTraits extended_ordinary()
    {
      using Model = ExtendedOrdinary<2>;
      FormTraits paper, energy;
      // Families with a negative weight have the spherical ones in their force.
      paper.name                    = "paper";
      paper.meaning                 = "as published, not the gradient of an energy, non-symmetric";
      paper.shape                   = Model::family_shape(Model::Form::paper);
      paper.create                  = {&create<2, true>, &create<3, true>};
      paper.follows_from_energy     = false;
      paper.is_made_for_each_family = false;
      paper.has_multipliers         = true;
      energy.name                   = "energy";
      energy.meaning                = "the gradient of the strain energy over bonds, symmetric";
      energy.shape                  = Model::family_shape(Model::Form::energy);
      energy.create                 = {&create<2, false>, &create<3, false>};
      energy.has_multipliers        = true;

      ModelTraits result;
      result.name          = "extended ordinary";
      result.meaning       = "with multipliers that make families of any shape exact for uniform strain";
      result.forms         = {consistent_form(), energy, paper};
      result.default_forms = {
        consistent_form().name, energy.name, consistent_form().name, energy.name, energy.name};
      result.critical_stretch = &ordinary_critical_stretch;
      result.declare          = &declare;
      return result;
    }
  } // namespace models

  PERIDEAL_INSTANTIATE_CLASS(ExtendedOrdinary)
} // namespace perideal
