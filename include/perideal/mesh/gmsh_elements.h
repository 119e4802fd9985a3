// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_mesh_gmsh_elements_h
#define perideal_mesh_gmsh_elements_h

#include <perideal/mesh/gmsh_lines.h>

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace perideal
{
  /// An element type of Gmsh, by its number in `.msh` files.
  struct GmshElementType
  {
    int         number;
    std::string name;
    int         dimension;
    int         n_nodes;
    /// Points, lines, quadrilaterals and hexahedra with nodes at their corners only.
    bool supported;
  };

  /// The type of a number; nullptr where Gmsh has it for rare elements only
  /// (third and higher order).
  const GmshElementType *gmsh_element_type(const int number);

  /// What to write into a `.geo` file so that elements of this type do not
  /// come up in a mesh of @p dim dimensions; @p type may be null.
  std::string advice_against(const GmshElementType *type, const int dim);

  /// A node or an element of a file: its number and the line that it stands in.
  struct GmshEntry
  {
    std::uint64_t number;
    std::size_t   line;
  };

  /// The numbers of the nodes of a file.
  class GmshNodes
  {
  public:
    void add(const GmshEntry &node) { nodes.push_back(node); }

    /// Ends the list.
    /// @throws InputError when a number stands in it twice.
    void close(const GmshLines &lines);

    /// Whether a node of the closed list has this number.
    bool has(const std::uint64_t number) const;

    std::uint64_t size() const { return nodes.size(); }

  private:
    std::vector<GmshEntry> nodes;
  };

  /// The cells of a file by their nodes.
  class GmshCells
  {
  public:
    /// Of the supported types, hexahedra have most nodes; unused ones are 0.
    using Nodes = std::array<std::uint64_t, 8>;

    void add(const GmshEntry &cell, Nodes nodes);

    /// deal.II does not return from a mesh with a cell that is listed twice.
    /// @throws InputError when two cells have the same nodes in whatever order.
    void check(const GmshLines &lines) const;

  private:
    std::vector<GmshEntry> cells;
    /// Those of each cell, sorted.
    std::vector<Nodes> nodes;
  };

  /// The physical tag of points, curves, surfaces and volumes by their number.
  using GmshEntities = std::array<std::map<int, int>, 4>;

  /// Format 4.1: reads the section $Entities, which begins in the present line.
  /// deal.II reads negative tags as huge ones and stops at a second tag.
  /// @throws InputError on these, and on entries that are not understood.
  GmshEntities read_gmsh_entities(GmshLines &lines);
} // namespace perideal

#endif
