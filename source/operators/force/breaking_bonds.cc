// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/force/breaking_bonds.h>
#include <perideal/output/lasting_state.h>

#include <deal.II/base/memory_consumption.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  namespace
  {
    constexpr float never = SofteningBonds::never;

    /// Lengths of bonds by slot [m], operation by operation as in the loops over bonds: a body at rest has no
    /// extension, not even by rounding.
    void measure_lengths(const BondList &bonds, const NodeRecord *y, std::vector<double> &result)
    {
      for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
        for (BondIndex k = bonds.row[i]; k < bonds.row[i + 1]; k += BondList::n_lanes)
          {
            const LocalIndex *j       = bonds.neighbour.data() + k;
            const Lanes       yi      = lanes(y[i]);
            const Lanes       bond[4] = {
                    lanes(y[j[0]]) - yi, lanes(y[j[1]]) - yi, lanes(y[j[2]]) - yi, lanes(y[j[3]]) - yi};
            Lanes square;
            sum_of_each(square, bond[0] * bond[0], bond[1] * bond[1], bond[2] * bond[2], bond[3] * bond[3]);
            const Lanes length = square_root(square);
            for (unsigned int lane = 0; lane < BondList::n_lanes; ++lane)
              // Padding has a length too: none that it could exceed.
              result[k + lane] = j[lane] == i ? 1. : length[lane];
          }
    }
  } // namespace

  template <int dim>
  void BondForce<dim>::take_weights(const BondWeights<dim> &, const std::vector<double> &)
  {
    AssertThrow(false, dealii::ExcNotImplemented());
  }

  template <int dim>
  BreakingBonds<dim>::BreakingBonds(const std::shared_ptr<const Families<dim>> &families,
                                    const BondList                             &bonds,
                                    const bool                                  has_sums,
                                    const bool                                  has_lengths)
    : families(families)
    , bonds(bonds)
    , rest_length(has_lengths ? bonds.n_slots() : 0, 0.)
    , regions(*families, bonds, has_sums)
    , volumes(families, bonds)
  {
    this->partitioner = families->make_partitioner(dim);
    ghosted.reinit(this->partitioner);
    position.resize(families->n_local(), NodeRecord{});
    forces.resize(families->n_local(), NodeRecord{});
    for (LocalIndex i = 0; i < families->n_local(); ++i)
      for (int d = 0; d < dim; ++d)
        position[i].value[d] = families->position[i][d];
    if (has_lengths)
      measure_lengths(bonds, position.data(), rest_length);
  }

  template <int dim>
  void BreakingBonds<dim>::move_nodes(const NodalVector                 &displacement,
                                      dealii::AlignedVector<NodeRecord> *records,
                                      const std::vector<LocalIndex>     *some)
  {
    n_lost.before = this->lost.size();
    softening.begin(critical_stretch);
    const LocalIndex n_owned = families->n_owned(), n_local = families->n_local();
    const auto       visit_nodes = [&](const auto &visit) {
      if (some != nullptr)
        std::for_each(some->begin(), some->end(), visit);
      else
        for (LocalIndex i = 0; i < n_owned; ++i)
          visit(i);
      for (LocalIndex i = n_owned; i < n_local; ++i)
        visit(i);
    };
    const NodalVector *source = &displacement;
    if (n_local > n_owned)
      {
        visit_nodes([&](const LocalIndex i) {
          for (int d = 0; d < dim && i < n_owned; ++d)
            ghosted.local_element(dim * i + d) = displacement.local_element(dim * i + d);
        });
        ghosted.update_ghost_values();
        source = &ghosted;
      }
    visit_nodes([&](const LocalIndex i) {
      for (int d = 0; d < dim; ++d)
        position[i].value[d] = families->position[i][d] + source->local_element(dim * i + d);
      if (records != nullptr)
        for (int d = 0; d < dim; ++d)
          (*records)[i].value[d] = source->local_element(dim * i + d);
    });
    // A displacement that rounding takes from the position has moved nothing.
    regions.update(
      [&](const LocalIndex i) {
        for (int d = 0; d < dim; ++d)
          if (position[i].value[d] != families->position[i][d])
            return true;
        return false;
      },
      visit_nodes,
      some == nullptr);
    ghosted.zero_out_ghost_values();
    if (can_break() && unknown.take_first_look())
      find_out_limits(true);
  }

  template <int dim>
  void BreakingBonds<dim>::judge_bonds(const Judgement given)
  {
    judgement = given;
    softening.judge(given == Judgement::for_good);
  }

  template <int dim>
  GlobalIndex BreakingBonds<dim>::cut(const BondPredicate<dim> &is_cut)
  {
    // Bonds that the partition cuts stand on both ranks.
    GlobalIndex ends = 0;
    for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
      for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
        if (bonds.neighbour[slot] != i &&
            is_cut(families->position[i], families->position[bonds.neighbour[slot]]))
          {
            break_bond(slot, i, true);
            ends += bonds.neighbour[slot] < families->n_owned() ? 2 : 1;
          }
    n_lost.cut = this->lost.size();
    return dealii::Utilities::MPI::sum(ends, families->communicator) / 2;
  }

  template <int dim>
  SofteningBonds::Change
  BreakingBonds<dim>::overstretch(const BondIndex slot, const LocalIndex near, const double stretch)
  {
    const auto change = softening.soften(slot, stretch, critical_stretch[slot]);
    if (change.breaks)
      break_bond(slot, near);
    return change;
  }

  template <int dim>
  void BreakingBonds<dim>::break_bond(const BondIndex slot, const LocalIndex near, const bool is_cut)
  {
    this->lost.push_back({slot, near, bonds.neighbour[slot]});
    clear_weights(slot);
    if (!critical_stretch.empty())
      critical_stretch[slot] = never;
    volumes.add(is_cut ? volumes.cut : volumes.broken, near, bonds.neighbour[slot]);
  }

  template <int dim>
  GlobalIndex BreakingBonds<dim>::n_broken_now() const
  {
    // Bonds that the partition cuts break on both ranks.
    GlobalIndex ends = 0;
    for (std::size_t k = n_lost.before; k < this->lost.size(); ++k)
      ends += this->lost[k].far < families->n_owned() ? 2 : 1;
    return dealii::Utilities::MPI::sum(ends, families->communicator) / 2;
  }

  template <int dim>
  void BreakingBonds<dim>::register_bonds(LastingState &state, const std::function<BreakingBonds &()> &bonds)
  {
    state.add_bond_array(
      "broken bonds",
      "-",
      0,
      [bonds] {
        return BondArray{"-", 0, bonds().memory().broken, {}};
      },
      [bonds](const BondArray &array) {
        bonds().restore({array.bonds, {}, {}});
      });
    // Whether bonds soften is not known yet.
    state.add_bond_array(
      BondMemory::name_of_softened,
      "-",
      SoftenedBond::n_values,
      [bonds] {
        const BondMemory memory = bonds().memory();
        return BondArray{"-", SoftenedBond::n_values, memory.softened, memory.of_softened};
      },
      [bonds](const BondArray &array) {
        bonds().restore({{}, array.bonds, array.values});
      });
  }

  template <int dim>
  BondMemory BreakingBonds<dim>::memory()
  {
    softening.begin(critical_stretch);
    BondMemory result;
    for (std::size_t k = n_lost.cut; k < this->lost.size(); ++k)
      result.broken.push_back({this->lost[k].near, this->lost[k].far});
    for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
      for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
        if (bonds.neighbour[slot] != i && softening.has_changed(slot) && carries_force(slot))
          result.add({i, bonds.neighbour[slot]}, softening.memory(slot, critical_stretch[slot]));
    return result;
  }

  template <int dim>
  void BreakingBonds<dim>::restore(const BondMemory &earlier)
  {
    if (unknown.are_there())
      {
        std::vector<bool> ends(families->n_local(), false);
        for (const BondEnds &bond : earlier.softened)
          ends[bond.near] = ends[bond.far] = true;
        unknown.find_out(ends);
      }
    restore_broken(earlier.broken);
    n_lost.before = this->lost.size();
    for (std::size_t b = 0; b < earlier.softened.size(); ++b)
      if (const BondIndex slot = bonds.find(earlier.softened[b].near, earlier.softened[b].far);
          softening.softens() && slot != BondList::no_slot && carries_force(slot))
        softening.restore(slot, BondMemory::bond(earlier.of_softened, b), critical_stretch[slot]);
  }

  template <int dim>
  void BreakingBonds<dim>::restore_broken(const std::vector<BondEnds> &broken)
  {
    for (const BondEnds &ends : broken)
      {
        const BondIndex slot = bonds.find(ends.near, ends.far);
        if (slot != BondList::no_slot && carries_force(slot))
          break_bond(slot, ends.near);
      }
  }

  template <int dim>
  std::vector<double> BreakingBonds<dim>::utilisation() const
  {
    NodalVector largest(families->make_partitioner(1));
    for (LocalIndex i = 0; i < bonds.n_rows() && !critical_stretch.empty(); ++i)
      for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
        if (const LocalIndex j = bonds.neighbour[slot]; j != i && carries_force(slot))
          {
            const double limit =
              critical_stretch[slot] / (unknown.contains(slot) ? UnknownLimits::share_of_limit : 1.);
            // One that softened is beyond its limit by what it bears less.
            const double share       = softening.has_changed(slot) ?
                                         2. - softening.memory(slot, critical_stretch[slot]).borne() :
                                         stretch_between<dim>(position[i], position[j], rest_length[slot]) / limit;
            largest.local_element(i) = std::max(largest.local_element(i), share);
            // A bond that the partition cuts is looked at from its other end, too.
            if (j < families->n_owned())
              largest.local_element(j) = std::max(largest.local_element(j), share);
          }
    return std::vector<double>(largest.begin(), largest.end());
  }

  template <int dim>
  std::vector<double> BreakingBonds<dim>::damage() const
  {
    std::vector<double> volume = volumes.broken;
    if (softening.softens())
      for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
        for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
          if (const double left = softening.share(slot); left < 1 && carries_force(slot))
            volumes.add(volume, i, bonds.neighbour[slot], 1. - left);
    return volumes.share(volume);
  }

  template <int dim>
  std::size_t BreakingBonds<dim>::breaking_memory() const
  {
    using dealii::MemoryConsumption::memory_consumption;
    return bonds.memory_consumption() + memory_consumption(rest_length) +
           memory_consumption(critical_stretch) + regions.memory_consumption() +
           softening.memory_consumption() + unknown.memory_consumption() + volumes.memory_consumption() +
           this->lost.capacity() * sizeof(this->lost[0]) + 2 * position.size() * sizeof(NodeRecord) +
           ghosted.memory_consumption();
  }

  PERIDEAL_INSTANTIATE_CLASS(BondForce)
  PERIDEAL_INSTANTIATE_CLASS(BreakingBonds)
} // namespace perideal
