// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/drivers/mesh_adaptation.h>
#include <perideal/problem/present_state.h>
#include <perideal/problem/strain_at_corners.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace perideal
{
  template <int dim>
  std::unique_ptr<Checkpoint> MeshAdaptation<dim>::begin()
  {
    std::unique_ptr<Checkpoint> result;
    if (goes_on())
      result = std::make_unique<Checkpoint>(change.state->on(problem.body, nodes_of_state(problem)));
    change = {};
    return result;
  }

  template <int dim>
  void MeshAdaptation<dim>::look(const double time)
  {
    if (exponents.empty())
      exponents = singular_exponents(problem);
    change.need = std::make_unique<MeshNeed<dim>>(problem, time, needed_before, exponents);
  }

  template <int dim>
  void MeshAdaptation<dim>::look_at_first_mesh()
  {
    const Timings::Scope scope(problem.run.timings, "adaptation");
    look(0.);
    change.state =
      std::make_unique<CarriedState<dim>>(problem, Checkpoint(), nodes_of_state(problem), *change.need);
  }

  template <int dim>
  void MeshAdaptation<dim>::register_state(LastingState &state)
  {
    if (problem.parameters.adaptation.is_by_need())
      state.add_node_array(
        "needed small cells",
        "1",
        1,
        [this] {
          std::vector<double> result(needed_before.begin(), needed_before.end());
          result.resize(problem.body.nodes->size(), 0.);
          return result;
        },
        [this](const std::vector<double> &read) { needed_before.assign(read.begin(), read.end()); });
  }

  template <int dim>
  bool MeshAdaptation<dim>::has_urgent_cells() const
  {
    const Nodes<dim> &nodes    = *problem.body.nodes;
    unsigned int      is_there = 0;
    for (const auto &cell : problem.body.mesh->triangulation.active_cell_iterators())
      if (cell->is_locally_owned() &&
          nodes.finest_share(nodes.node_of_cell[cell->active_cell_index()]) < 1. &&
          change.need->is_urgent(cell))
        is_there = 1;
    return dealii::Utilities::MPI::max(is_there, problem.run.communicator) > 0;
  }

  template <int dim>
  bool MeshAdaptation<dim>::is_due(const std::uint64_t step, const double time)
  {
    if (!problem.parameters.adaptation.is_by_need())
      return false;
    const Timings::Scope scope(problem.run.timings, "adaptation");
    if (!is_due_within(step, time))
      return false;
    change.state->fit(problem, *change.need);
    return true;
  }

  template <int dim>
  bool MeshAdaptation<dim>::is_due_within(const std::uint64_t step, const double time)
  {
    look(time);
    if (has_urgent_cells())
      {
        const auto before = std::exchange(needed_before, change.need->needs_small);
        carry(step, time);
        if (change.state->has_failed_larger_cells(*problem.body.mesh, problem.parameters.adaptation.levels))
          problem.run.warn(
            "bonds failed in cells that were not yet as small as Adaptation/Levels lets them be, and take "
            "more "
            "energy than they should: take a smaller Adaptation/Refine from, a larger Reach, shorter steps");
        if (change.state->is_urgent(*problem.body.mesh, *change.need, problem.parameters.adaptation.levels))
          return true;
        needed_before = before;
      }
    change = {};
    return false;
  }

  template <int dim>
  void MeshAdaptation<dim>::keep(const std::uint64_t step, const double time)
  {
    const Timings::Scope scope(problem.run.timings, "adaptation");
    carry(step, time);
    change.state->fit(problem, *change.need);
  }

  template <int dim>
  void MeshAdaptation<dim>::carry(const std::uint64_t step, const double time)
  {
    change.state = std::make_unique<CarriedState<dim>>(
      problem, state_after(problem, step, time), nodes_of_state(problem), *change.need);
  }

  template <int dim>
  bool MeshAdaptation<dim>::is_due_in_motion(const std::uint64_t step,
                                             const double        time,
                                             const NodalVector  &displacement)
  {
    if (!looks_at(step))
      return false;
    BondForce<dim> &bonds = *problem.force;
    NodalVector     force;
    bonds.initialize(force);
    bonds.judge_bonds(Judgement::none);
    bonds.compute(force, displacement);
    bonds.judge_bonds(Judgement::for_good);
    return is_due(step, time);
  }

  template <int dim>
  void MeshAdaptation<dim>::note_switched(const double energy)
  {
    if (!problem.run.adaptation.empty())
      problem.run.adaptation.back()["switched_energy"] = energy;
  }

  template <int dim>
  double MeshAdaptation<dim>::finest_cell() const
  {
    using dealii::Utilities::MPI::sum;
    const std::vector<double> &volume = problem.body.nodes->volume;
    double                     n      = 0;
    for (LocalIndex i = 0; i < volume.size(); ++i)
      n += std::pow(problem.body.nodes->finest_share(i), -dim);
    return sum(std::accumulate(volume.begin(), volume.end(), 0.), problem.run.communicator) /
           sum(n, problem.run.communicator);
  }

  template <int dim>
  double MeshAdaptation<dim>::smallest_share() const
  {
    using dealii::Utilities::MPI::min;
    double                     now = std::numeric_limits<double>::max(), to_come = now;
    const std::vector<double> &spacing = problem.body.nodes->spacing;
    for (LocalIndex i = 0; i < spacing.size(); ++i)
      {
        now     = std::min(now, spacing[i]);
        to_come = std::min(to_come, spacing[i] * problem.body.nodes->finest_share(i));
      }
    return min(to_come, problem.run.communicator) / min(now, problem.run.communicator);
  }

  PERIDEAL_INSTANTIATE_CLASS(MeshAdaptation)
} // namespace perideal
