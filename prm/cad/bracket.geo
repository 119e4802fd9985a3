// SPDX-License-Identifier: LGPL-2.1-or-later
// The angle bracket of the assembly as1-tu-203.stp, which comes with Gmsh (cad.md tells from where), by divided
// tetrahedra. In millimetres. Boundaries: "bolts" are the bores in the foot, "rod" is the bore in the wall.
//
// Size: of the tetrahedra before they are divided [mm]; cells are half as large.
DefineConstant[ Size = 8 ];

SetFactory("OpenCASCADE");
Geometry.OCCTargetUnit = "MM";
parts() = ShapeFromFile("as1-tu-203.stp");
bracket = parts(9);
For i In {0 : #parts() - 1}
  If (parts(i) != bracket)
    Recursive Delete { Volume{parts(i)}; }
  EndIf
EndFor

// Faces by a box about them: numbers change with the program that wrote the file.
bolts() = Surface In BoundingBox {14, 50, 19, 61, 100, 31};
rod()   = Surface In BoundingBox {4, 69, 49, 16, 81, 71};
Physical Surface("bolts")  = {bolts()};
Physical Surface("rod")    = {rod()};
Physical Volume("bracket") = {bracket};

Mesh.MeshSizeMax           = Size;
Mesh.MeshSizeFromCurvature = 12; // tetrahedra round a bore
Mesh.Algorithm3D           = 1;
Mesh.Optimize              = 1;
Mesh.SubdivisionAlgorithm  = 2;  // each tetrahedron becomes four hexahedra
Mesh.SecondOrderLinear     = 1;  // whose new corners stay on straight edges, lest they fold
Mesh.MshFileVersion        = 2.2;
