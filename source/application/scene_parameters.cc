// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/output_fields.h>
#include <perideal/application/scene_parameters.h>
#include <perideal/base/registry.h>

#include <deal.II/base/utilities.h>

#include <boost/property_tree/json_parser.hpp>

#include <algorithm>
#include <ostream>
#include <sstream>

namespace perideal
{
  void ComparisonParameters::declare(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Comparison");
    prm.add_parameter("FEM", fem, "Solve with Q1 finite elements on the same mesh and compare", Bool());
    prm.add_parameter("Reference",
                      reference,
                      "Solve with Q2 finite elements on the refined mesh and compare with that as converged",
                      Bool());
    prm.add_parameter("Reference refinements",
                      reference_refinements,
                      "Refinements of the mesh for the reference; 0 is Q2 on the mesh itself, -1 on the "
                      "mesh with one of its Mesh/Refinements less, for bodies that leave no room for more",
                      Integer(-1, 4));
    prm.add_parameter(
      "Reference mesh",
      reference_mesh,
      "Gmsh file of the same body, with the same names of boundaries and materials, on which the "
      "reference is solved; empty: the mesh of the scene. It shows what a mesh makes of the body's "
      "shape",
      Anything());
    prm.add_parameter("Profiles",
                      profiles,
                      "Boundaries (physical names or ids) along which displacements are written to "
                      "profile_NAME.csv and compared",
                      List(Anything(), 0, List::max_int_value, ","));
    const char *axes[] = {"x", "y", "z"};
    for (unsigned int d = 0; d < 3; ++d)
      prm.add_parameter(std::string("Exact u_") + axes[d],
                        exact[d],
                        std::string("Exact displacement along ") + axes[d] +
                          " [m], a formula in x, y, z, t; empty: not known");
    prm.leave_subsection();
  }

  void InitialParameters::declare(dealii::ParameterHandler &prm)
  {
    const char *axes[] = {"x", "y", "z"};
    prm.enter_subsection("Initial conditions");
    for (unsigned int d = 0; d < 3; ++d)
      prm.add_parameter(std::string("v_") + axes[d],
                        velocity[d],
                        std::string("Velocity at t = 0 along ") + axes[d] +
                          " [m/s], a formula in x, y, z, in dynamics; empty: at rest");
    prm.leave_subsection();
  }

  void CheckpointParameters::declare(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Checkpoints");
    prm.add_parameter("Steps",
                      steps,
                      "Steps of dynamics between two checkpoints, from which a run that was stopped goes on; "
                      "0: only when the program is asked to stop (SIGTERM, SIGINT)",
                      Integer(0));
    prm.add_parameter(
      "Restart",
      restart,
      "Go on from the last checkpoint in Output directory; any number of ranks may do so, and "
      "Solver/End time and the section Output may change",
      Bool());
    prm.leave_subsection();
  }

  void SceneParameters::declare(dealii::ParameterHandler &prm, const ParameterFile &file)
  {
    using namespace dealii::Patterns;
    prm.add_parameter("Dimension", dimension, "Dimensions of space", dealii::Patterns::Integer(2, 3));
    prm.add_parameter("Output directory",
                      output_directory,
                      "Directory for the results, from the current directory; created when missing");
    mesh.declare(prm);
    nodes.declare(prm);
    quadrature.declare(prm);
    model.declare(prm);
    material.declare(prm, file);
    solver.declare(prm);
    loads.declare(prm, file);
    initial.declare(prm);
    precracks.declare(prm, file);
    no_fail.declare(prm, file);
    cracks.declare(prm, file);
    checkpoints.declare(prm);
    contact.declare(prm);
    comparison.declare(prm);
    prm.enter_subsection("Output");
    prm.add_parameter(
      "Fields",
      fields,
      "Fields in solution.vtu, separated by commas: " + join_choices(output_field_names()) +
        ". family status adds up 1: fallback weights, 2: a moment condition missed, 4: negative "
        "deviatoric weights met");
    prm.add_parameter(
      "Boundary stress",
      boundary_stress,
      "Boundaries (physical names or ids) whose stresses, recovered at each face, are written to "
      "stress_NAME.csv, with the extremes in summary.json",
      List(Anything(), 0, List::max_int_value, ","));
    prm.add_parameter("Frames", frames, "Field files that dynamics leave, at equal times", Integer(1));
    prm.add_parameter(
      "History steps", history_steps, "Steps between two rows of the history of dynamics", Integer(1));
    prm.add_parameter("Nominal stress",
                      nominal_stress,
                      "Stress [Pa] that the largest principal stress of each of these boundaries is divided "
                      "by: their concentration; 0: none",
                      Double(0));
    prm.leave_subsection();
  }

