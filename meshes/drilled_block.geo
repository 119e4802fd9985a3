// SPDX-License-Identifier: LGPL-2.1-or-later
// A block of 1 x 0.5 x 0.3 m with a bore of 0.24 m along z, by OpenCASCADE: tetrahedra, each divided into four
// hexahedra. Boundaries "left" and "right" are the ends along x.
//
// Size: of the cells before they are divided [m]; around the bore it is finer.

DefineConstant[ Size = 0.15 ];

SetFactory("OpenCASCADE");
Box(1)      = {0, 0, 0, 1, 0.5, 0.3};
Cylinder(2) = {0.5, 0.25, -1, 0, 0, 3, 0.12};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };

left()  = Surface In BoundingBox {-0.01, -1, -1, 0.01, 1, 1};
right() = Surface In BoundingBox {0.99, -1, -1, 1.01, 1, 1};
Physical Surface("left")  = {left()};
Physical Surface("right") = {right()};
Physical Volume("body")   = {3};

Mesh.MeshSizeMax           = Size;
Mesh.MeshSizeFromCurvature = 2.1 / Size;
Mesh.Algorithm3D           = 1;
Mesh.SubdivisionAlgorithm  = 2;
Mesh.MshFileVersion        = 2.2;
