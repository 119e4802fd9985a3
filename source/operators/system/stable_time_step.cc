// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/system/largest_eigenvalue.h>
#include <perideal/operators/system/stable_time_step.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/diagonal_matrix.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace perideal
{
  template <int dim>
  double stable_time_step(const ConstrainedOperator<dim>                                &system,
                          const std::function<double(const dealii::types::material_id)> &density,
                          const std::vector<bool>                                       &moves)
  {
    dealii::DiagonalMatrix<NodalVector> inverse_mass;
    auto                               &diagonal = inverse_mass.get_vector();
    system.initialize(diagonal);
    const NodeCloud<dim> &nodes = system.mirror_layer().nodes();
    for (LocalIndex i = 0; i < system.n_nodes(); ++i)
      for (int d = 0; d < dim; ++d)
        diagonal.local_element(dim * i + d) = 1. / (density(nodes.material[i]) * nodes.volume[i]);
    return 2. / std::sqrt(estimate_largest_eigenvalue(system, inverse_mass, 10, moves));
  }

  template <int dim>
  std::vector<unsigned int>
  local_step_levels(const ConstrainedOperator<dim>                                &system,
                    const std::function<double(const dealii::types::material_id)> &density,
                    const std::function<double(const std::vector<bool> &)>        &stable_of,
                    const double                                                   step,
                    const double                                                   safety,
                    const unsigned int                                             n_levels)
  {
    // Estimates from Lanczos steps differ by some per cent.
    constexpr double      tolerance = 1.05;
    const NodeCloud<dim> &nodes     = system.mirror_layer().nodes();
    const auto            blocks    = system.jacobi_blocks();
    std::vector<double>   slowness(system.n_nodes());
    double                fastest = std::numeric_limits<double>::infinity();
    for (LocalIndex i = 0; i < system.n_nodes(); ++i)
      {
        slowness[i] = std::sqrt(density(nodes.material[i]) * nodes.volume[i] / trace(blocks[i]));
        fastest     = std::min(fastest, slowness[i]);
      }
    fastest                               = dealii::Utilities::MPI::min(fastest, system.communicator());
    const double              safe_of_all = safety * stable_of({});
    std::vector<unsigned int> result(system.n_nodes(), 0);
    for (unsigned int level = 1; level < n_levels; ++level)
      {
        const double ratio = std::ldexp(1., level);
        // Of irregular cells the diagonal says too little: the bar is raised until the step is stable.
        std::vector<bool> is_slow(result.size());
        double            bar = fastest * ratio * step / (tolerance * safe_of_all);
        for (bool is_stable = false; !is_stable;)
          {
            unsigned int any = 0;
            for (LocalIndex i = 0; i < result.size(); ++i)
              {
                is_slow[i] = result[i] == level - 1 && slowness[i] >= bar;
                any        = is_slow[i] ? 1 : any;
              }
            if (dealii::Utilities::MPI::max(any, system.communicator()) == 0)
              return result;
            const double excess = ratio * step / (safety * stable_of(is_slow));
            is_stable           = excess <= tolerance;
            bar *= std::max(1.02, excess);
          }
        for (LocalIndex i = 0; i < result.size(); ++i)
          if (is_slow[i])
            result[i] = level;
      }
    return result;
  }

  PERIDEAL_INSTANTIATE(stable_time_step)
  PERIDEAL_INSTANTIATE(local_step_levels)
} // namespace perideal
