// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_mesh_abaqus_to_gmsh_h
#define perideal_mesh_abaqus_to_gmsh_h

#include <perideal/mesh/abaqus_deck.h>

#include <string>
#include <vector>

namespace perideal
{
  /// A mesh in Gmsh's format 2.2, with what it does not take over.
  struct ConvertedMesh
  {
    std::string text;
    /// What the user should know of sets that became no groups, one line each.
    std::vector<std::string> notes;
  };

  /**
   * Writes the mesh of an Abaqus input file in Gmsh's format 2.2, its names kept: element sets become
   * physical groups of cells, surfaces, sets of elements that are faces, and node sets groups of faces. A
   * node set has the faces on the surface all of whose nodes it holds; one without any is no group. Names
   * that begin with _ are left out.
   *
   * A cell or face is in one group. Sets with the same members are names of one group. Of sets that share
   * some members the smaller is a group and the larger is noted; those of *SOLID SECTION go before other
   * element sets, surfaces before node sets.
   *
   * @param filename for messages
   * @throws InputError where there are no cells of this dimension, or an element has a node that is not there
   */
  ConvertedMesh gmsh_of_abaqus(const AbaqusDeck &deck, const std::string &filename, const int dim);
} // namespace perideal

#endif
