// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_parameters_load_parameters_h
#define perideal_parameters_load_parameters_h

#include <perideal/parameters/choice.h>
#include <perideal/parameters/face_rotation.h>
#include <perideal/parameters/space_time_function.h>
#include <perideal/parameters/treatment_list.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>
#include <deal.II/base/types.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

namespace perideal
{
  class ParameterFile;

  /// What the treatments of displacements and tractions are where these are automatic.
  enum class Treatment
  {
    automatic,
    layer,
    published,
    balanced,
    taylor_ghosts
  };

  template <>
  struct ChoiceNames<Treatment>
  {
    static constexpr const char *list[] = {"automatic", "layer", "published", "balanced", "taylor ghosts"};
  };

#define PERIDEAL_TREATMENT_VALUE(name, text, meaning) name,
#define PERIDEAL_TREATMENT_TEXT(name, text, meaning) text,

  /// How prescribed displacements reach the peridynamic nodes.
  enum class DisplacementTreatment
  {
    automatic,
    PERIDEAL_DISPLACEMENT_TREATMENTS(PERIDEAL_TREATMENT_VALUE)
  };

  template <>
  struct ChoiceNames<DisplacementTreatment>
  {
    static constexpr const char *list[] = {"automatic",
                                           PERIDEAL_DISPLACEMENT_TREATMENTS(PERIDEAL_TREATMENT_TEXT)};
  };

  /// How tractions and pressures reach the nodes.
  enum class TractionTreatment
  {
    automatic,
    PERIDEAL_TRACTION_TREATMENTS(PERIDEAL_TREATMENT_VALUE)
  };

  template <>
  struct ChoiceNames<TractionTreatment>
  {
    static constexpr const char *list[] = {"automatic",
                                           PERIDEAL_TRACTION_TREATMENTS(PERIDEAL_TREATMENT_TEXT)};
  };

#undef PERIDEAL_TREATMENT_VALUE
#undef PERIDEAL_TREATMENT_TEXT

  /// What is done about rigid-body motions that no condition holds.
  enum class FreeMotions
  {
    error,
    remove
  };

  template <>
  struct ChoiceNames<FreeMotions>
  {
    static constexpr const char *list[] = {"error", "remove"};
  };

  /// Along which directions the springs at a boundary pull.
  enum class SpringDirection
  {
    all,
    normal
  };

  template <>
  struct ChoiceNames<SpringDirection>
  {
    static constexpr const char *list[] = {"all", "normal"};
  };

  /// An elastic foundation of a boundary.
  struct FaceSpring
  {
    /// In a unit of area [N/m^3]; 0: none.
    double          stiffness = 0.;
    SpringDirection direction = SpringDirection::all;

    /// The stiffness at a face with that unit normal [N/m^3].
    template <int dim>
    dealii::SymmetricTensor<2, dim> in(const dealii::Tensor<1, dim> &normal) const
    {
      return stiffness * (direction == SpringDirection::all ?
                            dealii::unit_symmetric_tensor<dim>() :
                            dealii::symmetrize(dealii::outer_product(normal, normal)));
    }
  };

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
    /// Prescribes all components instead of the displacement.
    RotationText rotation;
    /// Prescribed displacement along the normal [m]: 0, or empty.
    std::string normal_displacement;
    FaceSpring  spring;
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

  /// Sections "Tables", "Boundary conditions", "Point loads", "Body force" and "Thermal strain", as text.
  struct LoadParameters
  {
    Treatment             treatment              = Treatment::automatic;
    DisplacementTreatment displacement_treatment = DisplacementTreatment::automatic;
    TractionTreatment     traction_treatment     = TractionTreatment::automatic;
    /// Of the published transfer: chi of PDBC (2.14) [-], lambda of (3.15) [N/m^11].
    double transfer_chi = 3.59, transfer_lambda = 1.;
    /// How many layers of cells under a boundary are held, where nodes are.
    unsigned int                       layers             = 1;
    FreeMotions                        rigid_body_motions = FreeMotions::error;
    std::vector<BoundaryConditionText> conditions;
    std::vector<PointLoadText>         point_loads;
    /// Force per volume by component [N/m^3].
    std::array<std::string, 3> body_force;
    /// Acceleration by component [m/s^2], formulas separated by commas; empty: none.
    std::string gravity;
    /// Temperature, a formula, empty: none; and that without thermal strain [K].
    std::string temperature;
    double      reference_temperature = 0.;

    /// Whether rotations are those of linear statics; what the solver says.
    bool has_small_rotations = false;
    /// Section "Tables", for formulas of all sections.
    TableParameters tables;

