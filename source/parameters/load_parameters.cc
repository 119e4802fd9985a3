// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/parameters/load_parameters.h>
#include <perideal/parameters/named_texts.h>

#include <deal.II/base/patterns.h>

namespace perideal
{
  void LoadParameters::declare(dealii::ParameterHandler &prm, const ParameterFile &file)
  {
    const std::array<std::string, 3> axes = {{"x", "y", "z"}};
    tables.declare(prm, file);
    prm.enter_subsection("Boundary conditions");
    prm.add_parameter(
      "Treatment",
      treatment,
      "What the next two are where they are automatic, for bonds between nodes: layer: layer and layer; "
      "published: surface nodes and published transfer, as in peridynamics with boundary conditions; "
      "balanced: surface nodes and transfer; taylor ghosts: these for both; automatic: what suits the model");
#define PERIDEAL_TREATMENT_HELP(name, text, meaning) text ": " meaning "; "
    prm.add_parameter("Displacement treatment",
                      displacement_treatment,
                      "How prescribed displacements reach the nodes: " PERIDEAL_DISPLACEMENT_TREATMENTS(
                        PERIDEAL_TREATMENT_HELP) "automatic: face value for the consistent form, taylor "
                                                 "ghosts with such tractions, else layer");
    prm.add_parameter("Traction treatment",
                      traction_treatment,
                      "How tractions and pressures reach the nodes: " PERIDEAL_TRACTION_TREATMENTS(
                        PERIDEAL_TREATMENT_HELP) "automatic: that for the consistent form, else layer");
#undef PERIDEAL_TREATMENT_HELP
    prm.add_parameter("Transfer chi",
                      transfer_chi,
                      "Of the published transfer: its factor is chi/(chi-1), not 0 or 1 [-]",
                      dealii::Patterns::Double());
    prm.add_parameter("Transfer lambda",
                      transfer_lambda,
                      "Of the published transfer: what the places of held faces do, in linear statics "
                      "[N/m^11]; 0: nothing. The unit makes results depend on the unit of length",
                      dealii::Patterns::Double());
    prm.add_parameter(
      "Layers",
      layers,
      "How many layers of cells under a boundary the treatments layer and reference hold [-]. 1: those "
      "at the boundary, which take its value at the face; more: also the cells that share a vertex with "
      "these, and so on, all of which take the formula's value at their own node: for formulas that are "
      "the field, in a collar as deep as the horizon",
      dealii::Patterns::Integer(1, 1000));
    prm.add_parameter(
      "Rigid body motions",
      rigid_body_motions,
      "What to do when the conditions leave a rigid-body motion free: error: stop; remove: find "
      "the solution whose mean translation and rotation are zero (the loads must balance)");
    conditions = named_texts<BoundaryConditionText>(file, "Boundary conditions");
    for (BoundaryConditionText &condition : conditions)
      {
        prm.enter_subsection(condition.name);
        prm.add_parameter(
          "Boundary", condition.boundary, "Gmsh physical names or ids of the boundary, separated by commas");
        for (unsigned int d = 0; d < 3; ++d)
          prm.add_parameter("u_" + axes[d],
                            condition.displacement[d],
                            "Prescribed displacement along " + axes[d] +
                              " [m], a formula in x, y, z, t; empty: free");
        prm.add_parameter("u_n",
                          condition.normal_displacement,
                          "Prescribed displacement along the normal of the boundary, whatever its direction "
                          "[m]: 0, as in a plane of symmetry or on rollers; empty: none");
        for (unsigned int d = 0; d < 3; ++d)
          prm.add_parameter("v_" + axes[d],
                            condition.velocity[d],
                            "Prescribed velocity along " + axes[d] +
                              " [m/s], a formula in x, y, z, t, in dynamics; empty: free");
        for (unsigned int d = 0; d < 3; ++d)
          prm.add_parameter("t_" + axes[d],
                            condition.traction[d],
                            "Traction along " + axes[d] + " [Pa], a formula in x, y, z, t; empty: none");
        prm.add_parameter("Pressure",
                          condition.pressure,
                          "Pressure towards the body [Pa], a formula in x, y, z, t; empty: none");
        prm.add_parameter(
          "Spring stiffness",
          condition.spring.stiffness,
          "Stiffness >= 0 of an elastic foundation on which the boundary stands, in a unit of "
          "area [N/m^3]; 0: none",
          dealii::Patterns::Double(0));
        prm.add_parameter(
          "Spring direction",
          condition.spring.direction,
          "Which motion of the boundary these springs resist: all: in all directions; normal: "
          "along its normal");
        prm.add_parameter(
          "Rotation",
          condition.rotation.angle,
          "Angle by which the boundary is turned about an axis [rad], a formula in x, y, z, t; "
          "it prescribes all components: exactly, and in Solver/Name = static what is linear "
          "in the angle; empty: none");
        prm.add_parameter("Axis point",
                          condition.rotation.point,
                          "A point of the axis of Rotation: coordinates [m], separated by commas");
        prm.add_parameter("Axis direction",
                          condition.rotation.direction,
                          "Direction of the axis of Rotation in 3-D, of any length: x, y, z; the angle turns "
                          "by the right hand's rule. In 2-D the axis is z");
        prm.leave_subsection();
      }
    prm.leave_subsection();

    prm.enter_subsection("Point loads");
    point_loads = named_texts<PointLoadText>(file, "Point loads");
    for (PointLoadText &load : point_loads)
      {
        prm.enter_subsection(load.name);
        prm.add_parameter("Point",
                          load.point,
                          "Where the force acts: coordinates [m], separated by commas, in the body or on its "
                          "boundary (up to a tenth of a cell outside, where that is curved)");
        for (unsigned int d = 0; d < 3; ++d)
          prm.add_parameter("F_" + axes[d],
                            load.force[d],
                            "Force along " + axes[d] +
                              " [N], a formula in x, y, z, t; in 2-D on the whole thickness; empty: none");
        prm.leave_subsection();
      }
    prm.leave_subsection();

    prm.enter_subsection("Body force");
    for (unsigned int d = 0; d < 3; ++d)
      prm.add_parameter("b_" + axes[d],
                        body_force[d],
                        "Force per volume along " + axes[d] +
                          " [N/m^3], a formula in x, y, z, t; empty: none");
    prm.add_parameter("Gravity",
                      gravity,
                      "Acceleration of gravity by component [m/s^2], such as 0, -9.81; each may be a formula "
                      "in x, y, z, t. The body weighs by it, each material by its Density; empty: none");
    prm.leave_subsection();

    prm.enter_subsection("Thermal strain");
    prm.add_parameter(
      "Temperature",
      temperature,
      "Temperature of the body [K], or in degrees Celsius, a formula in x, y, z, t. A free body expands in "
      "all directions by Material/Thermal expansion times what it is above Reference "
      "temperature; empty: no thermal strain");
    prm.add_parameter(
      "Reference temperature",
      reference_temperature,
      "Temperature at which there is no thermal strain [K], or in degrees Celsius like the other; 0 "
      "where Temperature is what the body is heated by",
      dealii::Patterns::Double());
    prm.leave_subsection();
  }
} // namespace perideal
