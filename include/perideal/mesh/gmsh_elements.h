// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_mesh_gmsh_elements_h
#define perideal_mesh_gmsh_elements_h

#include <string>

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
} // namespace perideal

#endif
