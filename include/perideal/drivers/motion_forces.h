// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_drivers_motion_forces_h
#define perideal_drivers_motion_forces_h

#include <perideal/operators/force/contact_force.h>
#include <perideal/operators/force/relative_damping.h>
#include <perideal/problem/problem.h>
#include <perideal/solvers/explicit_dynamics.h>

#include <nlohmann/json.hpp>

#include <memory>
#include <string>

namespace perideal
{
  /// What acts on moving nodes besides bonds and loads: contact, and damping of relative velocities.
  template <int dim>
  struct MotionForces
  {
    /// Makes the damping where the scene has some; needs the weights of the bonds.
    void make_damping(const Problem<dim> &problem);

    /// Makes the contact where the scene has some. Collective.
    void make_contact(const Problem<dim> &problem);

    /// Hands them to the dynamics; they must outlive these.
    void act_on(ExplicitDynamics<dim> &dynamics) const;

    /// Returns the largest rate of the damping [1/s], which bounds stable steps.
    double largest_rate() const { return damping ? damping->largest_rate() : 0.; }

    /// Brings the part "contact" of summary.json up to date. Collective.
    void record(nlohmann::ordered_json &summary) const;

    /// Returns a warning where contact was too soft; else nothing.
    static std::string describe(const nlohmann::ordered_json &summary);

    std::unique_ptr<ContactForce<dim>>    contact;
    std::unique_ptr<RelativeDamping<dim>> damping;
  };
} // namespace perideal

#endif
