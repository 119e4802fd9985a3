// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/simulation.h>
#include <perideal/base/instantiate.h>
#include <perideal/materials/bond_based.h>
#include <perideal/materials/boundary_compensation.h>
#include <perideal/operators/linear/gauss_operator.h>
#include <perideal/quadrature/regular_body.h>

#include <cmath>

// Simulation: bonds whose cells have several points, and factors that make up for those missing at the
// surface.

namespace perideal
{
  template <int dim>
  std::vector<double> Simulation<dim>::compensation_factors(const GaussPoints<dim> *points) const
  {
    const auto         &nodes = *scene.nodes;
    std::vector<double> result;
    if (parameters.model.boundary_compensation == BoundaryCompensation::closed_form)
      for (const auto &planes : find_surface_planes<dim>(nodes, scene.surface))
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
          scene.mesh->thickness * (parameters.model.boundary_compensation == BoundaryCompensation::sphere ?
                                     BondBased<dim>::sphere_moment(parameters.nodes.horizon_factor) :
                                     regular_first_moment<dim>(parameters.nodes, parameters.quadrature));
        for (LocalIndex i = 0; i < nodes.size(); ++i)
          result.push_back(
            whole * std::pow(nodes.spacing[i], dim + 1) /
            (points ? first_moment(*scene.families, *points, i) : first_moment(*scene.families, i)));
      }
    return result;
  }

  template <int dim>
  void Simulation<dim>::weigh_gauss_points()
  {
    const Timings::Scope part(timings, "setup: weights");
    const auto           solid_of = solid_of_model();
    const auto          &families = *scene.families;
    const auto           points   = std::make_shared<GaussPoints<dim>>(
      *scene.mesh, *scene.nodes, families, parameters.quadrature.gauss_points);
    points->fit(*scene.nodes, parameters.quadrature.support_radius);
    std::vector<double> modulus(families.n_local());
    for (LocalIndex i = 0; i < families.n_local(); ++i)
      modulus[i] = BondBased<dim>::micromodulus(solid_of(families.material[i]).isotropic().bulk_modulus(),
                                                families.horizon[i],
                                                scene.mesh->thickness);

    Stiffening stiffening;
    stiffening.of_neighbour = parameters.model.compensation_of_a_bond == CompensationOfABond::neighbour;
    if (parameters.model.compensates())
      {
        NodalVector factor(families.make_partitioner(1));
        const auto  own = compensation_factors(points.get());
        std::copy(own.begin(), own.end(), factor.begin());
        factor.update_ghost_values();
        for (LocalIndex i = 0; i < families.n_local(); ++i)
          stiffening.factor.push_back(factor.local_element(i));
      }
    scene.bonds = std::make_shared<GaussOperator<dim>>(scene.families, points, modulus, stiffening);
  }

  PERIDEAL_INSTANTIATE_CLASS(Simulation)

} // namespace perideal
