// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_problem_loading_h
#define perideal_problem_loading_h

#include <perideal/boundary/cell_expansion.h>
#include <perideal/boundary/point_forces.h>
#include <perideal/operators/system/null_space.h>
#include <perideal/problem/discrete_body.h>
#include <perideal/treatments/treatments.h>

#include <nlohmann/json_fwd.hpp>

#include <memory>
#include <vector>

namespace perideal
{
  /// The loads and supports of a scene, and the treatments by which they reach the nodes.
  template <int dim>
  class Loading
  {
  public:
    /// The body must outlive this object.
    explicit Loading(const Body<dim> &body);

    /// Reads loads and conditions; needs the mesh.
    /// @throws InputError on wrong formulas or unknown boundaries.
    void read();

    /// Makes the supports, with unknowns and held nodes; needs the nodes. Collective.
    void choose_nodes(Timings &timings);

    /// Makes what passes tractions on, and adds what acts besides the bonds. Collective.
    void surround(DiscreteBody<dim> &discretisation, Timings &timings);

    /// Evaluates everything that is prescribed. Collective.
    /// @throws InputError naming what is not a finite number somewhere.
    void check_finite(const double time) const;

    /// Sets the external force [N] and what is prescribed of the displacement [m] to a time. Collective.
    void apply(const double time, NodalVector &force, NodalVector &displacement) const;

    /// Sets the external force of all loads at a time [N], overwritten. Collective.
    void external_force(const double time, NodalVector &force) const;

    /// Strain by which the cell of an owned node would expand freely, its mean at the time of the last
    /// external_force() [-].
    double free_expansion(const LocalIndex i) const { return expansion ? expansion->mean[i] : 0.; }

    /// That of all cells, which external_force() sets to its time; null where the scene gives no temperature.
    std::shared_ptr<CellExpansion<dim>> expansion;

    /// Tractions of faces, body forces and point loads of this rank as forces at their places, at t = 1.
    std::vector<typename NullSpace<dim>::Force> forces_on_body() const;

    /// Returns the resultants of the loads and of what the nodes get of them, for summary.json. Collective.
    nlohmann::ordered_json
    resultants(const NodalVector &displacement, const NodalVector &external, const double time) const;

    const Body<dim>                &body;
    Loads<dim>                      loads;
    std::unique_ptr<Supports<dim>>  supports;
    std::unique_ptr<Tractions<dim>> tractions;

  private:
    TreatedBody<dim> treated_body(Timings &timings) const;

    /// Writes what body forces put on the nodes of cells [N]. Collective.
    void set_body_forces(const double time, NodalVector &force) const;

    /// Finds the cells of point loads. Collective.
    void place_point_forces(const CellGradients<dim> &gradients);

    PointForces<dim> point_forces;
    /// Of the consistent form, which takes body forces by moments; else null.
    std::shared_ptr<const GradientMoments<dim>> moments;
  };
} // namespace perideal

#endif
