// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_boundary_cell_expansion_h
#define perideal_boundary_cell_expansion_h

#include <perideal/nodes/nodes.h>
#include <perideal/parameters/load_parameters.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace perideal
{
  /// The strain by which the cells of owned nodes would expand freely in all directions, by node.
  template <int dim>
  struct CellExpansion
  {
    /// No expansion.
    explicit CellExpansion(const LocalIndex n_cells)
      : mean(n_cells, 0.)
      , moment(n_cells)
    {
    }

    /// Its mean over the cell [-].
    std::vector<double> mean;
    /// The integral of its product with the distance from the centroid [m^4], in 2-D times the thickness.
    std::vector<dealii::Tensor<1, dim>> moment;

    /// Integrates over the cells at a time by three Gauss points in each direction.
    void set(const Mesh<dim> &mesh, const Nodes<dim> &nodes, const Loads<dim> &loads, const double time);
  };
} // namespace perideal

#endif
