// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/force/contact_force.h>

#include <deal.II/base/memory_consumption.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  template <int dim>
  ContactForce<dim>::ContactForce(const std::shared_ptr<const Families<dim>> &families,
                                  const ContactParameters                    &parameters,
                                  const double                                horizon_factor,
                                  const std::function<double(const dealii::types::material_id)> &bulk_modulus,
                                  const std::vector<bool>                                       &on_surface)
    : families(families)
    , parameters(parameters)
    , horizon_factor(horizon_factor)
    , bulk_modulus(bulk_modulus)
    , spacing(families->n_local())
    , reach(families->n_local())
    , stiffness(families->n_local())
  {
    AssertDimension(on_surface.size(), families->n_owned());
    sought.is_exposed = on_surface;
    lists.made_at.assign(families->position.begin(), families->position.begin() + families->n_owned());
    for (LocalIndex i = 0; i < families->n_local(); ++i)
      {
        const double horizon = families->horizon[i];
        spacing[i]           = horizon / horizon_factor;
        reach[i]             = 0.5 * parameters.distance * spacing[i];
        stiffness[i] = parameters.stiffness * bulk_modulus(families->material[i]) * families->volume[i] /
                       (horizon * horizon);
      }
  }

  template <int dim>
  void ContactForce<dim>::register_state(LastingState &state)
  {
    // The mark of halves, and r over that of the spacing.
    state.add_node_array(
      "reach of contact",
      "1",
      2,
      [&] {
        std::vector<double> result;
        for (LocalIndex i = 0; i < families->n_owned(); ++i)
          result.insert(result.end(), {0., 2. * reach[i] / (parameters.distance * spacing[i])});
        return result;
      },
      [&](const std::vector<double> &read) {
        is_half.assign(families->n_local(), false);
        unsigned int any = 0;
        for (LocalIndex i = 0; i < families->n_owned(); ++i)
          {
            reach[i]   = 0.5 * parameters.distance * spacing[i] * read[2 * i + 1];
            is_half[i] = read[2 * i] > 0;
            any        = std::max<unsigned int>(any, is_half[i]);
          }
        publish_reach();
        if (dealii::Utilities::MPI::max(any, families->communicator) == 0)
          is_half.clear();
        forget_lists();
      },
      LastingState::Show::never,
      Transfer::marks_halves);
  }

  template <int dim>
  void ContactForce<dim>::publish_reach()
  {
    NodalVector of_all(families->make_partitioner(2));
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      {
        of_all.local_element(2 * i)     = reach[i];
        of_all.local_element(2 * i + 1) = !is_half.empty() && is_half[i] ? 1. : 0.;
      }
    of_all.update_ghost_values();
    for (LocalIndex i = families->n_owned(); i < families->n_local(); ++i)
      {
        reach[i] = of_all.local_element(2 * i);
        if (!is_half.empty())
          is_half[i] = of_all.local_element(2 * i + 1) > 0;
      }
  }

  template <int dim>
  void ContactForce<dim>::release_halves()
  {
    // All by r as it was, so that neither order nor ranks matter.
    const std::vector<double> before = reach;
    const auto                lessen =
      [&](const LocalIndex i, const double of_other, const bool is_half_too, const double length) {
        const double allowed =
          is_half_too ? length * before[i] / (before[i] + of_other) : std::max(0., length - of_other);
        if (i < families->n_owned() && is_half[i])
          reach[i] = std::min(reach[i], allowed);
      };
    for (const Pair &pair : lists.once_bonded)
      if (const double length = present_length(pair); length < pair.distance)
        {
          lessen(pair.i, before[pair.j], is_half[pair.j], length);
          lessen(pair.j, before[pair.i], is_half[pair.i], length);
        }
    if (lists.any_strangers)
      {
        place_strangers();
        const LocalIndex n_sought = sought.node.size();
        for (const Pair &pair : lists.strangers)
          {
            double square = 0;
            for (int d = 0; d < dim; ++d)
              square += std::pow(sought.position.local_element(dim * pair.j + d) -
                                   sought.position.local_element(dim * pair.i + d),
                                 2);
            const double length = std::sqrt(square);
            if (!(length < pair.distance))
              continue;
            const auto of = [&](const LocalIndex a, const unsigned int k) {
              return sought.reach.local_element(2 * a + k);
            };
            lessen(sought.node[pair.i], of(pair.j, 0), of(pair.j, 1) > 0, length);
            if (pair.j < n_sought)
              lessen(sought.node[pair.j], of(pair.i, 0), of(pair.i, 1) > 0, length);
          }
        sought.position.zero_out_ghost_values();
      }
    is_half.clear();
    publish_reach();
  }

  template <int dim>
  void ContactForce<dim>::repel(const Pair      &pair,
                                const double    *y_i,
                                const double    *y_j,
                                const LocalIndex node_i,
                                const LocalIndex node_j,
                                NodalVector     &force)
  {
    double along[dim], square = 0;
    for (int d = 0; d < dim; ++d)
      {
        along[d] = y_j[d] - y_i[d];
        square += along[d] * along[d];
      }
    if (!(square < pair.distance * pair.distance) || square == 0)
      return;
    const bool   both   = node_j < families->n_owned();
    const double length = std::sqrt(square), overlap = pair.distance - length;
    for (int d = 0; d < dim; ++d)
      {
        const double push = pair.stiffness * overlap * (along[d] / length);
        force.local_element(dim * node_i + d) -= push;
        if (both)
          force.local_element(dim * node_j + d) += push;
      }
    // A pair that the partition cuts stands on both ranks.
    const double share = both ? 1. : 0.5;
    own.energy += share * 0.5 * pair.stiffness * overlap * overlap;
    own.ends += 2 * share;
    own.overlap = std::max(own.overlap, overlap / pair.distance);
  }

  template <int dim>
  void ContactForce<dim>::add(NodalVector &force, const BondForce<dim> &bonds)
  {
    position = bonds.positions();
    take_lost_bonds(bonds);
    if (lists_are_old())
      {
        make_lists(bonds);
        if (!is_half.empty())
          {
            release_halves();
            make_lists(bonds);
          }
      }

    own.energy = own.ends = 0;
    for (const Pair &pair : lists.once_bonded)
      repel(pair, position[pair.i].value, position[pair.j].value, pair.i, pair.j, force);
    if (!lists.any_strangers)
      return;
    place_strangers();
    const double *y = sought.position.begin();
    for (const Pair &pair : lists.strangers)
      repel(pair,
            y + dim * pair.i,
            y + dim * pair.j,
            sought.node[pair.i],
            pair.j < sought.node.size() ? sought.node[pair.j] : families->n_local(),
            force);
    sought.position.zero_out_ghost_values();
  }

  template <int dim>
  double ContactForce<dim>::energy() const
  {
    return dealii::Utilities::MPI::sum(own.energy, families->communicator);
  }

  template <int dim>
  std::size_t ContactForce<dim>::memory_consumption() const
  {
    using dealii::MemoryConsumption::memory_consumption;
    return memory_consumption(spacing) + memory_consumption(reach) + memory_consumption(stiffness) +
           memory_consumption(sought.is_exposed) + lists.made_at.capacity() * sizeof(lists.made_at[0]) +
           memory_consumption(sought.node) +
           (lists.once_bonded.capacity() + lists.strangers.capacity()) * sizeof(Pair);
  }

  template <int dim>
  GlobalIndex ContactForce<dim>::n_contacts() const
  {
    return dealii::Utilities::MPI::sum(own.ends, families->communicator) / 2;
  }

  template <int dim>
  double ContactForce<dim>::largest_overlap() const
  {
    return dealii::Utilities::MPI::max(own.overlap, families->communicator);
  }

  PERIDEAL_INSTANTIATE_CLASS(ContactForce)
} // namespace perideal
