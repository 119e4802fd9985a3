// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/rules.h>

#include <algorithm>

// Rules of solvers: what is moved, kept or damped.

namespace perideal
{
  namespace
  {
    using Scene = SceneParameters;

    const char *const axes[] = {"x", "y", "z"};

    std::vector<std::string> velocities_of_conditions(const Scene &scene)
    {
      std::vector<std::string> result;
      if (!scene.solver.is_dynamic())
        for (const auto &condition : scene.loads.conditions)
          for (unsigned int d = 0; d < 3; ++d)
            if (!condition.velocity[d].empty())
              result.push_back("Boundary conditions/" + condition.name + "/v_" + axes[d]);
      return result;
    }

    std::vector<std::string> initial_conditions(const Scene &scene)
    {
      std::vector<std::string> result;
      if (!scene.solver.is_dynamic())
        for (unsigned int d = 0; d < 3; ++d)
          {
            if (!scene.initial.displacement[d].empty())
              result.push_back(std::string("Initial conditions/u_") + axes[d]);
            if (!scene.initial.velocity[d].empty())
              result.push_back(std::string("Initial conditions/v_") + axes[d]);
          }
      return result;
    }

    /// Whether the linear system of a scene is known not to be symmetric.
    bool is_unsymmetric(const Scene &scene)
    {
      return !scene.model.form_traits().follows_from_energy || scene.quadrature.has_gauss_points() ||
             scene.loads.has_taylor_extension();
    }

    bool controls_gauge(const Scene &scene)
    {
      return scene.solver.controls(LoadControlName::gauge);
    }

    /// Whether Solver/Control gauge names one gauge, or there is no more than one.
    bool knows_gauge(const Scene &scene)
    {
      const auto &gauges = scene.gauges.gauges;
      if (scene.solver.control_gauge.empty())
        return gauges.size() == 1;
      return std::any_of(gauges.begin(), gauges.end(), [&](const GaugeText &gauge) {
        return gauge.name == scene.solver.control_gauge;
      });
    }

    bool has_fracture_energy(const MaterialParameters &material)
    {
      return material.body.mean_fracture_energy() > 0 ||
             std::any_of(material.groups.begin(), material.groups.end(), [](const auto &group) {
               return group.second.mean_fracture_energy() > 0;
             });
    }

    std::vector<Rule> rules_of_control()
    {
      return {
        refuse(
          "Solver/Control gauge",
          "Solver/Control = gauge",
          [](const Scene &s) { return controls_gauge(s) && !knows_gauge(s); },
          "no gauge has this name, or it could be one of several",
          "the name of a subsection of Gauges; empty where there is one"),
        refuse(
          "Solver/Control end",
          "Solver/Control = gauge, Solver/Control end = 0",
          [](const Scene &s) { return controls_gauge(s) && !(s.solver.control_end > 0); },
          "the gauge needs an elongation at which the run ends",
          "an elongation > 0 [m]"),
        refuse(
          "Solver/Control",
          "Solver/Control = dissipated energy, Material/Softening = none",
          [](const Scene &s) {
            return s.solver.controls(LoadControlName::dissipated_energy) && !s.material.softens();
          },
          "bonds that break at once dissipate by leaps, which cannot be prescribed",
          "loads | gauge without Material/Softening",
          "set Material/Softening = linear"),
        refuse(
          "Solver/Control step",
          "Solver/Control = dissipated energy, Material/Critical stretch",
          [](const Scene &s) {
            return s.solver.controls(LoadControlName::dissipated_energy) && s.solver.control_step == 0 &&
                   !has_fracture_energy(s.material);
          },
          "without a fracture energy the step has no value by itself",
          "an energy > 0 [J]"),
      };
    }

    /// Whether the body is held together by bonds along themselves, weighed once.
    bool has_families_of_bonds(const ModelParameters &model)
    {
      return !model.has_cell_strains() && !model.is_correspondence() && !model.is_tensor_involved() &&
             !model.recomputes();
    }

    bool has_local_steps(const Scene &scene)
    {
      return scene.solver.is_dynamic() && scene.solver.local_step_ratio > 1;
    }

    Rule of_dynamics(const std::string &parameter, const Rule::Breaches &breaches)
    {
      return refuse_each(parameter,
                         "Solver/Name other than dynamics",
                         breaches,
                         "this belongs to dynamics",
                         "",
                         "set Solver/Name = dynamics");
    }

    Rule of_steps(const std::string &parameter, const Condition is_broken)
    {
      return refuse(parameter,
                    "Solver/Name = static",
                    is_broken,
                    "this belongs to dynamics, quasi static and dynamic relaxation",
                    "",
                    "set Solver/Name = dynamics, or = quasi static");
    }
  } // namespace

