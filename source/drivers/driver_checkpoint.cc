// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/drivers/driver.h>
#include <perideal/nodes/cell_keys.h>
#include <perideal/output/summary.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

// Driver: what goes on in steps is stopped and goes on.

namespace perideal
{
  namespace
  {
    using Json = nlohmann::ordered_json;

    /// Parameters that may differ between a run and the one that goes on from it.
    bool may_change(const std::string &path)
    {
      for (const char *start :
           {"/Output directory", "/Output/", "/Checkpoints/", "/Solver/End time", "/Solver/Last load step"})
        if (path.compare(0, std::string(start).size(), start) == 0)
          return true;
      return false;
    }

    /// @throws InputError naming the first parameter that two scenes do not agree on.
    void compare_scenes(const Json &earlier, const Json &now)
    {
      const Json a = earlier.flatten(), b = now.flatten();
      for (const auto &[one, other] : {std::pair<const Json &, const Json &>(a, b), {b, a}})
        for (const auto &item : one.items())
          if (!may_change(item.key()) && (!other.contains(item.key()) || other[item.key()] != item.value()))
            {
              const auto text = [&](const Json &scene) {
                return scene.contains(item.key()) ? scene[item.key()].get<std::string>() :
                                                    std::string("nothing");
              };
              throw InputError("the checkpoint belongs to another scene")
                .parameter(item.key().substr(1))
                .given(text(b))
                .allowed(text(a) + ", as in the run that wrote the checkpoint")
                .hint(
                  "only Output directory, Output, Solver/End time, Solver/Last load step and Checkpoints may "
                  "change");
            }
    }

    template <int dim>
    std::vector<std::string> refined_cells_as_text(const Mesh<dim> &mesh)
    {
      std::vector<std::string> result;
      for (const dealii::CellId &cell : mesh.adapted)
        result.push_back(cell.to_string());
      return result;
    }

    /// Owned nodes and ghosts. Collective.
    template <int dim>
    CheckpointNodes checkpoint_nodes(const Problem<dim> &problem)
    {
      const Families<dim> &families = *problem.discretisation.families;
      CheckpointNodes      result{cell_keys(*problem.body.mesh, *problem.body.nodes),
                             families.n_owned(),
                             problem.loading.supports->unknowns().n_global,
                             families.communicator};
      if (problem.loading.supports->surface_nodes())
        {
          // Cells have at most six; no cell uses the highest bits.
          std::vector<std::uint64_t> n_of_cell(problem.body.nodes->size(), 0);
          for (const LocalIndex cell : problem.loading.supports->surface_nodes()->cell_nodes())
            result.key.push_back(result.key[cell] | (++n_of_cell[cell] << 61));
        }
      // Halves of keys are exact as doubles.
      NodalVector halves(families.make_partitioner(2));
      for (LocalIndex i = 0; i < families.n_owned(); ++i)
        {
          halves.local_element(2 * i)     = static_cast<double>(result.key[i] >> 32);
          halves.local_element(2 * i + 1) = static_cast<double>(result.key[i] & 0xffffffffu);
        }
      halves.update_ghost_values();
      for (LocalIndex i = families.n_owned(); i < families.n_local(); ++i)
        result.key.push_back((static_cast<std::uint64_t>(halves.local_element(2 * i)) << 32) |
                             static_cast<std::uint64_t>(halves.local_element(2 * i + 1)));
      return result;
    }
  } // namespace

  template <int dim>
  Checkpoint Driver<dim>::state_after(const std::uint64_t step, const double time) const
  {
    Checkpoint checkpoint;
    checkpoint.header = {{"step", step}, {"time", time}, {"parameters", problem.run.context.parameters}};
    problem.lasting.save(checkpoint);
    return checkpoint;
  }

  template <int dim>
  void Driver<dim>::save_checkpoint(const std::uint64_t step, const double time) const
  {
    const Timings::Scope scope(problem.run.timings, "output");
    Checkpoint           checkpoint = state_after(step, time);
    if (problem.parameters.adaptation.is_by_need())
      checkpoint.header["refined cells"] = refined_cells_as_text(*problem.body.mesh);
    write_checkpoint(problem.parameters.output_directory, checkpoint, checkpoint_nodes(problem));
  }

