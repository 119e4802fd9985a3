// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/mesh/abaqus_lines.h>
#include <perideal/mesh/abaqus_to_gmsh.h>

#include <algorithm>
#include <cstdio>
#include <set>
#include <unordered_map>

namespace perideal
{
  namespace
  {
    using Corners = std::vector<std::uint64_t>;

    /// Sides of a cell by the indices of their corners, in Abaqus' order: S1, S2, ...
    const std::vector<std::vector<unsigned int>> &sides_of_abaqus(const int dim)
    {
      static const std::vector<std::vector<unsigned int>> of_quads = {{0, 1}, {1, 2}, {2, 3}, {3, 0}},
                                                          of_hexes = {{0, 1, 2, 3},
                                                                      {4, 7, 6, 5},
                                                                      {0, 4, 5, 1},
                                                                      {1, 5, 6, 2},
                                                                      {2, 6, 7, 3},
                                                                      {3, 7, 4, 0}};
      return dim == 2 ? of_quads : of_hexes;
    }

    /// A name and what belongs to it, by index.
    struct NamedMembers
    {
      std::string name;
      /// Lists of lower numbers are given their members first.
      unsigned int          priority;
      std::set<std::size_t> members;
    };

    /// Whether Abaqus/CAE made the name, such as _top_S3 for a part of the surface top.
    bool is_internal(const std::string &name)
    {
      return name.front() == '_';
    }

    /// Which group each member is in, 0: none, and the names of the groups.
    struct Partition
    {
      std::vector<unsigned int>                         group_of;
      std::vector<std::pair<std::string, unsigned int>> names;
    };

    /// Makes groups of lists that may share members.
    Partition
    part(std::vector<NamedMembers> lists, const std::size_t n_members, std::vector<std::string> &notes)
    {
      Partition result;
      result.group_of.resize(n_members, 0);
      std::stable_sort(lists.begin(), lists.end(), [](const NamedMembers &a, const NamedMembers &b) {
        return a.priority != b.priority ? a.priority < b.priority : a.members.size() < b.members.size();
      });
      std::vector<const NamedMembers *> groups;
      for (const NamedMembers &list : lists)
        {
          const auto same = std::find_if(
            groups.begin(), groups.end(), [&](const auto *group) { return group->members == list.members; });
          const auto taken =
            std::find_if(list.members.begin(), list.members.end(), [&](const std::size_t member) {
              return result.group_of[member] != 0;
            });
          // The name of a surface may be that of a node set too.
          if (std::any_of(result.names.begin(), result.names.end(), [&](const auto &named) {
                return named.first == list.name;
              }))
            continue;
          if (same != groups.end())
            result.names.emplace_back(list.name, static_cast<unsigned int>(same - groups.begin()) + 1);
          else if (taken != list.members.end())
            notes.push_back("the set " + list.name + " shares members with " +
                            groups[result.group_of[*taken] - 1]->name + " and is no group of its own");
          else
            {
              groups.push_back(&list);
              for (const std::size_t member : list.members)
                result.group_of[member] = groups.size();
              result.names.emplace_back(list.name, static_cast<unsigned int>(groups.size()));
            }
        }
      return result;
    }

    /// Makes the text from the deck.
    class Conversion
    {
    public:
      Conversion(const AbaqusDeck &deck, const std::string &filename, const int dim)
        : deck(deck)
        , filename(filename)
        , cells(deck.elements[dim])
        , dim(dim)
      {
      }

      ConvertedMesh run();

    private:
      /// A side of a cell, the first that has it.
      struct Side
      {
        Corners      corners;
        unsigned int n_cells = 0;
      };

      [[noreturn]] void fail(const std::string &problem, const std::string &advice) const;
      void              check() const;
      void              number_sides();
      std::size_t       side_with(Corners corners) const;

      std::vector<NamedMembers> named_cells() const;
      std::vector<NamedMembers> named_sides() const;
      void                      add_surfaces(std::vector<NamedMembers> &lists) const;
      void                      add_face_elements(std::vector<NamedMembers> &lists) const;
      void                      add_node_sets(std::vector<NamedMembers> &lists) const;
      std::string               write(const Partition &of_cells, const Partition &of_sides) const;

