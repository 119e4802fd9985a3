// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/weights/node_values.h>
#include <perideal/recorders/point_values.h>

#include <deal.II/base/mpi.h>

#include <utility>

namespace perideal
{
  template <int dim>
  PointValues<dim>::PointValues(const Problem<dim> &problem, const std::vector<NamedPoint> &points)
    : problem(problem)
  {
    const Mesh<dim> &mesh   = *problem.body.mesh;
    const auto       is_cut = problem.failure.precrack_test();
    if (const auto &polynomials = problem.discretisation.gradients.polynomials)
      {
        of_nodes       = PointInterpolation<dim>(mesh, polynomials->graph(), points, is_cut);
        of_polynomials = PointInterpolation<dim>(mesh, *polynomials, points);
      }
    else
      of_nodes = PointInterpolation<dim>(mesh, CellGraph<dim>(mesh, *problem.body.nodes), points, is_cut);
  }

  template <int dim>
  std::vector<typename PointValues<dim>::Column> PointValues<dim>::take()
  {
    return std::exchange(columns, {});
  }

  template <int dim>
  void PointValues<dim>::add_vector(const std::string                         &name,
                                    const std::vector<dealii::Tensor<1, dim>> &values)
  {
    const char *const axes[] = {"x", "y", "z"};
    for (int d = 0; d < dim; ++d)
      add_column(of_nodes, name + "_" + axes[d], [&](const LocalIndex i) { return values[i][d]; });
  }

  template <int dim>
  void PointValues<dim>::add_displacement(const std::string                         &name,
                                          const std::vector<dealii::Tensor<1, dim>> &values)
  {
    const auto &moments = problem.discretisation.gradients.moments;
    if (!moments)
      {
        add_vector(name, values);
        return;
      }
    // Polynomials take means over cells; values are those at centroids, rigid-body motions removed.
    const char *const axes[]   = {"x", "y", "z"};
    const auto        at_nodes = values_at_nodes(*moments, problem.state.unknowns);
    for (int d = 0; d < dim; ++d)
      add_column(of_polynomials, name + "_" + axes[d], [&](const LocalIndex i) {
        return values[i][d] + problem.state.unknowns.local_element(dim * i + d) - at_nodes[i][d];
      });
  }

  template <int dim>
  void PointValues<dim>::add_scalar(const std::string &name, const std::vector<double> &values)
  {
    add_column(of_nodes, name, [&](const LocalIndex i) { return values[i]; });
  }

  template <int dim>
  void PointValues<dim>::add_column(const PointInterpolation<dim>                 &interpolation,
                                    const std::string                             &name,
                                    const std::function<double(const LocalIndex)> &value)
  {
    std::vector<double> sums;
    for (const auto &shares : interpolation.shares())
      {
        sums.push_back(0.);
        for (const auto &[node, share] : shares)
          sums.back() += share * value(node);
      }
    dealii::Utilities::MPI::sum(sums, problem.run.communicator, sums);
    columns.push_back({name, sums});
  }

  PERIDEAL_INSTANTIATE_CLASS(PointValues)
} // namespace perideal
