// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/drivers/driver.h>
#include <perideal/output/summary.h>
#include <perideal/problem/carried_softening.h>
#include <perideal/problem/present_state.h>

#include <deal.II/base/mpi.h>

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
      for (const dealii::CellId &cell : mesh.adapted.refined)
        result.push_back(cell.to_string());
      return result;
    }
  } // namespace

  template <int dim>
  void Driver<dim>::save_checkpoint(const std::uint64_t step, const double time) const
  {
    const Timings::Scope scope(problem.run.timings, "output");
    Checkpoint           checkpoint = state_after(problem, step, time);
    if (problem.parameters.adaptation.is_by_need())
      {
        checkpoint.header["refined cells"] = refined_cells_as_text(*problem.body.mesh);
        const std::uint64_t mine           = problem.body.mesh->triangulation.n_locally_owned_active_cells();
        checkpoint.header["cells of ranks"] =
          dealii::Utilities::MPI::all_gather(problem.run.communicator, mine);
      }
    write_checkpoint(problem.parameters.output_directory, checkpoint, nodes_of_state(problem));
  }

  template <int dim>
  void Driver<dim>::open_checkpoint()
  {
    const SceneParameters &parameters = problem.parameters;
    resumed =
      std::make_unique<Checkpoint>(read_checkpoint(parameters.output_directory, nodes_of_state(problem)));
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
    const Timings::Scope scope(problem.run.timings, "setup");
    problem.lasting.resume(*resumed);
    CarriedSoftening<dim>::soften_halves(problem, *resumed);
    resumed.reset();
  }

  PERIDEAL_INSTANTIATE_CLASS(Driver)
} // namespace perideal
