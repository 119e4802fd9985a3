// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_weights_node_values_h
#define perideal_operators_weights_node_values_h

#include <perideal/operators/weights/gradient_moments.h>

#include <vector>

namespace perideal
{
  /// Values of the polynomials at the nodes [m], by owned node, of a displacement of means over cells; nodes
  /// lie at centroids, unless they were perturbed. Collective.
  template <int dim>
  std::vector<dealii::Tensor<1, dim>> values_at_nodes(const GradientMoments<dim> &moments,
                                                      const NodalVector          &displacement)
  {
    std::vector<typename GradientMoments<dim>::Place> places;
    const auto                                       &position = moments.cell_polynomials().graph().position;
    for (LocalIndex i = 0; i < moments.n_owned(); ++i)
      places.push_back({i, position[i]});
    return moments.values_at(places, displacement);
  }
} // namespace perideal

#endif
