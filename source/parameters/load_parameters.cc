// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/parameters/load_parameters.h>
#include <perideal/parameters/named_texts.h>
#include <perideal/parameters/point_text.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  namespace
  {
    const std::array<std::string, 3> axes = {{"x", "y", "z"}};

    /// Functions of the components a scene of this dimension has; a z component in 2-D is an error.
    template <int dim>
    std::array<SpaceTimeFunction<dim>, dim> make_components(const std::array<std::string, 3> &expressions,
                                                            const std::string                &prefix)
    {
      if (dim == 2 && !expressions[2].empty())
        throw InputError("a two-dimensional scene has no z component").parameter(prefix + "z");
      std::array<SpaceTimeFunction<dim>, dim> result;
      for (int d = 0; d < dim; ++d)
        result[d] = SpaceTimeFunction<dim>(expressions[d], prefix + axes[d]);
      return result;
    }

    /// Value of those components that are prescribed, zero for the others.
    template <int dim>
    dealii::Tensor<1, dim> value_of(const std::array<SpaceTimeFunction<dim>, dim> &components,
                                    const dealii::Point<dim>                      &point,
                                    const double                                   time)
    {
      dealii::Tensor<1, dim> result;
      for (int d = 0; d < dim; ++d)
        if (components[d].is_present())
          result[d] = components[d].value(point, time);
      return result;
    }

    template <typename Functions>
    bool any_present(const Functions &functions)
    {
      return std::any_of(functions.begin(), functions.end(), [](const auto &f) { return f.is_present(); });
    }

    template <int dim>
    BoundaryCondition<dim> make_condition(const BoundaryConditionText &text)
    {
      const std::string      section = "Boundary conditions/" + text.name + "/";
      BoundaryCondition<dim> result;
      result.name       = text.name;
      result.boundaries = dealii::Utilities::split_string_list(text.boundary, ',');
      if (text.boundary.empty())
        throw InputError("the condition names no boundary")
          .parameter(section + "Boundary")
          .allowed("Gmsh physical names or ids, separated by commas");
      result.displacement = make_components<dim>(text.displacement, section + "u_");
      result.velocity     = make_components<dim>(text.velocity, section + "v_");
      result.traction     = make_components<dim>(text.traction, section + "t_");
      result.pressure     = SpaceTimeFunction<dim>(text.pressure, section + "Pressure");

      if (!result.prescribes_displacement() && !result.prescribes_traction())
        throw InputError("the condition prescribes nothing")
          .parameter("Boundary conditions/" + text.name)
          .allowed("at least one of u_x, u_y, u_z, v_x, v_y, v_z, t_x, t_y, t_z, Pressure");
      for (int d = 0; d < dim; ++d)
        {
          if (result.displacement[d].is_present() && result.velocity[d].is_present())
            throw InputError("displacement and velocity of one component are both prescribed")
              .parameter(section + "v_" + axes[d])
              .hint("remove u_" + axes[d] + " or v_" + axes[d]);
          if (result.holds(d) && result.traction[d].is_present())
            throw InputError("displacement and traction of one component are both prescribed")
              .parameter(section + "t_" + axes[d])
              .hint("remove u_" + axes[d] + " (v_" + axes[d] + ") or t_" + axes[d]);
        }
      if (result.pressure.is_present() && result.prescribes_displacement())
        throw InputError("a pressure acts on all components, some of which are held")
          .parameter(section + "Pressure")
          .hint("give tractions for the free components instead");
      return result;
    }

    template <int dim>
    PointLoad<dim> make_point_load(const PointLoadText &text)
    {
      const std::string section = "Point loads/" + text.name + "/";
      PointLoad<dim>    result;
      result.name     = text.name;
      result.position = read_point<dim>(text.point, section + "Point");
      result.force    = make_components<dim>(text.force, section + "F_");
      if (!any_present(result.force))
        throw InputError("the load has no force")
          .parameter("Point loads/" + text.name)
          .allowed("at least one of F_x, F_y, F_z");
      for (int d = 0; d < dim; ++d)
        if (result.force[d].is_present())
          result.force[d].value(result.position, 1.);
      return result;
    }
  } // namespace

  void LoadParameters::declare(dealii::ParameterHandler &prm, const ParameterFile &file)
  {
    prm.enter_subsection("Boundary conditions");
    prm.add_parameter(
      "Treatment",
      treatment,
      "What the next two are where they are automatic, for bonds between nodes: layer: layer and layer; "
      "published: surface nodes and published transfer, as in peridynamics with boundary conditions; "
      "balanced: surface nodes and transfer; taylor ghosts: these for both; automatic: what suits the model");
#define PERIDEAL_TREATMENT_HELP(name, text, meaning) text ": " meaning "; "
    prm.add_parameter("Displacement treatment",
                      displacement_treatment,
                      "How prescribed displacements reach the nodes: " PERIDEAL_DISPLACEMENT_TREATMENTS(
                        PERIDEAL_TREATMENT_HELP) "automatic: face value for the consistent form, taylor "
                                                 "ghosts with such tractions, else layer");
    prm.add_parameter("Traction treatment",
                      traction_treatment,
                      "How tractions and pressures reach the nodes: " PERIDEAL_TRACTION_TREATMENTS(
                        PERIDEAL_TREATMENT_HELP) "automatic: that for the consistent form, else layer");
#undef PERIDEAL_TREATMENT_HELP
    prm.add_parameter("Transfer chi",
                      transfer_chi,
                      "Of the published transfer: its factor is chi/(chi-1), not 0 or 1 [-]",
                      dealii::Patterns::Double());
    prm.add_parameter("Transfer lambda",
                      transfer_lambda,
                      "Of the published transfer: what the places of held faces do, in linear statics "
                      "[N/m^11]; 0: nothing. The unit makes results depend on the unit of length",
                      dealii::Patterns::Double());
    prm.add_parameter(
      "Layers",
      layers,
      "How many layers of cells under a boundary the treatments layer and reference hold [-]. 1: those "
      "at the boundary, which take its value at the face; more: also the cells that share a vertex with "
      "these, and so on, all of which take the formula's value at their own node: for formulas that are "
      "the field, in a collar as deep as the horizon",
      dealii::Patterns::Integer(1, 1000));
    prm.add_parameter(
      "Rigid body motions",
      rigid_body_motions,
      "What to do when the conditions leave a rigid-body motion free: error: stop; remove: find "
      "the solution whose mean translation and rotation are zero (the loads must balance)");
    conditions = named_texts<BoundaryConditionText>(file, "Boundary conditions");
    for (BoundaryConditionText &condition : conditions)
      {
        prm.enter_subsection(condition.name);
        prm.add_parameter(
          "Boundary", condition.boundary, "Gmsh physical names or ids of the boundary, separated by commas");
        for (unsigned int d = 0; d < 3; ++d)
          prm.add_parameter("u_" + axes[d],
                            condition.displacement[d],
                            "Prescribed displacement along " + axes[d] +
                              " [m], a formula in x, y, z, t; empty: free");
        for (unsigned int d = 0; d < 3; ++d)
          prm.add_parameter("v_" + axes[d],
                            condition.velocity[d],
                            "Prescribed velocity along " + axes[d] +
                              " [m/s], a formula in x, y, z, t, in dynamics; empty: free");
        for (unsigned int d = 0; d < 3; ++d)
          prm.add_parameter("t_" + axes[d],
                            condition.traction[d],
                            "Traction along " + axes[d] + " [Pa], a formula in x, y, z, t; empty: none");
        prm.add_parameter("Pressure",
                          condition.pressure,
                          "Pressure towards the body [Pa], a formula in x, y, z, t; empty: none");
        prm.leave_subsection();
      }
    prm.leave_subsection();

    prm.enter_subsection("Point loads");
    point_loads = named_texts<PointLoadText>(file, "Point loads");
    for (PointLoadText &load : point_loads)
      {
        prm.enter_subsection(load.name);
        prm.add_parameter("Point",
                          load.point,
                          "Where the force acts: coordinates [m], separated by commas, in the body or on its "
                          "boundary (up to a tenth of a cell outside, where that is curved)");
        for (unsigned int d = 0; d < 3; ++d)
          prm.add_parameter("F_" + axes[d],
                            load.force[d],
                            "Force along " + axes[d] +
                              " [N], a formula in x, y, z, t; in 2-D on the whole thickness; empty: none");
        prm.leave_subsection();
      }
    prm.leave_subsection();

    prm.enter_subsection("Body force");
    for (unsigned int d = 0; d < 3; ++d)
      prm.add_parameter("b_" + axes[d],
                        body_force[d],
                        "Force per volume along " + axes[d] +
                          " [N/m^3], a formula in x, y, z, t; empty: none");
    prm.leave_subsection();
  }

  template <int dim>
  bool BoundaryCondition<dim>::prescribes_displacement() const
  {
    return any_present(displacement) || any_present(velocity);
  }

  template <int dim>
  bool BoundaryCondition<dim>::prescribes_traction() const
  {
    return any_present(traction) || pressure.is_present();
  }

  template <int dim>
  dealii::Tensor<1, dim> PointLoad<dim>::force_at(const double time) const
  {
    return value_of<dim>(force, position, time);
  }

  template <int dim>
  bool Loads<dim>::forces_depend_on_time() const
  {
    const auto changes = [](const auto &functions) {
      return std::any_of(
        functions.begin(), functions.end(), [](const auto &f) { return f.depends_on_time(); });
    };
    return changes(body_force) ||
           std::any_of(
             point_loads.begin(), point_loads.end(), [&](const auto &load) { return changes(load.force); }) ||
           std::any_of(conditions.begin(), conditions.end(), [&](const auto &condition) {
             return changes(condition.traction) || condition.pressure.depends_on_time();
           });
  }

  template <int dim>
  Loads<dim>::Loads(const LoadParameters &parameters)
    : body_force(make_components<dim>(parameters.body_force, "Body force/b_"))
  {
    for (const BoundaryConditionText &text : parameters.conditions)
      conditions.push_back(make_condition<dim>(text));
    for (const PointLoadText &text : parameters.point_loads)
      point_loads.push_back(make_point_load<dim>(text));
  }

  template <int dim>
  dealii::Tensor<1, dim> Loads<dim>::traction(const BoundaryCondition<dim> &condition,
                                              const dealii::Point<dim>     &point,
                                              const dealii::Tensor<1, dim> &normal,
                                              const double                  time)
  {
    dealii::Tensor<1, dim> result = value_of<dim>(condition.traction, point, time);
    if (condition.pressure.is_present())
      result -= condition.pressure.value(point, time) * normal;
    return result;
  }

  template <int dim>
  dealii::Tensor<1, dim> Loads<dim>::body_force_at(const dealii::Point<dim> &point, const double time) const
  {
    return value_of<dim>(body_force, point, time);
  }

  PERIDEAL_INSTANTIATE_CLASS(BoundaryCondition)
  PERIDEAL_INSTANTIATE_CLASS(PointLoad)
  PERIDEAL_INSTANTIATE_CLASS(Loads)
} // namespace perideal
