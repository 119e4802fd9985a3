// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_drivers_tangent_system_h
#define perideal_drivers_tangent_system_h

#include <perideal/drivers/preconditioning.h>
#include <perideal/solvers/controlled_newton.h>

#include <memory>
#include <string>

namespace perideal
{
  /// The tangent of the force of a problem with what solves its systems, from which Newton's methods are
  /// made.
  template <int dim>
  class TangentSystem
  {
  public:
    using Controls = typename EquilibriumPath<dim>::Controls;

    /// The arguments must outlive this object. Collective.
    /// @param report part "solver" of summary.json, which is told how systems are preconditioned
    TangentSystem(Problem<dim> &problem, nlohmann::ordered_json &report);

    /// Newton's method along given loads. Collective.
    std::unique_ptr<NewtonSolver<dim>> create_newton(const Controls &controls);

    /// Newton's method with loads that are an unknown. Collective.
    std::unique_ptr<ControlledNewton<dim>>
    create_controlled_newton(const typename ControlledNewton<dim>::Control &control,
                             const Controls                                &controls);

    /// What solves the systems, in words.
    std::string name() const { return solver->name(); }

    std::size_t memory_consumption() const { return tangent->memory_consumption(); }

  private:
    template <typename Solver, typename... First>
    std::unique_ptr<Solver> create(const Controls &controls, const First &...first);

    Problem<dim>                             &problem;
    std::shared_ptr<TangentOperator<dim>>     tangent;
    std::unique_ptr<ConstrainedOperator<dim>> system;
    std::unique_ptr<Preconditioning<dim>>     preconditioning;
    std::unique_ptr<TangentSolver<dim>>       solver;
  };
} // namespace perideal

#endif
