// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/text.h>
#include <perideal/output/summary.h>
#include <perideal/problem/mesh_error.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  template <int dim>
  ErrorEstimate estimate_mesh_error(const Problem<dim> &problem, const double time)
  {
    return estimate_error(*problem.discretisation.gradients.moments,
                          solids_of_model(problem.body),
                          problem.loading.loads,
                          time,
                          problem.state.unknowns,
                          problem.state.displacement);
  }

  namespace
  {
    /// Two digits, of what is known within a factor.
    std::string about(const double value)
    {
      const double digit = std::pow(10., std::floor(std::log10(value)) - 1.);
      return short_number(digit * std::round(value / digit));
    }

    /// Number of cells whose sizes differ by a factor, in place of those there are.
    std::string cells_in_place(const GlobalIndex n_cells, const unsigned int dim, const double factor)
    {
      return "some " + grouped(std::llround(n_cells * std::pow(factor, -static_cast<double>(dim)))) +
             " in place of " + grouped(n_cells);
    }
  } // namespace

  std::string in_words(const ErrorEstimate &estimate)
  {
    const double total = estimate.total();
    return total > 0.5 ? "the mesh does not resolve the displacement: its estimated error is above 50 %" :
           total > 0.  ? "the mesh leaves about " + about(100. * total) +
                          " % of error in the displacement (l2, estimated, mostly within a factor of three)" :
                        "the mesh leaves no error in this displacement";
  }

  std::string mesh_of_one_percent(const ErrorEstimate &estimate,
                                  const GlobalIndex    n_cells,
                                  const unsigned int   dim,
                                  const unsigned int   refinements)
  {
    constexpr double wanted = 0.01;
    if (estimate.total() > wanted)
      {
        const double factor = estimate.factor_for(wanted);
        const auto   more   = static_cast<unsigned int>(std::ceil(std::log2(1. / factor)));
        return "for 1 % take cells about " + about(factor) + " times as large, " +
               cells_in_place(n_cells, dim, factor) +
               " (Mesh/Refinements = " + std::to_string(refinements + more) + ")" +
               (estimate.rough > 0.5 * estimate.total() ?
                  ", or fewer that are finer where the strain changes fast: at corners, holes, ends of "
                  "supports" :
                  "");
      }
    // Beyond that the mesh would not show the body any more.
    const double factor = std::min(estimate.total() > 0. ? estimate.factor_for(wanted) : 4., 4.);
    if (factor < 1.3)
      return "it suits an error of 1 %";
    return "cells about " + about(factor) + " times as large would do for 1 %, " +
           cells_in_place(n_cells, dim, factor) + ", as long as they show the body's shape";
  }

  PERIDEAL_INSTANTIATE(estimate_mesh_error)
} // namespace perideal