  template <int dim>
  void Driver<dim>::open_checkpoint()
  {
    const SceneParameters &parameters = problem.parameters;
    resumed =
      std::make_unique<Checkpoint>(read_checkpoint(parameters.output_directory, checkpoint_nodes(problem)));
    compare_scenes(resumed->get<Json>("parameters"), problem.run.context.parameters);
    const double time = resumed->get<double>("time");
    // A run that was killed at its end has yet to write its results; times are sums of steps.
    if (kind.has_motion && !(time <= parameters.solver.end_time * (1. + 1e-9)))
      throw InputError("the checkpoint is beyond the end already")
        .parameter("Solver/End time")
        .allowed(short_number(time) + " s or more");
    const auto step = resumed->get<std::uint64_t>("step");
    if (!kind.has_motion && !parameters.solver.is_controlled() && step >= parameters.solver.n_load_steps())
      throw InputError("the checkpoint is at the last load step already")
        .parameter("Solver/Last load step")
        .given(std::to_string(parameters.solver.n_load_steps()))
        .allowed("more than " + std::to_string(step));
    problem.run.screen << "restart     from " << (kind.has_motion ? "step " : "load step ") << step
                       << ", t = " << short_number(time) << (kind.has_motion ? " s" : "") << std::endl;
  }

  template <int dim>
  void Driver<dim>::resume_checkpoint()
  {
    problem.lasting.resume(*resumed);
    resumed.reset();
  }

  template <int dim>
  void Driver<dim>::take_change()
  {
    if (change.state)
      {
        depth = change.state->depth_on(problem.body);
        if (change.state->has_begun())
          {
            resumed = std::make_unique<Checkpoint>(change.state->on(problem.body, checkpoint_nodes(problem)));
            // Cells that were halved or joined do not have those of the cells before.
            resumed->node_arrays.at("halvings").values = depth;
          }
      }
    change = {};
    if (problem.parameters.adaptation.is_by_need())
      problem.lasting.add_node_array(
        "halvings",
        "-",
        1,
        [this] { return depth; },
        [this](const std::vector<double> &values) { depth = values; });
  }

  template <int dim>
  void Driver<dim>::look_at_first_mesh()
  {
    build();
    change.need  = std::make_unique<MeshNeed<dim>>(problem, depth, 0.);
    change.state = std::make_unique<CarriedState<dim>>(
      problem, Checkpoint(), checkpoint_nodes(problem), depth, change.need->is_quiet);
  }

  template <int dim>
  bool Driver<dim>::mesh_changes(const std::uint64_t step, const double time, const double imbalance)
  {
    const Timings::Scope scope(problem.run.timings, "adaptation");
    change.need            = std::make_unique<MeshNeed<dim>>(problem, depth, time);
    const Mesh<dim> &mesh  = *problem.body.mesh;
    GlobalIndex      n_new = 0;
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned() &&
          depth[problem.body.nodes->node_of_cell[cell->active_cell_index()]] <
            problem.parameters.adaptation.levels &&
          change.need->is_urgent(cell))
        ++n_new;
    if (dealii::Utilities::MPI::sum(n_new, problem.run.communicator) > 0)
      {
        Checkpoint state                 = state_after(step, time);
        state.header["imbalance before"] = imbalance;
        change.state                     = std::make_unique<CarriedState<dim>>(
          problem, std::move(state), checkpoint_nodes(problem), depth, change.need->is_quiet);
        if (change.state->is_urgent(mesh, *change.need, problem.parameters.adaptation.levels))
          {
            change.state->fit(problem);
            return true;
          }
      }
    change = {};
    return false;
  }

  template <int dim>
  void Driver<dim>::note_switched(const double energy)
  {
    auto &rows = problem.run.adaptation;
    if (!rows.empty())
      rows.back()["switched_energy"] = energy;
  }

  template <int dim>
  double Driver<dim>::smallest_share() const
  {
    using dealii::Utilities::MPI::min;
    double                     now = std::numeric_limits<double>::max(), to_come = now;
    const std::vector<double> &spacing = problem.body.nodes->spacing;
    for (LocalIndex i = 0; i < spacing.size(); ++i)
      {
        now     = std::min(now, spacing[i]);
        to_come = std::min(
          to_come, std::ldexp(spacing[i], static_cast<int>(depth[i] - problem.parameters.adaptation.levels)));
      }
    return min(to_come, problem.run.communicator) / min(now, problem.run.communicator);
  }

  PERIDEAL_INSTANTIATE_CLASS(Driver)
} // namespace perideal
