// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_problem_finite_elements_h
#define perideal_problem_finite_elements_h

#include <perideal/materials/elastic_state.h>
#include <perideal/problem/problem.h>

#include <type_traits>

namespace perideal
{
  /// Returns what finite elements on the mesh itself have at the nodes.
  /// @param evaluate values from one point of each cell, both by active_cell_index()
  template <int dim, typename Evaluate>
  auto in_cells_of_nodes(const Nodes<dim> &nodes, const Evaluate &evaluate)
  {
    const auto                     &node_of_cell = nodes.node_of_cell;
    std::vector<dealii::Point<dim>> point_of_cell(node_of_cell.size());
    for (std::size_t cell = 0; cell < point_of_cell.size(); ++cell)
      if (node_of_cell[cell] != dealii::numbers::invalid_unsigned_int)
        point_of_cell[cell] = nodes.position[node_of_cell[cell]];
    const auto                     values = evaluate(point_of_cell);
    std::decay_t<decltype(values)> result(nodes.size());
    for (std::size_t cell = 0; cell < values.size(); ++cell)
      if (node_of_cell[cell] != dealii::numbers::invalid_unsigned_int)
        result[node_of_cell[cell]] = values[cell];
    return result;
  }

  /// Returns a solution by finite elements on the mesh itself, ElasticFem or HyperelasticFem, at the nodes,
  /// rigid-body motions removed.
  template <int dim, typename Fem>
  NodalField<dim> on_mesh_at_nodes(const Problem<dim> &problem, const Fem &fem)
  {
    const Nodes<dim> &nodes = *problem.body.nodes;
    NodalField<dim>   result =
      in_cells_of_nodes(nodes, [&](const auto &points) { return fem.evaluate_in_cells(points); });
    problem.free_motions.remove_mean(nodes, result);
    return result;
  }

  /// Returns linear finite elements of the degree that the scene compares with. Collective.
  template <int dim>
  FemSolution<dim> solve_compared_fem(Problem<dim> &problem, const double time);

  /// Returns Q2 finite elements on the refined mesh, or on the reference's own mesh, at the nodes.
  /// Collective.
  template <int dim>
  NodalField<dim> reference_at_nodes(Problem<dim> &problem);
} // namespace perideal

#endif
