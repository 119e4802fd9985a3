// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/simulation.h>
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/operators/linear/polynomial_response.h>

#include <deal.II/base/mpi.h>

// Simulation: bonds that are missing behind the surface, and the stiffness of families that lack none.

namespace perideal
{
  template <int dim>
  void Simulation<dim>::add_taylor_extension()
  {
    // Between materials a uniform strain needs forces that no missing bond stands for.
    if (scene.mesh->material_ids.size() > 1)
      throw InputError("what ghosts do is known in bodies of one material")
        .parameter("Boundary conditions/Traction treatment")
        .given(name_of(parameters.loads.traction_treatment))
        .allowed("automatic | layer for several cell groups");
    const Timings::Scope part(timings, "setup: ghosts");
    scene.ghosts =
      std::make_shared<TaylorExtension<dim>>(scene.bonds,
                                             scene.families,
                                             *scene.nodes,
                                             scene.faces,
                                             scene.surface,
                                             scene.loads,
                                             solid_of_model()(*scene.mesh->material_ids.begin()).stiffness());
    scene.bonds = scene.ghosts;
  }

  template <int dim>
  void Simulation<dim>::measure_families()
  {
    if (scene.ghosts)
      scene.family_stiffness = scene.ghosts->stiffness();
    else if (parameters.comparison.by_families())
      {
        const PolynomialResponse<dim> response(*scene.bonds, *scene.families);
        std::vector<std::uint8_t>     is_whole(scene.families->n_owned());
        for (LocalIndex i = 0; i < is_whole.size(); ++i)
          is_whole[i] = !response.lacks_bonds(i);
        scene.family_stiffness = response.stiffness(is_whole);
      }
    if (parameters.comparison.by_families() &&
        (!scene.family_stiffness || scene.mesh->material_ids.size() > 1))
      throw InputError(scene.family_stiffness ? "families of several materials have several stiffnesses" :
                                                "no family is whole, from which stiffness could be told")
        .parameter("Comparison/Stiffness")
        .given(parameters.comparison.stiffness)
        .allowed("material for this scene");
  }

  template <int dim>
  typename Simulation<dim>::GhostBalance Simulation<dim>::balance_of_ghosts(const double time) const
  {
    GhostBalance result;
    result.reactions.resize(scene.loads.conditions.size());
    for (const auto &seen : scene.ghosts->face_tractions(displacement, scene.loads, time))
      for (std::size_t k = 0; k < result.reactions.size(); ++k)
        if (scene.loads.conditions[k].acts_on(seen.boundary))
          for (unsigned int d = 0; d < dim; ++d)
            if (scene.loads.conditions[k].holds(d))
              result.reactions[k][d] += seen.point.area * seen.traction[d];
    for (auto &reaction : result.reactions)
      reaction = dealii::Utilities::MPI::sum(reaction, communicator);

    // What bonds resist with, and what ghosts and other external forces do, which holds the balance.
    NodalVector by_bonds, residual;
    scene.bonds->initialize(by_bonds);
    scene.bonds->initialize(residual);
    scene.ghosts->plain_bonds().vmult(by_bonds, displacement);
    scene.system->residual(residual, external_force, displacement);
    result.strain_energy = 0.5 * (by_bonds * displacement);
    result.external_work = result.strain_energy + 0.5 * (residual * displacement);
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(Simulation)

} // namespace perideal
