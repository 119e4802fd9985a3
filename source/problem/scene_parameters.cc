// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/registry.h>
#include <perideal/parameters/named_texts.h>
#include <perideal/problem/output_fields.h>
#include <perideal/problem/scene_parameters.h>

#include <deal.II/base/utilities.h>

#include <algorithm>

namespace perideal
{
  void ComparisonParameters::declare(dealii::ParameterHandler &prm, const ParameterFile &file)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Comparison");
    prm.add_parameter("FEM",
                      fem,
                      "Solve with finite elements on the same mesh and compare; of the same law along the "
                      "same load steps, where quasi static has Material/Model = correspondence, else linear",
                      Bool());
    prm.add_parameter("FEM degree", fem_degree, "Degree of these elements: Q1 or Q2 [-]", Integer(1, 2));
    prm.add_parameter("Reference",
                      reference,
                      "Solve with Q2 finite elements on the refined mesh and compare with that as converged",
                      Bool());
    prm.add_parameter("Reference refinements",
                      reference_refinements,
                      "Refinements of the mesh for the reference; 0 is Q2 on the mesh itself, -1 on the "
                      "mesh with one of its Mesh/Refinements less, for bodies that leave no room for more",
                      Integer(-1, 4));
    prm.add_parameter("Stiffness",
                      stiffness,
                      "Of what the finite elements are made: material: of the material; families: of a solid "
                      "as stiff as whole "
                      "families are by their quadrature, which shows what boundary conditions alone are off "
                      "by (one material, "
                      "regular meshes)");
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
                          " [m], a formula in x, y, z, t, compared at the end of the run; empty: not known");
    lines = named_texts<LineText>(file, "Comparison");
    for (LineText &line : lines)
      {
        prm.enter_subsection(line.name);
        prm.add_parameter("From", line.from, "Where a line through the body begins: coordinates [m]");
        prm.add_parameter(
          "To",
          line.to,
          "Where it ends: coordinates [m]. Along it displacements are written to "
          "profile_NAME.csv and compared, by node; and displacement, strain and stress, those of "
          "the finite elements beside them, to line_NAME.csv, interpolated");
        prm.add_parameter(
          "Points",
          line.points,
          "Points of line_NAME.csv, evenly from one end to the other; those outside the body are "
          "left out",
          Integer(2));
        prm.leave_subsection();
      }
    prm.leave_subsection();
  }

  void InitialParameters::declare(dealii::ParameterHandler &prm)
  {
    const char *axes[] = {"x", "y", "z"};
    prm.enter_subsection("Initial conditions");
    for (unsigned int d = 0; d < 3; ++d)
      prm.add_parameter(std::string("u_") + axes[d],
                        displacement[d],
                        std::string("Displacement at t = 0 along ") + axes[d] +
                          " [m], a formula in x, y, z, in dynamics; held boundaries start where their "
                          "conditions are at t = 0; empty: none");
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
                      "Steps of dynamics, or load steps of quasi static and dynamic relaxation, between two "
                      "checkpoints, from which a stopped run continues; 0: only when the program is "
                      "asked to stop (SIGTERM, SIGINT), which it does after the step",
                      Integer(0));
    prm.add_parameter(
      "At end",
      at_end,
      "Leave a checkpoint at the end too, from which a run with a later Solver/End time or Last "
      "load step goes on",
      Bool());
    prm.add_parameter(
      "Restart",
      restart,
      "Continue from the last checkpoint in Output directory; any number of ranks may do so, and "
      "Solver/End time, Solver/Last load step and the section Output may change",
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
    adaptation.declare(prm);
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
    comparison.declare(prm, file);
    areal_forces.declare(prm, file);
    gauges.declare(prm, file);
    probes.declare(prm, file);
    prm.enter_subsection("Output");
    prm.add_parameter(
      "Fields",
      fields,
      "Fields in solution.vtu, separated by commas: " + join_choices(output_field_names()) +
        ". family status adds up 1: fallback weights, 2: a moment condition missed, 4: negative "
        "deviatoric weights met. displacement is at the points of the mesh, two at each vertex that a crack "
        "runs "
        "through, all others of cells");
    prm.add_parameter(
      "Format",
      format,
      "vtu: one file with the cells of all ranks; pvtu: a file for the cells of each rank and one "
      "that lists them, for meshes that are large for one process");
    prm.add_parameter(
      "Boundary stress",
      boundary_stress,
      "Boundaries (physical names or ids) whose stresses, recovered at each face, are written to "
      "stress_NAME.csv, with the extremes in summary.json",
      List(Anything(), 0, List::max_int_value, ","));
    prm.add_parameter(
      "Frame steps",
      frame_steps,
      "Load steps that leave field files: one number n, every n-th; several, separated by commas, "
      "these; empty: all. The last load step leaves one in any case",
      List(Integer(1), 0, List::max_int_value, ","));
    prm.add_parameter("Frames", frames, "Field files that dynamics leave, at equal times", Integer(1));
    prm.add_parameter(
      "History steps", history_steps, "Steps between two rows of the history of dynamics", Integer(1));
    prm.add_parameter("Nominal stress",
                      nominal_stress,
                      "Stress [Pa] that the largest principal stress of each of these boundaries is divided "
                      "by: their concentration; 0: none",
                      Double(0));
    prm.leave_subsection();
    pictures.declare(prm);
  }

  std::vector<std::string> SceneParameters::field_names() const
  {
    std::vector<std::string> names = dealii::Utilities::split_string_list(fields, ',');
    for (const std::string &name : pictures.field_names())
      if (std::find(names.begin(), names.end(), name) == names.end())
        names.push_back(name);
    return names;
  }

  bool SceneParameters::has_frame(const std::uint64_t step) const
  {
    if (frame_steps.size() == 1)
      return step % frame_steps[0] == 0;
    return frame_steps.empty() ||
           std::find(frame_steps.begin(), frame_steps.end(), step) != frame_steps.end();
  }

  std::vector<std::string> SceneParameters::all_field_names() const
  {
    std::vector<std::string> result = field_names();
    for (const ProbeText &probe : probes.probes)
      for (const std::string &name : probe.field_names())
        result.push_back(name);
    return result;
  }

  bool can_break(const SceneParameters &parameters)
  {
    const auto breaks = [](const MaterialProperties &m) {
      return m.mean_fracture_energy() > 0 || m.critical_stretch > 0 || m.tensile_strength > 0;
    };
    return (parameters.solver.is_dynamic() || parameters.solver.is_nonlinear_static()) &&
           (breaks(parameters.material.body) ||
            std::any_of(parameters.material.groups.begin(),
                        parameters.material.groups.end(),
                        [&](const auto &group) { return breaks(group.second); }));
  }

  bool has_fracture_zone(const SceneParameters &parameters)
  {
    return parameters.model.is_consistent() && can_break(parameters);
  }

  bool has_contact(const SceneParameters &parameters)
  {
    if (parameters.contact.enabled == ContactChoice::automatic)
      return can_break(parameters) || !parameters.precracks.cracks.empty();
    return parameters.contact.enabled == ContactChoice::yes;
  }
} // namespace perideal
