// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_problem_scene_parameters_h
#define perideal_problem_scene_parameters_h

#include <perideal/fracture/crack_tracker.h>
#include <perideal/fracture/no_fail_zones.h>
#include <perideal/materials/models.h>
#include <perideal/mesh/adaptation.h>
#include <perideal/mesh/mesh_parameters.h>
#include <perideal/neighbourhood/precrack.h>
#include <perideal/nodes/nodes.h>
#include <perideal/operators/force/contact_force.h>
#include <perideal/output/output_format.h>
#include <perideal/output/pictures.h>
#include <perideal/parameters/areal_force_parameters.h>
#include <perideal/parameters/gauge_parameters.h>
#include <perideal/parameters/load_parameters.h>
#include <perideal/parameters/material_parameters.h>
#include <perideal/parameters/parameter_file.h>
#include <perideal/parameters/probe_parameters.h>
#include <perideal/quadrature/bond_volume.h>
#include <perideal/solvers/linear_solver.h>

#include <deal.II/base/parameter_handler.h>

#include <array>
#include <iosfwd>
#include <string>
#include <vector>

namespace perideal
{
  /// Subsection of "Comparison": a straight line through the body.
  struct LineText
  {
    /// Name of the subsection, "Comparison/<name>".
    std::string name;
    /// Its ends, coordinates [m] separated by commas.
    std::string from, to;
    /// Points along it, the ends among them, at which values are interpolated.
    unsigned int points = 101;
  };

  /// Of what the finite elements are made that solutions are held against.
  enum class ComparedStiffness
  {
    material,
    families
  };

  template <>
  struct ChoiceNames<ComparedStiffness>
  {
    static constexpr const char *list[] = {"material", "families"};
  };

  /// Section "Comparison": what the solution is held against.
  struct ComparisonParameters
  {
    /// Finite elements on the same mesh.
    bool fem = false;
    /// Polynomial degree of these.
    unsigned int fem_degree = 1;
    /// Q2 finite elements on the refined mesh.
    bool              reference = false;
    ComparedStiffness stiffness = ComparedStiffness::material;
    /// Refinements of the reference's mesh; -1: coarsened once.
    int reference_refinements = 1;
    /// Gmsh file of the same body on which the reference is solved; empty: the scene's mesh.
    std::string reference_mesh;
    /// Boundaries along which profiles are written.
    std::vector<std::string> profiles;
    /// Lines along which profiles are written.
    std::vector<LineText> lines;
    /// Exact displacement by component, formulas in x, y, z, t; empty: none.
    std::array<std::string, 3> exact;

    void declare(dealii::ParameterHandler &prm, const ParameterFile &file);

    bool by_families() const { return stiffness == ComparedStiffness::families; }

    bool has_exact() const { return !(exact[0].empty() && exact[1].empty() && exact[2].empty()); }
  };

  /// Section "Initial conditions".
  struct InitialParameters
  {
    /// Displacement of the body at t = 0 by component [m], formulas in x, y, z; empty: none.
    std::array<std::string, 3> displacement;
    /// Velocity of the body at t = 0 by component [m/s], formulas in x, y, z; empty: at rest.
    std::array<std::string, 3> velocity;

    void declare(dealii::ParameterHandler &prm);
  };

  /// Section "Checkpoints".
  struct CheckpointParameters
  {
    /// Steps between two checkpoints; 0: only when the program is asked to stop.
    unsigned int steps = 0;
    /// Whether there is one at the end, from which a run goes on to a later one.
    bool at_end = false;
    /// Whether to go on from the last one.
    bool restart = false;

    void declare(dealii::ParameterHandler &prm);
  };

  /// Everything a `.prm` file can say.
  struct SceneParameters
  {
    int         dimension        = 2;
    std::string output_directory = "output";
    std::string fields           = "displacement";
    /// Of the files of these fields.
    OutputFormat format = OutputFormat::vtu;
    /// Boundaries whose stresses are written.
    std::vector<std::string> boundary_stress;
    /// Stress that the largest one is divided by for its concentration [Pa]; 0: not given.
    double nominal_stress = 0.;
    /// Load steps that leave field files: one number, every so many; several, these; none, all. The last one
    /// does in any case.
    std::vector<unsigned int> frame_steps;
    /// Field files of dynamics, and steps between rows of their history.
    unsigned int         frames = 10, history_steps = 10;
    MeshParameters       mesh;
    AdaptationParameters adaptation;
    NodeParameters       nodes;
    QuadratureParameters quadrature;
    ModelParameters      model;
    MaterialParameters   material;
    SolverParameters     solver;
    LoadParameters       loads;
    InitialParameters    initial;
    PrecrackParameters   precracks;
    NoFailParameters     no_fail;
    CrackParameters      cracks;
    CheckpointParameters checkpoints;
    ContactParameters    contact;
    ComparisonParameters comparison;
    ArealForceParameters areal_forces;
    GaugeParameters      gauges;
    PictureParameters    pictures;
    ProbeParameters      probes;
    /// What the choice of automatic and the table of rules warn of, one line each.
    std::vector<std::string> warnings;

    void declare(dealii::ParameterHandler &prm, const ParameterFile &file);

    /// Fields to write: those of Output/Fields in the order given, then those of Output/Pictures.
    std::vector<std::string> field_names() const;

    /// Whether a load step leaves a field file.
    bool has_frame(const std::uint64_t step) const;

    /// Those, and the fields of probes.
    std::vector<std::string> all_field_names() const;
  };

  /// Returns whether bonds of the scene may break.
  bool can_break(const SceneParameters &parameters);

  /// Whether the consistent form turns into bonds where cracks grow.
  bool has_fracture_zone(const SceneParameters &parameters);

  /// Returns whether nodes repel each other that come too close.
  bool has_contact(const SceneParameters &parameters);

  /// Prints every parameter with default, range and meaning.
  /// @param format text | prm | markdown
  /// @throws InputError on another format.
  void print_parameters(std::ostream &out, const std::string &format);
} // namespace perideal

#endif
