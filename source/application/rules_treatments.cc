// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/rules.h>

// Rules of the treatments of boundary conditions.

namespace perideal
{
  namespace
  {
    using Scene = SceneParameters;

    const char *const displacements = "Boundary conditions/Displacement treatment";
    const char *const tractions     = "Boundary conditions/Traction treatment";
    const char *const others        = "automatic | layer | reference | mirror";

    bool has_reference(const Scene &scene)
    {
      return scene.loads.displacement_treatment == DisplacementTreatment::reference;
    }

    bool has_ghosts_of_displacements(const Scene &scene)
    {
      return scene.loads.displacement_treatment == DisplacementTreatment::taylor_ghosts;
    }

    bool has_ghosts(const Scene &scene)
    {
      return has_ghosts_of_displacements(scene) || scene.loads.has_taylor_extension();
    }

    bool takes_tractions_at_faces(const Scene &scene)
    {
      return scene.loads.traction_treatment == TractionTreatment::face_value;
    }

    Rule of_surface_nodes(const std::string &with,
                          const Condition    is_broken,
                          const std::string &message,
                          const std::string &allowed)
    {
      return refuse_each(
        displacements,
        std::string(displacements) + " = surface nodes, " + with,
        [is_broken](const Scene &scene) {
          return scene.loads.has_surface_nodes() && is_broken(scene) ?
                   std::vector<std::string>{displacements} :
                   std::vector<std::string>();
        },
        message,
        allowed);
    }

    std::vector<Rule> surface_node_rules()
    {
      return {
        of_surface_nodes(
          "Solver/Name = dynamics",
          [](const Scene &s) { return s.solver.is_dynamic(); },
          "nodes on the surface have no mass",
          "automatic | layer in dynamics"),
        of_surface_nodes(
          "Material/Form = consistent",
          [](const Scene &s) { return s.model.is_consistent(); },
          "nodes on the surface have no cells, which the consistent form needs",
          "automatic | face value | layer | reference for the consistent form"),
        of_surface_nodes(
          "Quadrature/Scheme = adaptive | exact | gauss points",
          [](const Scene &s) { return s.quadrature.has_gauss_points() || s.quadrature.needs_cells(); },
          "nodes on the surface have no cells, of which Quadrature/Scheme = ... counts the parts",
          std::string(others) + "; or Quadrature/Scheme = one point | cubic cell | partial volume"),
        of_surface_nodes(
          "Material/Boundary compensation other than none",
          [](const Scene &s) { return s.model.compensates(); },
          "bonds are stiffened for what they lack at the surface, where these nodes are",
          std::string(others) + "; or Material/Boundary compensation = none"),
        of_surface_nodes(
          "Material/Form = surface cure",
          [](const Scene &s) { return s.model.has_surface_cure(); },
          "the surface cure has no gradient at nodes on the surface",
          std::string(others) + "; or another Material/Form"),
        of_surface_nodes(
          "bonds that break or that Precracks/ cut (Solver/Name other than static)",
          [](const Scene &s) { return can_break(s) || !s.precracks.cracks.empty(); },
          "what breaks is told by the nodes of cells",
          "automatic | layer where bonds break or are cut"),
        of_surface_nodes(
          "Areal force densities/",
          [](const Scene &s) { return !s.areal_forces.points.empty(); },
          "areal force densities are sums over nodes of cells",
          std::string(others) + " with Areal force densities"),
      };
    }

    std::vector<Rule> displacement_rules()
    {
      return {
        refuse(
          "Boundary conditions/Treatment",
          "Material/Form = consistent",
          [](const Scene &s) { return s.model.is_consistent() && s.loads.treatment != Treatment::automatic; },
          "the consistent form takes its boundary conditions at faces",
          "automatic for this form; or set Material/Form to another one"),
        refuse(
          displacements,
          std::string(displacements) + " = face value, Material/Form other than consistent",
          [](const Scene &s) {
            return s.loads.displacement_treatment == DisplacementTreatment::face_value &&
                   !s.model.is_consistent();
          },
          "only the consistent form reads values at faces",
          "automatic | layer | reference | mirror for this model",
          "or set Material/Form = consistent"),
        refuse(
          displacements,
          std::string(displacements) + " = mirror, Material/Form = consistent",
          [](const Scene &s) { return s.loads.has_mirror() && s.model.is_consistent(); },
          "mirrored nodes have no cells, which the consistent form needs",
          "automatic | face value | layer | reference for the consistent form"),
        refuse(
          displacements,
          std::string(displacements) + " = mirror | reference, Solver/Name = dynamics",
          [](const Scene &s) { return s.solver.is_dynamic() && (s.loads.has_mirror() || has_reference(s)); },
          "dynamics hold the nodes at a boundary",
          "automatic | layer in dynamics"),
        refuse(
          displacements,
          std::string(displacements) +
            " = mirror | reference, Solver/Name = quasi static | dynamic relaxation",
          [](const Scene &s) {
            return s.solver.is_nonlinear_static() && (s.loads.has_mirror() || has_reference(s));
          },
          "quasi static and dynamic relaxation hold nodes",
          "automatic | layer | surface nodes in quasi static and dynamic relaxation"),
        refuse(
          "Boundary conditions/Layers",
          std::string(displacements) + " other than layer | reference",
          [](const Scene &s) { return s.loads.layers > 1 && !s.loads.holds_layer(); },
          "this treatment holds no nodes, of which there could be more layers",
          "1 for " + std::string(displacements) + " = ...",
          "set Boundary conditions/Displacement treatment = layer"),
        warn(
          displacements,
          std::string(displacements) + " = layer | reference, Material/Form = consistent",
          [](const Scene &s) { return s.model.is_consistent() && s.loads.holds_layer(); },
          "held nodes take from the consistent form the accuracy that face values have"),
      };
    }

