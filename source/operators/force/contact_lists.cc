// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/nodes/curve_order.h>
#include <perideal/operators/force/contact_force.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

// ContactForce: which nodes may touch.

namespace perideal
{
  template <int dim>
  typename ContactForce<dim>::Pair
  ContactForce<dim>::pair_of_lost(const typename BondForce<dim>::LostBond &bond) const
  {
    const LocalIndex i = bond.near, j = bond.far;
    // Shorter by what rounding may do, so that exactly nothing repels at rest.
    const double rest = (1. - 1e-12) * families->position[i].distance(families->position[j]);
    return {
      i, j, std::min(reach[i] + reach[j], parameters.distance * rest), std::min(stiffness[i], stiffness[j])};
  }

  template <int dim>
  double ContactForce<dim>::present_length(const Pair &pair) const
  {
    double square = 0;
    for (int d = 0; d < dim; ++d)
      {
        const double along = position[pair.j].value[d] - position[pair.i].value[d];
        square += along * along;
      }
    return std::sqrt(square);
  }

  template <int dim>
  void ContactForce<dim>::take_lost_bonds(const BondForce<dim> &bonds)
  {
    const auto &lost = bonds.lost_bonds();
    for (; lists.n_lost_taken < lost.size(); ++lists.n_lost_taken)
      {
        const Pair pair           = pair_of_lost(lost[lists.n_lost_taken]);
        sought.is_exposed[pair.i] = true;
        if (pair.j < families->n_owned())
          sought.is_exposed[pair.j] = true;
        // Either node may still move a whole spacing before the lists are made anew: from half a spacing
        // on one side of where it was then to half a spacing on the other.
        if (present_length(pair) < pair.distance + spacing[pair.i] + spacing[pair.j])
          lists.once_bonded.push_back(pair);
      }
  }

  template <int dim>
  bool ContactForce<dim>::lists_are_old() const
  {
    unsigned int result = lists.are_made ? 0 : 1;
    for (LocalIndex i = 0; i < families->n_owned() && result == 0; ++i)
      {
        double square = 0;
        for (int d = 0; d < dim; ++d)
          square +=
            (position[i].value[d] - lists.made_at[i][d]) * (position[i].value[d] - lists.made_at[i][d]);
        if (square > 0.25 * spacing[i] * spacing[i])
          result = 1;
      }
    return dealii::Utilities::MPI::max(result, families->communicator) > 0;
  }

  template <int dim>
  bool ContactForce<dim>::may_meet_strangers() const
  {
    // Strangers are more than the larger horizon apart at rest; half a spacing each may be added to where
    // they are now.
    const double slack  = 0.5 * (horizon_factor - parameters.distance - 1.);
    unsigned int result = 0;
    for (LocalIndex i = 0; i < families->n_owned() && result == 0; ++i)
      {
        double square = 0;
        for (int d = 0; d < dim; ++d)
          square += (position[i].value[d] - families->position[i][d]) *
                    (position[i].value[d] - families->position[i][d]);
        if (slack <= 0 || square > slack * slack * spacing[i] * spacing[i])
          result = 1;
      }
    return dealii::Utilities::MPI::max(result, families->communicator) > 0;
  }

  template <int dim>
  void ContactForce<dim>::list_lost_bonds(const BondForce<dim> &bonds)
  {
    lists.once_bonded.clear();
    for (const auto &bond : bonds.lost_bonds())
      {
        const Pair pair = pair_of_lost(bond);
        if (present_length(pair) < pair.distance + 0.5 * (spacing[pair.i] + spacing[pair.j]))
          lists.once_bonded.push_back(pair);
      }
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      for (int d = 0; d < dim; ++d)
        lists.made_at[i][d] = position[i].value[d];
    lists.are_made = true;
  }

  template <int dim>
  bool ContactForce<dim>::are_family(const LocalIndex i, const GlobalIndex j) const
  {
    const GlobalIndex first   = families->global_number(0);
    const LocalIndex  n_owned = families->n_owned();
    LocalIndex        local_j;
    if (j >= first && j < first + n_owned)
      local_j = j - first;
    else
      {
        const auto &ghosts = families->ghost_number;
        const auto  at     = std::lower_bound(ghosts.begin(), ghosts.end(), j);
        if (at == ghosts.end() || *at != j)
          return false;
        local_j = n_owned + (at - ghosts.begin());
      }
    return families->are_members(i, local_j);
  }

