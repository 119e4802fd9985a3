// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/base/text.h>
#include <perideal/drivers/driver.h>
#include <perideal/output/summary.h>
#include <perideal/problem/advice.h>
#include <perideal/problem/description.h>
#include <perideal/problem/mesh_error.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <functional>

// Driver: a scene is checked, and no more of it solved than an estimate of the error takes.

namespace perideal
{
  namespace
  {
    /// What breaks each material.
    template <int dim>
    void print_materials(Problem<dim> &problem)
    {
      const Body<dim>                &body  = problem.body;
      const Nodes<dim>               &nodes = *body.nodes;
      auto                           &out   = problem.run.screen;
      typename Failure<dim>::Breaking breaking;
      const MaterialParameters       &material  = problem.parameters.material;
      const bool                      by_stress = material.has_criterion();
      if (can_break(problem.parameters) && (!by_stress || material.softens()))
        breaking = Failure<dim>::breaking(body, problem.discretisation);
      for (const auto id : body.mesh->material_ids)
        {
          double horizon = 0;
          for (LocalIndex i = 0; i < nodes.size(); ++i)
            if (nodes.material[i] == id)
              horizon = std::max(horizon, nodes.horizon[i]);
          horizon                        = dealii::Utilities::MPI::max(horizon, problem.run.communicator);
          const MaterialProperties &data = body.properties_of(id);
          out << "material    " << body.mesh->material_name(id) << ": ";
          if (breaking.stretch.count(id) > 0)
            out << "critical stretch " << short_number(breaking.stretch.at(id)) << " on average"
                << (by_stress ? ", softening from " + name_of(material.failure_criterion) + " on" : "")
                << "\n";
          else if (const double strength = data.tensile_strength; strength > 0)
            // Irwin's length: a crack in an infinite plate with K^2 = E G bears the strength at
            // r = E G/(2 pi f^2).
            out << name_of(material.failure_criterion) << ", " << short_number(strength)
                << " Pa; at half the largest horizon, " << short_number(0.5 * horizon)
                << " m, before a crack it stands for a fracture energy of "
                << short_number(dealii::numbers::PI * horizon * strength * strength /
                                body.solids.at(id).isotropic().young_modulus)
                << " J/m^2\n";
          else
            out << "no fracture energy given, unbreakable\n";
        }
      if (const auto &share = breaking.share_of_energy; share && share->mean > 0)
        out << "cracks      take " << short_number(share->smallest) << " to " << short_number(share->largest)
            << " of the fracture energy by their direction, " << short_number(share->mean) << " on average\n";
    }

    /// Prints what the mesh leaves of error in the consistent form; whether it solved for that. Collective.
    /// @param solve for all loads to a tolerance; returns whether it came to that
    template <int dim>
    bool print_error(Problem<dim> &problem, const RunKind &kind, const std::function<bool(double)> &solve)
    {
      // A check is to take seconds.
      constexpr GlobalIndex max_unknowns = 300000;
      if (kind.has_motion || kind.has_iterations)
        return false;
      auto             &out     = problem.run.screen;
      const GlobalIndex n_cells = problem.body.nodes->n_global;
      out << "error       ";
      if (!problem.discretisation.gradients.moments)
        out << "not estimated: that takes Material/Form = consistent\n";
      else if (problem.loading.expansion)
        out << "not estimated: the estimate takes no thermal strain\n";
      else if (problem.loading.supports->needs_reference())
        out << "not estimated: nodes are held where a reference puts them, which the run solves for\n";
      else if (dim * n_cells > max_unknowns)
        out << "not estimated: " << grouped(n_cells) << " cells take long to solve for; the run tells it\n";
      else
        {
          problem.check_loads();
          if (!solve(std::max(1e-4, problem.parameters.solver.tolerance)))
            {
              out << "not estimated: the linear solver stopped, as it would in a run\n";
              return true;
            }
          const ErrorEstimate estimate = estimate_mesh_error(problem, 1.);
          out << in_words(estimate) << ";\n            "
              << mesh_of_one_percent(estimate, n_cells, dim, problem.parameters.mesh.refinements) << '\n';
          return true;
        }
      return false;
    }
  } // namespace

  template <int dim>
  void Driver<dim>::check()
  {
    build();
    problem.weigh();
    prepare_damping();
    recorders   = std::make_unique<Recorders<dim>>(problem, kind);
    auto &out   = problem.run.screen;
    auto  skips = list_skipped(problem);
    skips.update(skipped());
    out << banner(problem, describe(), skips);

    const std::size_t bytes = dealii::Utilities::MPI::sum(memory_consumption(), problem.run.communicator);
    out << "memory      about " << short_number(bytes / 1e6) << " MB for families and bonds, "
        << short_number(static_cast<double>(bytes) / problem.body.nodes->n_global) << " B a node"
        << (kind.has_motion || problem.parameters.solver.is_relaxation() ?
              "" :
              "; the preconditioner takes about as much again")
        << '\n';
    const double step = largest_stable_step();
    out << "time step   "
        << (std::isfinite(step) ? short_number(step) + " s is the largest stable one of explicit dynamics\n" :
                                  std::string("none: every node is held, nothing is left that could move\n"));
    print_materials(problem);
    if (!kind.has_motion && !kind.has_iterations)
      {
        problem.discretisation.gradients.make(problem.body, problem.failure.precrack_test());
        out << "suits       " << suitable_form(problem.parameters, thin_cells(problem)) << '\n';
      }
    for (const std::string &warning : warnings(problem))
      problem.run.warn(warning);
    if (!kind.has_motion)
      problem.find_motions();
    out << (print_error(problem, kind, [this](const double tolerance) { return solve_to(tolerance); }) ?
              "nothing was written" :
              "nothing was solved")
        << std::endl;
  }

  template <int dim>
  ErrorEstimate Driver<dim>::estimate(const double tolerance)
  {
    build();
    problem.find_motions();
    problem.weigh();
    problem.check_loads();
    if (!solve_to(tolerance))
      throw ComputationError(
        "the linear solver stopped before the error could be estimated\n  advice: see how "
        "it fares on this mesh: run the scene with --set \"Adaptation/Wanted error=0\"");
    return estimate_mesh_error(problem, 1.);
  }

  PERIDEAL_INSTANTIATE_CLASS(Driver)
} // namespace perideal
