// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/operators/force/correspondence_force.h>
#include <perideal/operators/weights/calibrated_stretches.h>
#include <perideal/parameters/stress_criteria.h>
#include <perideal/problem/failure.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace perideal
{
  namespace
  {
    /// Gives bonds that break by stress the strengths of their materials.
    template <int dim>
    void set_strengths(const Body<dim>                                               &body,
                       const std::function<bool(const LocalIndex, const LocalIndex)> &can_break,
                       CorrespondenceForce<dim>                                      &force)
    {
      std::map<dealii::types::material_id, StressCriterion> criteria;
      for (const auto id : body.mesh->material_ids)
        criteria[id] = stress_criterion(body.parameters.material, body.properties_of(id));
      force.set_strength(
        [criteria](const dealii::types::material_id id, const dealii::SymmetricTensor<2, 3> &stress) {
          return criteria.at(id).utilisation(stress);
        },
        can_break);
    }

    /// s_0 over s_d of bonds without a strength. The crack of a square with a slit then dissipates 1.01 of
    /// the fracture energy an area, those in the field of a stress intensity factor grow within 3 degrees of
    /// their direction (springs and energy form, horizon 3.01, at 0 to 45 degrees to the grid). With the root
    /// of 1/3 bonds beside the crack soften too, and it dissipates 1.06; above .8 the grid traps it.
    const double first_share = std::sqrt(1. / 2.);

    /// Critical stretches by bond, given by their row and slot.
    template <int dim>
    class BondLimits
    {
    public:
      /// Collective.
      /// @param with_shares whether shares() is asked for
      BondLimits(const Body<dim>         &body,
                 const DiscreteBody<dim> &discretisation,
                 const BondList          &bonds,
                 const bool               with_shares = false)
        : body(body)
        , families(*discretisation.families)
      {
        if (!body.parameters.model.calibrates_bonds())
          return;
        Calibration<dim> how;
        how.fracture_of = [this](const auto id) {
          const auto [strain, lateral]       = strain_of_strength(id);
          const MaterialProperties &material = this->body.properties_of(id);
          const double              energy   = material.mean_fracture_energy();
          BondFracture<dim>         result;
          result.energy = energy;
          if (energy > 0)
            result.by_normal = material.fracture_energy_by_normal<dim>() / energy;
          result.of_strength = strain;
          result.lateral     = lateral;
          return result;
        };
        how.law         = SofteningLaw(body.parameters.material.softening);
        how.first_share = first_share;
        how.with_shares = with_shares;
        calibrated =
          calibrate_stretches<dim>(families, bonds, *discretisation.model, solids_of_model(body), how);
      }

      double operator()(const LocalIndex i, const LocalIndex j, const BondIndex slot) const
      {
        const auto near = families.material[i], far = families.material[j];
        // Between unequal horizons the mean, between materials the weaker one (XOSB eqs. 81, 86).
        if (calibrated.near.empty())
          {
            const double horizon = 0.5 * (families.horizon[i] + families.horizon[j]);
            return std::min(Failure<dim>::critical_stretch(body, near, horizon),
                            Failure<dim>::critical_stretch(body, far, horizon));
          }
        const double of_near = square(near, calibrated.near[slot]),
                     of_far  = square(far, calibrated.far[slot]);
        return std::sqrt(near == far ? 0.5 * (of_near + of_far) : std::min(of_near, of_far));
      }

      /// The stretch at which a bond begins to soften: that with which families bear the tensile strength, of
      /// the weaker material; or a share of the stretch at which it would break at once.
      double first(const LocalIndex i, const LocalIndex j, const BondIndex slot) const
      {
        const auto of_end = [&](const LocalIndex end, const std::vector<double> &of_family) {
          if (!of_family.empty() && of_family[slot] > 0)
            return of_family[slot];
          const double of_strength = strain_of_strength(families.material[end]).first;
          return of_strength > 0 ? of_strength : first_share * (*this)(i, j, slot);
        };
        const double of_near = of_end(i, calibrated.first_near), of_far = of_end(j, calibrated.first_far);
        return families.material[i] == families.material[j] ? 0.5 * (of_near + of_far) :
                                                              std::min(of_near, of_far);
      }

      const EnergyByDirection &shares() const { return calibrated.shares; }

    private:
      /// The strain along a uniaxial stress of the tensile strength, and its contraction over that [-]; {0,
      /// 0} of materials without one.
      std::pair<double, double> strain_of_strength(const dealii::types::material_id id) const
      {
        const double strength = body.properties_of(id).tensile_strength;
        if (!(strength > 0))
          return {0., 0.};
        const ElasticConstants solid   = body.solids.at(id).isotropic();
        const double           nu      = solid.poisson_ratio;
        const bool             is_thin = solid.assumption != PlaneAssumption::plane_strain;
        return {strength / solid.young_modulus * (is_thin ? 1. : 1. - nu * nu),
                is_thin ? nu : nu / (1. - nu)};
      }

      /// The square of the stretch for an end of a material.
      double square(const dealii::types::material_id id, const double of_unit_energy) const
      {
        const double stretch = Failure<dim>::critical_stretch(body, id, 0.),
                     energy  = body.properties_of(id).mean_fracture_energy();
        return std::isfinite(stretch)      ? stretch * stretch :
               energy * of_unit_energy > 0 ? energy * of_unit_energy :
                                             std::numeric_limits<double>::infinity();
      }

      const Body<dim>     &body;
      const Families<dim> &families;
      CalibratedStretches  calibrated;
    };
  } // namespace

  template <int dim>
  void Failure<dim>::prepare(const Body<dim> &body)
  {
    for (const PrecrackText &text : body.parameters.precracks.cracks)
      precracks.emplace_back(text, *body.mesh);
    if (body.parameters.no_fail.zones.empty())
      return;
    no_fail_zones   = std::make_unique<NoFailZones<dim>>(body.parameters.no_fail, *body.mesh);
    n_no_fail_nodes = no_fail_zones->count(*body.nodes);
  }

  template <int dim>
  BondPredicate<dim> Failure<dim>::precrack_test() const
  {
    if (precracks.empty())
      return {};
    return [this](const dealii::Point<dim> &a, const dealii::Point<dim> &b) {
      return std::any_of(
        precracks.begin(), precracks.end(), [&](const auto &crack) { return crack.crosses(a, b); });
    };
  }

  template <int dim>
  void Failure<dim>::check_precracks(const Body<dim> &body, const Families<dim> &families) const
  {
    for (std::size_t k = 0; k < precracks.size(); ++k)
      {
        const auto cuts_family = [&](const LocalIndex i) {
          return std::any_of(families.begin(i), families.end(i), [&](const LocalIndex j) {
            return precracks[k].crosses(families.position[i], families.position[j]);
          });
        };
        unsigned int cuts = 0;
        for (LocalIndex i = 0; i < families.n_owned() && cuts == 0; ++i)
          cuts = cuts_family(i) ? 1 : 0;
        if (dealii::Utilities::MPI::max(cuts, body.nodes->communicator) == 0)
          throw InputError("this precrack cuts no bond: it lies outside the body, or between nodes")
            .parameter("Precracks/" + body.parameters.precracks.cracks[k].name)
            .hint("the body extends over " + body.box_in_words());
      }
  }

  template <int dim>
  double Failure<dim>::critical_stretch(const Body<dim>                 &body,
                                        const dealii::types::material_id id,
                                        const double                     horizon)
  {
    const MaterialProperties &material = body.properties_of(id);
    if (material.critical_stretch > 0)
      return material.critical_stretch;
    if (material.mean_fracture_energy() > 0 && !body.parameters.model.calibrates_bonds())
      return body.parameters.model.critical_stretch(
        body.solids.at(id).isotropic(), material.mean_fracture_energy(), horizon);
    return std::numeric_limits<double>::infinity();
  }

  template <int dim>
  void
  Failure<dim>::apply(const Body<dim> &body, const DiscreteBody<dim> &discretisation, BondForce<dim> &force)
  {
    if (!precracks.empty())
      n_cut_bonds = force.cut(precrack_test());
    if (!can_break(body.parameters))
      return;
    const Families<dim> &families = *discretisation.families;
    std::vector<bool>    unbreakable(families.n_local(), false);
    if (no_fail_zones)
      for (LocalIndex i = 0; i < families.n_local(); ++i)
        unbreakable[i] = no_fail_zones->contains(families.position[i]);
    if (auto *by_stress = dynamic_cast<CorrespondenceForce<dim> *>(&force))
      {
        set_strengths<dim>(
          body,
          [&](const LocalIndex i, const LocalIndex j) { return !unbreakable[i] && !unbreakable[j]; },
          *by_stress);
        return;
      }
    const BondList       &bonds = force.bond_list();
    const BondLimits<dim> limits(body, discretisation, bonds);
    force.set_critical_stretch(
      [&](const LocalIndex i, const LocalIndex j) {
        return unbreakable[i] || unbreakable[j] ? std::numeric_limits<double>::infinity() :
                                                  limits(i, j, bonds.find(i, j));
      },
      SofteningLaw(body.parameters.material.softening),
      [&](const LocalIndex i, const LocalIndex j) { return limits.first(i, j, bonds.find(i, j)); });
  }

  template <int dim>
  typename Failure<dim>::Breaking Failure<dim>::breaking(const Body<dim>         &body,
                                                         const DiscreteBody<dim> &discretisation)
  {
    const Families<dim>  &families = *discretisation.families;
    const BondList       &bonds    = discretisation.weights->bonds;
    const BondLimits<dim> limits(body, discretisation, bonds, true);
    Breaking              result;
    for (const auto id : body.mesh->material_ids)
      {
        double square = 0, number = 0;
        for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
          for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
            if (const LocalIndex j = bonds.neighbour[slot];
                j != i && families.material[i] == id && families.material[j] == id)
              if (const double stretch = limits(i, j, slot); std::isfinite(stretch))
                {
                  square += stretch * stretch;
                  ++number;
                }
        square = dealii::Utilities::MPI::sum(square, families.communicator);
        number = dealii::Utilities::MPI::sum(number, families.communicator);
        if (number > 0)
          result.stretch[id] = std::sqrt(square / number);
      }
    if (body.parameters.model.calibrates_bonds())
      result.share_of_energy = limits.shares();
    return result;
  }

  template <int dim>
  std::vector<double> total_damage(const BondForce<dim> &force)
  {
    std::vector<double>       result = force.damage();
    const std::vector<double> cut    = force.cut_share();
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] += cut[i];
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(Failure)
  PERIDEAL_INSTANTIATE(total_damage)
} // namespace perideal
