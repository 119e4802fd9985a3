// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_drivers_mesh_adaptation_h
#define perideal_drivers_mesh_adaptation_h

#include <perideal/problem/carried_state.h>

#include <memory>
#include <vector>

namespace perideal
{
  /// What goes from a driver to the one on the changed mesh; null without.
  template <int dim>
  struct MeshChange
  {
    std::unique_ptr<CarriedState<dim>> state;
    /// Where the mesh is to be finer.
    std::unique_ptr<MeshNeed<dim>> need;
  };

  /// Looks between the steps of a driver whether its mesh is to change, and takes what lasts to the next one.
  template <int dim>
  class MeshAdaptation
  {
  public:
    /// The problem must outlive this object.
    explicit MeshAdaptation(Problem<dim> &problem)
      : problem(problem)
    {
    }

    /// Whether a run that has begun on another mesh goes on here.
    bool goes_on() const { return change.state && change.state->has_begun(); }

    /// Takes what a driver on the mesh before has left; needs the nodes. Collective.
    /// @return the state to go on from; null where a run begins
    std::unique_ptr<Checkpoint> begin();

    /// Finds where the mesh is to be finer before the first step; needs the nodes. Collective.
    void look_at_first_mesh();

    /// Registers which nodes needed small cells when the mesh changed last.
    void register_state(LastingState &state);

    /// Whether the mesh is to change after a step, at a time; keeps what goes on then. Collective.
    bool is_due(const std::uint64_t step, const double time);

    /// Whether it is to change within the step after this one, at a time, in a scene that adapts by need;
    /// keep() follows when the step has ended for that. Collective.
    bool is_due_within(const std::uint64_t step, const double time);

    /// Keeps what goes on as the state is by now. Collective.
    void keep(const std::uint64_t step, const double time);

    /// Whether a motion looks at its mesh after a step.
    bool looks_at(const std::uint64_t step) const
    {
      const AdaptationParameters &adaptation = problem.parameters.adaptation;
      return adaptation.is_by_need() && step % adaptation.interval == 0;
    }

    /// is_due() of a motion, whose bonds it looks at as a displacement of owned nodes finds them [m].
    /// Collective.
    bool is_due_in_motion(const std::uint64_t step, const double time, const NodalVector &displacement);

    /// Notes by how much a change of the mesh lowered the energy [J].
    void note_switched(const double energy);

    /// Mean volume of cells, all as often halved as they may be [m^3]. Collective.
    double finest_cell() const;

    /// Smallest spacing of cells that may come over the present one [-]. Collective.
    double smallest_share() const;

    /// Before a run: what it goes on from; after it, where the mesh is to change: what goes on.
    MeshChange<dim> change;

  private:
    /// Finds where the mesh is to be finer at a time; needs the nodes. Collective.
    void look(const double time);
    bool has_urgent_cells() const;
    /// Takes the state after a step. Collective.
    void carry(const std::uint64_t step, const double time);

    Problem<dim> &problem;
    /// Owned nodes that needed small cells when the mesh changed last; none at first.
    std::vector<bool> needed_before;
    /// singular_exponents(), of the first look on.
    std::vector<double> exponents;
  };
} // namespace perideal

#endif
