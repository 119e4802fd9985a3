// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_drivers_driver_h
#define perideal_drivers_driver_h

#include <perideal/drivers/mesh_adaptation.h>
#include <perideal/problem/mesh_error.h>
#include <perideal/recorders/recorders.h>

#include <memory>
#include <string>

namespace perideal
{
  /// How a driver left its steps.
  enum class StepsEnd
  {
    /// All are taken.
    done,
    /// The program was asked to stop.
    stopped,
    /// The mesh is to change before the next one.
    mesh_changes
  };

  /**
   * Takes a problem through its steps, and hands each of them to the recorders. Every kind of solver is a
   * driver: it prepares what it needs of the problem, runs, and can check a scene without solving it.
   */
  template <int dim>
  class Driver
  {
  public:
    /// The problem must outlive this object.
    Driver(Problem<dim> &problem, const RunKind &kind);
    virtual ~Driver() = default;

    /// Runs the scene, up to its end or until the mesh is to change. Whatever it throws, what was computed by
    /// then is on disk. Collective.
    /// @throws InputError, ComputationError, and Stopped where the program was asked to stop.
    void run();

    /// Reads, meshes, counts and warns; solves what an estimate of the error takes, and writes nothing.
    /// Collective.
    /// @throws InputError as run() does before it solves.
    void check();

    /// Estimates the error that the mesh leaves in the displacement at t = 1, for which it solves to a
    /// tolerance, in linear statics of the consistent form. run() goes on from there. Collective.
    /// @throws InputError as run() does before it solves, ComputationError where the solver stops.
    ErrorEstimate estimate(const double tolerance);

    /// Makes mesh, nodes and families, and reads the scene, once. Collective.
    void build();

    /// Of meshes that change while the scene goes on.
    MeshAdaptation<dim> adaptation;

  protected:
    /// Reads what the scene says of failure and motion; needs the nodes. Collective.
    virtual void prepare_scene() = 0;

    /// Makes what damps a motion, and with it bounds stable steps; needs the weights.
    virtual void prepare_damping() {}

    /// Builds everything up to the first step. Collective.
    virtual void prepare() = 0;

    /// Looks at the loads before the first step. Collective.
    virtual void check_loads() { problem.check_loads(); }

    /// Takes all steps. Collective.
    virtual StepsEnd advance() = 0;

    /// Returns lines of the banner.
    virtual std::string describe() const = 0;

    /// Returns the step that a run stopped after, in words.
    virtual std::string last_step() const { return {}; }

    /// Returns what this driver does without.
    virtual nlohmann::ordered_json skipped() const = 0;

    /// Returns the memory of its operators on this rank [B].
    virtual std::size_t memory_consumption() const;

    /// Solves for all loads to a tolerance of its own, where that takes one linear system. Collective.
    /// @return whether the solver came to that
    virtual bool solve_to(const double /*tolerance*/) { return false; }

    /// Returns lines about the end of a run.
    virtual std::string closing_lines() const { return {}; }

    /// Returns viscous force over mass and velocity [1/s], which bounds stable steps.
    virtual double damping() const { return problem.parameters.solver.damping; }

    /// Returns the largest stable step of explicit dynamics [s]. Collective.
    /// @param moves by owned node: the others are held; empty: all move
    double largest_stable_step(const std::vector<bool> &moves = {}) const;

    /// Writes a checkpoint of all that lasts. Collective.
    void save_checkpoint(const std::uint64_t step, const double time) const;

    /// Reads the last checkpoint, where the run is to go on from it, and holds its scene against this one.
    /// Collective. @throws InputError when it belongs to another.
    void open_checkpoint();

    /// Brings all that lasts to the state of the checkpoint, which is done with. Collective.
    void resume_checkpoint();

    /// Energies of the present step, the largest so far noted.
    /// @return what is missing over that [-]
    double energy_error(const EnergyBudget &energy, const double scale);

    Problem<dim>                   &problem;
    const RunKind                   kind;
    std::unique_ptr<Recorders<dim>> recorders;
    /// What this run goes on from, if it does, and whether that was left by another mesh.
    std::unique_ptr<Checkpoint> resumed;
    bool                        mesh_has_changed = false;
    /// Of the run so far [J].
    double largest_energy = 0;
    /// Whether mesh, nodes and families are there.
    bool is_built = false;

  private:
    void finish(const RunStatus status);
    /// The same when an error is on its way, which no other may replace.
    void finish_after_error() noexcept;
  };

  /// Makes the driver that the scene asks for. Collective.
  template <int dim>
  std::unique_ptr<Driver<dim>> create_driver(Problem<dim> &problem);
} // namespace perideal

#endif
