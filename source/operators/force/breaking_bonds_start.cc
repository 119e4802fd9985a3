// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/force/breaking_bonds.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <map>

// Bonds that wait for a stress to begin to soften.

namespace perideal
{
  namespace
  {
    /// A cell whose stress comes to its strength.
    template <int dim>
    struct FailingCell
    {
      dealii::Point<dim> middle;
      double             spacing = 0;
      SofteningOnset     onset;

      /// Whether a bond passes through the ball in it.
      bool is_passed(const dealii::Point<dim> &from, const dealii::Tensor<1, dim> &along) const
      {
        const double share = std::clamp((middle - from) * along / along.norm_square(), 0., 1.);
        return middle.distance(from + share * along) <= 0.5 * spacing;
      }

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &middle &spacing &onset;
      }
    };
  } // namespace

  template <int dim>
  bool BreakingBonds<dim>::start_softening(const std::vector<SofteningOnset> &onset, const NodalVector &borne)
  {
    std::vector<FailingCell<dim>> own;
    for (const SofteningOnset &of_node : onset)
      own.push_back({families->position[of_node.node], families->spacing[of_node.node], of_node});
    // The least stretch that a cell asks for; bonds of one rank pass through cells of another.
    std::map<BondIndex, double> begins;
    const auto                  look_at = [&](const FailingCell<dim> &cell, const LocalIndex i) {
      for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
        {
          const LocalIndex j = bonds.neighbour[slot];
          if (j == i || !softening.waits(slot) || !carries_force(slot))
            continue;
          dealii::Tensor<1, dim> along = families->position[j] - families->position[i];
          if (!cell.is_passed(families->position[i], along))
            continue;
          double &first = begins.emplace(slot, SofteningBonds::never).first->second;
          first = std::min(first, cell.onset.first_stretch(softening.first_stretch(slot)));
          for (int d = 0; d < dim; ++d)
            along[d] += borne.local_element(dim * j + d) - borne.local_element(dim * i + d);
          first = std::max(first, along.norm() / rest_length[slot] - 1.);
        }
    };
    // A bond may be longer than the horizon of the end that lists it.
    const double longest =
      families->horizon.empty() ? 0. : *std::max_element(families->horizon.begin(), families->horizon.end());
    for (const auto &of_rank : dealii::Utilities::MPI::all_gather(families->communicator, own))
      for (const FailingCell<dim> &cell : of_rank)
        for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
          if (families->position[i].distance(cell.middle) <= longest + cell.spacing)
            look_at(cell, i);
    for (const auto &[slot, first] : begins)
      softening.start(slot, first, critical_stretch[slot]);
    return dealii::Utilities::MPI::max(begins.empty() ? 0u : 1u, families->communicator) > 0;
  }

#define PERIDEAL_INSTANTIATE_START(dim)                                                                      \
  template bool BreakingBonds<dim>::start_softening(const std::vector<SofteningOnset> &, const NodalVector &);
  PERIDEAL_INSTANTIATE_START(2)
  PERIDEAL_INSTANTIATE_START(3)
#undef PERIDEAL_INSTANTIATE_START
} // namespace perideal
