// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_mesh_mesh_parameters_h
#define perideal_mesh_mesh_parameters_h

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>

#include <map>
#include <string>
#include <vector>

namespace perideal
{
  /// Section "Mesh".
  struct MeshParameters
  {
    /// A mesh, or a `.geo` file that is to be meshed; empty: use the generator.
    std::string file;
    /// Factor on the coordinates of the file.
    double scale = 1.;
    /// How long the program gmsh may mesh a file [s].
    double gmsh_time_limit = 3600.;
    /// Name of the built-in generator; empty: use the file.
    std::string generator;
    /// Cell counts of the generator, their meaning is the generator's; empty: its default.
    std::vector<unsigned int> cells;
    /// Lengths of the generator's geometry [m]; empty: its default.
    std::vector<double> size;
    /// Where the box of the generator begins [m]; empty: at the origin.
    std::vector<double> corner;
    /// Radius of the generator's hole [m].
    double hole_radius = 0.1;
    /// Growth of the cell size over a graded block, from the hole outwards [-].
    double grading = 6.;
    /// Random displacement of the inner vertices before refinement, as a share of the shortest edge there
    /// [-].
    double distortion = 0.;
    /// Uniform p4est refinements.
    unsigned int refinements = 0;
    /// Boundaries, by name or id, whose cells are refined after that.
    std::vector<std::string> refine_at;
    /// Where cells are refined besides, a formula in x, y, z that is not zero there; empty: nowhere.
    std::string refine_where;
    /// How often they are, and at boundaries how many cells deep; 0: as deep as families need it.
    unsigned int refine_times = 0, refine_layers = 0;
    /// Thickness of a two-dimensional body [m].
    double thickness = 1.;
    /// Boundaries of a mesh file that are circular cylinders about an axis in
    /// z, by name or id, with the axis point (x, y) [m].
    std::map<std::string, dealii::Point<2>> cylinders;

    void declare(dealii::ParameterHandler &prm);

    /// @throws InputError on values that no mesh can be made from.
    void check() const;
  };
} // namespace perideal

#endif