      const AbaqusDeck                              &deck;
      const std::string                             &filename;
      const std::vector<AbaqusElement>              &cells;
      const int                                      dim;
      std::unordered_map<std::uint64_t, std::size_t> index_of_cell;
      std::vector<Side>                              sides;
      std::map<Corners, std::size_t>                 index_of_side;
      /// Of each cell, in Abaqus' order.
      std::vector<std::vector<std::size_t>> sides_of_cell;
    };

    constexpr std::size_t no_side = static_cast<std::size_t>(-1);

    void Conversion::fail(const std::string &problem, const std::string &advice) const
    {
      throw InputError(problem).location(filename).parameter("Mesh/File").hint(advice);
    }

    void Conversion::check() const
    {
      if (dim == 2 && !deck.elements[3].empty())
        fail("the mesh is three-dimensional, the scene two-dimensional", "set Dimension = 3");
      if (dim == 3 && cells.empty() && !deck.elements[2].empty())
        fail("the mesh is two-dimensional, the scene three-dimensional", "set Dimension = 2");
      if (cells.empty())
        fail("the mesh has no elements", "");
      for (const auto &of_dimension : deck.elements)
        for (const AbaqusElement &element : of_dimension)
          for (const std::uint64_t node : element.nodes)
            if (deck.nodes.count(node) == 0)
              throw InputError("element " + std::to_string(element.number) + " has a corner at node " +
                               std::to_string(node) + ", which is not in the file")
                .location(filename + ":" + std::to_string(element.line))
                .parameter("Mesh/File");
    }

    void Conversion::number_sides()
    {
      for (const AbaqusElement &cell : cells)
        {
          index_of_cell[cell.number] = sides_of_cell.size();
          sides_of_cell.emplace_back();
          for (const auto &indices : sides_of_abaqus(dim))
            {
              Corners corners;
              for (const unsigned int k : indices)
                corners.push_back(cell.nodes[k]);
              Corners key = corners;
              std::sort(key.begin(), key.end());
              const std::size_t index = index_of_side.emplace(key, sides.size()).first->second;
              if (index == sides.size())
                sides.push_back({corners, 0});
              ++sides[index].n_cells;
              sides_of_cell.back().push_back(index);
            }
        }
    }

    std::size_t Conversion::side_with(Corners corners) const
    {
      std::sort(corners.begin(), corners.end());
      const auto found = index_of_side.find(corners);
      return found == index_of_side.end() ? no_side : found->second;
    }

    std::vector<NamedMembers> Conversion::named_cells() const
    {
      std::vector<NamedMembers> lists;
      for (const auto &[name, numbers] : deck.element_sets)
        {
          const std::string capitals = in_capitals(name);
          const bool        is_section =
            std::any_of(deck.sections.begin(), deck.sections.end(), [&](const std::string &section) {
              return in_capitals(section) == capitals;
            });
          NamedMembers list{name, is_section ? 0u : 1u, {}};
          for (const std::uint64_t number : numbers)
            if (const auto found = index_of_cell.find(number); found != index_of_cell.end())
              list.members.insert(found->second);
          if (!list.members.empty() && !is_internal(name))
            lists.push_back(list);
        }
      return lists;
    }

    void Conversion::add_surfaces(std::vector<NamedMembers> &lists) const
    {
      for (const auto &[name, parts] : deck.surfaces)
        {
          NamedMembers list{name, 0, {}};
          for (const AbaqusSides &of : parts)
            for (const std::uint64_t number : of.elements)
              if (const auto cell = index_of_cell.find(number); cell != index_of_cell.end())
                {
                  const auto &own = sides_of_cell[cell->second];
                  if (of.side > own.size())
                    fail("the surface " + name + " has the side S" + std::to_string(of.side) +
                           " of element " + std::to_string(number) + ", which has " +
                           std::to_string(own.size()) + " sides",
                         "");
                  for (std::size_t k = 0; k < own.size(); ++k)
                    if (of.side == 0 ? sides[own[k]].n_cells == 1 : k + 1 == of.side)
                      list.members.insert(own[k]);
                }
          if (!list.members.empty() && !is_internal(name))
            lists.push_back(list);
        }
    }

