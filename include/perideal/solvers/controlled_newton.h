// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_solvers_controlled_newton_h
#define perideal_solvers_controlled_newton_h

#include <perideal/fracture/crack_fronts.h>
#include <perideal/solvers/newton.h>

#include <limits>
#include <optional>
#include <utility>

namespace perideal
{
  /**
   * Finds equilibria under loads whose factor t is an unknown too: the amount by which something grows is
   * prescribed instead, the opening of a gauge or the dissipated energy (Verhoosel, Remmers and Gutierrez,
   * International Journal for Numerical Methods in Engineering 77, 1290-1321, 2009). So a path is followed
   * where the loads must fall for equilibrium, as they must where a crack needs less of them the longer it
   * is, and where what is prescribed at a grip must go back (snap-back).
   *
   * With the residual r, the stiffness K of the bonds and the force q on the nodes by unit t, of loads and
   * supports, an iteration solves K x = r and K y = q, moves by x + y dt, and takes the dt with which the
   * controlled quantity, read at the moved body and not linearised, is what it should be. Near a limit of the
   * loads x and y dt nearly cancel: y is solved until its error times dt is what may be left of r.
   *
   * Where bonds soften and dissipated energy is controlled, K is at first the secant: what the bonds have
   * left, which is positive definite and leads to the equilibrium from afar, by about .6 of the residual an
   * iteration; then the tangent, which finishes. Where a gauge is controlled, the tangent leads there from
   * the start: the notched beam takes 138 iterations, and 724 by secants first. Where the tangent does not
   * lead on, since bonds change between softening, unloading and closing, some more secants do. No iterate
   * leaves a trace in the bonds, which are judged at the equilibrium, but in attempts that may jump: where
   * the residual falls no more, what has softened by then stays so, and secants lead on. What is left of the
   * bonds only falls then, so that they come to an equilibrium.
   *
   * Steps of dissipated energy begin along the motion of the step before, moved with the fronts of the cracks
   * (CrackFronts) where that leaves much less of the residual than the same motion in place: cracks that go
   * on cell by cell then need one or two iterations by the tangent, and fifteen otherwise.
   */
  template <int dim>
  class ControlledNewton : public NewtonSolver<dim>
  {
  public:
    using typename EquilibriumPath<dim>::Progress;
    using NewtonSolver<dim>::displacement;

    /// Sets the force of the loads [N] to a time. Collective.
    using LoadsAt = std::function<void(const double, NodalVector &)>;
    /// Reads what is controlled off a displacement [m]. Collective.
    using Gauge = std::function<double(const NodalVector &)>;

    /// How long an attempt goes on whose residual falls no more.
    struct Patience
    {
      /// Iterations in which the residual has to fall by half.
      unsigned int iterations = std::numeric_limits<unsigned int>::max();
      /// Whether what has softened by then stays so for good, where bonds soften; else the attempt fails.
      bool may_jump = false;
    };

    /// The controlled quantity and what the loads are.
    struct Control
    {
      LoadsAt loads_at;
      /// Empty: the dissipated energy.
      Gauge gauge;
      /// Change of t that is small enough to tell how loads change, and the largest one of an iteration.
      double small_time = 0, large_time = 0;
    };

    /// As those of NewtonSolver.
    template <typename... Arguments>
    explicit ControlledNewton(const Control &control, Arguments &&...arguments)
      : NewtonSolver<dim>(std::forward<Arguments>(arguments)...)
      , control(control)
      , fronts(this->system.mirror_layer().nodes())
    {
      initialize();
    }

    /// Goes on from the last equilibrium to one at which the controlled quantity has grown by an amount. A
    /// failure is reported, not thrown. Collective.
    EquilibriumStep advance(const double amount, const Progress &progress, const Patience &patience = {});

    /// Goes on from the last equilibrium to one at a time, if it can without a jump. Collective.
    EquilibriumStep load(const double time, const Progress &progress);

    /// The same, by whatever jump it takes. Collective.
    EquilibriumStep jump(const double time, const Progress &progress);

    /// Restores the last equilibrium, with its time.
    void go_back()
    {
      this->restore();
      now = last.time;
    }

    /// Factor of the loads at the last equilibrium, and by how much the controlled quantity grew in the step
    /// that led there.
    double time() const { return last.time; }
    double time_change() const { return last.time_change; }
    double amount() const { return previous.amount; }

    /// From now on a step by load() fails where it dissipates more [J].
    void limit_dissipation(const double energy) { most_by_loads = energy; }

    void register_state(LastingState &state) override;
    void resume(const NodalVector &external, const double time) override;

  private:
    /// A place on the path.
    struct Start
    {
      NodalVector displacement;
      double      time = 0;
    };

    void initialize();
    /// Starts along the way of the last step; returns whether it goes with the fronts of cracks, which leads
    /// near an equilibrium. Collective.
    bool predict(const double amount);
    /// The change of the controlled quantity since the last equilibrium.
    double changed() const;
    /// How far that may be from an amount asked for.
    double may_miss(const double amount) const;
    /// Brings loads, supports and nodes to where a share of x and a change of t lead. Collective.
    void place(const double share, const double time_change);
    /// One iteration; false, with the body back where it began, where there is none. Collective.
    bool correct(const double amount, const Slope slope, EquilibriumStep &result);
    /// The force by unit t at the present state. Collective.
    void prepare_loads();
    /// Solves until a residual norm is left [N]; from the solution, which may do already. Collective.
    bool
    solve(NodalVector &solution, const NodalVector &source, const double residual, EquilibriumStep &result);
    /// The change of t with which the controlled quantity is right after the whole x, where the body is left;
    /// not a number where there is none. Collective.
    double find_time_change(const double amount);
    /// Keeps a step that has come to an equilibrium, as the next one may go on.
    /// @param with_cells where it was before bonds took the place of cells in it, if they did: what the body
    /// moved by that is no part of how the path goes on
    void keep_step(const double change, const std::optional<Start> &with_cells);
    /// Keeps by how much the controlled quantity has grown to an equilibrium.
    void keep_amount(const double change);

    using EquilibriumPath<dim>::held;
    using EquilibriumPath<dim>::last;

    const Control control;
    double        most_by_loads = std::numeric_limits<double>::infinity();
    /// The loads at the present time [N] and those a little later, q [N]; the first residual of a linear
    /// system [N]; the motion of the last step as it goes with the fronts [m].
    NodalVector external, later, of_loads, first_residual, carried;
    double      now = 0;
    /// y by the secant and by the tangent, and the one in use [m].
    struct ByUnitLoads
    {
      NodalVector  secant, tangent;
      NodalVector *used = &secant;
    };
    ByUnitLoads by_unit;
    /// Where the present iteration began.
    Start start;
    /// The controlled quantity at the last equilibrium and its change in the step there; by how much unit t
    /// changes it, as read last, or zero; the change of t in the last iteration of the step, or zero.
    struct Previous
    {
      double amount = 0, reading = 0, by_time = 0, iteration = 0;
    };
    Previous previous;
    /// Of the cracks, where dissipated energy is controlled.
    CrackFronts<dim> fronts;
  };
} // namespace perideal

#endif
