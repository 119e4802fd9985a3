// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_mesh_abaqus_deck_h
#define perideal_mesh_abaqus_deck_h

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace perideal
{
  /// An element of an Abaqus input file.
  struct AbaqusElement
  {
    std::uint64_t              number;
    std::vector<std::uint64_t> nodes;
    /// Its line in the file.
    std::size_t line;
  };

  /// Sides of elements that belong to a surface.
  struct AbaqusSides
  {
    std::vector<std::uint64_t> elements;
    /// Abaqus' number, S1 to S6; 0: those that belong to no other element.
    unsigned int side;
  };

  /// A list by names in the order of the file; names differ whatever their letters' size.
  template <typename Entry>
  using AbaqusNames = std::vector<std::pair<std::string, Entry>>;

  /// Holds what an Abaqus input file says of its mesh.
  struct AbaqusDeck
  {
    std::map<std::uint64_t, std::array<double, 3>> nodes;
    /// Elements of one part by their dimension; those of dimension 0 are not kept.
    std::array<std::vector<AbaqusElement>, 4> elements;
    /// Numbers of elements and of nodes, each once.
    AbaqusNames<std::vector<std::uint64_t>> element_sets, node_sets;
    AbaqusNames<std::vector<AbaqusSides>>   surfaces;
    /// Element sets that have a material, by *SOLID SECTION.
    std::vector<std::string> sections;
  };

  /**
   * Reads nodes, elements, sets and surfaces of an input file for Abaqus, whatever else it holds is passed
   * over: one part, in one instance if any, of quadrilaterals CPS4, CPE4, S4, M3D4 and hexahedra C3D8 with
   * all their variants (R, I, H), with lines T2D2, T3D2, B21, B31 or quadrilaterals as faces.
   *
   * @param filename for messages
   * @throws InputError naming file and line, on elements of other kinds, nodes and sets that are not there,
   * and meshes that Abaqus would generate
   */
  AbaqusDeck read_abaqus_deck(const std::string &text, const std::string &filename);
} // namespace perideal

#endif