    void Conversion::add_face_elements(std::vector<NamedMembers> &lists) const
    {
      std::unordered_map<std::uint64_t, std::size_t> side_of_element;
      for (const AbaqusElement &face : deck.elements[dim - 1])
        if (const std::size_t side = side_with(face.nodes); side != no_side)
          side_of_element[face.number] = side;
      for (const auto &[name, numbers] : deck.element_sets)
        {
          NamedMembers list{name, 0, {}};
          for (const std::uint64_t number : numbers)
            if (const auto found = side_of_element.find(number); found != side_of_element.end())
              list.members.insert(found->second);
          if (!list.members.empty() && !is_internal(name))
            lists.push_back(list);
        }
    }

    void Conversion::add_node_sets(std::vector<NamedMembers> &lists) const
    {
      for (const auto &[name, numbers] : deck.node_sets)
        {
          const std::set<std::uint64_t> nodes(numbers.begin(), numbers.end());
          NamedMembers                  list{name, 1, {}};
          for (std::size_t k = 0; k < sides.size(); ++k)
            if (sides[k].n_cells == 1 &&
                std::all_of(sides[k].corners.begin(), sides[k].corners.end(), [&](const std::uint64_t node) {
                  return nodes.count(node) > 0;
                }))
              list.members.insert(k);
          if (!list.members.empty() && !is_internal(name))
            lists.push_back(list);
        }
    }

    std::vector<NamedMembers> Conversion::named_sides() const
    {
      std::vector<NamedMembers> lists;
      add_surfaces(lists);
      add_face_elements(lists);
      add_node_sets(lists);
      return lists;
    }

    void append_element(std::string        &text,
                        const std::uint64_t number,
                        const int           type,
                        const unsigned int  group,
                        const Corners      &nodes)
    {
      text += std::to_string(number) + " " + std::to_string(type) + " 2 " + std::to_string(group) + " " +
              std::to_string(std::max(group, 1u));
      for (const std::uint64_t node : nodes)
        text += " " + std::to_string(node);
      text += "\n";
    }

    std::string Conversion::write(const Partition &of_cells, const Partition &of_sides) const
    {
      // Gmsh's numbers of types: line, quadrilateral, hexahedron
      constexpr int type_of_dimension[] = {0, 1, 3, 5};

      std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n" +
                         std::to_string(of_cells.names.size() + of_sides.names.size()) + "\n";
      for (const auto &[partition, dimension] :
           {std::pair<const Partition &, int>(of_cells, dim), {of_sides, dim - 1}})
        for (const auto &[name, group] : partition.names)
          text += std::to_string(dimension) + " " + std::to_string(group) + " \"" + name + "\"\n";
      text += "$EndPhysicalNames\n$Nodes\n";

      std::set<std::uint64_t> used;
      for (const AbaqusElement &cell : cells)
        used.insert(cell.nodes.begin(), cell.nodes.end());
      text += std::to_string(used.size()) + "\n";
      for (const std::uint64_t number : used)
        {
          const auto &x = deck.nodes.at(number);
          char        coordinates[96];
          std::snprintf(coordinates, sizeof(coordinates), " %.17g %.17g %.17g\n", x[0], x[1], x[2]);
          text += std::to_string(number) + coordinates;
        }
      text += "$EndNodes\n$Elements\n";

      std::uint64_t last = 0;
      std::size_t   n    = cells.size();
      for (const AbaqusElement &cell : cells)
        last = std::max(last, cell.number);
      for (const unsigned int group : of_sides.group_of)
        n += group != 0;
      text += std::to_string(n) + "\n";
      for (std::size_t k = 0; k < sides.size(); ++k)
        if (of_sides.group_of[k] != 0)
          append_element(text, ++last, type_of_dimension[dim - 1], of_sides.group_of[k], sides[k].corners);
      for (std::size_t c = 0; c < cells.size(); ++c)
        append_element(text, cells[c].number, type_of_dimension[dim], of_cells.group_of[c], cells[c].nodes);
      return text + "$EndElements\n";
    }

    ConvertedMesh Conversion::run()
    {
      check();
      number_sides();
      ConvertedMesh   result;
      const Partition of_cells = part(named_cells(), cells.size(), result.notes),
                      of_sides = part(named_sides(), sides.size(), result.notes);
      result.text              = write(of_cells, of_sides);
      return result;
    }
  } // namespace

  ConvertedMesh gmsh_of_abaqus(const AbaqusDeck &deck, const std::string &filename, const int dim)
  {
    return Conversion(deck, filename, dim).run();
  }
} // namespace perideal
