// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_solvers_solver_parameters_h
#define perideal_solvers_solver_parameters_h

#include <perideal/parameters/choice.h>

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace perideal
{
  /// What is solved.
  enum class SolverName
  {
    linear_static,
    quasi_static,
    dynamic_relaxation,
    dynamics
  };

  template <>
  struct ChoiceNames<SolverName>
  {
    static constexpr const char *list[] = {"static", "quasi static", "dynamic relaxation", "dynamics"};
  };

  /// How linear systems are solved; those of Trilinos and the direct one assemble the matrix.
  enum class LinearSolverName
  {
    automatic,
    cg,
    gmres,
    trilinos_cg,
    trilinos_gmres,
    direct
  };

  template <>
  struct ChoiceNames<LinearSolverName>
  {
    static constexpr const char *list[] = {
      "automatic", "cg", "gmres", "trilinos cg", "trilinos gmres", "direct"};
  };

  /// What makes iterations few.
  enum class PreconditionerName
  {
    automatic,
    auxiliary,
    block_jacobi,
    none
  };

  template <>
  struct ChoiceNames<PreconditionerName>
  {
    static constexpr const char *list[] = {"automatic", "auxiliary", "block jacobi", "none"};
  };

  /// Where the finite elements of the auxiliary space live.
  enum class AuxiliaryMesh
  {
    automatic,
    same,
    parent
  };

  template <>
  struct ChoiceNames<AuxiliaryMesh>
  {
    static constexpr const char *list[] = {"automatic", "same", "parent"};
  };

  /// How motion is integrated in time; both are central differences.
  enum class Integrator
  {
    velocity_verlet,
    symplectic_euler
  };

  template <>
  struct ChoiceNames<Integrator>
  {
    static constexpr const char *list[] = {"velocity verlet", "symplectic euler"};
  };

  /// What grows by prescribed amounts from load step to load step of quasi statics.
  enum class LoadControlName
  {
    loads,
    gauge,
    dissipated_energy
  };

  template <>
  struct ChoiceNames<LoadControlName>
  {
    static constexpr const char *list[] = {"loads", "gauge", "dissipated energy"};
  };

  /// Section "Solver".
  struct SolverParameters
  {
    SolverName         name           = SolverName::linear_static;
    double             tolerance      = 1e-8;
    unsigned int       max_iterations = 5000;
    LinearSolverName   linear_solver  = LinearSolverName::automatic;
    PreconditionerName preconditioner = PreconditionerName::automatic;
    AuxiliaryMesh      auxiliary_mesh = AuxiliaryMesh::automatic;
    unsigned int       load_steps     = 1;
    /// Number of the last load step; 0: load_steps.
    unsigned int last_load_step = 0;
    /// What is controlled, a gauge by its name, how far it goes and by which steps [m or J]; 0: chosen.
    LoadControlName control = LoadControlName::loads;
    std::string     control_gauge;
    double          control_end = 0, control_step = 0;
    /// Newton iterations of an equilibrium.
    unsigned int newton_iterations = 25;
    /// Times that a load step may be halved before it has failed.
    unsigned int step_halvings = 5;

    /// Of dynamics [s]; step 0: chosen.
    double end_time = 0, time_step = 0;
    /// Part of the largest stable step [-].
    double time_step_safety = 0.8;
    /// Of the longest local step to the shortest.
    unsigned int local_step_ratio = 1;
    Integrator   integrator       = Integrator::velocity_verlet;
    /// Viscous force over mass and velocity [1/s].
    double damping = 0;
    /// Rate at which motion against the family dies out [1/s].
    double relative_damping = 0;

    bool is_linear_static() const { return name == SolverName::linear_static; }
    bool is_dynamic() const { return name == SolverName::dynamics; }
    bool is_relaxation() const { return name == SolverName::dynamic_relaxation; }
    bool is_quasi_static() const { return name == SolverName::quasi_static; }
    /// Whether this is controlled in load steps of quasi statics.
    bool controls(const LoadControlName what) const { return is_quasi_static() && control == what; }
    /// Whether the loads are an unknown.
    bool is_controlled() const { return is_quasi_static() && control != LoadControlName::loads; }
    /// Equilibria of the nonlinear force.
    bool is_nonlinear_static() const { return is_relaxation() || is_quasi_static(); }

    /// How many load steps there are: of those that are not controlled all up to the last one.
    unsigned int n_load_steps() const
    {
      return is_nonlinear_static() && !is_controlled() && last_load_step > 0 ? last_load_step : load_steps;
    }

    void declare(dealii::ParameterHandler &prm);
    /// @throws InputError on choices that do not go together.
    void check() const;

    /// True when the system is assembled.
    bool assembles() const;

    /// True when the solver that was asked for takes symmetric systems alone.
    bool takes_cg() const;
  };
} // namespace perideal

#endif