    void declare(dealii::ParameterHandler &prm, const ParameterFile &file);

    bool has_taylor_extension() const { return traction_treatment == TractionTreatment::taylor_ghosts; }
    bool has_surface_nodes() const { return displacement_treatment == DisplacementTreatment::surface_nodes; }
    bool has_mirror() const { return displacement_treatment == DisplacementTreatment::mirror; }
    bool has_published_transfer() const
    {
      return traction_treatment == TractionTreatment::published_transfer;
    }
    bool has_transfer() const
    {
      return traction_treatment == TractionTreatment::transfer || has_published_transfer();
    }
    bool has_line_to_point() const
    {
      return traction_treatment == TractionTreatment::line_to_point ||
             traction_treatment == TractionTreatment::published_line_to_point;
    }
    /// Whether nodes of the cells at the boundary take prescribed values.
    bool holds_layer() const
    {
      return displacement_treatment == DisplacementTreatment::layer ||
             displacement_treatment == DisplacementTreatment::reference;
    }
    /// Whether tractions act on the nodes that a face has within a horizon, and not on its cell's.
    bool act_in_depth() const { return has_transfer() || has_taylor_extension() || has_line_to_point(); }
  };

  /// A boundary condition ready to be evaluated.
  template <int dim>
  struct BoundaryCondition
  {
    std::string name;
    /// Gmsh physical names or ids, as given.
    std::vector<std::string> boundaries;
    /// The same as ids of the mesh, once resolve_boundaries() has found them.
    std::vector<dealii::types::boundary_id> boundary_ids;
    std::array<SpaceTimeFunction<dim>, dim> displacement;
    std::array<SpaceTimeFunction<dim>, dim> velocity;
    std::array<SpaceTimeFunction<dim>, dim> traction;
    SpaceTimeFunction<dim>                  pressure;
    /// Whether the boundary slides in its tangential plane: nothing moves along the normal, nothing pulls
    /// along it.
    bool slides = false;
    /// On which the boundary stands.
    FaceSpring spring;

    /// Whether it names a boundary.
    bool acts_on(const dealii::types::boundary_id boundary) const
    {
      return std::find(boundary_ids.begin(), boundary_ids.end(), boundary) != boundary_ids.end();
    }

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
    /// Acceleration by which the mass of the body weighs [m/s^2].
    std::array<SpaceTimeFunction<dim>, dim> gravity;
    /// Of the cell groups that it acts on [kg/m^3].
    std::map<dealii::types::material_id, double> densities;
    /// Temperature, and that without thermal strain [K].
    SpaceTimeFunction<dim> temperature;
    double                 reference_temperature = 0.;
    /// Coefficients of thermal expansion of the cell groups [1/K].
    std::map<dealii::types::material_id, double> expansions;

    /// @throws InputError on a wrong expression, a z component in 2-D, a
    /// condition that prescribes nothing or both displacement and traction of
    /// one component, a point load without a point or a force.
    explicit Loads(const LoadParameters &parameters);
    Loads() = default;

    /// @throws InputError where a table has no value at a time [s].
    void check_tables(const double time) const;

    /// Whether tractions, pressures, point loads or body forces change with t.
    bool forces_depend_on_time() const;

    /// Traction vector [Pa] of a condition at a boundary point with outward
    /// unit normal: the traction minus pressure times normal.
    static dealii::Tensor<1, dim> traction(const BoundaryCondition<dim> &condition,
                                           const dealii::Point<dim>     &point,
                                           const dealii::Tensor<1, dim> &normal,
                                           const double                  time);

    /// Body force, the weight of that material included [N/m^3].
    dealii::Tensor<1, dim> body_force_at(const dealii::Point<dim>        &point,
                                         const double                     time,
                                         const dealii::types::material_id material) const;
    /// Whether the scene gives one.
    bool has_body_force() const
    {
      const auto is_given = [](const auto &component) { return component.is_present(); };
      return has_gravity() || std::any_of(body_force.begin(), body_force.end(), is_given);
    }
    bool has_gravity() const { return gravity[0].is_present(); }

    /// Whether the scene gives a temperature.
    bool has_temperature() const { return temperature.is_present(); }
    /// The strain by which a free body of that material expands in all directions [-].
    double expansion_at(const dealii::Point<dim>        &point,
                        const double                     time,
                        const dealii::types::material_id material) const
    {
      return expansions.at(material) * (temperature.value(point, time) - reference_temperature);
    }
  };
} // namespace perideal

#endif
