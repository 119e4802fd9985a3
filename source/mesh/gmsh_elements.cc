// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/mesh/gmsh_elements.h>

#include <algorithm>
#include <numeric>

namespace perideal
{
  const GmshElementType *gmsh_element_type(const int number)
  {
    // Gmsh reference manual, section "MSH file format"
    static const std::vector<GmshElementType> types = {{1, "line", 1, 2, true},
                                                       {2, "triangle", 2, 3, false},
                                                       {3, "quadrilateral", 2, 4, true},
                                                       {4, "tetrahedron", 3, 4, false},
                                                       {5, "hexahedron", 3, 8, true},
                                                       {6, "prism", 3, 6, false},
                                                       {7, "pyramid", 3, 5, false},
                                                       {8, "second-order line", 1, 3, false},
                                                       {9, "second-order triangle", 2, 6, false},
                                                       {10, "second-order quadrilateral", 2, 9, false},
                                                       {11, "second-order tetrahedron", 3, 10, false},
                                                       {12, "second-order hexahedron", 3, 27, false},
                                                       {13, "second-order prism", 3, 18, false},
                                                       {14, "second-order pyramid", 3, 14, false},
                                                       {15, "point", 0, 1, true},
                                                       {16, "second-order quadrilateral", 2, 8, false},
                                                       {17, "second-order hexahedron", 3, 20, false},
                                                       {18, "second-order prism", 3, 15, false},
                                                       {19, "second-order pyramid", 3, 13, false}};
    for (const GmshElementType &type : types)
      if (type.number == number)
        return &type;
    return nullptr;
  }

  std::string advice_against(const GmshElementType *type, const int dim)
  {
    if (type == nullptr || type->name.rfind("second-order", 0) == 0)
      return "save elements of first order: Mesh.ElementOrder = 1; in the .geo file";
    if (dim == 2)
      return "recombine all triangles into quadrilaterals: Mesh.RecombineAll = 1; "
             "Mesh.SubdivisionAlgorithm = 1; in the .geo file";
    return "mesh with hexahedra only: Transfinite Volume, or Extrude {...} {...; Layers {n}; Recombine;} of "
           "a "
           "surface with Mesh.RecombineAll = 1; or Mesh.SubdivisionAlgorithm = 2; in the .geo file";
  }

  void GmshNodes::close(const GmshLines &lines)
  {
    std::sort(nodes.begin(), nodes.end(), [](const GmshEntry &a, const GmshEntry &b) {
      return a.number != b.number ? a.number < b.number : a.line < b.line;
    });
    const auto twice =
      std::adjacent_find(nodes.begin(), nodes.end(), [](const GmshEntry &a, const GmshEntry &b) {
        return a.number == b.number;
      });
    if (twice != nodes.end())
      lines.fail_at(twice[1].line,
                    "the node number " + std::to_string(twice[1].number) +
                      " is given twice, before in line " + std::to_string(twice[0].line),
                    "save the mesh again, or give every node a number of its own");
  }

  bool GmshNodes::has(const std::uint64_t number) const
  {
    if (nodes.empty() || number < nodes.front().number || number > nodes.back().number)
      return false;
    // mostly the numbers have no gaps
    const std::uint64_t index = number - nodes.front().number;
    if (index < nodes.size() && nodes[index].number == number)
      return true;
    const auto found = std::lower_bound(
      nodes.begin(), nodes.end(), number, [](const GmshEntry &node, const std::uint64_t wanted) {
        return node.number < wanted;
      });
    return found->number == number;
  }

  void GmshCells::add(const GmshEntry &cell, Nodes nodes_of_cell)
  {
    std::sort(nodes_of_cell.begin(), nodes_of_cell.end());
    cells.push_back(cell);
    nodes.push_back(nodes_of_cell);
  }

  void GmshCells::check(const GmshLines &lines) const
  {
    std::vector<std::size_t> order(cells.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](const std::size_t a, const std::size_t b) {
      return nodes[a] != nodes[b] ? nodes[a] < nodes[b] : a < b;
    });
    const auto twice =
      std::adjacent_find(order.begin(), order.end(), [&](const std::size_t a, const std::size_t b) {
        return nodes[a] == nodes[b];
      });
    if (twice == order.end())
      return;
    const GmshEntry &first = cells[twice[0]], &second = cells[twice[1]];
    lines.fail_at(second.line,
                  "elements " + std::to_string(first.number) + " (line " + std::to_string(first.line) +
                    ") and " + std::to_string(second.number) +
                    " lie on one another: they have the same nodes",
                  "is a surface (in 3-D a volume) in two physical groups, or drawn twice? Coherence; in "
                  "the .geo file unites duplicates");
  }

  GmshEntities read_gmsh_entities(GmshLines &lines)
  {
    static const std::array<std::string, 4> kinds = {{"point ", "curve ", "surface ", "volume "}};
    GmshEntities                            tags;
    std::array<std::uint64_t, 4>            counts = {};
    lines.read_all("Entities", counts[0], counts[1], counts[2], counts[3]);
    for (int d = 0; d < 4; ++d)
      for (std::uint64_t i = 0; i < counts[d]; ++i)
        {
          GmshFields fields(lines.entry("Entities"));
          // a point is described by its position, the others by a bounding box
          const int n_coordinates = d == 0 ? 3 : 6;
          double    coordinate    = 0;
          int       entity = 0, n_tags = 0, tag = 0;
          bool      understood = fields.read(entity);
          for (int c = 0; c < n_coordinates; ++c)
            understood = understood && fields.read(coordinate);
          if (!(understood && fields.read(n_tags) && n_tags >= 0 && (n_tags == 0 || fields.read(tag))))
            lines.fail_at_entry("Entities");
          if (n_tags > 1)
            lines.fail(kinds[d] + std::to_string(entity) + " is in more than one physical group",
                       "put every point, curve, surface and volume into one physical group at most");
          if (tag < 0)
            lines.fail(kinds[d] + std::to_string(entity) + " has a negative physical tag",
                       "name it without a minus sign in its physical group");
          std::uint64_t n_bounds = 0;
          int           bound    = 0;
          bool          bounded  = d == 0 || fields.read(n_bounds);
          for (std::uint64_t b = 0; bounded && b < n_bounds; ++b)
            bounded = fields.read(bound);
          if (!bounded || !fields.at_end())
            lines.fail_at_entry("Entities");
          tags[d][entity] = tag;
        }
    lines.expect_end("Entities");
    return tags;
  }
} // namespace perideal
