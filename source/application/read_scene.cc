// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/read_scene.h>
#include <perideal/application/rules.h>
#include <perideal/base/registry.h>
#include <perideal/mesh/local_refinement.h>
#include <perideal/parameters/declarations.h>
#include <perideal/parameters/point_text.h>
#include <perideal/problem/output_fields.h>

#include <deal.II/base/utilities.h>

#include <algorithm>

namespace perideal
{
  namespace
  {
    bool starts_with(const std::string &text, const std::string &start)
    {
      return text.compare(0, start.size(), start) == 0;
    }

    /// Whether a mistake in a parameter, or in a section, follows from what could not be read.
    bool follows_from(const std::string &path, const std::vector<std::string> &not_read)
    {
      return !path.empty() && std::any_of(not_read.begin(), not_read.end(), [&](const std::string &other) {
        return starts_with(path, other) || starts_with(other, path + "/");
      });
    }

    /// Whether the mistake in a value of a named material is that of the whole body, from which it has the
    /// value.
    bool is_inherited(const std::string &path, const ParameterFile &file, const InputErrorCollector &mistakes)
    {
      const std::size_t first = path.find('/'), last = path.rfind('/');
      if (first == last || file.gives(path))
        return false;
      const std::string of_body = path.substr(0, first) + path.substr(last);
      return std::any_of(mistakes.list().begin(), mistakes.list().end(), [&](const InputError &error) {
        return error.parameter() == of_body;
      });
    }

    /// Parameters with only one of a list of conditions, loads or the like.
    template <typename Parameters, typename Text>
    Parameters only(std::vector<Text> Parameters::*list, const Text &text, Parameters result = Parameters())
    {
      (result.*list).push_back(text);
      return result;
    }

    /// Reads formulas of the components that a scene has.
    template <int dim>
    void read_formulas(const std::array<std::string, 3> &formulas,
                       const std::string                &prefix,
                       const Tables                     &tables,
                       InputErrorCollector              &mistakes)
    {
      const char *const axes[] = {"x", "y", "z"};
      for (int d = 0; d < dim; ++d)
        mistakes.collect([&] { SpaceTimeFunction<dim>(formulas[d], prefix + axes[d], tables); });
    }

    /// Constants without which there is no material: what they default to is nobody's.
    void ask_for_constants(const ParameterFile &file, SceneParameters &scene, InputErrorCollector &mistakes)
    {
      struct Constant
      {
        std::string name, problem, allowed;
        bool        is_needed;
      };
      const auto look = [&](const std::string &section, const MaterialProperties &properties) {
        const bool              isotropic = properties.symmetry.is_isotropic();
        std::vector<Constant>   constants = {{"Young modulus",
                                              "the scene gives no Young's modulus",
                                              "a number > 0 [Pa], such as 210e9 for steel",
                                              isotropic},
                                             {"Poisson ratio",
                                              "the scene gives no Poisson's ratio",
                                              "a number between -1 and 0.5, such as 0.3 for steel",
                                              isotropic && !scene.model.model->poisson_ratio},
                                             {"Density",
                                              "the scene gives no density, and inertia or gravity needs it",
                                              "a number > 0 [kg/m^3], such as 7850 for steel",
                                              scene.solver.is_dynamic() || !scene.loads.gravity.empty()}};
        std::vector<InputError> missing;
        for (const Constant &constant : constants)
          if (constant.is_needed && !file.gives(section + "/" + constant.name) &&
              !file.gives("Material/" + constant.name))
            missing.push_back(InputError(constant.problem)
                                .parameter(section + "/" + constant.name)
                                .allowed(constant.allowed));
        return missing;
      };
      std::vector<InputError> missing = look("Material", scene.material.body);
      scene.material.body_is_given    = missing.empty();
      if (!scene.material.groups.empty())
        missing.clear();
      for (const auto &group : scene.material.groups)
        for (const InputError &error : look("Material/" + group.first, group.second))
          missing.push_back(error);
      for (const InputError &error : missing)
        mistakes.add(error);
    }

