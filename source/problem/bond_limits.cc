// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/problem/bond_limits.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace perideal
{
  namespace
  {
    constexpr double never = std::numeric_limits<double>::infinity();

    /// s_0 over s_d of bonds without a strength. The crack of a square with a slit then dissipates 1.01 of
    /// the fracture energy an area, those in the field of a stress intensity factor grow within 3 degrees of
    /// their direction (springs and energy form, horizon 3.01, at 0 to 45 degrees to the grid). With the root
    /// of 1/3 bonds beside the crack soften too, and it dissipates 1.06; above .8 the grid traps it.
    const double first_share = std::sqrt(1. / 2.);

    /// What bonds that break are of.
    template <int dim>
    ModelParameters model_of_bonds(const Body<dim> &body)
    {
      const ModelParameters &model = body.parameters.model;
      return has_fracture_zone(body.parameters) ? model.in_zone() : model;
    }

    /// Returns the critical stretch of a material at a horizon by the formula of the scene [-]; infinity:
    /// unbreakable. Of scenes that calibrate their bonds, a stretch that is given.
    /// @param model what bonds that break are of
    template <int dim>
    double critical_stretch(const ModelParameters           &model,
                            const Body<dim>                 &body,
                            const dealii::types::material_id id,
                            const double                     horizon)
    {
      const MaterialProperties &material = body.properties_of(id);
      if (material.critical_stretch > 0)
        return material.critical_stretch;
      if (material.mean_fracture_energy() > 0 && !body.parameters.model.calibrates_bonds())
        return model.critical_stretch(
          body.solids.at(id).isotropic(), material.mean_fracture_energy(), horizon);
      return never;
    }
  } // namespace

  template <int dim>
  std::pair<double, double> strain_of_strength(const Body<dim> &body, const dealii::types::material_id id)
  {
    const double strength = body.properties_of(id).tensile_strength;
    if (!(strength > 0))
      return {0., 0.};
    const ElasticConstants solid   = body.solids.at(id).isotropic();
    const double           nu      = solid.poisson_ratio;
    const bool             is_thin = solid.assumption != PlaneAssumption::plane_strain;
    return {strength / solid.young_modulus * (is_thin ? 1. : 1. - nu * nu), is_thin ? nu : nu / (1. - nu)};
  }

  template <int dim>
  double first_strain(const Body<dim> &body, const dealii::types::material_id id, const double horizon)
  {
    const ModelParameters     model    = model_of_bonds(body);
    const MaterialProperties &material = body.properties_of(id);
    // Of the bonds of a family that are calibrated, the first begin to fail at .75 to .84 of what their
    // material says (squares and cubes, horizons 3.01 and 5.01, with a strength and without).
    const double first_of_family = model.calibrates_bonds() ? 0.75 : 1.;
    if (const double strain = strain_of_strength(body, id).first; strain > 0)
      return first_of_family * strain;
    const double softening = SofteningLaw(body.parameters.material.softening).softens() ? first_share : 1.;
    if (material.critical_stretch > 0)
      return softening * material.critical_stretch;
    if (material.mean_fracture_energy() > 0)
      return first_of_family * softening *
             model.critical_stretch(body.solids.at(id).isotropic(), material.mean_fracture_energy(), horizon);
    return never;
  }

  template <int dim>
  BondLimits<dim>::BondLimits(const Body<dim>         &body,
                              const DiscreteBody<dim> &discretisation,
                              const Families<dim>     &families,
                              const BondList          &bonds,
                              const Calibrating       &calibrating)
    : body(body)
    , families(families)
    , model(model_of_bonds(body))
    , law(body.parameters.material.softening)
  {
    if (!body.parameters.model.calibrates_bonds())
      return;
    Calibration<dim> how;
    how.fracture_of = [&body](const auto id) {
      const auto [strain, lateral]       = strain_of_strength(body, id);
      const MaterialProperties &material = body.properties_of(id);
      const double              energy   = material.mean_fracture_energy();
      BondFracture<dim>         result;
      result.energy = energy;
      if (energy > 0)
        result.by_normal = material.fracture_energy_by_normal<dim>() / energy;
      result.of_strength = strain;
      result.lateral     = lateral;
      return result;
    };
    how.of_continuum = [&body, this](const auto id, const double horizon) {
      const double energy  = body.properties_of(id).mean_fracture_energy();
      const double stretch = model.critical_stretch(body.solids.at(id).isotropic(), energy, horizon);
      return stretch * stretch / energy;
    };
    how.law         = law;
    how.first_share = first_share;
    how.with_shares = calibrating.with_shares;
    how.memo        = calibrating.memo;
    how.is_wanted   = calibrating.is_wanted;
    calibrated = calibrate_stretches<dim>(families, bonds, *discretisation.model, solids_of_model(body), how);
  }

  template <int dim>
  double BondLimits<dim>::operator()(const LocalIndex i, const LocalIndex j, const BondIndex slot) const
  {
    const auto near = families.material[i], far = families.material[j];
    // Between unequal horizons the mean, between materials the weaker one (XOSB eqs. 81, 86).
    if (calibrated.near.empty())
      {
        const double horizon = 0.5 * (families.finest_horizon(i) + families.finest_horizon(j));
        const double of_near = critical_stretch(model, body, near, horizon);
        return near == far ? of_near : std::min(of_near, critical_stretch(model, body, far, horizon));
      }
    const auto of_cells = [&](const double share_near, const double share_far) {
      const double of_near = square(near, calibrated.near[slot] / share_near),
                   of_far  = square(far, calibrated.far[slot] / share_far);
      return near == far ? 0.5 * (of_near + of_far) : std::min(of_near, of_far);
    };
    // Bonds that begin to soften at a strength do so in cells of any size, and take what a crack takes.
    if (strain_of_strength(body, near).first > 0 && strain_of_strength(body, far).first > 0)
      if (const double own = of_cells(1., 1.); law.is_stable(first(i, j, slot), own))
        return std::sqrt(own);
    return std::sqrt(of_cells(families.finest_share(i), families.finest_share(j)));
  }

  template <int dim>
  double BondLimits<dim>::first(const LocalIndex i, const LocalIndex j, const BondIndex slot) const
  {
    const auto of_end = [&](const LocalIndex end, const std::vector<double> &of_family) {
      if (!of_family.empty() && of_family[slot] > 0)
        return of_family[slot];
      const double of_strength = strain_of_strength(body, families.material[end]).first;
      return of_strength > 0 ? of_strength : first_share * (*this)(i, j, slot);
    };
    const double of_near = of_end(i, calibrated.first_near), of_far = of_end(j, calibrated.first_far);
    return families.material[i] == families.material[j] ? 0.5 * (of_near + of_far) :
                                                          std::min(of_near, of_far);
  }

  template <int dim>
  double BondLimits<dim>::square(const dealii::types::material_id id, const double of_unit_energy) const
  {
    const double stretch = critical_stretch(model, body, id, 0.),
                 energy  = body.properties_of(id).mean_fracture_energy();
    // The least of a family that is not calibrated has a sign.
    const double of_energy = energy * std::abs(of_unit_energy);
    return std::isfinite(stretch) ? stretch * stretch : of_energy > 0 ? of_energy : never;
  }

  PERIDEAL_INSTANTIATE(strain_of_strength)
  PERIDEAL_INSTANTIATE(first_strain)
  PERIDEAL_INSTANTIATE_CLASS(BondLimits)
} // namespace perideal
