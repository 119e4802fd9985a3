// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_tests_unit_mesh_mesh_test_h
#define perideal_tests_unit_mesh_mesh_test_h

#include "testing.h"

#include <perideal/mesh/create_mesh.h>
#include <perideal/mesh/parent_mesh.h>

#include <deal.II/base/numbers.h>
#include <deal.II/grid/grid_tools.h>

#include <cmath>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <vector>

/// Small meshes as text and their measures.
namespace perideal::test
{
  /// A `.msh` file of format 2.2 from entries; counts are filled in.
  inline std::string msh_22(const std::vector<std::string> &names,
                            const std::vector<std::string> &nodes,
                            const std::vector<std::string> &elements)
  {
    std::ostringstream text;
    text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    const auto section = [&](const std::string &name, const std::vector<std::string> &entries) {
      text << "$" << name << "\n" << entries.size() << "\n";
      for (const std::string &entry : entries)
        text << entry << "\n";
      text << "$End" << name << "\n";
    };
    if (!names.empty())
      section("PhysicalNames", names);
    section("Nodes", nodes);
    section("Elements", elements);
    return text.str();
  }

  /// Corners of two unit squares side by side, [0,2] x [0,1]: 4 3 6 above 1 2 5.
  inline const std::vector<std::string> two_squares = {
    "1 0 0 0", "2 1 0 0", "3 1 1 0", "4 0 1 0", "5 2 0 0", "6 2 1 0"};

  /// Corners of a unit cube, the lower four counter-clockwise, then the upper.
  inline const std::vector<std::string> cube = {
    "1 0 0 0", "2 1 0 0", "3 1 1 0", "4 0 1 0", "5 0 0 1", "6 1 0 1", "7 1 1 1", "8 0 1 1"};

  /// Area of the unit plate without the polygon of n corners on the circle of radius 0.1.
  inline double plate_area(const unsigned int n)
  {
    return 1. - n / 2. * 0.01 * std::sin(2 * dealii::numbers::PI / n);
  }

  template <int dim>
  std::unique_ptr<Mesh<dim>> generate(const std::string               &generator,
                                      const std::vector<unsigned int> &cells,
                                      const std::vector<double>       &size        = {},
                                      const unsigned int               refinements = 0)
  {
    MeshParameters parameters;
    parameters.generator   = generator;
    parameters.cells       = cells;
    parameters.size        = size;
    parameters.refinements = refinements;
    return create_mesh<dim>(parameters, MPI_COMM_WORLD, "");
  }

  template <int dim>
  std::unique_ptr<Mesh<dim>> read(const std::string &path)
  {
    MeshParameters parameters;
    parameters.file = path;
    return create_mesh<dim>(parameters, MPI_COMM_WORLD, "");
  }

  /// Area or volume of all ranks' cells.
  template <int dim>
  double measure(const dealii::Triangulation<dim> &triangulation)
  {
    double sum = 0;
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        sum += cell->measure();
    return dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD);
  }

  /// Length or area of the faces of one boundary.
  template <int dim>
  double boundary_measure(const Mesh<dim> &mesh, const std::string &name)
  {
    const dealii::types::boundary_id id  = mesh.boundary_id(name, "test");
    double                           sum = 0;
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary() && face->boundary_id() == id)
            sum += face->measure();
    return dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD);
  }

  /// Of every own cell, the parent or the cell itself is an own active cell of
  /// the parent mesh, and nothing else is in it.
  template <int dim>
  void expect_parents_of_all_cells(const Mesh<dim> &mesh, const BondPredicate<dim> &is_cut = {})
  {
    ASSERT_TRUE(has_parents(mesh));
    const auto               parents = create_parent_mesh(mesh, is_cut);
    std::set<dealii::CellId> found;
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          auto id = cell->id();
          if (cell->level() > 0 && parents->create_cell_iterator(cell->parent()->id())->is_active())
            id = cell->parent()->id();
          const auto parent = parents->create_cell_iterator(id);
          ASSERT_TRUE(parent->is_active());
          ASSERT_FALSE(parent->is_artificial());
          EXPECT_TRUE(parent->is_locally_owned());
          EXPECT_EQ(parent->material_id(), cell->material_id());
          found.insert(id);
        }
    std::uint64_t n_owned = 0;
    for (const auto &cell : parents->active_cell_iterators())
      n_owned += cell->is_locally_owned() ? 1 : 0;
    EXPECT_EQ(found.size(), n_owned);
    EXPECT_LT(parents->n_global_active_cells(), mesh.triangulation.n_global_active_cells());
    EXPECT_LE(n_parent_cells(mesh), parents->n_global_active_cells());
  }
} // namespace perideal::test

#endif