    std::vector<Rule> traction_rules()
    {
      return {
        refuse(
          tractions,
          std::string(tractions) + " other than face value, Material/Form = consistent",
          [](const Scene &s) { return s.model.is_consistent() && !takes_tractions_at_faces(s); },
          "the consistent form takes tractions at faces",
          "automatic | face value for this form"),
        refuse(
          tractions,
          std::string(tractions) + " = face value, Material/Form other than consistent",
          [](const Scene &s) { return !s.model.is_consistent() && takes_tractions_at_faces(s); },
          "only the consistent form takes tractions at faces",
          "automatic | layer for this model"),
        refuse(
          tractions,
          std::string(tractions) +
            " = line to point | published line to point, Material/Model other than bond based or "
            "Dimension = 2",
          [](const Scene &s) {
            return s.loads.has_line_to_point() && !s.model.is_consistent() &&
                   (!s.model.model->has_one_micromodulus || s.dimension != 3);
          },
          "the closed form is that of bond-based peridynamics in 3-D",
          "automatic | layer | taylor ghosts | transfer for this scene"),
        refuse(
          "Boundary conditions/Transfer chi",
          std::string(tractions) + " = published transfer",
          [](const Scene &s) {
            return s.loads.has_published_transfer() &&
                   (s.loads.transfer_chi == 0 || s.loads.transfer_chi == 1);
          },
          "the factor chi/(chi-1) vanishes or is infinite",
          "numbers other than 0 and 1"),
        refuse(
          "Boundary conditions/Transfer lambda",
          std::string(tractions) + " = published transfer, Solver/Name other than static",
          [](const Scene &s) {
            return s.loads.has_published_transfer() && s.loads.transfer_lambda != 0 &&
                   !s.solver.is_linear_static();
          },
          "what the places of held faces do is known in linear statics",
          "0 for Solver/Name = ..."),
      };
    }

    std::vector<Rule> ghost_rules()
    {
      return {
        refuse(
          tractions,
          std::string(displacements) + " = taylor ghosts without such tractions, or the other way round",
          [](const Scene &s) {
            return has_ghosts_of_displacements(s) != s.loads.has_taylor_extension() &&
                   !s.model.is_consistent();
          },
          "ghosts meet displacements and tractions together, and here " + std::string(displacements) +
            " = ...",
          "taylor ghosts for both, or for none",
          "set Boundary conditions/Treatment = taylor ghosts instead of either"),
        refuse(
          tractions,
          std::string(tractions) + " = taylor ghosts, Solver/Name other than static",
          [](const Scene &s) { return has_ghosts(s) && !s.solver.is_linear_static(); },
          "what ghosts do follows from linear statics, not Solver/Name = ...",
          "",
          "choose another treatment for this solver"),
        refuse(
          displacements,
          std::string(displacements) + " = taylor ghosts, Material/Form = consistent",
          [](const Scene &s) { return has_ghosts_of_displacements(s) && s.model.is_consistent(); },
          "the consistent form takes its boundary conditions at faces",
          "automatic | face value | layer | reference for the consistent form",
          "set Material/Form to another one"),
        refuse(
          tractions,
          std::string(tractions) +
            " = taylor ghosts, Material/Boundary compensation other than none or Material/Form = surface "
            "cure",
          [](const Scene &s) {
            return has_ghosts(s) && (s.model.compensates() || s.model.has_surface_cure());
          },
          "the surface has what it lacks by other means",
          "",
          "set Material/Boundary compensation = none, and Material/Form to another one"),
      };
    }
  } // namespace

  std::vector<Rule> treatment_rules()
  {
    std::vector<Rule> all;
    for (const auto part : {displacement_rules, traction_rules, surface_node_rules, ghost_rules})
      for (Rule &rule : part())
        all.push_back(std::move(rule));
    return all;
  }
} // namespace perideal
