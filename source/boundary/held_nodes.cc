// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/boundary/held_nodes.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace perideal
{
  template <int dim>
  HeldNodes<dim>::HeldNodes(const std::vector<BoundaryFace<dim>>                       &faces,
                            const Loads<dim>                                           &loads,
                            const std::vector<std::vector<dealii::types::boundary_id>> &boundaries,
                            const LocalIndex                                            n_nodes)
    : held(static_cast<std::size_t>(dim) * n_nodes, 0)
    , n_conditions(loads.conditions.size())
  {
    std::vector<unsigned int> n_entries(held.size(), 0);
    for (const BoundaryFace<dim> &face : faces)
      for (unsigned int k = 0; k < n_conditions; ++k)
        if (std::count(boundaries[k].begin(), boundaries[k].end(), face.boundary) > 0)
          for (unsigned int d = 0; d < dim; ++d)
            if (loads.conditions[k].holds(d))
              {
                list.push_back({face.node, d, k, face.centre, 1.});
                held[dim * face.node + d] = 1;
                ++n_entries[dim * face.node + d];
              }
    for (Entry &entry : list)
      entry.share = 1. / n_entries[dim * entry.node + entry.component];
  }

  template <int dim>
  void HeldNodes<dim>::set_boundary_values(const Loads<dim> &loads,
                                           const double      time,
                                           NodalVector      &displacement) const
  {
    for (std::size_t i = 0; i < held.size(); ++i)
      if (held[i])
        displacement.local_element(i) = 0;
    for (const Entry &entry : list)
      displacement.local_element(dim * entry.node + entry.component) +=
        entry.share *
        loads.conditions[entry.condition].displacement[entry.component].value(entry.point, time);
  }

  template <int dim>
  void HeldNodes<dim>::set_velocities(const Loads<dim>  &loads,
                                      const double       time,
                                      const double       time_step,
                                      const NodalVector &displacement,
                                      NodalVector       &velocity) const
  {
    for (std::size_t i = 0; i < held.size(); ++i)
      if (held[i])
        velocity.local_element(i) = 0;
    for (const Entry &entry : list)
      {
        const BoundaryCondition<dim> &condition = loads.conditions[entry.condition];
        const std::size_t             i         = dim * entry.node + entry.component;
        const auto                   &position  = condition.displacement[entry.component];
        velocity.local_element(i) +=
          entry.share *
          (position.is_present() ?
             (position.value(entry.point, time + time_step) - displacement.local_element(i)) / time_step :
             condition.velocity[entry.component].value(entry.point, time + 0.5 * time_step));
      }
  }

  template <int dim>
  void HeldNodes<dim>::set_nodal_values(const std::vector<dealii::Tensor<1, dim>> &values,
                                        NodalVector                               &displacement) const
  {
    for (const Entry &entry : list)
      displacement.local_element(dim * entry.node + entry.component) = values[entry.node][entry.component];
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>> HeldNodes<dim>::sum_by_condition(const NodalVector &force,
                                                                       MPI_Comm           communicator) const
  {
    std::vector<dealii::Tensor<1, dim>> result(n_conditions);
    for (const Entry &entry : list)
      result[entry.condition][entry.component] +=
        entry.share * force.local_element(dim * entry.node + entry.component);
    for (auto &sum : result)
      sum = dealii::Utilities::MPI::sum(sum, communicator);
    return result;
  }

  template <int dim>
  double
  HeldNodes<dim>::work(const NodalVector &force, const NodalVector &displacement, MPI_Comm communicator) const
  {
    double sum = 0;
    for (std::size_t i = 0; i < held.size(); ++i)
      if (held[i])
        sum += force.local_element(i) * displacement.local_element(i);
    return dealii::Utilities::MPI::sum(sum, communicator);
  }

  template class HeldNodes<2>;
  template class HeldNodes<3>;
} // namespace perideal
