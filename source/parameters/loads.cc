// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/parameters/load_parameters.h>
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
                                                            const std::string                &prefix,
                                                            const Tables                     &tables)
    {
      if (dim == 2 && !expressions[2].empty())
        throw InputError("a two-dimensional scene has no z component").parameter(prefix + "z");
      std::array<SpaceTimeFunction<dim>, dim> result;
      for (int d = 0; d < dim; ++d)
        result[d] = SpaceTimeFunction<dim>(expressions[d], prefix + axes[d], tables);
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

    /// Whether a list of formulas gives one.
    bool any_formula(const std::array<std::string, 3> &formulas)
    {
      return std::any_of(
        formulas.begin(), formulas.end(), [](const std::string &text) { return !text.empty(); });
    }

    /// A boundary that slides takes no other condition.
    void check_sliding(const BoundaryConditionText &text, const std::string &section)
    {
      double value = 1.;
      try
        {
          value = dealii::Utilities::string_to_double(text.normal_displacement);
        }
      catch (const dealii::ExceptionBase &)
        {
        }
      if (value != 0.)
        throw InputError("a boundary may be held along its normal, and not be moved along it")
          .parameter(section + "u_n")
          .allowed("0; empty: none")
          .hint("move a boundary by u_x, u_y and u_z");
      if (any_formula(text.displacement) || any_formula(text.velocity) || any_formula(text.traction) ||
          !text.pressure.empty() || text.rotation.is_given() || text.spring.stiffness > 0)
        throw InputError("a boundary that is held along its normal takes no other condition")
          .parameter(section + "u_n")
          .hint("remove u_n, or the others; give a plane along the axes u_x, u_y or u_z = 0 instead of u_n");
    }

    template <int dim>
    BoundaryCondition<dim> make_condition(BoundaryConditionText text, const LoadParameters &parameters)
    {
      const Tables          &tables  = parameters.tables.tables;
      const std::string      section = "Boundary conditions/" + text.name + "/";
      BoundaryCondition<dim> result;
      result.name       = text.name;
      result.boundaries = dealii::Utilities::split_string_list(text.boundary, ',');
      if (text.boundary.empty())
        throw InputError("the condition names no boundary")
          .parameter(section + "Boundary")
          .allowed("Gmsh physical names or ids, separated by commas");
      if (text.rotation.is_given())
        {
          if (any_formula(text.displacement) || any_formula(text.velocity) || any_formula(text.traction))
            throw InputError("a rotation prescribes all components, one of which is given besides")
              .parameter(section + "Rotation")
              .hint("remove Rotation, or u_x, v_x, t_x and the like of this condition");
          text.displacement =
            displacement_of_rotation<dim>(text.rotation, parameters.has_small_rotations, section, tables);
        }
      if (result.slides = !text.normal_displacement.empty(); result.slides)
        check_sliding(text, section);
      result.displacement = make_components<dim>(text.displacement, section + "u_", tables);
      result.velocity     = make_components<dim>(text.velocity, section + "v_", tables);
      result.traction     = make_components<dim>(text.traction, section + "t_", tables);
      result.pressure     = SpaceTimeFunction<dim>(text.pressure, section + "Pressure", tables);

      result.spring = text.spring;
      if (!result.prescribes_displacement() && !result.prescribes_traction() && !(text.spring.stiffness > 0))
        throw InputError("the condition prescribes nothing")
          .parameter("Boundary conditions/" + text.name)
          .allowed("at least one of u_x, u_y, u_z, v_x, v_y, v_z, t_x, t_y, t_z, u_n, Pressure, Rotation, "
                   "Spring stiffness");
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

    /// Splits at the commas that stand in no parentheses.
    std::vector<std::string> split_formulas(const std::string &list)
    {
      std::vector<std::string> result(1);
      int                      depth = 0;
      for (const char letter : list)
        {
          depth += letter == '(' ? 1 : letter == ')' ? -1 : 0;
          if (letter == ',' && depth == 0)
            result.emplace_back();
          else
            result.back() += letter;
        }
      for (std::string &formula : result)
        formula = dealii::Utilities::trim(formula);
      return result;
    }

    template <int dim>
    std::array<SpaceTimeFunction<dim>, dim> make_gravity(const LoadParameters &parameters)
    {
      std::array<SpaceTimeFunction<dim>, dim> result;
      if (parameters.gravity.empty())
        return result;
      const std::string path     = "Body force/Gravity";
      const auto        formulas = split_formulas(parameters.gravity);
      if (formulas.size() != dim ||
          std::any_of(formulas.begin(), formulas.end(), [](const auto &f) { return f.empty(); }))
        throw InputError("gravity needs a component for each direction of the scene")
          .parameter(path)
          .allowed(std::to_string(dim) + " accelerations [m/s^2], separated by commas, such as " +
                   (dim == 2 ? "0, -9.81" : "0, 0, -9.81"));
      for (int d = 0; d < dim; ++d)
        result[d] = SpaceTimeFunction<dim>(formulas[d], path, parameters.tables.tables);
      return result;
    }

    template <int dim>
    PointLoad<dim> make_point_load(const PointLoadText &text, const Tables &tables)
    {
      const std::string section = "Point loads/" + text.name + "/";
      PointLoad<dim>    result;
      result.name     = text.name;
      result.position = read_point<dim>(text.point, section + "Point");
      result.force    = make_components<dim>(text.force, section + "F_", tables);
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

  template <int dim>
  bool BoundaryCondition<dim>::prescribes_displacement() const
  {
    return any_present(displacement) || any_present(velocity) || slides;
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
  void Loads<dim>::check_tables(const double time) const
  {
    const auto check = [&](const auto &functions) {
      for (const auto &function : functions)
        function.check_tables(time);
    };
    check(body_force);
    check(gravity);
    temperature.check_tables(time);
    for (const PointLoad<dim> &load : point_loads)
      check(load.force);
    for (const BoundaryCondition<dim> &condition : conditions)
      {
        check(condition.displacement);
        check(condition.velocity);
        check(condition.traction);
        condition.pressure.check_tables(time);
      }
  }

  template <int dim>
  bool Loads<dim>::forces_depend_on_time() const
  {
    const auto changes = [](const auto &functions) {
      return std::any_of(
        functions.begin(), functions.end(), [](const auto &f) { return f.depends_on_time(); });
    };
    return changes(body_force) || changes(gravity) || temperature.depends_on_time() ||
           std::any_of(
             point_loads.begin(), point_loads.end(), [&](const auto &load) { return changes(load.force); }) ||
           std::any_of(conditions.begin(), conditions.end(), [&](const auto &condition) {
             return changes(condition.traction) || condition.pressure.depends_on_time();
           });
  }

  template <int dim>
  Loads<dim>::Loads(const LoadParameters &parameters)
    : body_force(make_components<dim>(parameters.body_force, "Body force/b_", parameters.tables.tables))
    , gravity(make_gravity<dim>(parameters))
    , temperature(parameters.temperature, "Thermal strain/Temperature", parameters.tables.tables)
    , reference_temperature(parameters.reference_temperature)
  {
    for (const BoundaryConditionText &text : parameters.conditions)
      conditions.push_back(make_condition<dim>(text, parameters));
    for (const PointLoadText &text : parameters.point_loads)
      point_loads.push_back(make_point_load<dim>(text, parameters.tables.tables));
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
  dealii::Tensor<1, dim> Loads<dim>::body_force_at(const dealii::Point<dim>        &point,
                                                   const double                     time,
                                                   const dealii::types::material_id material) const
  {
    auto result = value_of<dim>(body_force, point, time);
    if (has_gravity())
      result += densities.at(material) * value_of<dim>(gravity, point, time);
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(BoundaryCondition)
  PERIDEAL_INSTANTIATE_CLASS(PointLoad)
  PERIDEAL_INSTANTIATE_CLASS(Loads)
} // namespace perideal
