// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_mesh_gmsh_inner_faces_h
#define perideal_mesh_gmsh_inner_faces_h

#include <deal.II/base/point.h>

#include <map>
#include <string>
#include <vector>

namespace perideal
{
  /// Holds the faces of a `.msh` file that lie between two cells.
  struct GmshInnerFaces
  {
    /// Corners around each face [m] by its physical tag; what is in no group is left out.
    std::map<int, std::vector<std::vector<dealii::Point<3>>>> by_tag;
    /// The file without any of them.
    std::string text;
  };

  /**
   * Removes the faces inside the body from a file, since deal.II refuses such a file.
   *
   * @param text as scan_gmsh() has accepted it
   * @param filename for messages
   * @param names of the physical groups of faces with their tags, for messages
   * @throws InputError on a physical group that lies partly inside the body and partly on its surface.
   */
  GmshInnerFaces take_out_inner_faces(const std::string                &text,
                                      const std::string                &filename,
                                      const int                         dim,
                                      const std::map<std::string, int> &names);
} // namespace perideal

#endif
