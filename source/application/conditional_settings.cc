// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/rules.h>

// Settings that have an effect in some scenes only.

namespace perideal
{
  namespace
  {
    using Scene = SceneParameters;

    bool is_dynamic(const Scene &scene)
    {
      return scene.solver.is_dynamic();
    }

    std::vector<ConditionalSettings> settings_of_solvers()
    {
      return {
        {{"Solver/End time",
          "Solver/Time step",
          "Solver/Time step safety",
          "Solver/Local step ratio",
          "Solver/Integrator",
          "Solver/Damping",
          "Output/Frames",
          "Output/History steps"},
         "Solver/Name = dynamics",
         is_dynamic},
        {{"Solver/Relative damping", "Contact/Enabled"},
         "Solver/Name = dynamics",
         // In linear statics they are refused.
         [](const Scene &s) { return s.solver.is_dynamic() || s.solver.is_linear_static(); }},
        {{"Contact/Distance", "Contact/Stiffness"},
         "Solver/Name = dynamics where Contact/Enabled is true, or automatic and bonds break or are cut",
         [](const Scene &s) { return s.solver.is_dynamic() && has_contact(s); }},
        {{"Solver/Load steps",
          "Output/Frame steps",
          "Solver/Tolerance",
          "Solver/Maximum iterations",
          "Boundary conditions/Rigid body motions"},
         "Solver/Name = static | quasi static | dynamic relaxation",
         [](const Scene &s) { return !s.solver.is_dynamic(); }},
        {{"Solver/Last load step"},
         "Solver/Name = quasi static | dynamic relaxation, Solver/Control = loads",
         [](const Scene &s) { return s.solver.is_nonlinear_static() && !s.solver.is_controlled(); }},
        {{"Solver/Newton iterations", "Solver/Step halvings", "Solver/Control"},
         "Solver/Name = quasi static",
         [](const Scene &s) { return s.solver.is_quasi_static(); }},
        {{"Solver/Control gauge"},
         "Solver/Control = gauge",
         [](const Scene &s) { return s.solver.controls(LoadControlName::gauge); }},
        {{"Solver/Control end"},
         "Solver/Control = gauge | dissipated energy",
         [](const Scene &s) { return s.solver.is_controlled(); }},
        {{"Solver/Control step"},
         "Solver/Control = dissipated energy",
         [](const Scene &s) { return s.solver.controls(LoadControlName::dissipated_energy); }},
        {{"Solver/Linear solver", "Solver/Preconditioner"},
         "Solver/Name = static | quasi static",
         solves_equations},
        {{"Solver/Auxiliary mesh"},
         "Solver/Name = static | quasi static, Solver/Preconditioner = automatic | auxiliary, Solver/Linear "
         "solver = automatic | cg | gmres",
         takes_auxiliary_space},
      };
    }

    std::vector<ConditionalSettings> settings_of_materials()
    {
      return {
        {{"Material/Form"},
         "Material/Model = extended ordinary | tensor involved | correspondence",
         [](const Scene &s) { return s.model.has_forms(); }},
        {{"Nodes/Families on demand"},
         "Material/Form = consistent, and something that can break",
         has_fracture_zone},
        {{"Material/Stabilisation"},
         "Material/Form = consistent, or Material/Model = correspondence",
         [](const Scene &s) { return s.model.is_consistent() || s.model.is_correspondence(); }},
        {{"Material/Fracture energy",
          "Material/Critical stretch",
          "Material/Failure criterion",
          "Material/Tensile strength",
          "Material/Compressive strength",
          "Material/Softening",
          "Material/Stretch formula"},
         "Solver/Name = quasi static | dynamic relaxation | dynamics",
         [](const Scene &s) { return !s.solver.is_linear_static(); }},
        {{"Material/Thermal expansion", "Thermal strain/Reference temperature"},
         "Thermal strain/Temperature",
         [](const Scene &s) { return !s.loads.temperature.empty(); }},
        {{"Adaptation/Cycles", "Adaptation/Largest number of cells"},
         "Adaptation/Wanted error",
         [](const Scene &s) { return s.adaptation.is_by_error(); }},
        {{"Adaptation/Refine from",
          "Adaptation/Coarsen below",
          "Adaptation/Reach",
          "Adaptation/Interval",
          "Adaptation/Refine where",
          "Adaptation/Refine at",
          "Adaptation/Refine in"},
         "Adaptation/Levels",
         [](const Scene &s) { return s.adaptation.is_by_need(); }},
        {{"Cracks/Energy release rates"},
         "Dimension = 2, Solver/Name = static | quasi static | dynamic relaxation",
         [](const Scene &s) { return s.dimension == 2 && !s.solver.is_dynamic(); }},
        {{"Material/Assumption", "Mesh/Thickness"},
         "Dimension = 2",
         [](const Scene &s) { return s.dimension == 2; }},
      };
    }

    std::vector<ConditionalSettings> settings_of_bonds()
    {
      return {
        {{"Quadrature/Adaptive rule", "Quadrature/Relative tolerance", "Quadrature/Absolute tolerance"},
         "Quadrature/Scheme = adaptive",
         [](const Scene &s) { return s.quadrature.scheme == QuadratureScheme::adaptive; }},
        {{"Quadrature/Gauss points", "Quadrature/Support radius"},
         "Quadrature/Scheme = gauss points",
         [](const Scene &s) { return s.quadrature.has_gauss_points(); }},
        {{"Boundary conditions/Transfer chi", "Boundary conditions/Transfer lambda"},
         "Boundary conditions/Traction treatment = published transfer",
         [](const Scene &s) { return s.loads.has_published_transfer(); }},
      };
    }

    std::vector<ConditionalSettings> settings_of_output()
    {
      return {
        {{"Output/View"},
         "Dimension = 3, with Output/Pictures or Output/Report",
         [](const Scene &s) { return s.dimension == 3 && s.pictures.are_wanted(); }},
        {{"Output/Nominal stress"},
         "Output/Boundary stress",
         [](const Scene &s) { return !s.boundary_stress.empty(); }},
        {{"Comparison/FEM degree"}, "Comparison/FEM = true", [](const Scene &s) { return s.comparison.fem; }},
        {{"Comparison/Reference refinements"},
         "Comparison/Reference = true, or Boundary conditions/Displacement treatment = reference",
         [](const Scene &s) {
           return s.comparison.reference ||
                  s.loads.displacement_treatment == DisplacementTreatment::reference;
         }},
        {{"Comparison/Stiffness"},
         "Comparison/FEM = true | Comparison/Reference = true",
         [](const Scene &s) { return s.comparison.fem || s.comparison.reference; }},
        {{"Mesh/Cells", "Mesh/Size", "Mesh/Hole radius", "Mesh/Grading"},
         "Mesh/Generator",
         [](const Scene &s) { return !s.mesh.generator.empty(); }},
      };
    }
  } // namespace

  std::vector<ConditionalSettings> conditional_settings()
  {
    std::vector<ConditionalSettings> all;
    for (const auto part :
         {settings_of_solvers, settings_of_materials, settings_of_bonds, settings_of_output})
      for (ConditionalSettings &settings : part())
        all.push_back(std::move(settings));
    return all;
  }
} // namespace perideal
