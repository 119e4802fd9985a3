// SPDX-License-Identifier: LGPL-2.1-or-later
// A plate 80 mm long and 40 mm high; the left half of its middle line is a physical curve.
cells = 20; // across half of the length and across half of the height

Point(1) = {0, 0, 0};
Point(2) = {0.04, 0, 0};
Point(3) = {0.08, 0, 0};
Point(4) = {0, 0.02, 0};
Point(5) = {0.04, 0.02, 0};
Point(6) = {0.08, 0.02, 0};
Point(7) = {0, 0.04, 0};
Point(8) = {0.04, 0.04, 0};
Point(9) = {0.08, 0.04, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {4, 5};
Line(4) = {5, 6};
Line(5) = {7, 8};
Line(6) = {8, 9};
Line(7) = {1, 4};
Line(8) = {2, 5};
Line(9) = {3, 6};
Line(10) = {4, 7};
Line(11) = {5, 8};
Line(12) = {6, 9};
Curve Loop(1) = {1, 8, -3, -7};
Curve Loop(2) = {2, 9, -4, -8};
Curve Loop(3) = {3, 11, -5, -10};
Curve Loop(4) = {4, 12, -6, -11};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Plane Surface(3) = {3};
Plane Surface(4) = {4};
Transfinite Curve {1:6}  = cells + 1;
Transfinite Curve {7:12} = cells / 2 + 1;
Transfinite Surface {1:4};
Recombine Surface {1:4};

Physical Curve("top", 1)    = {5, 6};
Physical Curve("bottom", 2) = {1, 2};
Physical Curve("crack", 3)  = {3};
Physical Surface("body", 4) = {1:4};
