// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/input_errors.h>
#include <perideal/base/registry.h>
#include <perideal/mesh/generators.h>
#include <perideal/mesh/mesh_parameters.h>

namespace perideal
{
  void MeshParameters::declare(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Mesh");
    prm.add_parameter(
      "File",
      file,
      "Mesh of quadrilaterals or hexahedra: of Gmsh (.msh), of Abaqus (.inp; CPS4, CPE4, C3D8 and their "
      "variants, with the names of sets and surfaces), .unv or .vtk, which the program gmsh converts like a "
      ".msh other than ASCII 2.2 and 4.1; or a .geo, which it meshes; relative paths start from the working "
      "directory, then from the scene's. "
      "Empty: take the Generator",
      Anything());
    prm.add_parameter(
      "Scale",
      scale,
      "Factor on the coordinates of a mesh File, > 0: all lengths are in metres, so that a part "
      "drawn in millimetres has 0.001 [-]",
      Double(0.));
    prm.add_parameter("Gmsh time limit",
                      gmsh_time_limit,
                      "How long the program gmsh may take to mesh a .geo File before the run ends, > 0 [s]",
                      Double(0.));
    prm.add_parameter("Generator",
                      generator,
                      "Built-in mesh, instead of a File: " + join_choices(generator_names()) +
                        ". Boundaries are named left, right (x), bottom, top (y), back, front (z), hole",
                      Anything());
    prm.add_parameter(
      "Cells",
      cells,
      "Cell counts of the generator [-]. box: along x, y(, z), default 10; plate with hole: "
      "around each of the eight blocks, radially(, layers in z), default 30, 32(, 4); plate with hole "
      "grid: along x, y(, z), default 100, 100(, 10)",
      List(Integer(1, 1000000), 0, 3));
    prm.add_parameter(
      "Size",
      size,
      "Lengths of the generator's body [m]. box: along x, y(, z) from the origin, default 1; "
      "plate with hole: side(, depth in z), about the origin, default 1(, 0.1); plate with hole grid: "
      "along x, y(, z), about the origin, default 1, 1(, 0.1)",
      List(Double(0.), 0, 3));
    prm.add_parameter("Corner",
                      corner,
                      "Lower corner of the generator box: x, y(, z), default the origin [m]",
                      List(Double(), 0, 3));
    prm.add_parameter(
      "Hole radius",
      hole_radius,
      "Radius of the hole of the generator plate with hole, between 0 and half the side; plate with "
      "hole grid: cells whose centre is nearer to the z axis are left out [m]",
      Double(0.));
    prm.add_parameter("Grading",
                      grading,
                      "Growth of the cell size of the generator plate with hole, from the hole outwards; "
                      "1: equal cells [-]",
                      Double(1e-3, 1e3));
    prm.add_parameter("Distortion",
                      distortion,
                      "Random displacement of the inner vertices before refinement, as a share of the "
                      "shortest edge there, for studies; 0.3 is much [-]",
                      Double(0., 0.5));
    prm.add_parameter("Refinements",
                      refinements,
                      "Uniform refinements; each halves all cells and follows curved boundaries [-]",
                      Integer(0, 15));
    prm.add_parameter("Refine at",
                      refine_at,
                      "Boundaries (names or ids, separated by commas) at which the mesh is refined further: "
                      "the cells next to them, then their children next to them, and so on",
                      List(Anything(), 0, List::max_int_value, ","));
    prm.add_parameter(
      "Refine where",
      refine_where,
      "Where the mesh is refined further, a formula in x, y, z that is not zero there, such as "
      "abs(y) < 0.01 && x > 0.1: the cells with their centre or a vertex there, then their children, "
      "and so on; empty: nowhere");
    prm.add_parameter("Refine times", refine_times, "How often that is done [-]", Integer(0, 12));
    prm.add_parameter(
      "Refine layers",
      refine_layers,
      "How many cells deep; 0: so many that no family meets three sizes of cells, which keeps "
      "the system well conditioned and the error small: twice the horizon factor less 1.25, "
      "rounded up, and 4 at least [-]",
      Integer(0, 50));
    prm.add_parameter("Thickness",
                      thickness,
                      "Thickness of a two-dimensional body, >= 1e-12; without meaning in 3-D [m]",
                      Double(0.));
    prm.add_parameter(
      "Cylinders",
      cylinders,
      "Boundaries of a mesh File that are circles (2-D) or cylinders along z, with their axis "
      "point x, y [m], so that refinement follows them: \"hole: 0, 0; pin: 1, 0.5\"",
      Map(Anything(), List(Double(), 2, 2), 0, Map::max_int_value, ";"));
    prm.leave_subsection();
  }

  void MeshParameters::check() const
  {
    InputErrorCollector errors;
    if (file.empty() && generator.empty())
      errors.add(InputError("the scene has no mesh: give Mesh/File or Mesh/Generator")
                   .parameter("Mesh/Generator")
                   .allowed(join_choices(generator_names())));
    if (!file.empty() && !generator.empty())
      errors.add(InputError("the scene has two meshes: give either Mesh/File or Mesh/Generator")
                   .parameter("Mesh/File")
                   .given("File = " + file + " and Generator = " + generator)
                   .hint("empty the one that is not meant: set Generator ="));
    if (!(scale > 0))
      errors.add(InputError("the factor on coordinates must be positive")
                   .parameter("Mesh/Scale")
                   .allowed("a number > 0, such as 0.001 for a part drawn in millimetres"));
    else if (scale != 1. && file.empty())
      errors.add(
        InputError("the factor on coordinates is one of a mesh File; a Generator has its Size in metres")
          .parameter("Mesh/Scale")
          .allowed("1 with a Generator"));
    if (!(gmsh_time_limit > 0))
      errors.add(InputError("the time limit must be positive")
                   .parameter("Mesh/Gmsh time limit")
                   .allowed("a number > 0 [s]"));
    // Volumes of nodes, their inverses and their squares are to be numbers.
    if (!(thickness >= 1e-12))
      errors.add(InputError("the thickness must be positive")
                   .parameter("Mesh/Thickness")
                   .allowed("a number >= 1e-12 [m]"));
    const bool refines_somewhere = !refine_at.empty() || !refine_where.empty();
    if (refine_times > 0 && !refines_somewhere)
      errors.add(InputError("no boundary is named to refine at, nor a place")
                   .parameter("Mesh/Refine at")
                   .allowed("boundary names or ids, a formula for Refine where, or Refine times = 0"));
    if (refine_times == 0 && refines_somewhere)
      errors.add(InputError("boundaries or places are named to refine at, but not how often")
                   .parameter("Mesh/Refine times")
                   .allowed("1 to 12, or an empty Refine at and Refine where"));
    if (!corner.empty() && !generator_has_corner(generator))
      errors.add(InputError("the Corner is one of the generator box").parameter("Mesh/Corner"));
    if (!generator.empty() && !cylinders.empty())
      errors.add(InputError("Cylinders belong to a mesh File; generators know their curved boundaries")
                   .parameter("Mesh/Cylinders"));
    errors.raise();
  }
} // namespace perideal
