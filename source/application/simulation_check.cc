// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/advice.h>
#include <perideal/application/report.h>
#include <perideal/application/simulation.h>
#include <perideal/base/instantiate.h>
#include <perideal/output/summary.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace perideal
{
  template <int dim>
  void Simulation<dim>::check()
  {
    make_mesh();
    make_nodes_and_families();
    if (parameters.solver.is_dynamic())
      prepare_dynamics();
    if (parameters.solver.is_nonlinear_static())
      prepare_cracks();
    weigh_bonds();
    make_relative_damping();
    screen << banner(parameters, scene);

    const std::size_t bytes = dealii::Utilities::MPI::sum(
      scene.families->memory_consumption() + scene.bonds->memory_consumption(), communicator);
    screen << "memory      about " << short_number(bytes / 1e6) << " MB for families and bonds, "
           << short_number(static_cast<double>(bytes) / scene.nodes->n_global) << " B a node"
           << (parameters.solver.is_dynamic() || parameters.solver.is_relaxation() ?
                 "" :
                 "; the preconditioner takes about as much again")
           << '\n';
    screen << "time step   " << short_number(largest_stable_step())
           << " s is the largest stable one of explicit dynamics\n";
    for (const auto id : scene.mesh->material_ids)
      {
        double largest_horizon = 0;
        for (LocalIndex i = 0; i < scene.nodes->size(); ++i)
          if (scene.nodes->material[i] == id)
            largest_horizon = std::max(largest_horizon, scene.nodes->horizon[i]);
        largest_horizon      = dealii::Utilities::MPI::max(largest_horizon, communicator);
        const double stretch = critical_stretch(id, largest_horizon);
        screen << "material    " << scene.mesh->material_name(id) << ": ";
        if (std::isfinite(stretch))
          screen << "critical stretch " << short_number(stretch) << " at the largest horizon, "
                 << short_number(largest_horizon) << " m\n";
        else if (const double strength = properties_of(id).tensile_strength; strength > 0)
          // Irwin's length: a crack in an infinite plate with K^2 = E G bears the strength at r = E G/(2 pi
          // f^2).
          screen << name_of(parameters.material.failure_criterion) << ", " << short_number(strength)
                 << " Pa; at half the largest horizon, " << short_number(0.5 * largest_horizon)
                 << " m, before a crack it stands for a fracture energy of "
                 << short_number(dealii::numbers::PI * largest_horizon * strength * strength /
                                 scene.solids.at(id).isotropic().young_modulus)
                 << " J/m^2\n";
        else
          screen << "no fracture energy given, unbreakable\n";
      }
    if (!parameters.solver.is_dynamic() && !parameters.solver.is_nonlinear_static())
      {
        if (!scene.gradient)
          make_gradient();
        screen << "suits       " << suitable_form(parameters, thin_cells(scene)) << '\n';
      }
    for (const std::string &warning : warnings(parameters, scene))
      screen << "warning     " << warning << '\n';
    if (!parameters.solver.is_dynamic())
      find_free_motions();
    screen << "nothing was solved" << std::endl;
  }

  PERIDEAL_INSTANTIATE_CLASS(Simulation)
} // namespace perideal
