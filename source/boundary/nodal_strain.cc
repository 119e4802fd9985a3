// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/boundary/nodal_strain.h>

namespace perideal
{
  template <int dim>
  std::vector<dealii::SymmetricTensor<2, dim>>
  compute_nodal_strain(const FaceGradient<dim>                   &gradient,
                       const FaceValues<dim>                     &prescribed,
                       const Nodes<dim>                          &nodes,
                       const std::vector<dealii::Tensor<1, dim>> &displacement)
  {
    const auto                          all  = gradient.graph().with_ghosts(displacement);
    const auto                         &rows = gradient.rows();
    std::vector<dealii::Tensor<2, dim>> gradients(displacement.size());
    for (LocalIndex i = 0; i < gradients.size(); ++i)
      for (BondIndex k = rows.first[i]; k < rows.first[i + 1]; ++k)
        gradients[i] += outer_product(all[rows.column[k]], rows.value[k]);

    for (const auto &entry : prescribed.entries())
      {
        const BoundaryPoint<dim> &point        = gradient.boundary_points()[entry.point];
        const auto                interpolated = gradient.boundary_value(entry.point, all);
        gradients[point.node] -=
          outer_product((interpolated * entry.normal) * entry.normal, point.area) / nodes.volume[point.node];
        for (unsigned int d = 0; d < dim; ++d)
          if (entry.condition[d] != FaceValues<dim>::free)
            gradients[point.node][d] +=
              (entry.value[d] - interpolated[d]) / nodes.volume[point.node] * point.area;
      }

    std::vector<dealii::SymmetricTensor<2, dim>> result;
    for (const auto &g : gradients)
      result.push_back(symmetrize(g));
    return result;
  }

  PERIDEAL_INSTANTIATE(compute_nodal_strain)
} // namespace perideal
