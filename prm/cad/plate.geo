// SPDX-License-Identifier: LGPL-2.1-or-later
// The base plate with six bores of the assembly as1-tu-203.stp, which comes with Gmsh (cad.md tells from where), by
// divided tetrahedra. In millimetres. Boundaries: "left" and "right" are the bores about either bracket.
//
// Size: of the tetrahedra before they are divided [mm]; cells are half as large.
DefineConstant[ Size = 20 ];

SetFactory("OpenCASCADE");
Geometry.OCCTargetUnit = "MM";
parts() = ShapeFromFile("as1-tu-203.stp");
plate   = parts(10);
For i In {0 : #parts() - 1}
  If (parts(i) != plate)
    Recursive Delete { Volume{parts(i)}; }
  EndIf
EndFor

left()  = Surface In BoundingBox {15, 45, -1, 60, 105, 21};
right() = Surface In BoundingBox {120, 45, -1, 165, 105, 21};
Physical Surface("left")  = {left()};
Physical Surface("right") = {right()};
Physical Volume("plate")  = {plate};

Mesh.MeshSizeMax           = Size;
Mesh.MeshSizeFromCurvature = 8; // tetrahedra round a bore
Mesh.Algorithm3D           = 1;
Mesh.Optimize              = 1;
Mesh.SubdivisionAlgorithm  = 2; // each tetrahedron becomes four hexahedra
Mesh.SecondOrderLinear     = 1; // whose new corners stay on straight edges, lest they fold
Mesh.MshFileVersion        = 2.2;
