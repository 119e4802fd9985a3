// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_tests_unit_moments_h
#define perideal_tests_unit_moments_h

#include <perideal/materials/models.h>
#include <perideal/operators/linear/consistent_operator.h>

#include <memory>

namespace perideal::test
{
  /// Gradients and their moments of the cells of a mesh, of one material. Collective.
  template <int dim>
  std::shared_ptr<const GradientMoments<dim>>
  make_moments(const Mesh<dim>                              &mesh,
               const Nodes<dim>                             &nodes,
               const std::shared_ptr<const FaceValues<dim>> &values,
               const BondPredicate<dim>                     &is_cut  = {},
               const CellUnknown                             unknown = CellUnknown::mean)
  {
    const auto polynomials = std::make_shared<const CellPolynomials<dim>>(
      mesh, nodes, typename CellPolynomials<dim>::Stiffness(), is_cut, unknown);
    return std::make_shared<const GradientMoments<dim>>(
      polynomials,
      std::make_shared<const FaceMoments<dim>>(
        mesh, *polynomials, [](const auto) { return 1.; }, is_cut),
      values,
      nodes.communicator);
  }

  /// The operator of the consistent form, of bonds of its own. Collective.
  template <int dim>
  std::shared_ptr<ConsistentOperator<dim>>
  make_consistent_operator(const std::shared_ptr<const Families<dim>>        &families,
                           const std::shared_ptr<const GradientMoments<dim>> &moments,
                           const Consistent<dim>                             &model,
                           const SolidOf<dim>                                &solid_of,
                           const BondPredicate<dim>                          &is_cut = {})
  {
    return std::make_shared<ConsistentOperator<dim>>(
      families,
      moments,
      std::make_shared<ConsistentBonds<dim>>(families, moments->cell_polynomials(), model, solid_of, is_cut),
      solid_of);
  }
  /// The same in motion, where values at centroids are the unknowns. Collective.
  template <int dim>
  std::shared_ptr<ConsistentOperator<dim>>
  make_moving_operator(const Mesh<dim>                            &mesh,
                       const Nodes<dim>                           &nodes,
                       const std::shared_ptr<const Families<dim>> &families,
                       const double                                horizon_factor,
                       const SolidOf<dim>                         &solid_of)
  {
    ModelParameters parameters;
    parameters.resolve(dim, ModelParameters::Use::motion, true);
    return make_consistent_operator<dim>(
      families,
      make_moments(
        mesh, nodes, std::make_shared<const FaceValues<dim>>(), BondPredicate<dim>(), CellUnknown::value),
      create_consistent<dim>(parameters, horizon_factor),
      solid_of);
  }
} // namespace perideal::test

#endif
