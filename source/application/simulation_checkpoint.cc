// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/simulation.h>
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/nodes/cell_keys.h>
#include <perideal/output/summary.h>

#include <algorithm>

// Simulation: what goes on in steps is stopped and goes on; dynamics in particular.

namespace perideal
{
  namespace
  {
    using Json = nlohmann::ordered_json;

    /// Parameters that may differ between a run and the one that goes on from it.
    bool may_change(const std::string &path)
    {
      for (const char *start : {"/Output directory", "/Output/", "/Checkpoints/", "/Solver/End time"})
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
                .hint("only Output directory, Output, Solver/End time and Checkpoints may change");
            }
    }

    /// Owned nodes and ghosts. Collective.
    template <int dim>
    CheckpointNodes checkpoint_nodes(const SceneState<dim> &scene)
    {
      const Families<dim> &families = *scene.families;
      CheckpointNodes      result{cell_keys(*scene.mesh, *scene.nodes),
                             {},
                             families.n_owned(),
                             scene.unknowns().n_global,
                             families.communicator};
      if (scene.surface_nodes)
        {
          // Cells have at most six; no cell uses the highest bits.
          std::vector<std::uint64_t> n_of_cell(scene.nodes->size(), 0);
          for (const LocalIndex cell : scene.surface_nodes->cell_nodes())
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
      for (LocalIndex i = 0; i < families.n_local(); ++i)
        {
          result.number.push_back(families.global_number(i));
          if (i >= families.n_owned())
            result.key.push_back((static_cast<std::uint64_t>(halves.local_element(2 * i)) << 32) |
                                 static_cast<std::uint64_t>(halves.local_element(2 * i + 1)));
        }
      return result;
    }
  } // namespace

  template <int dim>
  Checkpoint Simulation<dim>::start_checkpoint(const unsigned int step, const double time) const
  {
    Checkpoint result;
    result.header = {{"step", step},
                     {"time", time},
                     {"largest energy", largest_energy},
                     {"damage", summary.value("damage", Json::object())},
                     {"energy", summary.value("energy", Json::object())},
                     {"parameters", context.parameters}};
    if (scene.crack_tracker)
      {
        result.fields["crack"] = scene.crack_tracker->state();
        result.fields["crack"].resize(scene.unknowns().size());
      }
    result.broken = scene.force->broken_bonds();
    return result;
  }

  template <int dim>
  void Simulation<dim>::write(const Checkpoint &checkpoint)
  {
    write_checkpoint(parameters.output_directory, checkpoint, checkpoint_nodes(scene));
  }

  template <int dim>
  void Simulation<dim>::open_checkpoint()
  {
    resumed =
      std::make_unique<Checkpoint>(read_checkpoint(parameters.output_directory, checkpoint_nodes(scene)));
    compare_scenes(resumed->header.at("parameters"), context.parameters);
    const double time = resumed->header.at("time").template get<double>();
    if (parameters.solver.is_dynamic() && !(time < parameters.solver.end_time))
      throw InputError("the checkpoint is at the end already")
        .parameter("Solver/End time")
        .allowed("more than " + short_number(time) + " s");
    screen << "restart     from " << (parameters.solver.is_dynamic() ? "step " : "load step ")
           << resumed->header.at("step").template get<unsigned int>() << ", t = " << short_number(time)
           << (parameters.solver.is_dynamic() ? " s" : "") << std::endl;
  }

  template <int dim>
  void Simulation<dim>::resume_scene()
  {
    if (scene.crack_tracker)
      {
        std::vector<double> &state = resumed->fields.at("crack");
        state.resize(scene.nodes->size());
        scene.crack_tracker->resume(state);
      }
    scene.force->restore_broken(resumed->broken);
    largest_energy = resumed->header.at("largest energy").template get<double>();
    for (const char *part : {"damage", "energy"})
      if (!resumed->header.at(part).empty())
        summary[part] = resumed->header.at(part);
  }

  template <int dim>
  void Simulation<dim>::save_checkpoint(const ExplicitDynamics<dim> &dynamics, const double time_step)
  {
    const Timings::Scope scope(timings, "output");
    Checkpoint           checkpoint = start_checkpoint(dynamics.step(), dynamics.time());
    checkpoint.header.update({{"time step", time_step},
                              {"broken bonds", dynamics.n_broken()},
                              {"dissipated energy", dynamics.dissipated_energy()},
                              {"frames", frame_times},
                              {"contact", summary.value("contact", Json::object())}});
    checkpoint.put("displacement", dynamics.displacement);
    checkpoint.put("velocity", dynamics.velocity);
    checkpoint.shares = dynamics.energy_shares();
    write(checkpoint);
    // The run that goes on makes its lists anew; this one does so too, for the same order of sums.
    if (scene.contact)
      scene.contact->forget_lists();
  }

  template <int dim>
  void Simulation<dim>::resume(ExplicitDynamics<dim> &dynamics)
  {
    const Json &header = resumed->header;
    resumed->take("displacement", dynamics.displacement);
    resumed->take("velocity", dynamics.velocity);
    dynamics.resume(header.at("step").template get<unsigned int>(),
                    header.at("broken bonds").template get<GlobalIndex>(),
                    header.at("dissipated energy").template get<double>(),
                    resumed->shares);
    resume_scene();
    frame_times = header.at("frames").template get<std::vector<double>>();
    field_output->resume(frame_times);
    if (scene.contact)
      summary["contact"] = header.at("contact");
    resumed.reset();
  }

  PERIDEAL_INSTANTIATE_CLASS(Simulation)

} // namespace perideal
