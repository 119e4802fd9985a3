// SPDX-License-Identifier: LGPL-2.1-or-later
// Small block of hexahedra: unstructured quadrilaterals, extruded in layers.
length = 2;   // x [m]
width  = 1;   // y [m]
height = 1;   // z [m]
size   = 0.4; // [m], of the triangles before subdivision
layers = 5;
Mesh.Algorithm              = 6;
Mesh.RecombinationAlgorithm = 1;
Mesh.RecombineAll           = 1;
Mesh.SubdivisionAlgorithm   = 1; // quadrilaterals only

Point(1) = {0, 0, 0, size};
Point(2) = {length, 0, 0, size};
Point(3) = {length, width, 0, size};
Point(4) = {0, width, 0, size};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
// extruded[]: top surface, volume, then the sides in the order of the curves
extruded[] = Extrude {0, 0, height} { Surface{1}; Layers{layers}; Recombine; };

Physical Surface("left", 1)   = {extruded[5]};
Physical Surface("right", 2)  = {extruded[3]};
Physical Surface("bottom", 3) = {extruded[2]};
Physical Surface("top", 4)    = {extruded[4]};
Physical Surface("back", 5)   = {1};
Physical Surface("front", 6)  = {extruded[0]};
Physical Volume("block", 7)   = {extruded[1]};
