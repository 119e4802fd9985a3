// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/registry.h>
#include <perideal/problem/scene_parameters.h>

// SceneParameters: what goes together.

namespace perideal
{
  void SceneParameters::resolve()
  {
    const bool breaks = material.has_criterion() || !precracks.cracks.empty();
    model.resolve(dimension,
                  breaks                                              ? ModelParameters::Use::failure :
                  solver.is_dynamic() || solver.is_nonlinear_static() ? ModelParameters::Use::motion :
                                                                        ModelParameters::Use::statics);
    resolve_treatment();
    check_surface_nodes();
    if (solver.is_dynamic())
      check_dynamics();
    else if (solver.is_nonlinear_static())
      check_nonlinear_statics();
    else
      check_statics();
    check_correspondence();
    check_areal_forces();
    const auto check_symmetry = [this](const MaterialProperties &properties) {
      if (!properties.symmetry.is_isotropic() && !model.takes_any_symmetry())
        throw InputError("this model is one of isotropic materials")
          .parameter(properties.symmetry.section + "/Symmetry")
          .given(name_of(properties.symmetry.name))
          .allowed("isotropic; or set Material/Model = tensor involved | correspondence");
    };
    check_failure();
    check_symmetry(material.body);
    for (const auto &group : material.groups)
      check_symmetry(group.second);
    const bool             consistent = model.is_consistent();
    DisplacementTreatment &treatment  = loads.displacement_treatment;
    using Displacement                = DisplacementTreatment;
    if (treatment == Displacement::automatic)
      treatment = consistent                   ? Displacement::face_value :
                  loads.has_taylor_extension() ? Displacement::taylor_ghosts :
                                                 Displacement::layer;
    if (treatment == Displacement::face_value && !consistent)
      throw InputError("only the consistent form reads values at faces")
        .parameter("Boundary conditions/Displacement treatment")
        .given(name_of(treatment))
        .allowed("automatic | layer | reference | mirror for this model")
        .hint("or set Material/Form = consistent");
    if (loads.layers > 1 && !loads.holds_layer())
      throw InputError("this treatment holds no nodes, of which there could be more layers")
        .parameter("Boundary conditions/Layers")
        .given(std::to_string(loads.layers))
        .allowed("1 for Displacement treatment = " + name_of(treatment))
        .hint("set Boundary conditions/Displacement treatment = layer");
    // The consistent form leaves the choice to the mesh.
    if (nodes.horizon_shape == HorizonShape::automatic && !consistent)
      nodes.horizon_shape = HorizonShape::sphere;
    if (nodes.horizon_shape == HorizonShape::cell && !consistent)
      throw InputError("the weights of this model are those of spheres")
        .parameter("Nodes/Horizon shape")
        .given(name_of(nodes.horizon_shape))
        .allowed("automatic | sphere; or set Material/Form = consistent");
    if (quadrature.counts_parts() && consistent)
      throw InputError(
        "the bonds of the consistent form only stabilise it, for which their whole volumes serve")
        .parameter("Quadrature/Scheme")
        .given(name_of(quadrature.scheme))
        .allowed("one point; or set Material/Form = energy | paper, or another Material/Model");
    if (loads.has_mirror() && quadrature.needs_cells())
      throw InputError("mirrored nodes have no cells, of which this scheme counts the parts")
        .parameter("Quadrature/Scheme")
        .given(name_of(quadrature.scheme))
        .allowed("one point | cubic cell | partial volume with Displacement treatment = mirror");
    if (loads.has_mirror() && consistent)
      throw InputError("mirrored nodes have no cells, which the consistent form needs")
        .parameter("Boundary conditions/Displacement treatment")
        .given(name_of(treatment))
        .allowed("automatic | face value | layer | reference for the consistent form");
    check_quadrature();
    resolve_tractions();
    check_ghosts();
  }

  void SceneParameters::check_failure() const
  {
    const bool by_stress = !model.model->critical_stretch;
    if (material.has_criterion() && !by_stress)
      throw InputError("the bonds of this model break by stretch")
        .parameter("Material/Failure criterion")
        .given(name_of(material.failure_criterion))
        .allowed("none for Model = " + model.model->name)
        .hint("set Material/Fracture energy or Critical stretch");
    const auto check = [&](const MaterialProperties &properties, const std::string &section) {
      if (by_stress && (properties.fracture_energy > 0 || properties.critical_stretch > 0))
        throw InputError("the bonds of this model break by stress")
          .parameter(section + (properties.fracture_energy > 0 ? "/Fracture energy" : "/Critical stretch"))
          .allowed("0 for Model = correspondence")
          .hint("set Material/Failure criterion and Tensile strength");
    };
    check(material.body, "Material");
    for (const auto &group : material.groups)
      check(group.second, "Material/" + group.first);
  }