    /// Reads texts that are formulas or points, to find those that are not.
    template <int dim>
    void read_texts(const SceneParameters &scene, InputErrorCollector &mistakes)
    {
      LoadParameters none;
      none.tables.tables = scene.loads.tables.tables;
      for (const auto &text : scene.loads.conditions)
        mistakes.collect([&] { Loads<dim>(only(&LoadParameters::conditions, text, none)); });
      for (const auto &text : scene.loads.point_loads)
        mistakes.collect([&] { Loads<dim>(only(&LoadParameters::point_loads, text, none)); });
      LoadParameters body = none;
      body.body_force     = scene.loads.body_force;
      body.gravity        = scene.loads.gravity;
      body.temperature    = scene.loads.temperature;
      mistakes.collect([&] { Loads<dim>{body}; });
      read_formulas<dim>(scene.initial.displacement, "Initial conditions/u_", Tables(), mistakes);
      read_formulas<dim>(scene.initial.velocity, "Initial conditions/v_", Tables(), mistakes);
      read_formulas<dim>(scene.comparison.exact, "Comparison/Exact u_", Tables(), mistakes);
      for (const auto &text : scene.gauges.gauges)
        mistakes.collect([&] { read_gauges<dim>(only(&GaugeParameters::gauges, text)); });
      for (const auto &probe : scene.probes.probes)
        mistakes.collect([&] { read_point<dim>(probe.point, "Probes/" + probe.name + "/Point"); });
      for (const auto &text : scene.areal_forces.points)
        mistakes.collect([&] { read_areal_force_points<dim>(only(&ArealForceParameters::points, text)); });
    }

    void check_fields(const std::vector<std::string> &fields,
                      const std::string              &parameter,
                      InputErrorCollector            &mistakes)
    {
      const auto known = output_field_names();
      for (const std::string &field : fields)
        if (std::find(known.begin(), known.end(), field) == known.end())
          mistakes.add(InputError("unknown field")
                         .parameter(parameter)
                         .given(field)
                         .allowed(join_choices(known))
                         .nearest(nearest_name(field, known)));
    }

    /// Looks at each section by itself.
    void check_values(const SceneParameters &scene, InputErrorCollector &mistakes)
    {
      mistakes.collect([&] { scene.mesh.check(); });
      mistakes.collect([&] { scene.nodes.check(); });
      mistakes.collect([&] { scene.quadrature.check(); });
      mistakes.collect([&] { scene.material.check(scene.dimension); });
      mistakes.collect([&] { scene.solver.check(); });
      mistakes.collect([&] { scene.cracks.check(); });
      mistakes.collect([&] { scene.contact.check(); });
      mistakes.collect([&] { scene.pictures.check(); });
      if (scene.dimension == 2)
        read_texts<2>(scene, mistakes);
      else
        read_texts<3>(scene, mistakes);
      check_fields(dealii::Utilities::split_string_list(scene.fields, ','), "Output/Fields", mistakes);
      check_fields(scene.pictures.field_names(), "Output/Pictures", mistakes);
      for (const ProbeText &probe : scene.probes.probes)
        check_fields(probe.field_names(), "Probes/" + probe.name + "/Fields", mistakes);
    }