  template <int dim>
  NodeCloud<dim> ContactForce<dim>::candidates()
  {
    NodeCloud<dim>                  cloud;
    std::vector<LocalIndex>         candidate;
    std::vector<dealii::Point<dim>> present;
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      {
        dealii::Point<dim> y;
        for (int d = 0; d < dim; ++d)
          y[d] = position[i].value[d];
        if (sought.is_exposed[i] && std::isfinite(y.square()))
          {
            candidate.push_back(i);
            present.push_back(y);
          }
      }
    // Debris is no longer in the order of the body.
    sought.node.clear();
    for (const LocalIndex k : order_along_curve(present))
      {
        const LocalIndex i = candidate[k];
        sought.node.push_back(i);
        cloud.position.push_back(present[k]);
        cloud.volume.push_back(families->volume[i]);
        cloud.spacing.push_back(spacing[i]);
        cloud.horizon.push_back(search_radius() * spacing[i]);
        cloud.material.push_back(families->material[i]);
      }
    cloud.communicator = families->communicator;
    cloud.number();
    return cloud;
  }

  template <int dim>
  void ContactForce<dim>::search()
  {
    const NodeCloud<dim> cloud = candidates();
    const GlobalIndex    n_all =
      dealii::Utilities::MPI::sum(static_cast<GlobalIndex>(families->n_owned()), families->communicator);
    sought.n_left_out = n_all - cloud.n_global;
    ++sought.n_searches;
    lists.strangers.clear();
    lists.any_strangers = false;
    if (cloud.n_global == 0)
      return;

    const Families<dim> found(cloud);
    NodalVector         number(found.make_partitioner(1));
    sought.reach.reinit(found.make_partitioner(2));
    for (LocalIndex a = 0; a < sought.node.size(); ++a)
      {
        const LocalIndex i                    = sought.node[a];
        number.local_element(a)               = families->global_number(i);
        sought.reach.local_element(2 * a)     = reach[i];
        sought.reach.local_element(2 * a + 1) = !is_half.empty() && is_half[i] ? 1. : 0.;
      }
    number.update_ghost_values();
    sought.reach.update_ghost_values();
    const auto stiffness_of = [&](const LocalIndex a) {
      const double h = found.horizon[a] / search_radius() * horizon_factor;
      return parameters.stiffness * bulk_modulus(found.material[a]) * found.volume[a] / (h * h);
    };
    for (LocalIndex a = 0; a < sought.node.size(); ++a)
      for (const LocalIndex *b = std::upper_bound(found.begin(a), found.end(a), a); b != found.end(a); ++b)
        if (!are_family(sought.node[a], static_cast<GlobalIndex>(number.local_element(*b))))
          lists.strangers.push_back({a,
                                     *b,
                                     sought.reach.local_element(2 * a) + sought.reach.local_element(2 * *b),
                                     std::min(stiffness_of(a), stiffness_of(*b))});
    sought.position.reinit(found.make_partitioner(dim));
    lists.any_strangers =
      dealii::Utilities::MPI::max(lists.strangers.empty() ? 0u : 1u, families->communicator) > 0;
  }

  template <int dim>
  void ContactForce<dim>::make_lists(const BondForce<dim> &bonds)
  {
    list_lost_bonds(bonds);
    lists.strangers.clear();
    lists.any_strangers = false;
    if (may_meet_strangers())
      search();
  }

  template <int dim>
  void ContactForce<dim>::place_strangers()
  {
    for (LocalIndex a = 0; a < sought.node.size(); ++a)
      for (int d = 0; d < dim; ++d)
        sought.position.local_element(dim * a + d) = position[sought.node[a]].value[d];
    sought.position.update_ghost_values();
  }

  PERIDEAL_INSTANTIATE_CLASS(ContactForce)
} // namespace perideal
