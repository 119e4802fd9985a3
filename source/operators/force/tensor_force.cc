// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/force/tensor_force.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  template <int dim>
  TensorForce<dim>::TensorForce(const TensorWeights<dim> &weights)
    : BreakingBonds<dim>(weights.families, weights.bonds, false)
  {
    double largest = 0;
    for (const auto &values : weights.component)
      for (const double value : values)
        largest = std::max(largest, std::abs(value));
    largest = dealii::Utilities::MPI::max(largest, families->communicator);
    unit    = largest > 0 ? largest : 1.;
    for (unsigned int p = 0; p < tensors.n_components; ++p)
      {
        tensors.component[p].resize(weights.component[p].size());
        std::transform(weights.component[p].begin(),
                       weights.component[p].end(),
                       tensors.component[p].begin(),
                       [&](const double value) { return static_cast<float>(value / unit); });
      }
    displacements.resize(families->n_local(), NodeRecord{});
  }

  template <int dim>
  bool TensorForce<dim>::carries_force(const BondIndex slot) const
  {
    return std::any_of(tensors.component.begin(), tensors.component.end(), [&](const auto &values) {
      return values[slot] != 0;
    });
  }

  template <int dim>
  void TensorForce<dim>::clear_weights(const BondIndex slot)
  {
    for (auto &values : tensors.component)
      values[slot] = 0;
  }

  template <int dim>
  void TensorForce<dim>::break_bonds(const LocalIndex i, const BondIndex first_slot, const Lanes &margin)
  {
    for (unsigned int lane = 0; lane < BondList::n_lanes && this->can_break(); ++lane)
      if (const BondIndex slot = first_slot + lane; margin[lane] < 0 && !this->unknown.holds(slot))
        {
          const auto whole = tensor(slot);
          const auto change =
            this->overstretch(slot, i, critical_stretch[slot] - margin[lane] / rest_length[slot]);
          broken_now.push_back({i, bonds.neighbour[slot], (change.before - change.after) * whole});
        }
  }

  template <int dim>
  void TensorForce<dim>::press_together(const LocalIndex i,
                                        const BondIndex  first_slot,
                                        const Lanes     &loose,
                                        const Lanes     &longer)
  {
    for (unsigned int lane = 0; lane < BondList::n_lanes; ++lane)
      if (const BondIndex slot = first_slot + lane; loose[lane] * longer[lane] < 0)
        {
          const LocalIndex j = bonds.neighbour[slot];
          // The tensors of the loop are in units of the largest component.
          const dealii::Tensor<1, dim> pull = (loose[lane] / unit) * pressed(slot, i, j).force;
          for (int d = 0; d < dim; ++d)
            {
              forces[i].value[d] += pull[d];
              forces[j].value[d] -= pull[d];
            }
        }
  }

  template <int dim>
  typename TensorForce<dim>::Pressed
  TensorForce<dim>::pressed(const BondIndex slot, const LocalIndex i, const LocalIndex j) const
  {
    dealii::Tensor<1, dim> bond;
    for (int d = 0; d < dim; ++d)
      bond[d] = position[j].value[d] - position[i].value[d];
    const double length = bond.norm(), longer = length - rest_length[slot];
    if (longer >= 0 || length == 0)
      return {};
    const dealii::Tensor<1, dim> direction =
      (families->position[j] - families->position[i]) / rest_length[slot];
    const double stiffness = direction * (tensor(slot) * direction);
    return {stiffness * longer / length * bond, 0.5 * stiffness * longer * longer};
  }

  template <int dim>
  template <bool can_break>
  void TensorForce<dim>::sum_forces()
  {
    const NodeRecord *y = position.data(), *u = displacements.data();
    NodeRecord       *f       = forces.data();
    const bool        softens = softening.softens();
    std::fill(forces.begin(), forces.end(), NodeRecord{});
    for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
      {
        if (i % RestRegions::block_size == 0 && !regions.forces_awake(i / RestRegions::block_size))
          {
            i += RestRegions::block_size - 1;
            continue;
          }
        const Lanes yi = lanes(y[i]), ui = lanes(u[i]);
        Lanes       own = {};
        for (BondIndex k = bonds.row[i]; k < bonds.row[i + 1]; k += BondList::n_lanes)
          {
            const LocalIndex *j     = bonds.neighbour.data() + k;
            Lanes             share = Lanes{} + 1.;
            if constexpr (can_break)
              {
                const Lanes bond[4] = {
                  lanes(y[j[0]]) - yi, lanes(y[j[1]]) - yi, lanes(y[j[2]]) - yi, lanes(y[j[3]]) - yi};
                Lanes square, rest, critical;
                sum_of_each(
                  square, bond[0] * bond[0], bond[1] * bond[1], bond[2] * bond[2], bond[3] * bond[3]);
                load(rest, rest_length.data() + k);
                load(critical, critical_stretch.data() + k);
                const Lanes longer = square_root(square) - rest, margin = critical * rest - longer;
                if (__builtin_expect(any_negative(margin), false))
                  break_bonds(i, k, margin);
                if (softens)
                  {
                    share = softening.shares_of(k);
                    if (const Lanes loose = 1. - share; __builtin_expect(any_negative(loose * longer), false))
                      press_together(i, k, loose, longer);
                  }
              }
            const Lanes eta[4] = {
              lanes(u[j[0]]) - ui, lanes(u[j[1]]) - ui, lanes(u[j[2]]) - ui, lanes(u[j[3]]) - ui};
            Lanes by_component[4], pull[4], of_bond[4];
            transpose(eta, by_component);
            tensors.multiply(k, by_component, pull);
            transpose(pull, of_bond);
            for (unsigned int lane = 0; lane < BondList::n_lanes; ++lane)
              {
                const Lanes force = can_break ? share[lane] * of_bond[lane] : of_bond[lane];
                own += force;
                lanes(f[j[lane]]) -= force;
              }
          }
        lanes(f[i]) += own;
      }
  }

  template <int dim>
  void TensorForce<dim>::compute(NodalVector &force, const NodalVector &displacement)
  {
    broken_now.clear();
    this->move_nodes(displacement, &displacements);
    // What softened carries its share, judged or not.
    if (this->can_break() || softening.softens())
      do
        sum_forces<true>();
      while (this->find_out_limits());
    else
      sum_forces<false>();
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      for (int d = 0; d < dim; ++d)
        force.local_element(dim * i + d) = unit * forces[i].value[d];
  }

  template <int dim>
  dealii::Tensor<1, dim> TensorForce<dim>::eta(const LocalIndex i, const LocalIndex j) const
  {
    dealii::Tensor<1, dim> result;
    for (int d = 0; d < dim; ++d)
      result[d] = displacements[j].value[d] - displacements[i].value[d];
    return result;
  }

  template <int dim>
  void TensorForce<dim>::visit_bond_forces(const typename BondForce<dim>::VisitBond &visit) const
  {
    for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
      for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
        if (const LocalIndex j = bonds.neighbour[slot]; j != i)
          {
            const double left = softening.share(slot);
            visit(i, j, left * (tensor(slot) * eta(i, j)) + (1. - left) * pressed(slot, i, j).force);
          }
  }

  template <int dim>
  double TensorForce<dim>::strain_energy() const
  {
    double result = 0;
    for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
      for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
        {
          const LocalIndex j     = bonds.neighbour[slot];
          const double     share = j < families->n_owned() ? 1. : 0.5, left = softening.share(slot);
          const auto       e = eta(i, j);
          result += share * left * 0.5 * (e * (tensor(slot) * e));
          if (left < 1)
            result += share * (1. - left) * pressed(slot, i, j).energy;
        }
    return dealii::Utilities::MPI::sum(result, families->communicator);
  }

  template <int dim>
  double TensorForce<dim>::released_energy(const NodalVector &velocity, const double time_step) const
  {
    // The bond's energy, and half a step of what its force did to the velocities.
    NodalVector ghosted_velocity(this->partitioner);
    std::copy(velocity.begin(), velocity.end(), ghosted_velocity.begin());
    ghosted_velocity.update_ghost_values();
    double result = 0;
    for (const BrokenBond &bond : broken_now)
      {
        const double                 share = bond.far < families->n_owned() ? 1. : 0.5;
        const dealii::Tensor<1, dim> e     = eta(bond.near, bond.far);
        dealii::Tensor<1, dim>       rate;
        for (int d = 0; d < dim; ++d)
          rate[d] = ghosted_velocity.local_element(dim * bond.far + d) -
                    ghosted_velocity.local_element(dim * bond.near + d);
        result += share * (0.5 * e - 0.5 * time_step * rate) * (bond.tensor * e);
      }
    return dealii::Utilities::MPI::sum(result, families->communicator);
  }

  template <int dim>
  std::size_t TensorForce<dim>::memory_consumption() const
  {
    return this->breaking_memory() + tensors.tensors_memory() + displacements.size() * sizeof(NodeRecord);
  }

  PERIDEAL_INSTANTIATE_CLASS(TensorForce)
} // namespace perideal
