// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_application_simulation_h
#define perideal_application_simulation_h

#include <perideal/application/scene_parameters.h>
#include <perideal/application/scene_state.h>
#include <perideal/base/timing.h>
#include <perideal/output/checkpoint.h>
#include <perideal/output/field_output.h>
#include <perideal/output/history.h>
#include <perideal/solvers/equilibrium_path.h>
#include <perideal/solvers/explicit_dynamics.h>

#include <deal.II/base/conditional_ostream.h>

#include <nlohmann/json.hpp>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace perideal
{
  template <int dim>
  class GaussPoints;

  /// What a run is told besides its parameters.
  struct RunContext
  {
    /// The command as typed, for summary.json.
    std::string command;
    /// Directory of the `.prm` file, where relative mesh files may lie.
    std::string scene_directory;
    /// Every parameter as used, for summary.json.
    nlohmann::ordered_json parameters;
  };

  /**
   * Puts the parts of a scene together and runs it: mesh, nodes, families,
   * weights, solve, compare, write.
   */
  template <int dim>
  class Simulation
  {
  public:
    /// The parameters must outlive this object.
    Simulation(const SceneParameters &parameters, const RunContext &context, MPI_Comm communicator);

    /// Runs the scene. Collective.
    /// @throws InputError, ComputationError; what was computed by then is on disk.
    void run();

    /// Reads, meshes, counts and warns; solves nothing. Collective.
    void check();

  private:
    // Set-up.
    void make_mesh();
    void make_nodes_and_families();
    void find_free_motions();
    /// What of the body hangs together, where that is not known yet. Collective.
    void find_parts();
    /// @throws InputError when one of several bodies can move as a whole. Collective.
    void check_bodies_held() const;
    /// Tells when bonds with tensors have turned further than they know. Collective.
    void warn_of_large_rotations();
    /// Tells of nodes that hang on nothing any more.
    void warn_of_loose_nodes(const GlobalIndex n_loose);
    void prepare_comparisons();
    void make_gradient();
    void weigh_bonds();
    void weigh_gauss_points();
    void make_correspondence();
    /// Counts the nodes whose plane law leaves no thickness. Collective.
    void warn_of_lost_thickness();
    /// Factors that stiffen bonds near the surface, by owned node; empty where the scene has none.
    /// Collective.
    /// @param points of the cells; null: one point each
    std::vector<double> compensation_factors(const GaussPoints<dim> *points = nullptr) const;
    void                add_taylor_extension();
    /// Transfer functions, where the scene has them. Collective.
    void make_transfer();
    void set_up_solver();
    /// Chooses the preconditioner for a number of solves, and assembles what it needs. Collective.
    PreconditionerChoice prepare_preconditioner(const unsigned int n_solves);

    /// Whether prescribed displacements hold nodes, and not images or faces.
    bool by_nodes() const;
    /// The material of a cell group.
    const MaterialProperties &properties_of(const dealii::types::material_id id) const;
    /// The solids of the cell groups of a mesh of the body.
    SolidsByMaterial<dim> solids_on(const Mesh<dim> &mesh) const;
    /// Those of finite elements that the solution is compared with.
    SolidsByMaterial<dim> compared_solids_on(const Mesh<dim> &mesh) const;
    /// Measures the stiffness of whole families. Collective.
    void measure_families();
    /// Bulk and shear modulus by cell group, as the model takes them.
    SolidOf<dim> solid_of_model() const;

    /// Banner, more lines of it, and warnings.
    void announce(const std::string &more = std::string());
    /// History and fields, those of the run that this one goes on from included.
    void open_outputs();
    void finish(const std::string &status);

    // Statics.
    void apply_loads(const double time);
    /// External forces by tractions, body forces and point loads. Collective.
    void apply_forces(const double time);
    /// Those by the tractions and body forces of some loads on the conditions of the scene, overwritten.
    /// Collective.
    void set_tractions(const Loads<dim> &loads, const double time, NodalVector &force) const;
    /// Supports by ghosts: forces by condition, strain energy and work of all external forces. Collective.
    struct GhostBalance
    {
      std::vector<dealii::Tensor<1, dim>> reactions;
      double                              strain_energy, external_work;
    };
    GhostBalance balance_of_ghosts(const double time) const;
    /// Resultant over the faces of a condition of the tractions that ghosts meet there, without held
    /// components.
    Resultant<dim> met_by_ghosts(const std::size_t condition, const double time) const;
    /// Resultants of the loads and of what the nodes get of them, for summary.json. Collective.
    nlohmann::ordered_json load_resultants(const double time) const;
    void                   check_loads();
    /// Tractions of faces, body forces and point loads of this rank as forces at their places, at t = 1.
    std::vector<typename NullSpace<dim>::Force> forces_on_body() const;
    void                                        step(const unsigned int number);
    void                                        solve_equilibrium(const double time);
    void                                        store_displacement();
    void                                        record_step(const unsigned int number, const double time);
    void                                        write_fields(const unsigned int number, const double time);
    void                                        compare_at_end(const double time);

    // Failure, of nonlinear equilibria and dynamics.
    void prepare_cracks();
    void make_cracks_and_limits();
    /// Whether precracks cut a bond; empty where there are none.
    BondPredicate<dim> precrack_test() const;
    /// Critical stretch of a material at a horizon [-]; infinity: unbreakable.
    double critical_stretch(const dealii::types::material_id id, const double horizon) const;
    /// Share of the family behind broken bonds and precracks, by owned node.
    std::vector<double> total_damage() const;
    /// The tips of cracks, in the row of the history. Collective.
    void record_crack_tips(const GlobalIndex n_broken, const double time);

    // Equilibria of the nonlinear force, by dynamic relaxation or Newton's method.
    /// The parts of the scene up to the force, of whole bonds.
    void make_bond_force();
    /// Cracks and limits, checks and outputs, before the first load step.
    void prepare_equilibria(const std::string &solver);
    void run_relaxation();
    void run_quasi_static();
    /// Strengths of the bonds that break by stress.
    void set_strengths(const std::function<bool(const LocalIndex, const LocalIndex)> &can_break);
    /// The tangent and what solves with it, in the body before anything is cut.
    void set_up_tangent();
    /// Load steps, with what they leave behind.
    void run_load_steps(EquilibriumPath<dim> &path);
    /// Those that are left; returns the last one done, since the program may be asked to stop.
    unsigned int take_load_steps(EquilibriumPath<dim> &path);
    /// A load step, in parts where it fails as a whole.
    void load_step(const unsigned int number, EquilibriumPath<dim> &path);
    /// Finite elements of finite strain along the same load steps. Collective.
    void set_up_nonlinear_fem();
    /// Their equilibrium at a time.
    void solve_nonlinear_fem(const double time);
    /// Adds it to the row of the history and to the summary.
    void record_nonlinear_fem();
    EquilibriumStep
         find_equilibrium(const unsigned int number, const double time, EquilibriumPath<dim> &path);
    void record_equilibrium(const unsigned int          number,
                            const EquilibriumStep      &result,
                            const EquilibriumPath<dim> &path);
    void save_checkpoint(const unsigned int number, const EquilibriumPath<dim> &path);
    void resume(EquilibriumPath<dim> &path);

    // Dynamics.
    void   run_dynamics();
    void   prepare_dynamics();
    void   make_relative_damping();
    void   make_contact();
    double choose_time_step();
    /// Of explicit dynamics, with the scene's damping [s]. Collective.
    double largest_stable_step() const;
    /// False when the program was asked to stop.
    bool run_steps(ExplicitDynamics<dim> &dynamics, const double time_step);
    void record_dynamics(const ExplicitDynamics<dim> &dynamics);
    void write_frame(const unsigned int number, const ExplicitDynamics<dim> &dynamics);
    void store_motion(const ExplicitDynamics<dim> &dynamics);
    /// @throws ComputationError on all ranks when the motion is not finite, or its energy comes from nowhere.
    /// Collective.
    void check_motion(const ExplicitDynamics<dim> &dynamics, const EnergyBudget &energy);
    /// Number and place of the fastest node of all ranks. Collective.
    std::string fastest_node(const ExplicitDynamics<dim> &dynamics) const;
    void        save_checkpoint(const ExplicitDynamics<dim> &dynamics, const double time_step);
    void        resume(ExplicitDynamics<dim> &dynamics);

    // Checkpoints, of whatever goes on in steps.
    /// With what all steps leave: bonds, cracks, what the summary has of them.
    Checkpoint start_checkpoint(const unsigned int step, const double time) const;
    void       write(const Checkpoint &checkpoint);
    /// Reads the last checkpoint and holds its scene against this one.
    void open_checkpoint();
    /// What start_checkpoint() left.
    void resume_scene();

    const SceneParameters     &parameters;
    const RunContext           context;
    MPI_Comm                   communicator;
    dealii::ConditionalOStream screen;
    Timings                    timings;
    SceneState<dim>            scene;
    NodalVector                displacement, external_force;
    /// Of dynamics or nonlinear equilibria so far, which their drift is measured by [J].
    double largest_energy = 0;
    /// Times in succession at which more than half of that was missing.
    unsigned int rows_without_balance = 0;
    /// Of the field files so far [s].
    std::vector<double> frame_times;
    /// What this run goes on from, if it does.
    std::unique_ptr<Checkpoint> resumed;
    /// Broken bonds when the cracks were last looked at.
    GlobalIndex broken_in_cracks = 0;
    /// When the stored motion was, and the last one written [s].
    double motion_time = -1, frame_time = -1;

    std::unique_ptr<History>          history;
    std::unique_ptr<FieldOutput<dim>> field_output;
    nlohmann::ordered_json            summary;
  };
} // namespace perideal

#endif
