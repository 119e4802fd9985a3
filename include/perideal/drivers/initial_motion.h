// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_drivers_initial_motion_h
#define perideal_drivers_initial_motion_h

#include <perideal/problem/problem.h>
#include <perideal/solvers/explicit_dynamics.h>

#include <array>

namespace perideal
{
  /// Where the body is at t = 0, and how it moves, of section "Initial conditions".
  template <int dim>
  class InitialMotion
  {
  public:
    /// @throws InputError on wrong formulas, and on a z component in 2-D.
    explicit InitialMotion(const InitialParameters &parameters);

    /// Sets displacement and velocity of the nodes. Held components that are where a condition says at t = 0,
    /// and not where a velocity takes them, start there.
    void set(const Problem<dim> &problem, ExplicitDynamics<dim> &dynamics) const;

    /// Moves prescribed values at faces, and held nodes of a changed mesh, to where they are at the present
    /// time of the dynamics: without an initial displacement from zero, else from their conditions at t = 0,
    /// or with it where these give a velocity.
    void move_supports(const Problem<dim>    &problem,
                       const bool             mesh_has_changed,
                       ExplicitDynamics<dim> &dynamics) const;

  private:
    using Functions = std::array<SpaceTimeFunction<dim>, dim>;

    bool displaces() const;

    void
    move_faces(const Problem<dim> &problem, FaceValues<dim> &values, ExplicitDynamics<dim> &dynamics) const;

    /// Puts held nodes where conditions say.
    void hold(const Problem<dim> &problem, NodalVector &displacement) const;

    Functions displacement, velocity;
  };
} // namespace perideal

#endif
