// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/simulation.h>
#include <perideal/materials/bond_based.h>
#include <perideal/operators/gauss_operator.h>

// Simulation: bonds whose cells have several points.

namespace perideal
{
  template <int dim>
  void Simulation<dim>::weigh_gauss_points()
  {
    const Timings::Scope part(timings, "setup: weights");
    const auto           solid_of = solid_of_model();
    const auto          &families = *scene.families;
    const auto           points   = std::make_shared<const GaussPoints<dim>>(*scene.mesh,
                                                                 *scene.nodes,
                                                                 families,
                                                                 parameters.quadrature.gauss_points,
                                                                 parameters.quadrature.support_radius);
    std::vector<double>  modulus(families.n_local());
    for (LocalIndex i = 0; i < families.n_local(); ++i)
      modulus[i] = BondBased<dim>::micromodulus(solid_of(families.material[i]).isotropic().bulk_modulus(),
                                                families.horizon[i],
                                                scene.mesh->thickness);
    scene.bonds = std::make_shared<GaussOperator<dim>>(scene.families, points, modulus, Stiffening());
  }

  template <int dim>
  void Simulation<dim>::add_missing_bonds()
  {
    const Timings::Scope part(timings, "setup: missing bonds");
    scene.missing_bonds =
      std::make_shared<MissingBonds<dim>>(scene.bonds,
                                          scene.gradient,
                                          find_surface_planes<dim>(*scene.nodes, scene.surface),
                                          scene.loads,
                                          scene.condition_boundaries,
                                          solid_of_model());
    scene.bonds = scene.missing_bonds;
  }

  template void Simulation<2>::weigh_gauss_points();
  template void Simulation<2>::add_missing_bonds();
  template void Simulation<3>::weigh_gauss_points();
  template void Simulation<3>::add_missing_bonds();
} // namespace perideal
