// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/base/rendezvous.h>
#include <perideal/drivers/driver.h>
#include <perideal/operators/system/stable_time_step.h>
#include <perideal/output/files.h>
#include <perideal/problem/advice.h>
#include <perideal/problem/description.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  namespace
  {
    /// The energy [J] of strains of 1e-13 all over a body, of which displacements are by round-off.
    /// Collective.
    template <int dim>
    double energy_of_round_off(const Body<dim> &body)
    {
      double volume = 0, modulus = 0;
      for (const double of_node : body.nodes->volume)
        volume += of_node;
      for (const auto &[id, solid] : body.solids)
        modulus = std::max(modulus, solid.stiffness().norm());
      return dealii::Utilities::MPI::sum(volume, body.nodes->communicator) * modulus * 1e-26;
    }
  } // namespace

  template <int dim>
  Driver<dim>::Driver(Problem<dim> &problem, const RunKind &kind)
    : adaptation(problem)
    , problem(problem)
    , kind(kind)
  {
    problem.lasting.add_value("largest energy", largest_energy);
  }

  template <int dim>
  void Driver<dim>::run()
  {
    create_output_directory(problem.parameters.output_directory, problem.run.communicator);
    const DirectoryLock lock(problem.parameters.output_directory, problem.run.communicator);
    build();
    mesh_has_changed = adaptation.goes_on();
    resumed          = adaptation.begin();
    if (problem.parameters.checkpoints.restart && !mesh_has_changed)
      open_checkpoint();
    prepare();
    recorders = std::make_unique<Recorders<dim>>(problem, kind);
    if (!mesh_has_changed)
      {
        auto skips = list_skipped(problem);
        skips.update(skipped());
        problem.run.screen << banner(problem, describe(), skips) << std::flush;
        for (const std::string &warning : warnings(problem))
          problem.run.warn(warning);
      }
    check_loads();
    // Dynamics have moved on to their step, load steps have recorded theirs.
    recorders->open(resumed ? resumed->get<double>("step") + (kind.has_motion ? -0.5 : 0.5) : -1.,
                    resumed.get());
    adaptation.register_state(problem.lasting);
    StepsEnd end = StepsEnd::stopped;
    try
      {
        end = advance();
      }
    catch (const std::exception &)
      {
        finish_after_error();
        throw;
      }
    if (end == StepsEnd::mesh_changes)
      return;
    finish(end == StepsEnd::done ? RunStatus::done : RunStatus::stopped);
    if (end == StepsEnd::stopped)
      throw Stopped("asked to stop after " + last_step() +
                    "; the checkpoint is written\n  advice: to continue, run the same scene with --set "
                    "Checkpoints/Restart=true");
  }

  template <int dim>
  void Driver<dim>::build()
  {
    if (is_built)
      return;
    problem.build();
    prepare_scene();
    is_built = true;
  }

  template <int dim>
  void Driver<dim>::finish(const RunStatus status)
  {
    RunReport report;
    report.status         = status;
    report.skipped        = skipped();
    report.operator_bytes = memory_consumption();
    report.lines          = closing_lines();
    recorders->finish(report);
  }

  template <int dim>
  void Driver<dim>::finish_after_error() noexcept
  {
    try
      {
        if (all_ranks_arrive(problem.run.communicator))
          {
            finish(RunStatus::failed);
            return;
          }
      }
    catch (const std::exception &)
      {
        // The first error is told.
      }
    recorders->abandon();
  }

  template <int dim>
  std::size_t Driver<dim>::memory_consumption() const
  {
    const auto &discretisation = problem.discretisation;
    return discretisation.families->memory_consumption() +
           (problem.force ? problem.force->memory_consumption() : discretisation.bonds->memory_consumption());
  }

  template <int dim>
  double Driver<dim>::largest_stable_step(const std::vector<bool> &moves) const
  {
    return damped_time_step(
      stable_time_step(
        *problem.system,
        [&](const dealii::types::material_id id) { return problem.body.density_of(id); },
        moves),
      damping());
  }

  template <int dim>
  double Driver<dim>::energy_error(const EnergyBudget &energy, const double scale)
  {
    if (largest_energy == 0.)
      largest_energy = energy_of_round_off(problem.body);
    largest_energy = std::max({largest_energy, std::abs(energy.external), scale});
    return largest_energy > 0 ? energy.imbalance() / largest_energy : 0.;
  }

  PERIDEAL_INSTANTIATE_CLASS(Driver)
} // namespace perideal
