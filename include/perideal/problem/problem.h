// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_problem_problem_h
#define perideal_problem_problem_h

#include <perideal/materials/elastic_state.h>
#include <perideal/output/lasting_state.h>
#include <perideal/problem/failure.h>
#include <perideal/problem/loading.h>
#include <perideal/problem/run.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace perideal
{
  /// A displacement at this rank's nodes [m].
  template <int dim>
  using NodalField = std::vector<dealii::Tensor<1, dim>>;

  /// A solution by finite elements on the mesh itself.
  template <int dim>
  struct FemSolution
  {
    /// At the nodes, rigid-body motions removed [m].
    NodalField<dim> displacement;
    /// At the nodes; none where the elements' cells are not those of the body.
    std::optional<std::vector<ElasticState>> states;
    unsigned int                             iterations = 0;
    dealii::types::global_dof_index          n_unknowns = 0;
  };

  /// The state of the body, as the last step left it.
  template <int dim>
  struct State
  {
    /// Displacement of the unknowns [m], and the external force on them [N].
    NodalVector unknowns, external_force;
    /// Displacement of the nodes, rigid-body motions removed [m]; in dynamics their velocity [m/s].
    NodalField<dim> displacement, velocity;
    /// Solutions it is held against, by name: "fem", "reference", "exact".
    std::map<std::string, NodalField<dim>> comparisons;
    /// The linear finite elements among them.
    std::optional<FemSolution<dim>> fem;
  };

  /**
   * A built scene: the body, its discretisation, loading and failure, and the state that drivers move on.
   * Drivers build the parts that they need, in the order of the methods; recorders read them.
   */
  template <int dim>
  struct Problem
  {
    /// The parameters must outlive this object.
    Problem(const SceneParameters &parameters, const RunContext &context, MPI_Comm communicator);

    /// Makes mesh, nodes and families. Collective.
    /// @throws InputError on a bad mesh, unknown boundaries, a node without neighbours.
    void build();

    /// Finds the motions that supports leave free. Collective.
    /// @throws InputError where the scene does not remove them.
    void find_motions();

    /// Weighs the bonds and makes the linear system. Collective.
    void weigh();

    /// Solves finite elements on the mesh itself for the loads of a time. Collective.
    void solve_fem(const double time);

    /// Solves for what the scene compares with at t = 1: the converged reference, and in linear statics
    /// finite elements on the mesh itself. To be called before weigh(), when little else is in memory, and
    /// again after it, for stiffnesses that are those of weighed families. Collective.
    void solve_comparisons(const bool is_linear_static);

    /// Makes the nonlinear force of whole bonds.
    void make_force();

    /// Cuts precracks and sets the limits of the force's bonds. Collective.
    void make_failure();

    /// Frees what explicit steps do not need once there is a force: the system, the linear operator and,
    /// unless families are weighed anew as bonds break, their weights and members.
    void keep_force();

    /// Makes the vectors of the state and looks at all loads once, at t = 1. Collective.
    /// @throws InputError on loads that are not finite, or push along a motion that nothing holds.
    void check_loads();

    /// Sets supports, prescribed displacements and external forces to a time. Collective.
    void apply_loads(const double time);

    /// Takes over the displacement of the unknowns to that of the nodes.
    void store_displacement();

    const SceneParameters &parameters;
    Run                    run;

    Body<dim>                                 body;
    Loading<dim>                              loading;
    DiscreteBody<dim>                         discretisation;
    Failure<dim>                              failure;
    std::unique_ptr<ConstrainedOperator<dim>> system;
    /// Of dynamics and nonlinear equilibria.
    std::unique_ptr<BondForce<dim>> force;
    NullSpace<dim>                  free_motions;
    State<dim>                      state;
    /// What of this and of all who move or record it lasts from step to step.
    LastingState lasting;
  };
} // namespace perideal

#endif
