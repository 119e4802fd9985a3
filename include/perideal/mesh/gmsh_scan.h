// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_mesh_gmsh_scan_h
#define perideal_mesh_gmsh_scan_h

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace perideal
{
  /// Holds what a Gmsh file contains and deal.II's reader does not return.
  struct GmshContents
  {
    /// Name -> tag of the physical groups of cells (dimension dim).
    std::map<std::string, int> cell_groups;
    /// Name -> tag of the physical groups of boundary faces (dimension dim - 1).
    std::map<std::string, int> face_groups;
    /// Element numbers of the quadrilaterals (2-D) or hexahedra (3-D), in file order.
    std::vector<std::uint64_t> cell_numbers;
    /// Number of boundary faces by physical tag; 0: in no group.
    std::map<int, std::uint64_t> faces_by_tag;
  };

  /**
   * Walks once through the text of a `.msh` file (2.2 or 4.1, ASCII) and
   * refuses, in words the user can act on, what deal.II's reader would take
   * silently or refuse obscurely: other versions, binary files, truncated
   * sections, elements other than linear quadrilaterals and hexahedra, a mesh
   * of another dimension than @p dim, 2-D meshes off the x-y plane.
   *
   * @param filename for messages
   * @throws InputError naming file, line and element.
   */
  GmshContents scan_gmsh(const std::string &text, const std::string &filename, const int dim);
} // namespace perideal

#endif
