// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/reconstruction/cell_moments.h>

#include <deal.II/fe/fe_q.h>

namespace perideal
{
  template <int dim>
  CellMoments<dim>::CellMoments()
    : quadrature(3)
  {
    const dealii::FE_Q<dim> shape(1);
    for (const auto &point : quadrature.get_points())
      {
        std::array<double, n_vertices>                 value;
        std::array<dealii::Tensor<1, dim>, n_vertices> gradient;
        for (unsigned int v = 0; v < n_vertices; ++v)
          {
            value[v]    = shape.shape_value(v, point);
            gradient[v] = shape.shape_grad(v, point);
          }
        values.push_back(value);
        gradients.push_back(gradient);
      }
  }

  template <int dim>
  void CellMoments<dim>::integrate(const typename dealii::Triangulation<dim>::cell_iterator &cell,
                                   dealii::Point<dim>                                       &centroid,
                                   dealii::SymmetricTensor<2, dim> &second_moment) const
  {
    std::array<dealii::Tensor<1, dim>, n_vertices> vertex;
    for (unsigned int v = 0; v < n_vertices; ++v)
      vertex[v] = cell->vertex(v) - cell->vertex(0);
    double                          measure = 0;
    dealii::Tensor<1, dim>          first;
    dealii::SymmetricTensor<2, dim> second;
    for (unsigned int q = 0; q < values.size(); ++q)
      {
        dealii::Tensor<1, dim> x;
        dealii::Tensor<2, dim> jacobian;
        for (unsigned int v = 0; v < n_vertices; ++v)
          {
            x += values[q][v] * vertex[v];
            jacobian += outer_product(vertex[v], gradients[q][v]);
          }
        const double part = determinant(jacobian) * quadrature.weight(q);
        measure += part;
        first += part * x;
        second += part * symmetrize(outer_product(x, x));
      }
    first /= measure;
    centroid      = cell->vertex(0) + first;
    second_moment = second / measure - symmetrize(outer_product(first, first));
  }

  PERIDEAL_INSTANTIATE_CLASS(CellMoments)
} // namespace perideal
