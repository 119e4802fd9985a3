// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/mesh/gmsh_elements.h>

#include <vector>

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
} // namespace perideal
