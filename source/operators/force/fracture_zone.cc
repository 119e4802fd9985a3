// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/force/fracture_zone.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/memory_consumption.h>
#include <deal.II/base/mpi.h>

#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace perideal
{
  template <int dim>
  FractureZone<dim>::FractureZone(const std::shared_ptr<const Families<dim>>               &families,
                                  const std::vector<std::pair<dealii::Point<dim>, double>> &held)
    : families(families)
    , chi(families->n_local(), 0.)
    , largest(families->n_owned(), 1.)
    , core(families->n_owned(), false)
    , ghosted(families->make_partitioner(1))
  {
    std::vector<Entry> entries;
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      entries.emplace_back(families->position[i], i);
    tree = dealii::pack_rtree(entries);
    for (const auto &of_rank : dealii::Utilities::MPI::all_gather(families->communicator, held))
      for (const auto &[point, spacing] : of_rank)
        visit_within(
          point, (ramp + 1.) * spacing, [&, spacing = spacing](const LocalIndex i, const double d) {
            largest[i] = std::min(largest[i], std::max(0., d / spacing - 1.) / ramp);
          });
  }

  template <int dim>
  template <typename Visit>
  void FractureZone<dim>::visit_within(const dealii::Point<dim> &middle,
                                       const double              radius,
                                       const Visit              &visit) const
  {
    dealii::Point<dim> low = middle, high = middle;
    for (int d = 0; d < dim; ++d)
      {
        low[d] -= radius;
        high[d] += radius;
      }
    namespace bgi = boost::geometry::index;
    const dealii::BoundingBox<dim> box({low, high});
    tree.query(bgi::intersects(box), boost::make_function_output_iterator([&](const Entry &entry) {
                 if (const double distance = entry.first.distance(middle); distance < radius)
                   visit(entry.second, distance);
               }));
  }

  template <int dim>
  double FractureZone<dim>::full_radius(const LocalIndex i) const
  {
    return core_radius + std::floor(families->horizon[i] / families->spacing[i]) + 1.;
  }

  template <int dim>
  bool FractureZone<dim>::grow(const std::vector<LocalIndex> &nodes)
  {
    // Where nodes are, their spacing, and in spacings where chi ends to be one.
    std::vector<std::pair<dealii::Point<dim>, std::pair<double, double>>> middles;
    for (const LocalIndex i : nodes)
      middles.emplace_back(families->position[i], std::make_pair(families->spacing[i], full_radius(i)));
    bool changed = false;
    for (const auto &of_rank : dealii::Utilities::MPI::all_gather(families->communicator, middles))
      for (const auto &[middle, sizes] : of_rank)
        visit_within(
          middle,
          (sizes.second + ramp) * sizes.first,
          [&, spacing = sizes.first, full = sizes.second](const LocalIndex i, const double distance) {
            const double cells = distance / spacing;
            const double share = std::min(largest[i], std::min(1., (full + ramp - cells) / ramp));
            changed            = changed || share > chi[i];
            chi[i]             = std::max(chi[i], share);
            core[i]            = core[i] || cells <= core_radius;
          });
    if (dealii::Utilities::MPI::max(changed ? 1u : 0u, families->communicator) == 0)
      return false;
    ++n_growths;
    update_ghosts();
    return true;
  }

  template <int dim>
  void FractureZone<dim>::update_ghosts()
  {
    const LocalIndex n_owned = families->n_owned();
    std::copy_n(chi.begin(), n_owned, ghosted.begin());
    ghosted.update_ghost_values();
    for (LocalIndex i = n_owned; i < families->n_local(); ++i)
      chi[i] = ghosted.local_element(i);
    ghosted.zero_out_ghost_values();
    const bool here = std::any_of(chi.begin(), chi.end(), [](const double c) { return c > 0; });
    there           = dealii::Utilities::MPI::max(here ? 1u : 0u, families->communicator) > 0;
  }

  template <int dim>
  GlobalIndex FractureZone<dim>::n_nodes() const
  {
    const GlobalIndex own =
      std::count_if(chi.begin(), chi.begin() + families->n_owned(), [](const double c) { return c > 0; });
    return dealii::Utilities::MPI::sum(own, families->communicator);
  }

  template <int dim>
  std::vector<double> FractureZone<dim>::state() const
  {
    std::vector<double> result;
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      {
        result.push_back(chi[i]);
        result.push_back(core[i] ? 1. : 0.);
      }
    return result;
  }

  template <int dim>
  void FractureZone<dim>::restore(const std::vector<double> &state)
  {
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      {
        chi[i]  = state[2 * i];
        core[i] = state[2 * i + 1] > 0;
      }
    ++n_growths;
    update_ghosts();
  }

  template <int dim>
  std::size_t FractureZone<dim>::memory_consumption() const
  {
    using dealii::MemoryConsumption::memory_consumption;
    return memory_consumption(chi) + memory_consumption(largest) + memory_consumption(core) +
           tree.size() * sizeof(Entry) + ghosted.memory_consumption();
  }

  PERIDEAL_INSTANTIATE_CLASS(FractureZone)
} // namespace perideal
