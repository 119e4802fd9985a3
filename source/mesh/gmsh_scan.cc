// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/mesh/gmsh_elements.h>
#include <perideal/mesh/gmsh_lines.h>
#include <perideal/mesh/gmsh_scan.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace perideal
{
  namespace
  {
    const std::string conversion = "convert it: gmsh OLD.msh -save -format msh41 -o NEW.msh";

    /// deal.II reads the numbers of nodes and elements as int.
    constexpr std::uint64_t largest_number = std::numeric_limits<int>::max();

    /// One walk through a file.
    class Scan
    {
    public:
      Scan(const std::string &text, const std::string &filename, const int dim)
        : lines(text, filename)
        , dim(dim)
      {
      }

      GmshContents run();

    private:
      void read_format();
      void read_physical_names();
      void read_nodes();
      void read_node();
      void read_elements_2();
      void read_elements_4();
      void add_element(GmshFields &fields, const std::uint64_t number, const int type, const int tag);
      void
      check_total(const std::string &section, const std::uint64_t total, const std::uint64_t count) const;
      void note_unsupported(const GmshElementType *type, const int type_number, const std::uint64_t number);
      void check_order();
      void check_elements() const;

      GmshLines lines;
      const int dim;

      bool is_version_4 = false;
      bool has_nodes    = false;
      bool has_elements = false;
      /// Of the sections that deal.II reads, the first that may come.
      std::ptrdiff_t next_section = 0;
      GmshEntities   tag_of_entity;
      GmshNodes      nodes;
      GmshCells      cells;
      /// Bounding box of the nodes.
      std::array<double, 3> lower, upper;
      /// Number of elements by their dimension, and of quadrilaterals.
      std::array<std::uint64_t, 4> n_elements       = {};
      std::uint64_t                n_quadrilaterals = 0;
      /// The first element that is not supported, in words.
      std::string  unsupported, advice;
      GmshContents contents;
    };

    void Scan::read_format()
    {
      if (!lines.next())
        lines.fail("the mesh file is empty");
      if (lines.line() == "$NOD")
        lines.fail("this is Gmsh's format 1; formats 2.2 and 4.1 are supported", conversion);
      if (lines.line() != "$MeshFormat")
        lines.fail("this is not a Gmsh mesh: it does not begin with $MeshFormat");
      double version = 0;
      int    binary  = 0;
      lines.read("MeshFormat", version, binary);
      if (binary != 0)
        lines.fail("this is a binary .msh file; ASCII is supported",
                   "save it with Mesh.Binary = 0; or " + conversion);
      if (version != 2.2 && version != 4.1)
        lines.fail("this is not a supported version of Gmsh's format; 2.2 and 4.1 are", conversion);
      is_version_4 = version == 4.1;
      lines.expect_end("MeshFormat");
    }

    void Scan::read_physical_names()
    {
      std::uint64_t count = 0;
      lines.read("PhysicalNames", count);
      for (std::uint64_t i = 0; i < count; ++i)
        {
          int dimension = -1, tag = 0;
          lines.read("PhysicalNames", dimension, tag);
          const std::size_t first = lines.line().find('"'), last = lines.line().rfind('"');
          if (first == last)
            lines.fail("a physical name must stand in quotes");
          const std::string name(lines.line().substr(first + 1, last - first - 1));
          if (dimension == dim)
            contents.cell_groups[name] = tag;
          else if (dimension == dim - 1)
            contents.face_groups[name] = tag;
        }
      lines.expect_end("PhysicalNames");
    }

    void Scan::read_node()
    {
      GmshFields    fields(lines.entry("Nodes"));
      std::uint64_t number     = 0;
      bool          understood = is_version_4 || fields.read(number);
      for (int d = 0; d < 3; ++d)
        {
          double x   = 0;
          understood = understood && fields.read(x) && std::isfinite(x);
          lower[d]   = std::min(lower[d], x);
          upper[d]   = std::max(upper[d], x);
        }
      if (!understood || !fields.at_end() || number > largest_number)
        lines.fail_at_entry("Nodes");
      if (!is_version_4)
        nodes.add({number, lines.line_number()});
    }

    void
    Scan::check_total(const std::string &section, const std::uint64_t total, const std::uint64_t count) const
    {
      if (total != count)
        lines.fail("the section $" + section + " announces " + std::to_string(total) +
                     " entries in all (its second number) and its blocks hold " + std::to_string(count),
                   "save the mesh again");
    }

    void Scan::read_nodes()
    {
      lower.fill(std::numeric_limits<double>::max());
      upper.fill(std::numeric_limits<double>::lowest());
      std::uint64_t n_blocks = 1, count = 0, total = 0, smallest = 0, largest = 0;
      if (is_version_4)
        lines.read_all("Nodes", n_blocks, total, smallest, largest);
      else
        lines.read_all("Nodes", count);
      for (std::uint64_t block = 0; block < n_blocks; ++block)
        {
          if (is_version_4)
            {
              int dimension = 0, entity = 0, parametric = 0;
              lines.read_all("Nodes", dimension, entity, parametric, count);
              if (parametric != 0)
                lines.fail("nodes with parametric coordinates are not supported",
                           "save the mesh with Mesh.SaveParametric = 0;");
              for (std::uint64_t i = 0; i < count; ++i)
                {
                  std::uint64_t number = 0;
                  lines.read_all("Nodes", number);
                  if (number > largest_number)
                    lines.fail_at_entry("Nodes");
                  nodes.add({number, lines.line_number()});
                }
            }
          for (std::uint64_t i = 0; i < count; ++i)
            read_node();
        }
      lines.expect_end("Nodes");
      if (is_version_4)
        check_total("Nodes", total, nodes.size());
      nodes.close(lines);
      has_nodes = true;
    }

    void
    Scan::note_unsupported(const GmshElementType *type, const int type_number, const std::uint64_t number)
    {
      if (!unsupported.empty())
        return;
      const std::string kind =
        type == nullptr ? "an element of Gmsh type " + std::to_string(type_number) : "a " + type->name;
      unsupported = "element " + std::to_string(number) + " is " + kind + "; the mesh must consist of " +
                    (dim == 2 ? "quadrilaterals" : "hexahedra") + " with nodes at their corners only";
      advice = advice_against(type, dim);
    }

    void Scan::add_element(GmshFields &fields, const std::uint64_t number, const int type, const int tag)
    {
      const GmshElementType *element = gmsh_element_type(type);
      if (element != nullptr)
        ++n_elements[element->dimension];
      if (element == nullptr || !element->supported)
        {
          note_unsupported(element, type, number);
          return;
        }
      GmshCells::Nodes corners = {};
      const auto       end     = corners.begin() + element->n_nodes;
      bool             fits    = true;
      for (auto node = corners.begin(); node != end; ++node)
        fits = fits && fields.read(*node);
      if (!fits || !fields.at_end())
        lines.fail("element " + std::to_string(number) + ", a " + element->name + ", must have " +
                   std::to_string(element->n_nodes) + " node numbers");
      const auto occurs_before = [&](const auto node) {
        return std::find(corners.begin(), node, *node) != node;
      };
      bool is_collapsed = false;
      for (auto node = corners.begin(); node != end; ++node)
        {
          is_collapsed = is_collapsed || occurs_before(node);
          if (!nodes.has(*node))
            lines.fail("element " + std::to_string(number) + ", a " + element->name +
                         ", has a corner at node " + std::to_string(*node) +
                         ", and the section $Nodes has no such node",
                       "save the mesh again");
        }
      if (is_collapsed)
        lines.fail("element " + std::to_string(number) + ", a " + element->name +
                   ", is collapsed: it has one node at two of its corners");
      if (element->dimension == dim)
        {
          contents.cell_numbers.push_back(number);
          cells.add({number, lines.line_number()}, corners);
        }
      else if (element->dimension == dim - 1)
        ++contents.faces_by_tag[tag];
      n_quadrilaterals += element->name == "quadrilateral" ? 1 : 0;
    }

    void Scan::read_elements_2()
    {
      std::uint64_t count = 0;
      lines.read_all("Elements", count);
      for (std::uint64_t i = 0; i < count; ++i)
        {
          GmshFields    fields(lines.entry("Elements"));
          std::uint64_t number = 0;
          int           type = 0, n_tags = 0, tag = 0, other_tag = 0;
          bool          understood = fields.read(number) && fields.read(type) && fields.read(n_tags);
          for (int t = 0; understood && t < n_tags; ++t)
            understood = fields.read(t == 0 ? tag : other_tag);
          if (!understood || n_tags < 0 || number > largest_number)
            lines.fail_at_entry("Elements");
          if (tag < 0)
            lines.fail("element " + std::to_string(number) + " has a negative physical tag",
                       "number physical groups from 1");
          add_element(fields, number, type, tag);
        }
      lines.expect_end("Elements");
    }

    void Scan::read_elements_4()
    {
      std::uint64_t n_blocks = 0, total = 0, n_read = 0, smallest = 0, largest = 0;
      lines.read_all("Elements", n_blocks, total, smallest, largest);
      for (std::uint64_t block = 0; block < n_blocks; ++block)
        {
          int           dimension = 0, entity = 0, type = 0;
          std::uint64_t count = 0;
          lines.read_all("Elements", dimension, entity, type, count);
          const GmshElementType *element = gmsh_element_type(type);
          if (dimension < 0 || dimension > 3 || (element != nullptr && element->dimension != dimension))
            lines.fail_at_entry("Elements");
          const auto found = tag_of_entity[dimension].find(entity);
          const int  tag   = found == tag_of_entity[dimension].end() ? 0 : found->second;
          for (std::uint64_t i = 0; i < count; ++i)
            {
              GmshFields    fields(lines.entry("Elements"));
              std::uint64_t number = 0;
              if (!fields.read(number) || number > largest_number)
                lines.fail_at_entry("Elements");
              add_element(fields, number, type, tag);
            }
          n_read += count;
        }
      lines.expect_end("Elements");
      check_total("Elements", total, n_read);
    }

    void Scan::check_elements() const
    {
      if (!has_nodes || !has_elements)
        lines.fail(std::string("the file has no section $") + (has_nodes ? "Elements" : "Nodes"));
      if (dim == 2 && n_elements[3] > 0)
        lines.fail("the mesh is three-dimensional, the scene two-dimensional", "set Dimension = 3");
      if (dim == 3 && n_elements[3] == 0 && n_quadrilaterals > 0)
        lines.fail("the mesh is two-dimensional, the scene three-dimensional",
                   "set Dimension = 2, or mesh the volume (gmsh -3) and put it into a physical group");
      if (!unsupported.empty())
        lines.fail(unsupported, advice);
      if (contents.cell_numbers.empty())
        lines.fail(dim == 2 ? "the mesh has no quadrilaterals" : "the mesh has no hexahedra",
                   "Gmsh saves the elements of physical groups only: put the body into one");
      const double extent = std::max(upper[0] - lower[0], upper[1] - lower[1]);
      if (dim == 2 && upper[2] - lower[2] > 1e-9 * extent)
        lines.fail("the mesh is not planar: its nodes differ in z", "draw 2-D bodies in the x-y plane");
    }

    /// deal.II reads the sections in this order only, and none between them.
    void Scan::check_order()
    {
      static const std::array<std::string, 4> order = {
        {"$PhysicalNames", "$Entities", "$Nodes", "$Elements"}};
      const std::string section(lines.line());
      const auto        found    = std::find(order.begin(), order.end(), section) - order.begin();
      const bool        is_known = found < static_cast<std::ptrdiff_t>(order.size());
      if (section.front() == '$' && (is_known ? found < next_section : !has_elements) &&
          section.rfind("$Partitioned", 0) != 0)
        lines.fail(
          "the section " + lines.quoted() +
            " does not belong here: $MeshFormat, $PhysicalNames, $Entities, $Nodes and $Elements stand "
            "once each, in this order",
          "save the mesh again, every mesh in a file of its own");
      if (is_known)
        next_section = found + 1;
    }

    GmshContents Scan::run()
    {
      read_format();
      while (lines.next())
        {
          check_order();
          if (lines.line() == "$PhysicalNames")
            read_physical_names();
          else if (lines.line() == "$Entities")
            tag_of_entity = read_gmsh_entities(lines);
          else if (lines.line() == "$PartitionedEntities")
            lines.fail("the mesh is partitioned", "save it in one part: Mesh.NbPartitions = 0;");
          else if (lines.line() == "$Nodes")
            read_nodes();
          else if (lines.line() == "$Elements")
            {
              is_version_4 ? read_elements_4() : read_elements_2();
              has_elements = true;
            }
          else if (lines.line().front() == '$')
            lines.skip_section();
          else
            lines.fail("expected the beginning of a section, not '" + lines.quoted() + "'");
        }
      check_elements();
      cells.check(lines);
      return std::move(contents);
    }
  } // namespace

  GmshContents scan_gmsh(const std::string &text, const std::string &filename, const int dim)
  {
    return Scan(text, filename, dim).run();
  }
} // namespace perideal
