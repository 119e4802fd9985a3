// SPDX-License-Identifier: LGPL-2.1-or-later
// A rectangle in quadrilaterals that follow no grid.
DefineConstant[ Left = 0, Bottom = 0, Width = 0.1, Height = 0.2, Size = 0.0025 ]; // corner, sides, cells [m]
// The sizes are those of the triangles before subdivision: cells are half as large.
Mesh.Algorithm               = 6;
Mesh.RecombinationAlgorithm  = 1;
Mesh.SubdivisionAlgorithm    = 1; // quadrilaterals only
Mesh.CharacteristicLengthMin = 2 * Size;
Mesh.CharacteristicLengthMax = 2 * Size;
SetFactory("OpenCASCADE");
Rectangle(1) = {Left, Bottom, 0, Width, Height};
Recombine Surface {1};

Physical Curve("bottom", 1)  = {1};
Physical Curve("right", 2)   = {2};
Physical Curve("top", 3)     = {3};
Physical Curve("left", 4)    = {4};
Physical Surface("plate", 5) = {1};
