// SPDX-License-Identifier: LGPL-2.1-or-later
// Square plate with a central circular hole, unstructured quadrilaterals.
// The sizes are those of the triangles before subdivision: cells are half as large.
side       = 1;    // [m]
radius     = 0.1;  // [m]
size_hole  = 0.02; // [m]
size_edge  = 0.07; // [m]
Mesh.Algorithm              = 6;
Mesh.RecombinationAlgorithm = 1;
Mesh.RecombineAll           = 1;
Mesh.SubdivisionAlgorithm   = 1; // quadrilaterals only

half = side / 2;
Point(1) = {-half, -half, 0, size_edge};
Point(2) = {half, -half, 0, size_edge};
Point(3) = {half, half, 0, size_edge};
Point(4) = {-half, half, 0, size_edge};
Point(5) = {0, 0, 0, size_hole};
Point(6) = {radius, 0, 0, size_hole};
Point(7) = {0, radius, 0, size_hole};
Point(8) = {-radius, 0, 0, size_hole};
Point(9) = {0, -radius, 0, size_hole};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Circle(5) = {6, 5, 7};
Circle(6) = {7, 5, 8};
Circle(7) = {8, 5, 9};
Circle(8) = {9, 5, 6};
Curve Loop(1) = {1:4};
Curve Loop(2) = {5:8};
Plane Surface(1) = {1, 2};

Physical Curve("left", 1)    = {4};
Physical Curve("right", 2)   = {2};
Physical Curve("bottom", 3)  = {1};
Physical Curve("top", 4)     = {3};
Physical Curve("hole", 5)    = {5:8};
Physical Surface("plate", 6) = {1};
