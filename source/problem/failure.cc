// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/operators/force/correspondence_force.h>
#include <perideal/operators/force/zoned_force.h>
#include <perideal/parameters/stress_criteria.h>
#include <perideal/problem/bond_limits.h>
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
    /// Returns the share of its strength that a stress takes of each material.
    template <int dim>
    typename CorrespondenceForce<dim>::Utilisation utilisation_of_strengths(const Body<dim> &body)
    {
      std::map<dealii::types::material_id, StressCriterion> criteria;
      for (const auto id : body.mesh->material_ids)
        criteria[id] = stress_criterion(body.parameters.material, body.properties_of(id));
      return [criteria](const dealii::types::material_id id, const dealii::SymmetricTensor<2, 3> &stress) {
        return criteria.at(id).utilisation(stress);
      };
    }

    /// What gives bonds their critical stretches.
    template <int dim>
    struct StretchesOfBonds
    {
      const Body<dim>                                        &body;
      const DiscreteBody<dim>                                &discretisation;
      const Families<dim>                                    &families;
      std::function<bool(const LocalIndex, const LocalIndex)> can_break;
      std::shared_ptr<CalibrationMemo>                        memo;
    };

    /// Sets those of the bonds between some nodes, at least; others are calibrated on demand. Returns whether
    /// there are others. Collective.
    template <int dim>
    bool set_stretches(const StretchesOfBonds<dim> &of, BondForce<dim> &force, const std::vector<bool> &nodes)
    {
      const MaterialParameters &material = of.body.parameters.material;
      const SofteningLaw        law(material.softening, material.has_criterion());
      const BondList           &bonds     = force.bond_list();
      const bool                on_demand = of.memo && !law.waits() && !of.body.parameters.model.recomputes();
      const BondLimits<dim>     limits(of.body,
                                   of.discretisation,
                                   of.families,
                                   bonds,
                                   {false,
                                        of.memo.get(),
                                    on_demand ?
                                          [&](const LocalIndex i) { return !nodes.empty() && nodes[i]; } :
                                          std::function<bool(const LocalIndex)>()});
      UnknownLimits::Source     unknown;
      if (!limits.are_all_known())
        unknown = {[&](const LocalIndex i, const LocalIndex j) { return limits.is_known(bonds.find(i, j)); },
                   [of, &force](const std::vector<bool> &more) { set_stretches(of, force, more); }};
      force.set_critical_stretch(
        [&](const LocalIndex i, const LocalIndex j) {
          return of.can_break(i, j) ? limits(i, j, bonds.find(i, j)) :
                                      std::numeric_limits<double>::infinity();
        },
        law,
        [&](const LocalIndex i, const LocalIndex j) { return limits.first(i, j, bonds.find(i, j)); },
        unknown);
      return !limits.are_all_known();
    }
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
    const auto can_both = [unbreakable](const LocalIndex i, const LocalIndex j) {
      return !unbreakable[i] && !unbreakable[j];
    };
    if (auto *by_stress = dynamic_cast<CorrespondenceForce<dim> *>(&force))
      {
        by_stress->set_strength(utilisation_of_strengths(body), can_both);
        return;
      }
    const auto set_limits = [&body, &discretisation, can_both, memo = calibrations](
                              const Families<dim> &of, BondForce<dim> &bonds_of) {
      return set_stretches<dim>({body, discretisation, of, can_both, memo}, bonds_of, {});
    };
    auto *zoned = dynamic_cast<ZonedForce<dim> *>(&force);
    if (zoned == nullptr)
      {
        calibrates_later = set_limits(families, force);
        return;
      }
    typename ZonedForce<dim>::Limits limits{
      set_limits, [&](const LocalIndex i) {
        return unbreakable[i] ? std::numeric_limits<double>::infinity() :
                                first_strain(body, families.material[i], families.finest_horizon(i));
      }};
    if (body.parameters.material.has_criterion())
      {
        limits.criterion.uniaxial = [&](const LocalIndex i) {
          return strain_of_strength(body, families.material[i]);
        };
        limits.criterion.utilisation = [&families, of_material = utilisation_of_strengths(body)](
                                         const LocalIndex i, const dealii::SymmetricTensor<2, 3> &stress) {
          return of_material(families.material[i], stress);
        };
      }
    zoned->set_limits(limits);
  }

  template <int dim>
  typename Failure<dim>::Breaking Failure<dim>::breaking(const Body<dim>         &body,
                                                         const DiscreteBody<dim> &discretisation)
  {
    const auto            whole    = discretisation.sample_of_whole_families();
    const Families<dim>  &families = *whole;
    const BondList        bonds(families);
    const BondLimits<dim> limits(body, discretisation, families, bonds, {true});
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
