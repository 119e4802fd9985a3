// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_drivers_load_control_h
#define perideal_drivers_load_control_h

#include <perideal/problem/problem.h>
#include <perideal/solvers/controlled_newton.h>

namespace perideal
{
  /**
   * Chooses the load steps of a path whose loads are an unknown: by equal elongations of a gauge, or by loads
   * that grow until a step of them would dissipate more than the largest step, and by dissipated energy from
   * there on. A step that fails is halved; steps grow again where they are found easily. Where the shortest
   * one fails, as where nothing softens any more, the path jumps by a step of the loads. A body that stores
   * less than a step would dissipate has to be loaded first. Without another end the path goes on to t = 1,
   * or until a thousandth of the largest strain energy is left.
   */
  template <int dim>
  class LoadControl
  {
  public:
    /// @param path made with control_of() the same problem; both must outlive this object
    /// @param cell volume of the cells that cracks cross [m^3]
    LoadControl(Problem<dim> &problem, ControlledNewton<dim> &path, const double cell);

    /// What a path under control needs of a problem, which must outlive it. Collective.
    /// The rules have found the gauge. @throws InputError where it ends outside the body
    static typename ControlledNewton<dim>::Control control_of(Problem<dim> &problem);

    /// Called before each attempt with what it is, in words.
    using Announce = std::function<void(const std::string &)>;

    /// Goes on to the next equilibrium, and counts the attempts that failed before. Collective.
    EquilibriumStep next(unsigned int                                  &n_failed,
                         const Announce                                &announce,
                         const typename EquilibriumPath<dim>::Progress &progress);

    /// Whether the last equilibrium is the end.
    bool is_done() const;

    /// How much of the path is behind [-]: of what is controlled where its end is known, else of the loads.
    double share_done() const { return solver.control_end > 0 ? reached / solver.control_end : path.time(); }

    void register_state(LastingState &state);

  private:
    /// One attempt. Collective.
    /// @param patience as of ControlledNewton, of a gauge
    EquilibriumStep attempt(const unsigned int                             patience,
                            const Announce                                &announce,
                            const typename EquilibriumPath<dim>::Progress &progress);
    /// After an attempt; returns false where no shorter one is left.
    bool shorten();
    void lengthen(const unsigned int iterations);
    /// The dissipated energy of a load step by default [J].
    double default_amount(const double cell) const;

    const SolverParameters &solver;
    const Problem<dim>     &problem;
    ControlledNewton<dim>  &path;
    /// Of loads [-] and of what is controlled [m or J].
    const double largest_time_step, largest_amount;
    double       time_step, amount;
    bool         by_loads, jumps = false;
    /// Whether loads were tried since the last equilibrium where the body stores less than a step dissipates.
    bool tried_loads = false;
    /// Of what is controlled [m or J], and the largest strain energy [J].
    double reached = 0, largest_energy = 0;
  };
} // namespace perideal

#endif
