// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/boundary/surface_planes.h>
#include <perideal/materials/bond_based.h>
#include <perideal/materials/boundary_compensation.h>
#include <perideal/materials/models.h>
#include <perideal/operators/linear/gauss_operator.h>
#include <perideal/operators/linear/surface_cure.h>
#include <perideal/operators/weights/bond_weights.h>
#include <perideal/problem/discrete_body.h>
#include <perideal/quadrature/gauss_points.h>
#include <perideal/quadrature/regular_body.h>

#include <cmath>

namespace perideal
{
  namespace
  {
    /// Factors that stiffen bonds near the surface, by owned node; empty where the scene has none.
    /// @param points of the cells; null: one point each
    template <int dim>
    std::vector<double> compensation_factors(const Body<dim>        &body,
                                             const Families<dim>    &families,
                                             const GaussPoints<dim> *points = nullptr)
    {
      const SceneParameters &parameters = body.parameters;
      const auto            &nodes      = *body.nodes;
      std::vector<double>    result;
      if (parameters.model.boundary_compensation == BoundaryCompensation::closed_form)
        for (const auto &planes :
             find_surface_planes<dim>(nodes, gather_faces(body.faces, nodes.communicator)))
          {
            std::vector<double> depths;
            for (const SurfacePlane<dim> &plane : planes)
              depths.push_back(plane.depth);
            result.push_back(plane_compensation<dim>(nodes.horizon[result.size()], depths));
          }
      else if (parameters.model.compensates())
        {
          // Of a unit cell in a regular body, or of the sphere itself.
          const double whole =
            body.mesh->thickness * (parameters.model.boundary_compensation == BoundaryCompensation::sphere ?
                                      BondBased<dim>::sphere_moment(parameters.nodes.horizon_factor) :
                                      regular_first_moment<dim>(parameters.nodes, parameters.quadrature));
          for (LocalIndex i = 0; i < nodes.size(); ++i)
            result.push_back(whole * std::pow(nodes.spacing[i], dim + 1) /
                             (points ? first_moment(families, *points, i) : first_moment(families, i)));
        }
      return result;
    }
  } // namespace

  template <int dim>
  void DiscreteBody<dim>::weigh_nodes(const Body<dim> &body, const BondPredicate<dim> &is_cut)
  {
    const SceneParameters &parameters = body.parameters;
    const auto             solid_of   = solids_of_model(body);
    model = create_model<dim>(parameters.model, body.mesh->thickness, compensation_factors(body, *families));
    weights = weigh_bonds<dim>(families,
                               *model,
                               solid_of,
                               {parameters.model.after_the_cut() ? is_cut : nullptr,
                                parameters.model.recomputes(),
                                parameters.nodes.share_equal_families});
    bonds   = create_bond_operator<dim>(weights);
    if (parameters.model.has_surface_cure())
      bonds = std::make_shared<SurfaceCure<dim>>(bonds, gradients.linear, body.nodes->volume, solid_of);
  }

  template <int dim>
  void DiscreteBody<dim>::weigh_gauss_points(const Body<dim> &body)
  {
    const SceneParameters &parameters = body.parameters;
    const auto             solid_of   = solids_of_model(body);
    const auto             points     = std::make_shared<GaussPoints<dim>>(
      *body.mesh, *body.nodes, *families, parameters.quadrature.gauss_points);
    points->fit(*body.nodes, parameters.quadrature.support_radius);
    std::vector<double> modulus(families->n_local());
    for (LocalIndex i = 0; i < families->n_local(); ++i)
      modulus[i] = BondBased<dim>::micromodulus(solid_of(families->material[i]).isotropic().bulk_modulus(),
                                                families->horizon[i],
                                                body.mesh->thickness);

    Stiffening stiffening;
    stiffening.of_neighbour = parameters.model.compensation_of_a_bond == CompensationOfABond::neighbour;
    if (parameters.model.compensates())
      {
        NodalVector factor(families->make_partitioner(1));
        const auto  own = compensation_factors(body, *families, points.get());
        std::copy(own.begin(), own.end(), factor.begin());
        factor.update_ghost_values();
        for (LocalIndex i = 0; i < families->n_local(); ++i)
          stiffening.factor.push_back(factor.local_element(i));
      }
    bonds = std::make_shared<GaussOperator<dim>>(families, points, modulus, stiffening);
  }

  PERIDEAL_INSTANTIATE_CLASS(DiscreteBody)
} // namespace perideal