  void SceneParameters::check_quadrature() const
  {
    if (model.compensation_of_a_bond != CompensationOfABond::mean && !quadrature.has_gauss_points())
      throw InputError("bonds whose ends oppose each other have one factor")
        .parameter("Material/Compensation of a bond")
        .given(name_of(model.compensation_of_a_bond))
        .allowed("mean; or set Quadrature/Scheme = gauss points");
    if (model.compensates() && loads.has_mirror())
      throw InputError("bonds to mirrored nodes are not missing")
        .parameter("Material/Boundary compensation")
        .given(name_of(model.boundary_compensation))
        .allowed("none with Displacement treatment = mirror");
    if (nodes.perturbation > 0 && quadrature.needs_squares())
      throw InputError("this scheme takes cells for squares or cubes about their nodes, which are elsewhere")
        .parameter("Quadrature/Scheme")
        .given(name_of(quadrature.scheme))
        .allowed("one point | adaptive | exact | gauss points with Nodes/Perturbation");
    if (!quadrature.has_gauss_points())
      return;
    const auto complain = [this](const std::string &what) {
      throw InputError("Gauss points serve springs in statics only, " + what)
        .parameter("Quadrature/Scheme")
        .given(name_of(quadrature.scheme))
        .hint("choose another scheme");
    };
    if (!model.model->has_one_micromodulus)
      complain("not Material/Model = " + model.model->name);
    if (solver.is_dynamic() || solver.is_nonlinear_static())
      complain("not Solver/Name = " + name_of(solver.name));
    if (loads.has_mirror())
      complain("and mirrored nodes have no cells");
  }

  void SceneParameters::resolve_tractions()
  {
    TractionTreatment &treatment  = loads.traction_treatment;
    const bool         consistent = model.is_consistent();
    const auto         complain   = [&](const std::string &problem, const std::string &allowed) {
      throw InputError(problem)
        .parameter("Boundary conditions/Traction treatment")
        .given(name_of(treatment))
        .allowed(allowed);
    };
    if (consistent && treatment != TractionTreatment::automatic && treatment != TractionTreatment::face_value)
      complain("the consistent form takes tractions at faces", "automatic | face value for this form");
    if (!consistent && treatment == TractionTreatment::face_value)
      complain("only the consistent form takes tractions at faces", "automatic | layer for this model");
    if (treatment == TractionTreatment::automatic)
      treatment = consistent ? TractionTreatment::face_value : TractionTreatment::layer;
    if (loads.has_line_to_point() && (!model.model->has_one_micromodulus || dimension != 3))
      complain("the closed form is that of bond-based peridynamics in 3-D",
               "automatic | layer | taylor ghosts | transfer for this scene");
    check_transfer();
  }

  void SceneParameters::check_correspondence() const
  {
    if (!model.is_correspondence())
      return;
    if (solver.is_dynamic() || solver.is_relaxation())
      throw InputError("the correspondence model is one of statics, by tangents")
        .parameter("Solver/Name")
        .given(name_of(solver.name))
        .allowed("static | quasi static for Material/Model = correspondence");
    if (!model.law->is_linear && !solver.is_quasi_static())
      throw InputError("large strain is sought along load steps")
        .parameter("Material/Law")
        .given(model.law->name)
        .allowed("linear elastic for Solver/Name = " + name_of(solver.name))
        .hint("set Solver/Name = quasi static");
    if (quadrature.has_gauss_points())
      throw InputError("Gauss points serve springs only")
        .parameter("Quadrature/Scheme")
        .given(name_of(quadrature.scheme))
        .allowed("one point | cubic cell | partial volume for Material/Model = correspondence");
    if (model.is_consistent() && (material.has_criterion() || !precracks.cracks.empty()))
      throw InputError("the consistent form takes gradients from faces, which no crack cuts")
        .parameter("Material/Form")
        .given(model.form)
        .allowed("automatic | family with Failure criterion or Precracks");
    if (!areal_forces.points.empty())
      throw InputError("bonds of the correspondence model carry the stresses of whole families")
        .parameter("Areal force densities/" + areal_forces.points.front().name)
        .hint("remove it, or write Output/Fields = stress");
  }

  void SceneParameters::check_dynamics() const
  {
    if (model.is_linear_only())
      throw InputError("this form is one of linear statics")
        .parameter("Material/Form")
        .given(model.form)
        .allowed("automatic | " + join_choices(model.forms_of_motion()) + " in dynamics");
    const DisplacementTreatment treatment = loads.displacement_treatment;
    if (treatment != DisplacementTreatment::automatic && treatment != DisplacementTreatment::layer)
      throw InputError("dynamics hold the nodes at a boundary")
        .parameter("Boundary conditions/Displacement treatment")
        .given(name_of(treatment))
        .allowed("automatic | layer in dynamics");
    if (comparison.fem || comparison.reference)
      throw InputError("the finite elements that dynamics would be compared with are static")
        .parameter(comparison.fem ? "Comparison/FEM" : "Comparison/Reference")
        .hint("set it to false");
    if (!boundary_stress.empty())
      throw InputError("boundary stresses are those of statics").parameter("Output/Boundary stress");
  }