  void SceneParameters::read(const ParameterFile &file, dealii::ParameterHandler &prm)
  {
    declare(prm, file);
    file.apply(prm);
    nodes.check();
    material.check(dimension);
    solver.check();
    cracks.check();
    contact.check();
    resolve();
    if (comparison.reference_refinements < 0 && mesh.refinements == 0)
      throw InputError("the mesh of the reference cannot be coarser than one that was not refined")
        .parameter("Comparison/Reference refinements")
        .allowed("0 to 4, or -1 where Mesh/Refinements is 1 or more");
    if (!comparison.reference_mesh.empty() && comparison.reference_refinements < 0)
      throw InputError("a mesh of its own for the reference is not refined before")
        .parameter("Comparison/Reference refinements")
        .allowed("0 to 4 with a Reference mesh");
    if (!comparison.reference_mesh.empty() && !comparison.reference &&
        loads.displacement_treatment != "reference")
      throw InputError("a mesh is given for a reference that is not asked for")
        .parameter("Comparison/Reference mesh")
        .hint("set Comparison/Reference = true, or remove it");
    for (const std::string &field : field_names())
      {
        const auto known = output_field_names();
        if (std::find(known.begin(), known.end(), field) == known.end())
          throw InputError("unknown field")
            .parameter("Output/Fields")
            .given(field)
            .allowed(join_choices(known))
            .nearest(nearest_name(field, known));
      }
  }

  void SceneParameters::resolve()
  {
    model.resolve(dimension,
                  solver.is_dynamic() || solver.is_relaxation() ? ModelParameters::Use::motion :
                                                                  ModelParameters::Use::statics);
    if (solver.is_dynamic())
      check_dynamics();
    else if (solver.is_relaxation())
      check_relaxation();
    else
      check_statics();
    const auto check_symmetry = [this](const MaterialProperties &properties) {
      if (!properties.symmetry.is_isotropic() && !model.is_tensor_involved())
        throw InputError("this model is one of isotropic materials")
          .parameter(properties.symmetry.section + "/Symmetry")
          .given(properties.symmetry.name)
          .allowed("isotropic; or set Material/Model = tensor involved");
    };
    check_symmetry(material.body);
    for (const auto &group : material.groups)
      check_symmetry(group.second);
    const bool   consistent = model.is_consistent();
    std::string &treatment  = loads.displacement_treatment;
    if (treatment == "automatic")
      treatment = consistent ? "face value" : "layer";
    if (treatment == "face value" && !consistent)
      throw InputError("only the consistent form reads values at faces")
        .parameter("Boundary conditions/Displacement treatment")
        .given(treatment)
        .allowed("automatic | layer | reference | mirror for this model")
        .hint("or set Material/Form = consistent");
    if (loads.layers > 1 && treatment != "layer" && treatment != "reference")
      throw InputError("this treatment holds no nodes, of which there could be more layers")
        .parameter("Boundary conditions/Layers")
        .given(std::to_string(loads.layers))
        .allowed("1 for Displacement treatment = " + treatment)
        .hint("set Boundary conditions/Displacement treatment = layer");
    // The consistent form leaves the choice to the mesh.
    if (nodes.horizon_shape == "automatic" && !consistent)
      nodes.horizon_shape = "sphere";
    if (nodes.horizon_shape == "cell" && !consistent)
      throw InputError("the weights of this model are those of spheres")
        .parameter("Nodes/Horizon shape")
        .given(nodes.horizon_shape)
        .allowed("automatic | sphere; or set Material/Form = consistent");
    if (quadrature.counts_parts() && consistent)
      throw InputError(
        "the bonds of the consistent form only stabilise it, for which their whole volumes serve")
        .parameter("Quadrature/Scheme")
        .given(quadrature.scheme)
        .allowed("one point; or set Material/Form = energy | paper, or another Material/Model");
    if (treatment == "mirror" && consistent)
      throw InputError("mirrored nodes have no cells, which the consistent form needs")
        .parameter("Boundary conditions/Displacement treatment")
        .given(treatment)
        .allowed("automatic | face value | layer | reference for the consistent form");
  }

  void SceneParameters::check_dynamics() const
  {
    if (model.is_linear_only())
      throw InputError("this form is one of linear statics")
        .parameter("Material/Form")
        .given(model.form)
        .allowed("automatic | " + join_choices(model.forms_of_motion()) + " in dynamics");
    const std::string &treatment = loads.displacement_treatment;
    if (treatment != "automatic" && treatment != "layer")
      throw InputError("dynamics hold the nodes at a boundary")
        .parameter("Boundary conditions/Displacement treatment")
        .given(treatment)
        .allowed("automatic | layer in dynamics");
    if (comparison.fem || comparison.reference)
      throw InputError("the finite elements that dynamics would be compared with are static")
        .parameter(comparison.fem ? "Comparison/FEM" : "Comparison/Reference")
        .hint("set it to false");
    if (!boundary_stress.empty())
      throw InputError("boundary stresses are those of statics").parameter("Output/Boundary stress");
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
    if (checkpoints.steps > 0)
      complain("Checkpoints/Steps");
    if (checkpoints.restart)
      complain("Checkpoints/Restart");
    if (model.recomputes())
      complain("Material/Multipliers");
  }

