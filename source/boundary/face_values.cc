// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/boundary/face_values.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace perideal
{
  template <int dim>
  FaceValues<dim>::FaceValues(const std::vector<BoundaryPoint<dim>> &points, const Loads<dim> &loads)
    : n_conditions(loads.conditions.size())
  {
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        Entry entry{p, points[p].point, points[p].area.norm(), {}, free, {}, {}, {}};
        entry.condition.fill(free);
        for (unsigned int k = 0; k < n_conditions; ++k)
          if (loads.conditions[k].acts_on(points[p].boundary))
            {
              for (int d = 0; d < dim; ++d)
                if (loads.conditions[k].holds(d))
                  entry.condition[d] = k;
              if (loads.conditions[k].slides)
                entry.sliding_condition = k;
            }
        if (entry.sliding_condition != free || std::any_of(entry.condition.begin(),
                                                           entry.condition.end(),
                                                           [](const auto k) { return k != free; }))
          list.push_back(entry);
      }
    set_normals(points);
  }

  template <int dim>
  void FaceValues<dim>::set_normals(const std::vector<BoundaryPoint<dim>> &points)
  {
    for (std::size_t first = 0, last = 0; first < list.size(); first = last)
      {
        dealii::Tensor<1, dim> sum;
        for (; last < list.size() && points[list[last].point].face == points[list[first].point].face; ++last)
          sum += points[list[last].point].area;
        for (std::size_t e = first; e < last; ++e)
          if (list[e].sliding_condition != free)
            list[e].normal = sum / sum.norm();
      }
  }

  template <int dim>
  void FaceValues<dim>::set_time(const Loads<dim> &loads, const double time)
  {
    prepare(loads, time);
    move();
  }

  template <int dim>
  void FaceValues<dim>::prepare(const Loads<dim> &loads, const double time)
  {
    for (Entry &entry : list)
      for (int d = 0; d < dim; ++d)
        if (entry.condition[d] != free)
          if (const auto &position = loads.conditions[entry.condition[d]].displacement[d];
              position.is_present())
            entry.increment[d] = position.value(entry.position, time) - entry.value[d];
  }

  template <int dim>
  void FaceValues<dim>::prepare_step(const Loads<dim> &loads, const double time, const double time_step)
  {
    prepare(loads, time + time_step);
    for (Entry &entry : list)
      for (int d = 0; d < dim; ++d)
        if (entry.condition[d] != free)
          if (const auto &condition = loads.conditions[entry.condition[d]];
              !condition.displacement[d].is_present())
            entry.increment[d] =
              time_step * condition.velocity[d].value(entry.position, time + 0.5 * time_step);
  }

  template <int dim>
  void FaceValues<dim>::move()
  {
    for (Entry &entry : list)
      {
        entry.value += entry.increment;
        entry.increment = 0.;
      }
  }

  template <int dim>
  void FaceValues<dim>::set_values(const std::vector<dealii::Tensor<1, dim>> &values)
  {
    AssertDimension(values.size(), list.size());
    for (std::size_t e = 0; e < list.size(); ++e)
      {
        list[e].value     = values[e];
        list[e].increment = 0.;
      }
  }

  template <int dim>
  double FaceValues<dim>::largest_increment() const
  {
    double result = 0;
    for (const Entry &entry : list)
      result = std::max(result, entry.increment.norm());
    return result;
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  FaceValues<dim>::sum_by_condition(const std::vector<dealii::Tensor<1, dim>> &forces,
                                    MPI_Comm                                   communicator) const
  {
    AssertDimension(forces.size(), list.size());
    std::vector<dealii::Tensor<1, dim>> result(n_conditions);
    for (std::size_t e = 0; e < list.size(); ++e)
      for (int d = 0; d < dim; ++d)
        if (const auto k = std::min(list[e].condition[d], list[e].sliding_condition); k != free)
          result[k][d] += forces[e][d] - (borne.empty() ? 0. : borne[e][d]);
    for (auto &sum : result)
      sum = dealii::Utilities::MPI::sum(sum, communicator);
    return result;
  }

  template <int dim>
  double FaceValues<dim>::work(const std::vector<dealii::Tensor<1, dim>> &forces, MPI_Comm communicator) const
  {
    AssertDimension(forces.size(), list.size());
    double result = 0;
    for (std::size_t e = 0; e < list.size(); ++e)
      result += forces[e] * list[e].value;
    return dealii::Utilities::MPI::sum(result, communicator);
  }

  PERIDEAL_INSTANTIATE_CLASS(FaceValues)
} // namespace perideal