    /// What a treatment means for displacements and tractions.
    void resolve_treatments(LoadParameters &loads, const bool is_consistent)
    {
      using Displacement = DisplacementTreatment;
      using Traction     = TractionTreatment;
      // The consistent form has treatments of its own.
      const Treatment treatment = is_consistent ? Treatment::automatic : loads.treatment;
      const auto      choose    = [&](const Displacement displacement, const Traction traction) {
        if (loads.traction_treatment == Traction::automatic)
          loads.traction_treatment = traction;
        if (loads.displacement_treatment == Displacement::automatic)
          loads.displacement_treatment = displacement;
      };
      switch (treatment)
        {
        case Treatment::layer:
          return choose(Displacement::layer, Traction::layer);
        case Treatment::published:
          return choose(Displacement::surface_nodes, Traction::published_transfer);
        case Treatment::balanced:
          return choose(Displacement::surface_nodes, Traction::transfer);
        case Treatment::taylor_ghosts:
          return choose(Displacement::taylor_ghosts, Traction::taylor_ghosts);
        case Treatment::automatic:
          if (is_consistent)
            choose(Displacement::face_value, Traction::face_value);
          else
            choose(loads.has_taylor_extension() ? Displacement::taylor_ghosts : Displacement::layer,
                   Traction::layer);
        }
    }

    /// Puts what serves the scene best in the place of "automatic".
    void choose(SceneParameters &scene)
    {
      using Use            = ModelParameters::Use;
      const bool by_stress = scene.material.has_criterion() && scene.material.softens();
      scene.model.resolve(scene.dimension,
                          can_break(scene)                ? by_stress ? Use::stress_onset : Use::failure :
                          scene.solver.is_linear_static() ? Use::statics :
                                                            Use::motion,
                          scene.solver.is_dynamic());
      if (scene.model.stretch_formula == StretchFormula::automatic)
        scene.model.stretch_formula = scene.material.softens() || scene.material.has_fracture_energies() ?
                                        StretchFormula::bonds :
                                        StretchFormula::published;
      resolve_treatments(scene.loads, scene.model.is_consistent());
      scene.loads.has_small_rotations = scene.solver.is_linear_static();
      if (const double own = scene.model.form_traits().defaults.horizon_factor;
          own > 0 && !has_fracture_zone(scene))
        scene.nodes.horizon_factor = own;
      if (scene.mesh.refine_layers == 0)
        scene.mesh.refine_layers = layers_between_sizes(scene.nodes.horizon_factor);
      // The consistent form leaves the choice to the mesh, unless it has families besides.
      if (scene.nodes.horizon_shape == HorizonShape::automatic &&
          (!scene.model.is_consistent() || has_fracture_zone(scene)))
        scene.nodes.horizon_shape = HorizonShape::sphere;
    }
  } // namespace

  void resolve(SceneParameters &scene)
  {
    SceneParameters asked = scene;
    choose(scene);
    if (asked.model.form == scene.model.form || !scene.model.is_consistent() || !can_break(scene))
      return;
    // What the scene asks for besides may be nothing that the consistent form has.
    const std::vector<std::string> refused = refusals(scene);
    if (refused.empty())
      return;
    asked.model.form = scene.model.model->default_forms.otherwise;
    choose(asked);
    if (refusals(asked).size() >= refused.size())
      return;
    asked.warnings.push_back("Material/Form = automatic is " + asked.model.form +
                             " here, for consistent is not possible: " + refused.front());
    scene = asked;
  }

  void read_scene(const ParameterFile &file, dealii::ParameterHandler &prm, SceneParameters &scene)
  {
    scene.declare(prm, file);
    InputErrorCollector errors, mistakes;
    const auto          not_read = file.apply(prm, errors);
    scene.loads.tables.read(file.directory(), mistakes);
    check_values(scene, mistakes);
    resolve(scene);
    // What is missing may stand in a line that was not understood.
    if (std::all_of(errors.list().begin(), errors.list().end(), [](const InputError &error) {
          return !error.parameter().empty();
        }))
      ask_for_constants(file, scene, mistakes);
    const auto warned = apply_rules(scene, changed_parameters(prm), not_read, mistakes);
    scene.warnings.insert(scene.warnings.end(), warned.begin(), warned.end());
    for (const InputError &mistake : mistakes.list())
      if (!follows_from(mistake.parameter(), not_read) && !is_inherited(mistake.parameter(), file, mistakes))
        errors.add(file.locate(mistake));
    errors.raise();
  }
} // namespace perideal
