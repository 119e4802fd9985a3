// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/system/largest_eigenvalue.h>
#include <perideal/operators/system/stable_time_step.h>

#include <deal.II/lac/diagonal_matrix.h>

#include <cmath>

namespace perideal
{
  template <int dim>
  double stable_time_step(const ConstrainedOperator<dim>                                &system,
                          const std::function<double(const dealii::types::material_id)> &density)
  {
    dealii::DiagonalMatrix<NodalVector> inverse_mass;
    auto                               &diagonal = inverse_mass.get_vector();
    system.initialize(diagonal);
    const NodeCloud<dim> &nodes = system.mirror_layer().nodes();
    for (LocalIndex i = 0; i < system.n_nodes(); ++i)
      for (int d = 0; d < dim; ++d)
        diagonal.local_element(dim * i + d) = 1. / (density(nodes.material[i]) * nodes.volume[i]);
    return 2. / std::sqrt(estimate_largest_eigenvalue(system, inverse_mass));
  }

  PERIDEAL_INSTANTIATE(stable_time_step)
} // namespace perideal
