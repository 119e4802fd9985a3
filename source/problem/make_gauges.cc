// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/problem/make_gauges.h>

namespace perideal
{
  template <int dim>
  Gauges<dim> make_gauges(const Problem<dim> &problem)
  {
    const Mesh<dim> &mesh = *problem.body.mesh;
    const auto       list = read_gauges<dim>(problem.parameters.gauges);
    if (const auto &polynomials = problem.discretisation.gradients.polynomials)
      return {mesh, *polynomials, list};
    return {mesh, CellGraph<dim>(mesh, *problem.body.nodes), list};
  }

  PERIDEAL_INSTANTIATE(make_gauges)
} // namespace perideal
