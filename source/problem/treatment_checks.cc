// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/problem/scene_parameters.h>

// SceneParameters: treatments of boundary conditions that go together, and with the scene.
#include <map>
#include <string>

namespace perideal
{
  void SceneParameters::resolve_treatment()
  {
    if (loads.treatment == Treatment::automatic)
      return;
    if (model.is_consistent())
      throw InputError("the consistent form takes its boundary conditions at faces")
        .parameter("Boundary conditions/Treatment")
        .given(name_of(loads.treatment))
        .allowed("automatic for this form; or set Material/Form to another one");
    // What displacements are given by, and tractions.
    using Pair                                 = std::pair<DisplacementTreatment, TractionTreatment>;
    const std::map<Treatment, Pair> treatments = {
      {Treatment::layer, {DisplacementTreatment::layer, TractionTreatment::layer}},
      {Treatment::published, {DisplacementTreatment::surface_nodes, TractionTreatment::published_transfer}},
      {Treatment::balanced, {DisplacementTreatment::surface_nodes, TractionTreatment::transfer}},
      {Treatment::taylor_ghosts, {DisplacementTreatment::taylor_ghosts, TractionTreatment::taylor_ghosts}}};
    const Pair &chosen = treatments.at(loads.treatment);
    if (loads.displacement_treatment == DisplacementTreatment::automatic)
      loads.displacement_treatment = chosen.first;
    if (loads.traction_treatment == TractionTreatment::automatic)
      loads.traction_treatment = chosen.second;
  }

  void SceneParameters::check_surface_nodes() const
  {
    if (!loads.has_surface_nodes())
      return;
    const auto complain = [this](const std::string &problem, const std::string &allowed) {
      throw InputError(problem)
        .parameter("Boundary conditions/Displacement treatment")
        .given(name_of(loads.displacement_treatment))
        .allowed(allowed);
    };
    const std::string others = "automatic | layer | reference | mirror";
    if (solver.is_dynamic())
      complain("nodes on the surface have no mass", "automatic | layer in dynamics");
    if (model.is_consistent())
      complain("nodes on the surface have no cells, which the consistent form needs",
               "automatic | face value | layer | reference for the consistent form");
    if (quadrature.has_gauss_points() || quadrature.needs_cells())
      complain("nodes on the surface have no cells, of which Quadrature/Scheme = " +
                 name_of(quadrature.scheme) + " counts the parts",
               others + "; or Quadrature/Scheme = one point | cubic cell | partial volume");
    if (model.compensates())
      complain("bonds are stiffened for what they lack at the surface, where these nodes are",
               others + "; or Material/Boundary compensation = none");
    if (model.has_surface_cure())
      complain("the surface cure has no gradient at nodes on the surface",
               others + "; or another Material/Form");
    if (can_break(*this) || !precracks.cracks.empty())
      complain("what breaks is told by the nodes of cells", "automatic | layer where bonds break or are cut");
    if (!areal_forces.points.empty())
      complain("areal force densities are sums over nodes of cells", others + " with Areal force densities");
  }

  void SceneParameters::check_ghosts() const
  {
    const bool of_displacements = loads.displacement_treatment == DisplacementTreatment::taylor_ghosts;
    if (!of_displacements && !loads.has_taylor_extension())
      return;
    const auto complain = [this](const std::string &problem, const std::string &hint) {
      throw InputError(problem)
        .parameter("Boundary conditions/Traction treatment")
        .given(name_of(loads.traction_treatment))
        .hint(hint);
    };
    if (!of_displacements || !loads.has_taylor_extension())
      complain("ghosts meet displacements and tractions together, and displacements have the treatment " +
                 name_of(loads.displacement_treatment),
               "set Boundary conditions/Treatment = taylor ghosts instead of either");
    if (!solver.is_linear_static())
      complain("what ghosts do follows from linear statics, not Solver/Name = " + name_of(solver.name),
               "choose another treatment for this solver");
    if (model.is_consistent())
      complain("the consistent form takes its boundary conditions at faces",
               "set Material/Form to another one");
    if (model.compensates() || model.has_surface_cure())
      complain("the surface has what it lacks by other means",
               "set Material/Boundary compensation = none, and Material/Form to another one");
  }

  void SceneParameters::check_transfer() const
  {
    if (!loads.has_published_transfer())
      return;
    if (loads.transfer_chi == 0 || loads.transfer_chi == 1)
      throw InputError("the factor chi/(chi-1) vanishes or is infinite")
        .parameter("Boundary conditions/Transfer chi")
        .allowed("numbers other than 0 and 1");
    if (loads.transfer_lambda != 0 && !solver.is_linear_static())
      throw InputError("what the places of held faces do is known in linear statics")
        .parameter("Boundary conditions/Transfer lambda")
        .allowed("0 for Solver/Name = " + name_of(solver.name));
  }
} // namespace perideal
