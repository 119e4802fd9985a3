// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_drivers_load_steps_h
#define perideal_drivers_load_steps_h

#include <perideal/drivers/heating.h>
#include <perideal/solvers/equilibrium_path.h>

#include <functional>
#include <string>

namespace perideal
{
  /**
   * Goes along load steps that all change t by as much: to the end of each, after a failure in halves. Where
   * the mesh is to change within a step, the next driver goes on from the equilibrium found by then, and
   * counts to the step what was done before.
   */
  template <int dim>
  class LoadSteps
  {
  public:
    /// The arguments must outlive this object.
    LoadSteps(Problem<dim> &problem, EquilibriumPath<dim> &path);

    /// Time at the end of a load step [-].
    double end_of(const std::uint64_t number) const
    {
      return static_cast<double>(number) / solver.load_steps;
    }
    /// Time of the last equilibrium, or of one that is sought or was in vain [-].
    double time() const { return reached; }
    /// Goes on from an equilibrium that an earlier run left at a time [-].
    void go_on_from(const double time) { reached = time; }

    /// Called with the search in words, the time of all steps that is behind [-], the iteration and the
    /// relative residual.
    using Progress = std::function<void(const std::string &, const double, const unsigned int, const double)>;

    /// Goes to the end of a load step, or to where the path wants another mesh; one that failed is at its
    /// time(). Collective.
    /// @param n_halvings of the step
    EquilibriumStep next(const std::uint64_t number, unsigned int &n_halvings, const Progress &progress);

    /// Whether the last equilibrium is where bonds broke since the mesh changed last in this load step, or
    /// the mesh has not changed often since; else changes of the mesh may go round in a circle.
    bool may_change_mesh() const
    {
      return path.n_broken() > unfinished.n_broken || unfinished.n_changes < most_changes;
    }

    /// Of heating, since the beginning [J].
    double work() const { return work_of_heating; }

    void register_state(LastingState &state);

  private:
    /// Changes of the mesh at one equilibrium.
    static constexpr unsigned int most_changes = 10;

    /// Goes on to the equilibrium of a time; as often as bonds take the place of cells on the way, for loads
    /// act on nodes there.
    EquilibriumStep find_equilibrium(const std::uint64_t number, const double to, const Progress &progress);
    EquilibriumStep approach(const std::uint64_t number, const double to, const Progress &progress);

    /// What was done in a load step before the mesh changed.
    struct Unfinished
    {
      EquilibriumStep search;
      unsigned int    n_halvings = 0;
      /// Changes of the mesh since a bond broke, and bonds broken by the last one.
      unsigned int n_changes = 0;
      GlobalIndex  n_broken  = 0;
    };

    const SolverParameters &solver;
    Problem<dim>           &problem;
    EquilibriumPath<dim>   &path;
    Heating<dim>            heating;
    double                  work_of_heating = 0; // [J]
    double                  reached         = 0;
    Unfinished              unfinished;
  };
} // namespace perideal

#endif
