// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh_test.h"

#include <map>
#include <string>

using namespace perideal;
using namespace perideal::test;

// The bodies of fracture tests: equal squares, and edges of the right names and lengths.

namespace
{
  /// @param lengths of the boundaries by name [m]
  void expect_squares(const std::string                   &file,
                      const unsigned int                   n_cells,
                      const double                         size,
                      const std::map<std::string, double> &lengths)
  {
    const auto mesh = read<2>(file);
    EXPECT_EQ(mesh->triangulation.n_global_active_cells(), n_cells);
    // Gmsh places vertices to 1e-12 or so.
    for (const auto &cell : mesh->triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          EXPECT_NEAR(cell->measure(), size * size, 1e-10 * size);
          for (const auto &face : cell->face_iterators())
            EXPECT_NEAR(face->measure(), size, 1e-10);
        }
    EXPECT_EQ(mesh->boundary_names.size(), lengths.size());
    for (const auto &[name, length] : lengths)
      EXPECT_NEAR(boundary_measure(*mesh, name), length, 1e-9) << name;
  }
} // namespace

TEST(Specimens, LPanel)
{
  expect_squares(
    "meshes/l_panel.geo",
    1875,
    0.01,
    {{"bottom", 0.25}, {"load", 0.02}, {"left", 0.5}, {"top", 0.5}, {"right", 0.25}, {"inner", 0.48}});
}

TEST(Specimens, NotchedSpecimen)
{
  expect_squares("meshes/notched_specimen.geo",
                 6360,
                 2.5e-3,
                 {{"bottom", 0.2},
                  {"top", 0.2},
                  {"left_lower", 0.0975},
                  {"left_upper", 0.0975},
                  {"right_lower", 0.0975},
                  {"right_upper", 0.0975},
                  {"notches", 0.11}});
}
