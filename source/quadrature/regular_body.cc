// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/quadrature/gauss_points.h>
#include <perideal/quadrature/regular_body.h>

#include <deal.II/grid/grid_generator.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  template <int dim>
  double regular_first_moment(const NodeParameters &parameters, const QuadratureParameters &quadrature)
  {
    // A body of this rank alone, large enough for the family of its middle.
    const unsigned int reach = static_cast<unsigned int>(std::ceil(parameters.horizon_factor)) + 1;
    Mesh<dim>          mesh(MPI_COMM_SELF);
    dealii::GridGenerator::subdivided_hyper_cube(
      mesh.triangulation, 2 * reach + 1, -0.5 - reach, 0.5 + reach);
    NodeParameters spheres = parameters;
    spheres.horizon_shape  = HorizonShape::sphere;
    Nodes<dim> nodes(mesh, spheres);
    prepare_cells(quadrature, mesh, nodes);
    const Families<dim> families(nodes, create_volume_rule<dim>(quadrature));
    const auto          middle = static_cast<LocalIndex>(
      std::min_element(nodes.position.begin(),
                       nodes.position.end(),
                       [](const auto &a, const auto &b) { return a.norm_square() < b.norm_square(); }) -
      nodes.position.begin());
    if (quadrature.has_gauss_points())
      return first_moment(families, GaussPoints<dim>(mesh, nodes, families, quadrature.gauss_points), middle);
    return first_moment(families, middle);
  }

  PERIDEAL_INSTANTIATE(regular_first_moment)
} // namespace perideal
