// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/operators/force/family_force.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

// FamilyForce where families that lose bonds are weighed anew.

namespace perideal
{
  template <int dim, unsigned int n_sums, bool own_force_weights>
  void FamilyForce<dim, n_sums, own_force_weights>::reweigh_as_bonds_break(
    const std::shared_ptr<const BondWeights<dim>> &weights, const typename BondForce<dim>::Reweigh &how)
  {
    current_weights = std::static_pointer_cast<const Weights>(weights);
    reweigh         = how;
    this->initialize(force_change);
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  void FamilyForce<dim, n_sums, own_force_weights>::take_weights(const BondWeights<dim>    &scaled,
                                                                 const std::vector<double> &share)
  {
    // They become single precision.
    const auto &from = static_cast<const Weights &>(scaled);
    unit             = from.largest();
    for (double *size : {&unit.sum, &unit.force, &unit.stiffness})
      {
        *size = dealii::Utilities::MPI::max(*size, families->communicator);
        if (*size == 0)
          *size = 1.;
      }
    weights.copy_from(from, unit);
    map    = from.map;
    energy = from.energy;
    if (share.empty())
      return;
    for (const auto &bond : this->lost)
      clear_weights(bond.slot);
    regions.keep_awake([&](const LocalIndex i) { return share[i] > 0; });
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  void FamilyForce<dim, n_sums, own_force_weights>::compute_and_reweigh(NodalVector &force)
  {
    compute_forces<Failing::not_at_all>(force);
    const auto any_too_long = [&] {
      for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
        for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
          {
            const LocalIndex j = bonds.neighbour[slot];
            // Padding has a bond of no length.
            if (j != i &&
                stretch_between<dim>(position[i], position[j], rest_length[slot]) > critical_stretch[slot])
              return true;
          }
      return false;
    };
    const unsigned int breaks = any_too_long();
    if (dealii::Utilities::MPI::max(breaks, families->communicator) == 0)
      return;
    force_change            = force;
    energy_before           = strain_energy();
    const std::size_t first = this->lost.size();
    compute_forces<Failing::at_once>(force);
    reweigh_ends(first);
    compute_forces<Failing::not_at_all>(force);
    force_change.sadd(-1., 1., force);
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  void FamilyForce<dim, n_sums, own_force_weights>::reweigh_ends(const std::size_t first)
  {
    std::vector<LocalIndex> ends;
    for (std::size_t k = first; k < this->lost.size(); ++k)
      for (const LocalIndex i : {this->lost[k].near, this->lost[k].far})
        if (i < families->n_owned())
          ends.push_back(i);
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    reweigh(ends, [&](const LocalIndex i, const LocalIndex j) { return !carries_force(bonds.find(i, j)); });
    take_weights(*current_weights, {});
  }

#define PERIDEAL_INSTANTIATE_SHAPE(dim, n_sums, own_force_weights)                                           \
  template void FamilyForce<dim, n_sums, own_force_weights>::reweigh_as_bonds_break(                         \
    const std::shared_ptr<const BondWeights<dim>> &, const BondForce<dim>::Reweigh &);                       \
  template void FamilyForce<dim, n_sums, own_force_weights>::take_weights(const BondWeights<dim> &,          \
                                                                          const std::vector<double> &);      \
  template void FamilyForce<dim, n_sums, own_force_weights>::compute_and_reweigh(NodalVector &);             \
  template void FamilyForce<dim, n_sums, own_force_weights>::reweigh_ends(const std::size_t);
  PERIDEAL_FOR_FAMILY_SHAPES(PERIDEAL_INSTANTIATE_SHAPE)
#undef PERIDEAL_INSTANTIATE_SHAPE
} // namespace perideal
