// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_drivers_motion_steps_h
#define perideal_drivers_motion_steps_h

#include <perideal/operators/force/local_steps.h>
#include <perideal/problem/problem.h>
#include <perideal/solvers/solver_parameters.h>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace perideal
{
  /// The time steps of a motion.
  struct MotionSteps
  {
    /// Chooses a whole number of steps up to the end of the motion, of which none is larger than asked for
    /// or, where nothing is asked for, than a safe share of the largest stable one.
    /// @param stable_step the largest stable one [s]; infinity: nothing can move; 0: none is
    /// @param of_damping the parameter of the strongest damping
    /// @throws InputError where nothing can move, no step is stable, or their number has no end.
    void choose(const SolverParameters &solver, const double stable_step, const std::string &of_damping);

    /// Goes on with the steps of an earlier run [s].
    void resume(const SolverParameters &solver, const double earlier);

    /// Halves the steps of an earlier mesh until they are a safe share of the largest stable one, where they
    /// are not stable and the scene asks for none. Returns what to tell of that; empty: nothing.
    std::string divide(const SolverParameters &solver);

    /// Chooses the nodes with longer steps than the shortest, where the scene wants that. Collective.
    /// Steps that nobody asked for become shorter where many more nodes can take long ones then.
    /// @param stable_of the largest stable step of some nodes, all others held [s]
    template <int dim>
    void choose_levels(const Problem<dim>                                     &problem,
                       const std::function<double(const std::vector<bool> &)> &stable_of);

    /// Makes the local steps of these levels; needs the force. Collective.
    template <int dim>
    void make_local(Problem<dim> &problem);

    /// The shortest step [s].
    double shortest() const { return size / LocalSteps::ratio(n_levels - 1); }

    /// What summary.json tells of local steps.
    nlohmann::ordered_json figures() const;

    /// The step and the largest stable one of all nodes [s]; the number of steps.
    double        size = 0, stable = 0;
    std::uint64_t number = 0;
    /// Into how many parts divide() has divided each step.
    unsigned int parts = 1;
    /// Null where all nodes take the same step.
    std::shared_ptr<const LocalSteps> local;

  private:
    /// Takes steps of one size up to the end of the motion [s].
    void take(const SolverParameters &solver, const double step);

    bool         is_resumed = false;
    unsigned int n_levels   = 1;
    /// By owned node.
    std::vector<unsigned int> levels;
  };
} // namespace perideal

#endif
