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

  namespace
  {
    /// How many times more steps are worth taking for one level more.
    constexpr double most_shortening = 1.3;

    /// Returns how many times shorter steps would have to be for some more nodes to be of a level, or 1 where
    /// that takes more time. Collective.
    /// @param levels of owned nodes, the highest of them that or the one below @param n_more those of all
    /// ranks @param excess of their steps now
    double worthwhile_shortening(const std::vector<unsigned int> &levels,
                                 const unsigned int               level,
                                 const double                     n_more,
                                 const double                     excess,
                                 MPI_Comm                         communicator)
    {
      double steps = 0;
      for (const unsigned int own : levels)
        steps += std::ldexp(1., -static_cast<int>(own));
      steps             = dealii::Utilities::MPI::sum(steps, communicator);
      const double then = excess * (steps - std::ldexp(n_more, -static_cast<int>(level)));
      return excess < most_shortening && then < steps ? excess : 1.;
    }
  } // namespace

  template <int dim>
  LocalStepLevels local_step_levels(const ConstrainedOperator<dim>                                &system,
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
    fastest                                = dealii::Utilities::MPI::min(fastest, system.communicator());
    const double               safe_of_all = safety * stable_of({});
    LocalStepLevels            levels{std::vector<unsigned int>(system.n_nodes(), 0)};
    std::vector<unsigned int> &result = levels.of_nodes;
    for (unsigned int level = 1; level < n_levels; ++level)
      {
        const double ratio = std::ldexp(1., level);
        // Of irregular cells the diagonal says too little: the bar is raised until the step is stable.
        std::vector<bool> is_slow(result.size());
        double            bar    = fastest * ratio * step / (tolerance * safe_of_all);
        double            n_left = 0, n_wanted = 0, excess_of_these = 0;
        for (bool is_stable = false; !is_stable;)
          {
            double n = 0;
            for (LocalIndex i = 0; i < result.size(); ++i)
              {
                is_slow[i] = result[i] == level - 1 && slowness[i] >= bar;
                n += is_slow[i] ? 1. : 0.;
              }
            n_left = dealii::Utilities::MPI::sum(n, system.communicator());
            if (n_left == 0)
              break;
            const double excess = ratio * step / (safety * stable_of(is_slow));
            is_stable           = excess <= tolerance;
            if (n_wanted == 0)
              {
                n_wanted        = n_left;
                excess_of_these = excess;
              }
            bar *= std::max(1.02, excess);
          }
        for (LocalIndex i = 0; i < result.size(); ++i)
          if (is_slow[i])
            result[i] = level;
        if (levels.shortening == 1. && n_left < n_wanted)
          levels.shortening = worthwhile_shortening(
            result, level, n_wanted - n_left, excess_of_these / (0.98 * tolerance), system.communicator());
        if (n_left == 0)
          break;
      }
    return levels;
  }

  PERIDEAL_INSTANTIATE(stable_time_step)
  PERIDEAL_INSTANTIATE(local_step_levels)
} // namespace perideal
