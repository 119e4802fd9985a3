// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/force/breaking_bonds.h>
#include <perideal/operators/force/intact_gradients.h>
#include <perideal/operators/force/zoned_force.h>
#include <perideal/output/lasting_state.h>

#include <deal.II/base/memory_consumption.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/timer.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace perideal
{
  namespace
  {
    void add(std::vector<bool> &chosen, const std::vector<bool> &more)
    {
      for (std::size_t i = 0; i < chosen.size(); ++i)
        chosen[i] = chosen[i] || more[i];
    }

    std::vector<double> shares_of_cells(std::vector<double> of_bonds)
    {
      for (double &share : of_bonds)
        share = 1. - share;
      return of_bonds;
    }

    /// Chooses needed nodes and, as all families are made again, half as many more at least than there were:
    /// however a zone grows, that takes some times what making the last ones takes. Collective.
    template <int dim>
    void choose(const Families<dim> &families, const std::vector<bool> &needed, std::vector<bool> &chosen)
    {
      using dealii::Utilities::MPI::sum;
      const auto count = [&] {
        const GlobalIndex own = std::count(chosen.begin(), chosen.begin() + families.n_owned(), true);
        return sum(own, families.communicator);
      };
      const GlobalIndex enough = 3 * count() / 2;
      add(chosen, needed);
      // Further ones may not be there, or be parts that nothing joins to the zone.
      GlobalIndex now = count(), before = 0;
      do
        {
          before = now;
          add(chosen, families.with_members(chosen));
          now = count();
        }
      while (now < enough && now > before);
    }

    /// Owned nodes outside of the core of a zone with a share of the strains that are their limits.
    template <int dim>
    std::vector<LocalIndex> nodes_near_breaking(const ConsistentForce<dim> &cells,
                                                const FractureZone<dim>    &zone,
                                                const std::vector<double>  &limit,
                                                const double                share)
    {
      std::vector<LocalIndex> result;
      for (LocalIndex i = 0; i < limit.size(); ++i)
        {
          if (zone.is_core(i))
            continue;
          const double most = 1. + share * limit[i], most_strain = 0.5 * (most * most - 1.);
          const auto   strain = cells.strain(i);
          // No eigenvalue is larger than the norm.
          if (strain.norm() > most_strain && eigenvalues(strain)[0] > most_strain)
            result.push_back(i);
        }
      return result;
    }

    /// Memory of the bonds of whole families, with their weights and those that are scaled, if any [B].
    template <int dim>
    std::size_t
    bytes_of(const BondForce<dim> &bonds, const BondWeights<dim> &whole, const BondWeights<dim> *scaled)
    {
      return bonds.memory_consumption() + whole.memory_consumption() + whole.families->memory_consumption() +
             (scaled ? scaled->memory_consumption() : 0);
    }
  } // namespace

  template <int dim>
  ZonedForce<dim>::ZonedForce(std::unique_ptr<ConsistentForce<dim>>                     given,
                              const std::shared_ptr<const Families<dim>>               &families,
                              const Weigh                                              &weigh,
                              const std::vector<std::pair<dealii::Point<dim>, double>> &held,
                              const bool                                                all_at_once)
    : WrappedBonds<dim>(nullptr, *families)
    , cells(std::move(given))
    , families(families)
    , zone(families, held)
    , making{weigh, {}, {}, std::vector<bool>(families->n_local(), all_at_once), {}, 0, 0.}
    , limit(families->n_owned(), std::numeric_limits<double>::infinity())
  {
    this->initialize(of_cells);
    this->initialize(change.force);
    make_bonds();
  }

  template <int dim>
  void ZonedForce<dim>::set_limits(const Limits &limits)
  {
    making.set_limits = limits.set;
    limits.set(*whole->families, *bonds);
    for (LocalIndex i = 0; i < limit.size(); ++i)
      limit[i] = limits.first_strain(i);
    onset = StressOnset<dim>(limits.criterion, families->n_owned());
    cells->set_shares(shares_of_cells(zone.share()));
    scale_bonds();
  }

  template <int dim>
  GlobalIndex ZonedForce<dim>::cut(const BondPredicate<dim> &is_cut)
  {
    making.is_cut = is_cut;
    // Of bonds that a crack cuts, the short ones are known; long ones are near them.
    const BondList   &listed = cells->bond_list();
    std::vector<bool> near(families->n_local(), false);
    for (LocalIndex i = 0; i < listed.n_rows(); ++i)
      for (BondIndex slot = listed.row[i]; slot < listed.row[i + 1]; ++slot)
        if (const LocalIndex j = listed.neighbour[slot];
            j != i && is_cut(families->position[i], families->position[j]))
          near[i] = near[j] = true;
    add(making.chosen, families->with_members(families->with_members(near)));
    make_bonds();
    return making.n_cut;
  }

  template <int dim>
  void ZonedForce<dim>::make_bonds()
  {
    const dealii::Timer clock(MPI_COMM_SELF);
    whole     = making.weigh(families->whole_families(making.chosen));
    auto made = create_bond_force<dim>(*whole);
    if (making.is_cut)
      making.n_cut = made->cut(making.is_cut);
    if (making.set_limits)
      making.set_limits(*whole->families, *made);
    if (bonds)
      made->restore(dynamic_cast<BreakingBonds<dim> &>(*bonds).memory());
    made->judge_bonds(judgement);
    bonds            = std::move(made);
    making.is_inside = families->with_all_members(making.chosen);
    making.seconds += clock.wall_time();
  }

  template <int dim>
  void ZonedForce<dim>::judge_bonds(const Judgement given)
  {
    judgement = given;
    bonds->judge_bonds(given);
  }

  template <int dim>
  void ZonedForce<dim>::scale_bonds()
  {
    scaled = whole->scaled(zone.share());
    bonds->take_weights(*scaled, zone.share());
  }

  template <int dim>
  bool ZonedForce<dim>::grow(const std::vector<LocalIndex> &nodes, const NodalVector &displacement)
  {
    change.force  = 0.;
    change.energy = 0.;
    NodalVector of_bonds(of_cells);
    const auto  look = [&](const double sign) {
      bonds->judge_bonds(Judgement::on_trial);
      bonds->compute(of_bonds, displacement);
      bonds->judge_bonds(judgement);
      change.force.add(sign, of_bonds);
      change.energy -= sign * bonds->strain_energy();
    };
    if (zone.is_there())
      look(-1.);
    change.is_there = zone.grow(nodes);
    if (!change.is_there)
      return false;
    std::vector<bool> counts(families->n_local());
    unsigned int      lacks = 0;
    for (LocalIndex i = 0; i < counts.size(); ++i)
      {
        counts[i] = zone.share()[i] > 0;
        lacks     = counts[i] && !making.is_inside[i] ? 1 : lacks;
      }
    if (dealii::Utilities::MPI::max(lacks, families->communicator) > 0)
      {
        choose(*families, families->with_members(counts), making.chosen);
        make_bonds();
      }
    scale_bonds();
    change.force -= of_cells;
    change.energy -= cells->change_shares(shares_of_cells(zone.share()), of_cells);
    change.force += of_cells;
    look(1.);
    return true;
  }

  template <int dim>
  bool ZonedForce<dim>::extend_bonds(const NodalVector &displacement)
  {
    const auto near = [&](const double share) { return nodes_near_breaking(*cells, zone, limit, share); };
    const unsigned int comes_near = near(near_to_breaking).empty() ? 0 : 1;
    if (dealii::Utilities::MPI::max(comes_near, displacement.get_mpi_communicator()) > 0 &&
        grow(near(alike * near_to_breaking), displacement))
      return true;
    return zone.is_there() &&
           onset.start(*cells, *families, dynamic_cast<BreakingBonds<dim> &>(*bonds), zone.share());
  }

  template <int dim>
  void ZonedForce<dim>::compute(NodalVector &force, const NodalVector &displacement)
  {
    change.is_there = false;
    cells->compute(of_cells, displacement);
    // Bonds are told when to begin by where they were before.
    if (judgement == Judgement::for_good)
      extend_bonds(displacement);
    bonds->compute(force, displacement);
    force += of_cells;
    onset.keep(*families, *bonds, judgement == Judgement::for_good);
  }

  template <int dim>
  std::vector<dealii::Tensor<2, dim>> ZonedForce<dim>::gradients() const
  {
    std::vector<dealii::Tensor<2, dim>> result = cells->gradients();
    std::vector<LocalIndex>             nodes;
    for (LocalIndex i = 0; i < result.size(); ++i)
      if (zone.share()[i] > 0)
        nodes.push_back(i);
    const auto in_zone = intact_gradients(*families, *bonds, displacement_of(*families, *bonds), nodes);
    for (std::size_t k = 0; k < nodes.size(); ++k)
      result[nodes[k]] = in_zone[k];
    return result;
  }

  template <int dim>
  std::vector<double> ZonedForce<dim>::utilisation() const
  {
    std::vector<double> result = bonds->utilisation();
    for (LocalIndex i = 0; i < result.size(); ++i)
      if (zone.share()[i] == 0.)
        result[i] = (std::sqrt(std::max(0., 1. + 2. * eigenvalues(cells->strain(i))[0])) - 1.) / limit[i];
    return result;
  }

  template <int dim>
  double ZonedForce<dim>::strain_energy() const
  {
    return cells->strain_energy() + (zone.is_there() ? bonds->strain_energy() : 0.);
  }

  template <int dim>
  double ZonedForce<dim>::switched_energy(const NodalVector &velocity, const double time_step) const
  {
    return change.is_there ? change.energy - 0.5 * time_step * (velocity * change.force) : 0.;
  }

  template <int dim>
  void ZonedForce<dim>::register_state(LastingState &state)
  {
    state.add_node_array(
      "whole families",
      "-",
      1,
      [this] {
        return std::vector<double>(making.chosen.begin(), making.chosen.begin() + families->n_owned());
      },
      [this](const std::vector<double> &values) {
        NodalVector chosen(families->make_partitioner(1));
        std::copy_n(values.begin(), families->n_owned(), chosen.begin());
        chosen.update_ghost_values();
        for (LocalIndex i = 0; i < families->n_local(); ++i)
          making.chosen[i] = chosen.local_element(i) > 0;
        make_bonds();
      });
    state.add_node_array(
      "share of bonds",
      "-",
      2,
      [this] { return zone.state(); },
      [this](const std::vector<double> &values) {
        zone.restore(values);
        cells->set_shares(shares_of_cells(zone.share()));
        scale_bonds();
      });
    BreakingBonds<dim>::register_bonds(
      state, [this]() -> BreakingBonds<dim> & { return dynamic_cast<BreakingBonds<dim> &>(*bonds); });
  }

  template <int dim>
  typename ZonedForce<dim>::WholeFamilies ZonedForce<dim>::whole_families() const
  {
    using dealii::Utilities::MPI::sum;
    const MPI_Comm communicator = families->communicator;
    WholeFamilies  result;
    const auto     first = making.chosen.begin();
    result.nodes =
      sum(static_cast<GlobalIndex>(std::count(first, first + families->n_owned(), true)), communicator);
    result.bytes   = sum(bytes_of(*bonds, *whole, scaled.get()), communicator);
    result.seconds = dealii::Utilities::MPI::max(making.seconds, communicator);
    return result;
  }

  template <int dim>
  std::size_t ZonedForce<dim>::memory_consumption() const
  {
    return cells->memory_consumption() + bytes_of(*bonds, *whole, scaled.get()) + zone.memory_consumption() +
           dealii::MemoryConsumption::memory_consumption(limit) + 2 * of_cells.memory_consumption();
  }

  PERIDEAL_INSTANTIATE_CLASS(ZonedForce)
} // namespace perideal
