// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_drivers_motion_steps_h
#define perideal_drivers_motion_steps_h

#include <perideal/solvers/solver_parameters.h>

#include <cstdint>
#include <string>

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

    /// The step and the largest stable one [s]; the number of steps.
    double        size = 0, stable = 0;
    std::uint64_t number = 0;
  };
} // namespace perideal

#endif
