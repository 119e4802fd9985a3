// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/report.h>
#include <perideal/base/text.h>
#include <perideal/output/summary.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <ostream>
#include <sstream>

namespace perideal
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    double seconds_now()
    {
      return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    }
  } // namespace

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
    result["quadrature"] = parameters.quadrature.scheme;
    result["model"]      = parameters.model.model;
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
    if (parameters.contact.enabled == "automatic")
      return can_break(parameters) || !parameters.precracks.cracks.empty();
    return parameters.contact.enabled == "true";
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
    if (parameters.loads.displacement_treatment != "mirror" && !scene.surface_nodes)
      result["fictitious nodes (no mirror)"] = 1;
    if (parameters.model.model == "bond based" ||
        (parameters.model.is_tensor_involved() && !parameters.model.is_consistent()))
      result["sums over families, their halo exchange"] = bonds;
    else if (parameters.model.model == "ordinary" || parameters.model.form == "paper")
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
        << (parameters.quadrature.counts_parts() ? ", volumes by " + parameters.quadrature.scheme : "")
        << '\n'
        << "model       " << parameters.model.model
        << (parameters.model.has_forms() ? ", " + parameters.model.form + " form" : "") << ", "
        << (dim == 3 ? std::string("3-D") : parameters.material.assumption) << '\n';
    const FamilyCounts &counts = scene.family_counts;
    out << "families    " << grouped(counts.fallback) << " with fallback weights, "
        << grouped(counts.singular) << " miss a moment condition (singular), " << grouped(counts.indefinite)
        << " had negative deviatoric weights\n";
    if (scene.family_stiffness)
      out << "stiffness   " << describe_stiffness<dim>(*scene.family_stiffness) << " by whole families\n";
    out << "boundaries  displacement by " << parameters.loads.displacement_treatment;
    if (parameters.loads.layers > 1)
      out << ", " << parameters.loads.layers << " layers of cells";
    if (scene.mirror->n_fictitious() > 0)
      out << ", " << grouped(scene.mirror->nodes().n_global - scene.nodes->n_global) << " fictitious nodes";
    if (scene.surface_nodes)
      out << " (" << grouped(scene.unknowns().n_global - scene.nodes->n_global) << ')';
    if (parameters.loads.has_transfer())
      out << ", tractions by " << parameters.loads.traction_treatment;
    if (scene.ghosts)
      out << ", tractions as well";
    if (!scene.null_space.empty())
      out << ", free rigid-body motions removed";
    out << '\n';
    if (scene.no_fail_zones)
      out << "no failure  at the bonds of " << grouped(scene.n_no_fail_nodes) << " nodes\n";
    if (scene.linear_solver)
      out << "solver      " << parameters.solver.name << ", " << scene.linear_solver->name() << '\n';
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

  std::string timing_table(const std::map<std::string, double> &seconds)
  {
    std::vector<std::vector<std::string>> rows;
    const double                          total = seconds.at("total");
    for (const auto &phase : seconds)
      if (phase.first != "total")
        rows.push_back({phase.first,
                        short_number(phase.second),
                        std::to_string(static_cast<int>(std::lround(100 * phase.second / total))) + " %"});
    rows.push_back({"total", short_number(total), "100 %"});
    return report_table({"phase", "seconds", "share"}, rows);
  }

  namespace
  {
    void
    add_error_rows(const Json &errors, const std::string &title, std::vector<std::vector<std::string>> &rows)
    {
      const auto number = [](const Json &value) {
        return value.is_number() ? short_number(value.get<double>()) : std::string("-");
      };
      rows.push_back({title, number(errors.at("l2")), number(errors.at("max"))});
      if (errors.contains("profiles"))
        for (const auto &profile : errors["profiles"].items())
          for (const auto &component : profile.value().items())
            rows.push_back(
              {"  " + component.key() + " along " + profile.key(), "", number(component.value())});
      for (const auto &item : errors.items())
        if (item.value().is_object() && item.key() != "profiles")
          add_error_rows(item.value(), title + ", " + item.key(), rows);
    }
  } // namespace

  std::string error_table(const Json &errors)
  {
    std::vector<std::vector<std::string>> rows;
    for (const auto &comparison : errors.items())
      add_error_rows(comparison.value(), "against " + comparison.key(), rows);
    return report_table({"relative error", "l2", "max"}, rows);
  }

  ProgressLine::ProgressLine(std::ostream      &out,
                             const bool         is_visible,
                             const std::string &what,
                             const double       tolerance)
    : out(out)
    , is_visible(is_visible)
    , what(what)
    , tolerance(tolerance)
    , start(seconds_now())
    , last_print(start)
  {
  }

  ProgressLine::~ProgressLine()
  {
    if (printed)
      out << std::endl;
  }

  void ProgressLine::operator()(const unsigned int iteration, const double residual)
  {
    const double now = seconds_now();
    if (!is_visible || iteration == 0 || now - last_print < 1)
      return;
    last_print = now;
    printed    = true;
    std::ostringstream line;
    line << '\r' << what << ": iteration " << iteration << ", residual " << short_number(residual);
    if (residual > 0 && residual < 1)
      {
        const double left = (now - start) * std::max(0., std::log(tolerance) / std::log(residual) - 1);
        line << ", about " << short_number(left) << " s left";
      }
    out << line.str() << "      " << std::flush;
  }

  StepLine::StepLine(std::ostream &out, const bool is_visible, const unsigned int n_steps)
    : out(out)
    , is_visible(is_visible)
    , n_steps(n_steps)
    , start(seconds_now())
    , last_print(start)
  {
  }

  StepLine::~StepLine()
  {
    if (printed)
      out << std::endl;
  }

  void StepLine::operator()(const unsigned int step, const GlobalIndex broken_bonds)
  {
    const double now = seconds_now();
    if (!is_visible || now - last_print < 1 || step == 0)
      return;
    last_print = now;
    printed    = true;
    std::ostringstream line;
    line << "\rstep " << step << " of " << n_steps << ", " << grouped(broken_bonds) << " broken bonds, about "
         << short_number((now - start) * (n_steps - step) / step) << " s left";
    out << line.str() << "      " << std::flush;
  }

  namespace
  {
    std::string describe_branching(const Json &crack)
    {
      if (!crack.contains("branching"))
        return "";
      const Json &branching = crack["branching"];
      if (branching.is_null())
        return "; no branches";
      return "; " + std::to_string(branching["branches"].get<unsigned int>()) + " branches from " +
             short_number(branching["reach"].get<double>()) + " m, " +
             short_number(branching["time"].get<double>()) + " s, " +
             (branching["full_angle"].is_number() ? short_number(branching["full_angle"].get<double>()) :
                                                    "-") +
             " degrees between the outermost";
    }
  } // namespace

  std::string describe_loads(const Json &loads)
  {
    std::ostringstream out;
    const char        *separator = "loads       nodes get of the tractions: ";
    for (const auto &condition : loads.at("conditions").items())
      if (condition.value().contains("ratio"))
        {
          out << separator << condition.key() << ' '
              << short_number(100 * condition.value()["ratio"].get<double>()) << " %";
          separator = ", ";
        }
    return out.str().empty() ? "" : out.str() + '\n';
  }

  std::string describe_motion(const Json &summary)
  {
    std::ostringstream out;
    const Json        &energy = summary.at("energy");
    const auto         number = [](const Json &value, const double unit) {
      return value.is_number() ? short_number(value.get<double>() * unit) : std::string("-");
    };
    out << "energy      " << number(energy["kinetic"], 1) << " J kinetic, " << number(energy["strain"], 1)
        << " J strain, " << number(energy["dissipated"], 1) << " J dissipated, "
        << number(energy["external"], 1) << " J put in; error " << number(energy["drift"], 1) << '\n';
    if (std::abs(energy["drift"].get<double>()) > 0.01)
      out << "warning     the energy is off by more than 1 %: take a smaller time step, or a form that has "
             "an energy\n";
    if (summary.contains("contact") && summary["contact"]["largest_overlap"].get<double>() > 0.5)
      out
        << "warning     nodes came to less than half their contact distance and may have passed each other: "
           "raise Contact/Stiffness\n";
    out << describe_damage(summary, " s");
    if (summary.contains("cracks"))
      for (const auto &crack : summary["cracks"].items())
        out << "crack       " << crack.key() << ": from " << number(crack.value()["first_time"], 1)
            << " s on, reach " << number(crack.value()["reach"], 1) << " m, angle "
            << number(crack.value()["angle"], 1) << " degrees, speed " << number(crack.value()["speed"], 1)
            << " m/s" << describe_branching(crack.value()) << '\n';
    return out.str();
  }

  std::string describe_damage(const Json &summary, const std::string &unit)
  {
    std::ostringstream out;
    const Json         damage = summary.value("damage", Json::object());
    if (damage.contains("cut_bonds"))
      out << "precracks   " << grouped(damage["cut_bonds"].get<GlobalIndex>()) << " cut bonds\n";
    if (damage.value("broken_bonds", GlobalIndex(0)) > 0)
      {
        out << "damage      " << grouped(damage["broken_bonds"].get<GlobalIndex>())
            << " broken bonds, the first at " << short_number(damage["first_break_time"].get<double>())
            << unit;
        if (damage.contains("fragments"))
          out << "; " << damage["fragments"].size() << " piece(s)";
        out << '\n';
      }
    return out.str();
  }

  std::string describe_stop(const std::string &step)
  {
    return "asked to stop after " + step +
           "; the checkpoint is written\n  advice: to go on, run the same scene with --set "
           "Checkpoints/Restart=true";
  }

#define PERIDEAL_INSTANTIATE(dim)                                                                            \
  template Json        describe_discretisation(const SceneParameters &, const SceneState<dim> &);            \
  template Json        list_skipped(const SceneParameters &, const SceneState<dim> &);                       \
  template std::string banner(const SceneParameters &, const SceneState<dim> &);
  PERIDEAL_INSTANTIATE(2)
  PERIDEAL_INSTANTIATE(3)
#undef PERIDEAL_INSTANTIATE
} // namespace perideal
