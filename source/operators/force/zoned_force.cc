// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/force/intact_gradients.h>
#include <perideal/operators/force/zoned_force.h>
#include <perideal/output/lasting_state.h>

#include <deal.II/base/memory_consumption.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace perideal
{
  template <int dim>
  ZonedForce<dim>::ZonedForce(std::unique_ptr<ConsistentForce<dim>>                     given,
                              const std::shared_ptr<const BondWeights<dim>>            &weights,
                              const std::vector<std::pair<dealii::Point<dim>, double>> &held)
    : WrappedBonds<dim>(create_bond_force<dim>(*weights), *weights->families)
    , cells(std::move(given))
    , whole(weights)
    , zone(weights->families, held)
    , limit(weights->families->n_owned(), std::numeric_limits<double>::infinity())
  {
    this->initialize(of_cells);
    this->initialize(change.force);
  }

  template <int dim>
  void ZonedForce<dim>::set_critical_stretch(const typename BondForce<dim>::CriticalStretch &stretch,
                                             const SofteningLaw                             &law,
                                             const typename BondForce<dim>::CriticalStretch &first)
  {
    bonds->set_critical_stretch(stretch, law, first);
    const BondList &list = bonds->bond_list();
    for (LocalIndex i = 0; i < list.n_rows(); ++i)
      for (BondIndex slot = list.row[i]; slot < list.row[i + 1]; ++slot)
        if (const LocalIndex j = list.neighbour[slot]; j != i)
          {
            const double begins = std::min(
              stretch(i, j), law.softens() && first ? first(i, j) : std::numeric_limits<double>::infinity());
            limit[i] = std::min(limit[i], begins);
            if (j < limit.size())
              limit[j] = std::min(limit[j], begins);
          }
    scale();
  }

  template <int dim>
  void ZonedForce<dim>::judge_bonds(const bool judge)
  {
    judges = judge;
    bonds->judge_bonds(judge);
  }

  template <int dim>
  void ZonedForce<dim>::scale()
  {
    std::vector<double> of_cells(zone.share());
    for (double &share : of_cells)
      share = 1. - share;
    cells->set_shares(of_cells);
    scaled = whole->scaled(zone.share());
    bonds->take_weights(*scaled, zone.share());
  }

  template <int dim>
  std::vector<LocalIndex> ZonedForce<dim>::nodes_near_breaking(const double share) const
  {
    std::vector<LocalIndex> result;
    for (LocalIndex i = 0; i < limit.size(); ++i)
      {
        if (zone.is_core(i))
          continue;
        const double most = 1. + share * limit[i], most_strain = 0.5 * (most * most - 1.);
        const auto   strain = cells->strain(i);
        // No eigenvalue is larger than the norm.
        if (strain.norm() > most_strain && eigenvalues(strain)[0] > most_strain)
          result.push_back(i);
      }
    return result;
  }

  template <int dim>
  bool ZonedForce<dim>::grow(const std::vector<LocalIndex> &nodes, const NodalVector &displacement)
  {
    NodalVector of_bonds(of_cells);
    const auto  look = [&](const double sign) {
      bonds->judge_bonds(false);
      bonds->compute(of_bonds, displacement);
      bonds->judge_bonds(judges);
      change.force.add(sign, of_cells, sign, of_bonds);
      change.energy -= sign * strain_energy();
    };
    change.force  = 0.;
    change.energy = 0.;
    look(-1.);
    change.is_there = zone.grow(nodes);
    if (!change.is_there)
      return false;
    scale();
    cells->compute(of_cells, displacement);
    look(1.);
    return true;
  }

  template <int dim>
  bool ZonedForce<dim>::extend_bonds(const NodalVector &displacement)
  {
    const unsigned int comes_near = nodes_near_breaking(near_to_breaking).empty() ? 0 : 1;
    return dealii::Utilities::MPI::max(comes_near, displacement.get_mpi_communicator()) > 0 &&
           grow(nodes_near_breaking(alike * near_to_breaking), displacement);
  }

  template <int dim>
  void ZonedForce<dim>::compute(NodalVector &force, const NodalVector &displacement)
  {
    change.is_there = false;
    cells->compute(of_cells, displacement);
    if (judges)
      extend_bonds(displacement);
    bonds->compute(force, displacement);
    force += of_cells;
  }

  template <int dim>
  std::vector<dealii::Tensor<2, dim>> ZonedForce<dim>::gradients() const
  {
    std::vector<dealii::Tensor<2, dim>> result = cells->gradients();
    std::vector<LocalIndex>             nodes;
    for (LocalIndex i = 0; i < result.size(); ++i)
      if (zone.share()[i] > 0)
        nodes.push_back(i);
    const Families<dim> &families = *whole->families;
    NodalVector          displacement(families.make_partitioner(dim));
    for (LocalIndex i = 0; i < families.n_local(); ++i)
      for (int d = 0; d < dim; ++d)
        displacement.local_element(dim * i + d) = bonds->positions()[i].value[d] - families.position[i][d];
    const auto in_zone = intact_gradients(families, *bonds, displacement, nodes);
    for (std::size_t k = 0; k < nodes.size(); ++k)
      result[nodes[k]] = in_zone[k];
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
      "share of bonds",
      "-",
      2,
      [this] { return zone.state(); },
      [this](const std::vector<double> &values) {
        zone.restore(values);
        scale();
      });
    bonds->register_state(state);
  }

  template <int dim>
  std::size_t ZonedForce<dim>::memory_consumption() const
  {
    return cells->memory_consumption() + bonds->memory_consumption() + whole->memory_consumption() +
           (scaled ? scaled->memory_consumption() : 0) + zone.memory_consumption() +
           dealii::MemoryConsumption::memory_consumption(limit) + 2 * of_cells.memory_consumption();
  }

  PERIDEAL_INSTANTIATE_CLASS(ZonedForce)
} // namespace perideal
