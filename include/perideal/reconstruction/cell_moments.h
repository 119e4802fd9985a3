// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_reconstruction_cell_moments_h
#define perideal_reconstruction_cell_moments_h

#include <deal.II/base/point.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/grid/tria.h>

#include <array>
#include <vector>

namespace perideal
{
  /// Integrates the centroid and the second moment of (bi-, tri-)linear cells: three points in each direction
  /// integrate both exactly.
  template <int dim>
  class CellMoments
  {
  public:
    CellMoments();

    /// @param centroid set to that of the cell [m]
    /// @param second_moment set to the mean of (x - centroid) (x) (x - centroid) over the cell [m^2]
    void integrate(const typename dealii::Triangulation<dim>::cell_iterator &cell,
                   dealii::Point<dim>                                       &centroid,
                   dealii::SymmetricTensor<2, dim>                          &second_moment) const;

  private:
    static constexpr unsigned int n_vertices = 1u << dim;

    dealii::QGauss<dim>                                         quadrature;
    std::vector<std::array<double, n_vertices>>                 values;
    std::vector<std::array<dealii::Tensor<1, dim>, n_vertices>> gradients;
  };
} // namespace perideal

#endif
