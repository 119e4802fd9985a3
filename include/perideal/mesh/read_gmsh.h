// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_mesh_read_gmsh_h
#define perideal_mesh_read_gmsh_h

#include <perideal/mesh/coarse_mesh.h>

#include <string>

namespace perideal
{
  /// Fills @p mesh from the text of a `.msh` file.
  /// @param filename for messages
  /// @throws InputError on any text that is not a mesh of quadrilaterals or hexahedra.
  template <int dim>
  void read_gmsh(const std::string &text, const std::string &filename, CoarseMesh<dim> &mesh);
} // namespace perideal

#endif
