// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/force/breaking_bonds.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

// Limits of bonds, and those that are found out on demand.

namespace perideal
{
  namespace
  {
    /// A limit in single precision, in which infinity has no place.
    float at_most_never(const double value)
    {
      return static_cast<float>(std::min<double>(value, SofteningBonds::never));
    }
  } // namespace

  template <int dim>
  void BreakingBonds<dim>::set_critical_stretch(const typename BondForce<dim>::CriticalStretch &stretch,
                                                const SofteningLaw                             &law,
                                                const typename BondForce<dim>::CriticalStretch &first,
                                                const UnknownLimits::Source                    &source)
  {
    const bool is_new = !unknown.are_there();
    if (is_new)
      {
        critical_stretch.assign(bonds.n_slots(), SofteningBonds::never);
        if (law.softens())
          softening = SofteningBonds(law, critical_stretch);
      }
    std::vector<bool> left(source.is_known ? bonds.n_slots() : 0, false);
    unsigned int      any_left = 0;
    for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
      for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
        if (const LocalIndex j = bonds.neighbour[slot];
            j != i && carries_force(slot) && (is_new || unknown.contains(slot)))
          {
            float      &limit = critical_stretch[slot] = at_most_never(stretch(i, j));
            const bool  breaks                         = limit < SofteningBonds::never;
            const float begins                         = law.softens() ? at_most_never(first(i, j)) : limit;
            if (law.softens())
              softening.begin_at(slot, begins, limit);
            if (!left.empty() && breaks && !source.is_known(i, j))
              {
                limit      = std::min(limit, begins);
                left[slot] = true;
                any_left   = 1;
              }
          }
    if (left.empty() || dealii::Utilities::MPI::max(any_left, families->communicator) == 0)
      unknown = UnknownLimits();
    else
      unknown = UnknownLimits(source.find_out,
                              std::move(left),
                              is_new ? std::vector<bool>(families->n_local(), false) : unknown.asked_nodes(),
                              !is_new);
  }

  template <int dim>
  bool BreakingBonds<dim>::find_out_limits(const bool anyway)
  {
    const unsigned int is_asked = unknown.take_question();
    if (!unknown.are_there() ||
        (!anyway && dealii::Utilities::MPI::max(is_asked, families->communicator) == 0))
      return false;
    std::vector<bool> nodes(families->n_local(), false);
    unsigned int      any = 0;
    for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
      for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
        if (unknown.contains(slot) && carries_force(slot) &&
            stretch_between<dim>(position[i], position[bonds.neighbour[slot]], rest_length[slot]) >
              UnknownLimits::alike * critical_stretch[slot])
          {
            nodes[i] = nodes[bonds.neighbour[slot]] = true;
            any                                     = 1;
          }
    if (dealii::Utilities::MPI::max(any, families->communicator) == 0)
      return false;
    // In a motion their neighbours are next; states on the way to an equilibrium may be far from it.
    if (judgement == Judgement::for_good)
      nodes = families->with_members(families->with_members(nodes));
    unknown.find_out(nodes);
    return true;
  }

#define PERIDEAL_INSTANTIATE_LIMITS(dim)                                                                     \
  template void BreakingBonds<dim>::set_critical_stretch(const BondForce<dim>::CriticalStretch &,            \
                                                         const SofteningLaw &,                               \
                                                         const BondForce<dim>::CriticalStretch &,            \
                                                         const UnknownLimits::Source &);                     \
  template bool BreakingBonds<dim>::find_out_limits(const bool);
  PERIDEAL_INSTANTIATE_LIMITS(2)
  PERIDEAL_INSTANTIATE_LIMITS(3)
#undef PERIDEAL_INSTANTIATE_LIMITS
} // namespace perideal
