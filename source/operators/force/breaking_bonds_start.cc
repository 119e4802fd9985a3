// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/force/breaking_bonds.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

// Bonds that wait for a stress to begin to soften.

namespace perideal
{
  namespace
  {
    /// Share of the largest stretch of a node that its bonds have at least when they begin to soften [-].
    constexpr double least_of_largest = 0.5;

    /// A cell whose stress comes to its strength: its middle, how far it reaches [m], the least stretch at
    /// which bonds through it begin to soften, and the share of the strength [-].
    template <int dim>
    struct FailingCell
    {
      dealii::Point<dim>    middle;
      std::array<double, 3> values;

      double radius() const { return values[0]; }
      double least() const { return values[1]; }
      double utilisation() const { return values[2]; }

      bool is_passed(const dealii::Point<dim> &from, const dealii::Tensor<1, dim> &along) const
      {
        const double share = std::clamp((middle - from) * along / along.norm_square(), 0., 1.);
        return middle.distance(from + share * along) <= radius();
      }

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &middle &values;
      }
    };
  } // namespace

  template <int dim>
  double BreakingBonds<dim>::stretch_of(const BondIndex slot, const dealii::Tensor<1, dim> &along) const
  {
    return along.norm() / rest_length[slot] - 1.;
  }

  template <int dim>
  bool BreakingBonds<dim>::start_softening(const std::vector<std::pair<LocalIndex, double>> &utilisation,
                                           const NodalVector                                &borne)
  {
    const auto visit_waiting = [this](const LocalIndex i, const auto &visit) {
      for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
        if (bonds.neighbour[slot] != i && softening.waits(slot) && carries_force(slot))
          visit(bonds.neighbour[slot], slot);
    };
    const auto stretch_now = [this](const LocalIndex i, const LocalIndex j, const BondIndex slot) {
      dealii::Tensor<1, dim> along;
      for (int d = 0; d < dim; ++d)
        along[d] = position[j].value[d] - position[i].value[d];
      return stretch_of(slot, along);
    };
    const auto stretch_borne = [&](const LocalIndex i, const LocalIndex j, const BondIndex slot) {
      dealii::Tensor<1, dim> along = families->position[j] - families->position[i];
      for (int d = 0; d < dim; ++d)
        along[d] += borne.local_element(dim * j + d) - borne.local_element(dim * i + d);
      return stretch_of(slot, along);
    };

    std::map<LocalIndex, double> largest;
    for (const auto &[i, share] : utilisation)
      largest[i] = 0.;
    for (LocalIndex i = 0; i < bonds.n_rows() && !largest.empty(); ++i)
      visit_waiting(i, [&](const LocalIndex j, const BondIndex slot) {
        for (const LocalIndex end : {i, j})
          if (const auto found = largest.find(end); found != largest.end())
            found->second = std::max(found->second, stretch_now(i, j, slot));
      });
    std::vector<FailingCell<dim>> own;
    for (const auto &[i, share] : utilisation)
      if (largest[i] > 0)
        own.push_back(
          {families->position[i],
           {{0.5 * std::sqrt(dim) * families->spacing[i], least_of_largest * largest[i], share}}});

    // Bonds of one rank pass through cells of another.
    std::map<BondIndex, double> first;
    std::vector<double>         reach(families->n_local());
    for (LocalIndex i = 0; i < reach.size(); ++i)
      reach[i] = families->horizon[i] + families->spacing[i];
    for (const auto &of_rank : dealii::Utilities::MPI::all_gather(families->communicator, own))
      for (const FailingCell<dim> &cell : of_rank)
        for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
          if (families->position[i].distance(cell.middle) <= reach[i])
            visit_waiting(i, [&](const LocalIndex j, const BondIndex slot) {
              if (!cell.is_passed(families->position[i], families->position[j] - families->position[i]))
                return;
              const double begins = std::max(cell.least(), stretch_now(i, j, slot)) / cell.utilisation();
              const auto   found  = first.emplace(slot, begins).first;
              found->second       = std::min(found->second, begins);
              found->second       = std::max(found->second, stretch_borne(i, j, slot));
            });
    for (const auto &[slot, begins] : first)
      softening.start(slot, begins, critical_stretch[slot]);
    const unsigned int started = first.empty() ? 0 : 1;
    return dealii::Utilities::MPI::max(started, families->communicator) > 0;
  }

#define PERIDEAL_INSTANTIATE_START(dim)                                                                      \
  template double BreakingBonds<dim>::stretch_of(const BondIndex, const dealii::Tensor<1, dim> &) const;     \
  template bool   BreakingBonds<dim>::start_softening(const std::vector<std::pair<LocalIndex, double>> &,    \
                                                    const NodalVector &);
  PERIDEAL_INSTANTIATE_START(2)
  PERIDEAL_INSTANTIATE_START(3)
#undef PERIDEAL_INSTANTIATE_START
} // namespace perideal
