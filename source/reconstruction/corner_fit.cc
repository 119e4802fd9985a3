// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/least_squares.h>
#include <perideal/reconstruction/corner_fit.h>

namespace perideal
{
  template <int dim>
  CornerValues<dim> fit_at_corners(const MeshPoints<dim>                     &points,
                                   const LocalIndex                           node,
                                   const std::vector<dealii::Tensor<1, dim>> &values)
  {
    using Matrix                                    = Eigen::Matrix<double, dim, dim>;
    const std::vector<dealii::Point<dim>> &position = points.graph().position;
    Matrix                                 offsets = Matrix::Zero(), steps = Matrix::Zero();
    for (const LocalIndex j : points.cells_around(node))
      if (j != node)
        {
          const auto   offset = position[j] - position[node], step = values[j] - values[node];
          const double weight = 1. / offset.norm_square();
          for (int a = 0; a < dim; ++a)
            for (int b = 0; b < dim; ++b)
              {
                offsets(a, b) += weight * offset[a] * offset[b];
                steps(a, b) += weight * step[a] * offset[b];
              }
        }
    // Offsets of a plane of cells differ from one by round-off; flat cells have sides of 1 to 100.
    Matrix gradient = Matrix::Zero();
    if (offsets.trace() > 0)
      gradient = steps * PseudoInverse<Matrix>(offsets, 1e-6).matrix();

    CornerValues<dim> result;
    const auto        cell = points.cell(node);
    for (unsigned int v = 0; v < result.size(); ++v)
      {
        const auto arm = cell->vertex(v) - position[node];
        result[v]      = values[node];
        for (int a = 0; a < dim; ++a)
          for (int b = 0; b < dim; ++b)
            result[v][a] += gradient(a, b) * arm[b];
      }
    return result;
  }

  PERIDEAL_INSTANTIATE(fit_at_corners)
} // namespace perideal
