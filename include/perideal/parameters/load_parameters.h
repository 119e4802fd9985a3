// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_parameters_load_parameters_h
#define perideal_parameters_load_parameters_h

#include <perideal/parameters/space_time_function.h>

#include <deal.II/base/parameter_handler.h>

#include <array>
#include <string>
#include <vector>

namespace perideal
{
  class ParameterFile;

  /// Expressions of one subsection of "Boundary conditions"; an empty one is free.
  struct BoundaryConditionText
  {
    /// Name of the subsection, "Boundary conditions/<name>".
    std::string name;
    /// Gmsh physical names or ids, separated by commas.
    std::string boundary;
    /// Prescribed displacement by component [m].
    std::array<std::string, 3> displacement;
    /// Prescribed velocity by component [m/s], in dynamics.
    std::array<std::string, 3> velocity;
    /// Traction vector by component [Pa].
    std::array<std::string, 3> traction;
    /// Pressure [Pa], positive towards the body.
    std::string pressure;
  };

  /// Expressions of one subsection of "Point loads"; an empty one is no force.
  struct PointLoadText
  {
    /// Name of the subsection, "Point loads/<name>".
    std::string name;
    /// Coordinates [m], separated by commas.
    std::string point;
    /// Force by component [N].
    std::array<std::string, 3> force;
  };

  /// Sections "Boundary conditions", "Point loads" and "Body force", as text.
  struct LoadParameters
  {
    /// What the next two are where they are automatic: automatic | layer | printed | balanced |
    /// taylor ghosts.
    std::string treatment = "automatic";
    /// How prescribed displacements reach the peridynamic nodes: automatic | face value |
    /// layer | reference | mirror | surface nodes | taylor ghosts.
    std::string displacement_treatment = "automatic";
    /// How tractions reach the nodes: automatic | layer | taylor ghosts | line to point |
    /// printed line to point | transfer | printed transfer.
    std::string traction_treatment = "automatic";
    /// Of the printed transfer: chi of PDBC (2.14) [-], lambda of (3.15) [N/m^11].
    double transfer_chi = 3.59, transfer_lambda = 1.;
    /// How many layers of cells under a boundary are held, where nodes are.
    unsigned int layers = 1;
    /// What to do about rigid-body motions that no condition holds: error | remove.
    std::string                        rigid_body_motions = "error";
    std::vector<BoundaryConditionText> conditions;
    std::vector<PointLoadText>         point_loads;
    /// Force per volume by component [N/m^3].
    std::array<std::string, 3> body_force;

    void declare(dealii::ParameterHandler &prm, const ParameterFile &file);

    bool has_taylor_extension() const { return traction_treatment == "taylor ghosts"; }
    bool has_surface_nodes() const { return displacement_treatment == "surface nodes"; }
    bool has_published_transfer() const { return traction_treatment == "printed transfer"; }
    bool has_transfer() const { return traction_treatment == "transfer" || has_published_transfer(); }
    bool has_line_to_point() const
    {
      return traction_treatment == "line to point" || traction_treatment == "printed line to point";
    }
    /// Whether tractions act on the nodes that a face has within a horizon, and not on its cell's.
    bool act_in_depth() const { return has_transfer() || has_taylor_extension() || has_line_to_point(); }
  };

  /// A boundary condition ready to be evaluated.
  template <int dim>
  struct BoundaryCondition
  {
    std::string                             name;
    std::vector<std::string>                boundaries;
    std::array<SpaceTimeFunction<dim>, dim> displacement;
    std::array<SpaceTimeFunction<dim>, dim> velocity;
    std::array<SpaceTimeFunction<dim>, dim> traction;
    SpaceTimeFunction<dim>                  pressure;

    /// Whether the displacement of a component is prescribed, or its velocity.
    bool holds(const unsigned int component) const
    {
      return displacement[component].is_present() || velocity[component].is_present();
    }

    /// Whether it holds any component.
    bool prescribes_displacement() const;
    bool prescribes_traction() const;
  };

  /// A force at a point, ready to be evaluated.
  template <int dim>
  struct PointLoad
  {
    std::string                             name;
    dealii::Point<dim>                      position;
    std::array<SpaceTimeFunction<dim>, dim> force;

    /// Force [N]; in 2-D on the whole thickness.
    dealii::Tensor<1, dim> force_at(const double time) const;
  };

  /// All loads of a scene, ready to be evaluated.
  template <int dim>
  struct Loads
  {
    std::vector<BoundaryCondition<dim>>     conditions;
    std::vector<PointLoad<dim>>             point_loads;
    std::array<SpaceTimeFunction<dim>, dim> body_force;

    /// @throws InputError on a wrong expression, a z component in 2-D, a
    /// condition that prescribes nothing or both displacement and traction of
    /// one component, a point load without a point or a force.
    explicit Loads(const LoadParameters &parameters);
    Loads() = default;

    /// Whether tractions, pressures, point loads or body forces change with t.
    bool forces_depend_on_time() const;

    /// Traction vector [Pa] of a condition at a boundary point with outward
    /// unit normal: the traction minus pressure times normal.
    static dealii::Tensor<1, dim> traction(const BoundaryCondition<dim> &condition,
                                           const dealii::Point<dim>     &point,
                                           const dealii::Tensor<1, dim> &normal,
                                           const double                  time);

    /// Body force [N/m^3].
    dealii::Tensor<1, dim> body_force_at(const dealii::Point<dim> &point, const double time) const;
  };
} // namespace perideal

#endif
