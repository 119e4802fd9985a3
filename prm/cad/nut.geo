// SPDX-License-Identifier: LGPL-2.1-or-later
// The hexagon nut of component8.step, which comes with Gmsh (cad.md tells from where), by divided tetrahedra. In
// millimetres. Boundaries: "seat" is the ring on which it sits, "bore" the wall of the bore.
//
// Size: of the tetrahedra before they are divided [mm]; cells are half as large.
DefineConstant[ Size = 5 ];

SetFactory("OpenCASCADE");
Geometry.OCCTargetUnit = "MM";
nut() = ShapeFromFile("component8.step");

seat() = Surface In BoundingBox {-17, 188, -17, 17, 189, 17};
bore() = Surface In BoundingBox {-10, 156, -10, 10, 188, 10};
Physical Surface("seat") = {seat()};
Physical Surface("bore") = {bore()};
Physical Volume("nut")   = {nut()};

Mesh.MeshSizeMax           = Size;
Mesh.MeshSizeFromCurvature = 12; // tetrahedra round the bore
Mesh.Algorithm3D           = 1;
Mesh.Optimize              = 1;
Mesh.SubdivisionAlgorithm  = 2;  // each tetrahedron becomes four hexahedra
Mesh.SecondOrderLinear     = 1;  // whose new corners stay on straight edges, lest they fold
Mesh.MshFileVersion        = 2.2;
