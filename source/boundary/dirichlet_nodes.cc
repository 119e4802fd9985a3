// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/boundary/dirichlet_nodes.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  template <int dim>
  DirichletNodes<dim>::DirichletNodes(const std::vector<BoundaryFace<dim>> &faces,
                                      const Loads<dim>                     &loads,
                                      const LocalIndex                      n_nodes)
    : n_conditions(loads.conditions.size())
  {
    for (const BoundaryFace<dim> &face : faces)
      for (unsigned int k = 0; k < n_conditions; ++k)
        if (loads.conditions[k].acts_on(face.boundary))
          add(loads, k, face.node, face.centre);
    mask_and_share(n_nodes);
  }

  namespace
  {
    /// Marks the nodes of owned cells that share a vertex with a marked one, for marks of owned nodes.
    /// Collective.
    template <int dim>
    void widen(const Mesh<dim>      &mesh,
               const Nodes<dim>     &nodes,
               const CellGraph<dim> &graph,
               std::vector<double>  &marks)
    {
      const std::vector<double> before = graph.with_ghosts(marks);
      for (const auto &cell : mesh.triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            const auto around = graph.cells_around(cell);
            if (std::any_of(around.begin(), around.end(), [&](const LocalIndex j) { return before[j] > 0; }))
              marks[nodes.node_of_cell[cell->active_cell_index()]] = 1;
          }
    }
  } // namespace

  template <int dim>
  DirichletNodes<dim>::DirichletNodes(const Mesh<dim>                      &mesh,
                                      const Nodes<dim>                     &nodes,
                                      const std::vector<BoundaryFace<dim>> &faces,
                                      const Loads<dim>                     &loads,
                                      const unsigned int                    n_layers)
    : n_conditions(loads.conditions.size())
    , is_collar(n_layers > 1)
  {
    const CellGraph<dim> graph(mesh, nodes);
    for (unsigned int k = 0; k < n_conditions; ++k)
      if (loads.conditions[k].prescribes_displacement())
        {
          std::vector<double> marks(nodes.size(), 0.);
          for (const BoundaryFace<dim> &face : faces)
            if (loads.conditions[k].acts_on(face.boundary))
              marks[face.node] = 1;
          for (unsigned int layer = 1; layer < n_layers; ++layer)
            widen(mesh, nodes, graph, marks);
          for (LocalIndex i = 0; i < nodes.size(); ++i)
            if (marks[i] > 0)
              add(loads, k, i, nodes.position[i]);
        }
    mask_and_share(nodes.size());
  }

  template <int dim>
  void DirichletNodes<dim>::add(const Loads<dim>         &loads,
                                const unsigned int        condition,
                                const LocalIndex          node,
                                const dealii::Point<dim> &point)
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (loads.conditions[condition].holds(d))
        list.push_back({node, d, condition, point, 1.});
  }

  template <int dim>
  void DirichletNodes<dim>::mask_and_share(const LocalIndex n_nodes)
  {
    held.assign(static_cast<std::size_t>(dim) * n_nodes, 0);
    std::vector<unsigned int> n_entries(held.size(), 0);
    for (const Entry &entry : list)
      {
        held[dim * entry.node + entry.component] = 1;
        ++n_entries[dim * entry.node + entry.component];
      }
    for (Entry &entry : list)
      entry.share = 1. / n_entries[dim * entry.node + entry.component];
  }

  template <int dim>
  void
  DirichletNodes<dim>::check_finite(const Loads<dim> &loads, const double time, MPI_Comm communicator) const
  {
    std::vector<unsigned int> bad(dim * n_conditions, 0);
    for (const Entry &entry : list)
      {
        const BoundaryCondition<dim> &condition = loads.conditions[entry.condition];
        const auto                   &function  = condition.displacement[entry.component].is_present() ?
                                                    condition.displacement[entry.component] :
                                                    condition.velocity[entry.component];
        if (!function.is_finite(entry.point, time))
          bad[dim * entry.condition + entry.component] = 1;
      }
    // The nodes may be on any rank; all ranks must agree on the complaint.
    dealii::Utilities::MPI::max(bad, communicator, bad);
    const char *axes[] = {"x", "y", "z"};
    for (unsigned int k = 0; k < n_conditions; ++k)
      for (unsigned int d = 0; d < dim; ++d)
        if (bad[dim * k + d] > 0)
          throw InputError("this formula is not a finite number somewhere at the nodes that it holds")
            .parameter("Boundary conditions/" + loads.conditions[k].name +
                       (loads.conditions[k].displacement[d].is_present() ? "/u_" : "/v_") + axes[d])
            .hint("look for poles, for roots and logarithms of negative numbers, and for places far from all "
                  "points of a field of Tables, whose coordinates are in metres");
  }

  template <int dim>
  void DirichletNodes<dim>::set_boundary_values(const Loads<dim> &loads,
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
  void DirichletNodes<dim>::set_velocities(const Loads<dim>  &loads,
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
  void DirichletNodes<dim>::set_nodal_values(const std::vector<dealii::Tensor<1, dim>> &values,
                                             NodalVector                               &displacement) const
  {
    for (const Entry &entry : list)
      displacement.local_element(dim * entry.node + entry.component) = values[entry.node][entry.component];
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>> DirichletNodes<dim>::sum_by_condition(const NodalVector &force,
                                                                            MPI_Comm communicator) const
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
  double DirichletNodes<dim>::work(const NodalVector &force,
                                   const NodalVector &displacement,
                                   MPI_Comm           communicator) const
  {
    double sum = 0;
    for (std::size_t i = 0; i < held.size(); ++i)
      if (held[i])
        sum += force.local_element(i) * displacement.local_element(i);
    return dealii::Utilities::MPI::sum(sum, communicator);
  }

  PERIDEAL_INSTANTIATE_CLASS(DirichletNodes)
} // namespace perideal
