// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_system_largest_eigenvalue_h
#define perideal_operators_system_largest_eigenvalue_h

#include <perideal/operators/system/constrained_operator.h>

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_control.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  /// An operator on the motions of some nodes, with all others held.
  template <int dim>
  struct RestrictedOperator
  {
    void vmult(NodalVector &result, const NodalVector &source) const
    {
      system.vmult(result, source);
      restrict_to_moving(result);
    }

    void restrict_to_moving(NodalVector &vector) const
    {
      for (std::size_t i = 0; i < moves.size(); ++i)
        for (int d = 0; d < dim && !moves[i]; ++d)
          vector.local_element(dim * i + d) = 0.;
    }

    const ConstrainedOperator<dim> &system;
    /// By owned node; empty: all move.
    const std::vector<bool> &moves;
  };

  /// Estimates the largest eigenvalue of the preconditioned operator by Lanczos steps, which
  /// underestimate it by a few per cent; the result is 1.1 times theirs. Steps that fail because the
  /// operator is indefinite or unsymmetric do not count. Returns 0 where nothing is free to move. Collective.
  /// @param moves by owned node: the others are held, and the preconditioner is diagonal; empty: all move
  template <int dim, typename Preconditioner>
  double estimate_largest_eigenvalue(const ConstrainedOperator<dim> &system,
                                     const Preconditioner           &preconditioner,
                                     const unsigned int              steps = 10,
                                     const std::vector<bool>        &moves = {})
  {
    NodalVector source, solution;
    system.initialize(source);
    system.initialize(solution);
    // A vector without structure that follows from the positions, since numbers depend on the ranks.
    const NodeCloud<dim> &nodes = system.mirror_layer().nodes();
    for (std::size_t i = 0; i < source.locally_owned_size(); ++i)
      if (!system.is_held(i))
        {
          const std::size_t node = i / dim;
          double            x    = 1. + static_cast<double>(i % dim);
          for (int d = 0; d < dim; ++d)
            x += (12.9898 + 7.1 * d) * nodes.position[node][d] / nodes.horizon[node];
          source.local_element(i) = std::fmod(std::abs(43758.5453 * std::sin(x)), 1.) - 0.5;
        }
    const RestrictedOperator<dim> restricted{system, moves};
    restricted.restrict_to_moving(source);
    double largest = 0;
    // Small bodies have fewer motions than steps: past the last of them there is only round-off.
    dealii::IterationNumberControl control(steps, 1e-12 * source.l2_norm());
    dealii::SolverCG<NodalVector>  cg(control);
    cg.connect_eigenvalues_slot(
      [&](const std::vector<double> &eigenvalues) {
        // Not a number where the operator is indefinite or not symmetric.
        for (const double value : eigenvalues)
          if (std::isfinite(value))
            largest = std::max(largest, value);
      },
      true);
    try
      {
        cg.solve(restricted, solution, source, preconditioner);
      }
    catch (const dealii::SolverControl::NoConvergence &)
      {
        // What the steps before have found counts.
      }
    return 1.1 * largest;
  }
} // namespace perideal

#endif
