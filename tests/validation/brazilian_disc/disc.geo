// SPDX-License-Identifier: LGPL-2.1-or-later
// A disc of 150 mm about the origin; "top" and "bottom" are the arcs under strips of 25 mm.
DefineConstant[ Size = 0.00375 ]; // of cells [m]
// The sizes are those of the triangles before subdivision: cells are half as large.
Mesh.Algorithm               = 6;
Mesh.RecombinationAlgorithm  = 1;
Mesh.SubdivisionAlgorithm    = 1; // quadrilaterals only
Mesh.CharacteristicLengthMin = 2 * Size;
Mesh.CharacteristicLengthMax = 2 * Size;
x = 0.0125;
y = Sqrt(0.075 * 0.075 - x * x);
Point(1) = {0, 0, 0};
Point(2) = {x, -y, 0};
Point(3) = {0.075, 0, 0};
Point(4) = {x, y, 0};
Point(5) = {-x, y, 0};
Point(6) = {-0.075, 0, 0};
Point(7) = {-x, -y, 0};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Circle(4) = {5, 1, 6};
Circle(5) = {6, 1, 7};
Circle(6) = {7, 1, 2};
Curve Loop(1)    = {1 : 6};
Plane Surface(1) = {1};
Recombine Surface {1};

Physical Curve("top", 1)    = {3};
Physical Curve("bottom", 2) = {6};
Physical Curve("sides", 3)  = {1, 2, 4, 5};
Physical Surface("disc", 4) = {1};