  void SceneParameters::check_areal_forces() const
  {
    const bool of_ends   = model.form_traits().bonds_know_only_their_ends;
    const bool not_whole = can_break(*this) || !precracks.cracks.empty();
    for (const ArealForceText &text : areal_forces.points)
      if (text.rule == ArealForceRule::line && (!of_ends || not_whole))
        throw InputError(of_ends ? "the line takes all bonds for whole, and some may not be" :
                                   "the line needs bonds that know only their own ends")
          .parameter("Areal force densities/" + text.name + "/Rule")
          .given(name_of(text.rule))
          .allowed(of_ends ?
                     "automatic | bonds where bonds are cut or break" :
                     "automatic | bonds for this model; or set Material/Model = bond based, or = tensor "
                     "involved with Form = one point");
  }

  void SceneParameters::check_no_motion() const
  {
    const auto complain = [](const std::string &parameter) {
      throw InputError("this belongs to dynamics").parameter(parameter).hint("set Solver/Name = dynamics");
    };
    const char *axes[] = {"x", "y", "z"};
    for (unsigned int d = 0; d < 3; ++d)
      {
        for (const auto &condition : loads.conditions)
          if (!condition.velocity[d].empty())
            complain("Boundary conditions/" + condition.name + "/v_" + axes[d]);
        if (!initial.velocity[d].empty())
          complain(std::string("Initial conditions/v_") + axes[d]);
      }
    if (model.recomputes())
      complain("Material/Multipliers");
  }

  void SceneParameters::check_nonlinear_statics() const
  {
    const std::string method = solver.is_quasi_static() ? "quasi static" : "dynamic relaxation";
    if (model.is_linear_only())
      throw InputError("this form is one of linear statics")
        .parameter("Material/Form")
        .given(model.form)
        .allowed("automatic | " + join_choices(model.forms_of_motion()) + " in " + method);
    const DisplacementTreatment treatment = loads.displacement_treatment;
    const bool at_faces = treatment == DisplacementTreatment::face_value && model.is_consistent();
    if (treatment != DisplacementTreatment::automatic && treatment != DisplacementTreatment::layer &&
        !at_faces && !loads.has_surface_nodes())
      throw InputError(method + " holds nodes")
        .parameter("Boundary conditions/Displacement treatment")
        .given(name_of(treatment))
        .allowed("automatic | layer | surface nodes in " + method);
    check_no_motion();
    for (const std::string &field : field_names())
      if (field == "velocity")
        throw InputError("this field belongs to dynamics")
          .parameter("Output/Fields")
          .given(field)
          .hint("remove it, or set Solver/Name = dynamics");
    if (comparison.fem_degree != 1 && model.is_correspondence())
      throw InputError("finite elements of large strain are Q1")
        .parameter("Comparison/FEM degree")
        .given(std::to_string(comparison.fem_degree))
        .allowed("1 for Material/Model = correspondence in " + method);
    if ((comparison.fem || comparison.reference) && !precracks.cracks.empty())
      throw InputError("the finite elements that the solution would be compared with have no cracks")
        .parameter(comparison.fem ? "Comparison/FEM" : "Comparison/Reference")
        .hint("set it to false, or remove the section Precracks");
  }

  void SceneParameters::check_statics() const
  {
    const auto complain = [](const std::string &parameter) {
      throw InputError("this belongs to dynamics, quasi static and dynamic relaxation")
        .parameter(parameter)
        .hint("set Solver/Name = dynamics, or = quasi static");
    };
    check_no_motion();
    if (checkpoints.steps > 0)
      complain("Checkpoints/Steps");
    if (checkpoints.restart)
      complain("Checkpoints/Restart");
    for (const std::string &field : field_names())
      if (field == "velocity" || field == "damage" || field == "precracks")
        throw InputError("this field belongs to dynamics")
          .parameter("Output/Fields")
          .given(field)
          .hint("remove it, or set Solver/Name = dynamics");
    if (!cracks.cracks.empty())
      complain("Cracks/" + cracks.cracks.front().name);
    if (!precracks.cracks.empty())
      complain("Precracks/" + precracks.cracks.front().name);
    if (!no_fail.zones.empty())
      complain("No-fail zones/" + no_fail.zones.front().name);
    if (model.after_the_cut())
      complain("Material/Multipliers");
    if (contact.enabled == ContactChoice::yes)
      complain("Contact/Enabled");
    if (solver.relative_damping > 0)
      complain("Solver/Relative damping");
  }
} // namespace perideal