  bool solves_equations(const SceneParameters &scene)
  {
    return scene.solver.is_linear_static() || scene.solver.is_quasi_static();
  }

  bool takes_auxiliary_space(const SceneParameters &scene)
  {
    return solves_equations(scene) && !scene.solver.assembles() &&
           (scene.solver.preconditioner == PreconditionerName::automatic ||
            scene.solver.preconditioner == PreconditionerName::auxiliary);
  }

  std::vector<Rule> solver_rules()
  {
    std::vector<Rule> rules = {
      refuse(
        "Solver/Linear solver",
        "Solver/Linear solver = cg | trilinos cg, with Material/Form = paper, Quadrature/Scheme = gauss "
        "points or Boundary conditions/Traction treatment = taylor ghosts",
        [](const Scene &s) { return solves_equations(s) && is_unsymmetric(s) && s.solver.takes_cg(); },
        "the operator of this scene is not symmetric",
        "automatic | gmres | trilinos gmres | direct"),
      refuse(
        "Solver/Auxiliary mesh",
        "Solver/Auxiliary mesh = parent, Mesh/Refinements = 0, Mesh/Refine times = 0",
        [](const Scene &s) {
          return takes_auxiliary_space(s) && s.solver.auxiliary_mesh == AuxiliaryMesh::parent &&
                 s.mesh.refinements == 0 && s.mesh.refine_times == 0;
        },
        "no cell of this mesh has a parent: it was not refined",
        "automatic | same for this mesh",
        "halve Mesh/Cells and set Mesh/Refinements = 1"),
      refuse(
        "Initial conditions/v_z",
        "Dimension = 2",
        [](const Scene &s) { return s.dimension == 2 && !s.initial.velocity[2].empty(); },
        "a two-dimensional scene has no z component",
        "none in 2-D"),
      warn(
        "Solver/Tolerance",
        "above 1e-4, with Solver/Name = static | quasi static | dynamic relaxation",
        [](const Scene &s) { return !s.solver.is_dynamic() && s.solver.tolerance > 1e-4; },
        "the error of displacements may be many times the tolerance: take 1e-4 or less"),
      refuse(
        "Solver/Relative damping",
        "Material/Form = consistent, Solver/Name other than static",
        [](const Scene &s) {
          return s.solver.relative_damping > 0 && s.model.is_consistent() && !s.solver.is_linear_static();
        },
        "damping between nodes is that of bonds that carry the body's forces",
        "0 for Material/Form = consistent",
        "set Solver/Damping"),
      refuse(
        "Solver/Local step ratio",
        "Solver/Local step ratio > 1, with Material/Form = family, Model = tensor involved or Multipliers = "
        "recomputed",
        [](const Scene &s) {
          return has_local_steps(s) && !has_families_of_bonds(s.model) && !s.model.is_consistent();
        },
        "steps are those of families of bonds that are not weighed anew, or of cells",
        "1",
        "set Material/Form = consistent | energy"),
      refuse(
        "Solver/Local step ratio",
        "Solver/Local step ratio > 1, with bonds that break or contact",
        [](const Scene &s) { return has_local_steps(s) && (can_break(s) || has_contact(s)); },
        "bonds and contact would be looked at after the longest steps only",
        "1 where bonds break or nodes touch",
        "without a fracture energy, a critical stretch or a criterion: set Contact/Enabled = false"),
      refuse(
        "Solver/Local step ratio",
        "Solver/Local step ratio > 1, with Solver/Relative damping > 0",
        [](const Scene &s) { return has_local_steps(s) && s.solver.relative_damping > 0; },
        "damping against the family acts in every step",
        "1",
        "set Solver/Damping"),
      of_dynamics("Boundary conditions/NAME/v_x, v_y, v_z", velocities_of_conditions),
      of_dynamics("Initial conditions/u_x, u_y, u_z, v_x, v_y, v_z", initial_conditions),
      of_steps("Checkpoints/Steps",
               [](const Scene &s) { return s.checkpoints.steps > 0 && s.solver.is_linear_static(); }),
      of_steps("Checkpoints/Restart",
               [](const Scene &s) { return s.checkpoints.restart && s.solver.is_linear_static(); }),
      of_steps("Contact/Enabled",
               [](const Scene &s) {
                 return s.contact.enabled == ContactChoice::yes && s.solver.is_linear_static();
               }),
      of_steps("Solver/Relative damping",
               [](const Scene &s) { return s.solver.relative_damping > 0 && s.solver.is_linear_static(); }),
    };
    const std::vector<Rule> of_control = rules_of_control();
    rules.insert(rules.end(), of_control.begin(), of_control.end());
    return rules;
  }
} // namespace perideal
