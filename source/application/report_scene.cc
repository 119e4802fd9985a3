// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/report.h>
#include <perideal/base/instantiate.h>
#include <perideal/base/text.h>
#include <perideal/output/summary.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <iomanip>
#include <limits>
#include <sstream>

// What is told of a scene before it is solved.

namespace perideal
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    /// C by pairs of indices, ordered as in dealii::SymmetricTensor.
    template <int dim>
    double
    entry_of(const dealii::SymmetricTensor<4, dim> &stiffness, const unsigned int p, const unsigned int q)
    {
      using Pair   = dealii::SymmetricTensor<2, dim>;
      const auto a = Pair::unrolled_to_component_indices(p), b = Pair::unrolled_to_component_indices(q);
      return stiffness[a[0]][a[1]][b[0]][b[1]];
    }

    template <int dim>
    std::string describe_stiffness(const dealii::SymmetricTensor<4, dim> &stiffness)
    {
      return "C_xxxx " + short_number(entry_of<dim>(stiffness, 0, 0)) + ", C_xxyy " +
             short_number(entry_of<dim>(stiffness, 0, 1)) + ", C_xyxy " +
             short_number(entry_of<dim>(stiffness, dim, dim)) + " Pa";
    }
  } // namespace

  template <int dim>
  Json describe_discretisation(const SceneParameters &parameters, const SceneState<dim> &scene)
  {
    using dealii::Utilities::MPI::max;
    using dealii::Utilities::MPI::min;
    using dealii::Utilities::MPI::sum;
    const MPI_Comm communicator = scene.nodes->communicator;
    double         smallest = 1e300, largest = 0, volume = 0;
    for (LocalIndex i = 0; i < scene.nodes->size(); ++i)
      {
        smallest = std::min(smallest, scene.nodes->spacing[i]);
        largest  = std::max(largest, scene.nodes->spacing[i]);
        volume += scene.nodes->volume[i];
      }
    const auto statistics = scene.families->statistics();
    Json       result;
    result["mesh"]       = {{"dim", dim},
                            {"cells", scene.mesh->triangulation.n_global_active_cells()},
                            {"min_size", min(smallest, communicator)},
                            {"max_size", max(largest, communicator)},
                            {"volume", sum(volume, communicator)}};
    result["nodes"]      = scene.nodes->n_global;
    result["bonds"]      = scene.families->n_bonds();
    result["neighbours"] = {{"min", statistics.min}, {"mean", statistics.mean}, {"max", statistics.max}};
    result["quadrature"] = name_of(parameters.quadrature.scheme);
    result["model"]      = parameters.model.model->name;
    result["variant"]    = parameters.model.has_forms() ? parameters.model.form : "uncorrected";
    result["families"]   = {{"fallback", scene.family_counts.fallback},
                            {"singular", scene.family_counts.singular},
                            {"indefinite", scene.family_counts.indefinite}};
    if (scene.family_counts.different > 0)
      result["families"]["different"] = scene.family_counts.different;
    if (scene.family_stiffness)
      {
        Json rows;
        for (unsigned int p = 0; p < dim * (dim + 1) / 2; ++p)
          {
            Json row;
            for (unsigned int q = 0; q < dim * (dim + 1) / 2; ++q)
              row.push_back(entry_of(*scene.family_stiffness, p, q));
            rows.push_back(row);
          }
        result["families"]["stiffness"] = rows;
      }
    return result;
  }

  bool can_break(const SceneParameters &parameters)
  {
    const auto breaks = [](const MaterialProperties &m) {
      return m.fracture_energy > 0 || m.critical_stretch > 0 || m.tensile_strength > 0;
    };
    return (parameters.solver.is_dynamic() || parameters.solver.is_nonlinear_static()) &&
           (breaks(parameters.material.body) ||
            std::any_of(parameters.material.groups.begin(),
                        parameters.material.groups.end(),
                        [&](const auto &group) { return breaks(group.second); }));
  }

  bool has_contact(const SceneParameters &parameters)
  {
    if (parameters.contact.enabled == ContactChoice::automatic)
      return can_break(parameters) || !parameters.precracks.cracks.empty();
    return parameters.contact.enabled == ContactChoice::yes;
  }

  template <int dim>
  Json list_skipped(const SceneParameters &parameters, const SceneState<dim> &scene)
  {
    Json       result;
    const auto bonds = scene.families->n_bonds();
    const auto nodes = scene.nodes->n_global;
    const bool alone = dealii::Utilities::MPI::n_mpi_processes(scene.nodes->communicator) == 1;
    if (!can_break(parameters))
      result["bond state (nothing can break)"] = bonds;
    const GlobalIndex different = scene.family_counts.different, families = scene.mirror->nodes().n_global;
    if (different > 0 && different < families)
      result["weights of families equal to others"] = families - different;
    if (parameters.solver.is_dynamic())
      {
        result["matrix, preconditioner (explicit)"] = 1;
        if (!has_contact(parameters))
          result[can_break(parameters) ? "contact (off)" : "contact (nothing can break)"] = 1;
        if (scene.contact && scene.contact->n_searches() > 0)
          result["nodes left out of the search for contacts"] = scene.contact->n_left_out();
        if (scene.force)
          result["bonds at rest"] = 1. - scene.force->share_computed();
      }
    else
      {
        result["mass and velocity (statics)"] = 2 * dim * nodes;
        if (parameters.solver.is_relaxation())
          result["matrix, preconditioner (relaxation)"] = 1;
        else if (!parameters.solver.is_quasi_static())
          result["set-ups of further load steps (linear)"] = parameters.solver.load_steps - 1;
      }
    if (alone)
      result["halo exchange (one rank)"] = 1;
    if (!parameters.loads.has_mirror() && !scene.surface_nodes)
      result["fictitious nodes (no mirror)"] = 1;
    const auto &shape = parameters.model.form_traits().shape;
    if (shape && shape->n_sums == 0)
      result["sums over families, their halo exchange"] = bonds;
    else if (shape && shape->n_sums == 1)
      result["second sum over families"] = bonds;
    return result;
  }

  template <int dim>
  std::string banner(const SceneParameters &parameters, const SceneState<dim> &scene)
  {
    const auto         statistics = scene.families->statistics();
    std::ostringstream out;
    out << "mesh        " << scene.mesh->description << '\n'
        << "nodes       " << grouped(scene.nodes->n_global) << ", horizon " << parameters.nodes.horizon_factor
        << " spacings, influence " << parameters.model.influence_function << '\n'
        << "bonds       " << grouped(scene.families->n_bonds()) << ", neighbours a node " << statistics.min
        << " / " << std::setprecision(4) << statistics.mean << " / " << statistics.max << " (min/mean/max)"
        << (parameters.quadrature.counts_parts() ? ", volumes by " + name_of(parameters.quadrature.scheme) :
                                                   "")
        << '\n'
        << "model       " << parameters.model.model->name
        << (parameters.model.has_forms() ? ", " + parameters.model.form + " form" : "") << ", "
        << (dim == 3 ? std::string("3-D") : name_of(parameters.material.assumption)) << '\n';
    const FamilyCounts &counts = scene.family_counts;
    out << "families    " << grouped(counts.fallback) << " with fallback weights, "
        << grouped(counts.singular) << " miss a moment condition (singular), " << grouped(counts.indefinite)
        << " had negative deviatoric weights\n";
    if (scene.family_stiffness)
      out << "stiffness   " << describe_stiffness<dim>(*scene.family_stiffness) << " by whole families\n";
    out << "boundaries  displacement by " << name_of(parameters.loads.displacement_treatment);
    if (parameters.loads.layers > 1)
      out << ", " << parameters.loads.layers << " layers of cells";
    if (scene.mirror->n_fictitious() > 0)
      out << ", " << grouped(scene.mirror->nodes().n_global - scene.nodes->n_global) << " fictitious nodes";
    if (scene.surface_nodes)
      out << " (" << grouped(scene.unknowns().n_global - scene.nodes->n_global) << ')';
    if (parameters.loads.has_transfer())
      out << ", tractions by " << name_of(parameters.loads.traction_treatment);
    if (scene.ghosts)
      out << ", tractions as well";
    if (!scene.null_space.empty())
      out << ", free rigid-body motions removed";
    out << '\n';
    if (scene.no_fail_zones)
      out << "no failure  at the bonds of " << grouped(scene.n_no_fail_nodes) << " nodes\n";
    if (scene.linear_solver)
      out << "solver      " << name_of(parameters.solver.name) << ", " << scene.linear_solver->name() << '\n';
    if (parameters.solver.is_relaxation())
      out << "solver      dynamic relaxation in " << parameters.solver.load_steps << " load step(s)\n";
    if (parameters.solver.is_quasi_static())
      out << "solver      quasi static, Newton's method in " << parameters.solver.load_steps
          << " load step(s)" << (scene.tangent_solver ? ", tangents by " + scene.tangent_solver->name() : "")
          << '\n';
    if (parameters.solver.is_dynamic() && has_contact(parameters))
      out << "contact     of nodes without a bond, nearer than " << parameters.contact.distance
          << " spacings\n";
    out << "not needed ";
    const Json  skipped   = list_skipped(parameters, scene);
    const char *separator = " ";
    for (const auto &item : skipped.items())
      {
        out << separator << item.key();
        separator = "; ";
      }
    out << '\n';
    return out.str();
  }

  PERIDEAL_INSTANTIATE(describe_discretisation)
  PERIDEAL_INSTANTIATE(list_skipped)
  PERIDEAL_INSTANTIATE(banner)

} // namespace perideal
