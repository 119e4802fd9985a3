// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_tests_unit_moments_h
#define perideal_tests_unit_moments_h

#include <perideal/operators/weights/gradient_moments.h>

#include <memory>

namespace perideal::test
{
  /// Gradients and their moments of the cells of a mesh, of one material. Collective.
  template <int dim>
  std::shared_ptr<const GradientMoments<dim>> make_moments(
    const Mesh<dim> &mesh, const Nodes<dim> &nodes, const std::shared_ptr<const FaceValues<dim>> &values)
  {
    const auto polynomials = std::make_shared<const CellPolynomials<dim>>(mesh, nodes);
    return std::make_shared<const GradientMoments<dim>>(
      polynomials,
      std::make_shared<const FaceMoments<dim>>(mesh, polynomials->graph(), [](const auto) { return 1.; }),
      values,
      nodes.communicator);
  }
} // namespace perideal::test

#endif