  void SceneParameters::check_relaxation() const
  {
    if (model.is_linear_only())
      throw InputError("this form is one of linear statics")
        .parameter("Material/Form")
        .given(model.form)
        .allowed("automatic | " + join_choices(model.forms_of_motion()) + " in dynamic relaxation");
    const std::string &treatment = loads.displacement_treatment;
    if (treatment != "automatic" && treatment != "layer")
      throw InputError("dynamic relaxation holds the nodes at a boundary")
        .parameter("Boundary conditions/Displacement treatment")
        .given(treatment)
        .allowed("automatic | layer in dynamic relaxation");
    check_no_motion();
    for (const std::string &field : field_names())
      if (field == "velocity")
        throw InputError("this field belongs to dynamics")
          .parameter("Output/Fields")
          .given(field)
          .hint("remove it, or set Solver/Name = dynamics");
    if ((comparison.fem || comparison.reference) && !precracks.cracks.empty())
      throw InputError("the finite elements that the solution would be compared with have no cracks")
        .parameter(comparison.fem ? "Comparison/FEM" : "Comparison/Reference")
        .hint("set it to false, or remove the section Precracks");
  }

  void SceneParameters::check_statics() const
  {
    const auto complain = [](const std::string &parameter) {
      throw InputError("this belongs to dynamics and dynamic relaxation")
        .parameter(parameter)
        .hint("set Solver/Name = dynamics, or = dynamic relaxation");
    };
    check_no_motion();
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
    if (contact.enabled == "true")
      complain("Contact/Enabled");
    if (solver.relative_damping > 0)
      complain("Solver/Relative damping");
  }

  std::vector<std::string> SceneParameters::field_names() const
  {
    return dealii::Utilities::split_string_list(fields, ',');
  }

  namespace
  {
    /// One table row a parameter, one heading a section.
    void
    print_markdown(std::ostream &out, const boost::property_tree::ptree &section, const std::string &path)
    {
      const auto is_parameter = [](const auto &entry) {
        return entry.second.find("pattern_description") != entry.second.not_found();
      };
      const auto cell = [](std::string text) {
        for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
          text.insert(at, "\\");
        return text;
      };
      out << "## " << (path.empty() ? "Top of the file" : path) << "\n\n"
          << "| parameter | default | allowed | meaning |\n|---|---|---|---|\n";
      for (const auto &entry : section)
        if (is_parameter(entry))
          out << "| `" << entry.first << "` | " << cell(entry.second.get<std::string>("default_value"))
              << " | " << cell(entry.second.get<std::string>("pattern_description")) << " | "
              << cell(entry.second.get<std::string>("documentation")) << " |\n";
      out << '\n';
      for (const auto &entry : section)
        if (!is_parameter(entry))
          print_markdown(out, entry.second, path.empty() ? entry.first : path + "/" + entry.first);
    }
  } // namespace

  void print_parameters(std::ostream &out, const std::string &format)
  {
    // Sections that the user names appear once, under a name that says so.
    const ParameterFile file =
      ParameterFile::parse("subsection Material\n subsection PHYSICAL GROUP\n end\nend\n"
                           "subsection Boundary conditions\n"
                           " subsection ANY NAME\n end\nend\n"
                           "subsection Point loads\n subsection ANY NAME\n end\nend\n"
                           "subsection Precracks\n subsection ANY NAME\n end\nend\n"
                           "subsection No-fail zones\n subsection ANY NAME\n end\nend\n"
                           "subsection Cracks\n subsection ANY NAME\n end\nend\n",
                           "");
    SceneParameters          scene;
    dealii::ParameterHandler prm;
    scene.declare(prm, file);
    if (format == "text")
      prm.print_parameters(
        out, dealii::ParameterHandler::Description | dealii::ParameterHandler::KeepDeclarationOrder);
    else if (format == "prm")
      prm.print_parameters(out,
                           dealii::ParameterHandler::PRM | dealii::ParameterHandler::KeepDeclarationOrder);
    else if (format == "markdown")
      {
        std::stringstream json;
        prm.print_parameters(json,
                             dealii::ParameterHandler::JSON | dealii::ParameterHandler::KeepDeclarationOrder);
        boost::property_tree::ptree tree;
        boost::property_tree::read_json(json, tree);
        print_markdown(out, tree, "");
      }
    else
      throw InputError("unknown format of --parameters").given(format).allowed("text | prm | markdown");
  }
} // namespace perideal
