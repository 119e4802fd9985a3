// SPDX-License-Identifier: LGPL-2.1-or-later
// Bar of two squares, one behind the other, each a physical group of its own.
cells = 8; // along each side of a square

Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0};
Point(3) = {2, 0, 0};
Point(4) = {2, 1, 0};
Point(5) = {1, 1, 0};
Point(6) = {0, 1, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Line(7) = {2, 5};
Curve Loop(1) = {1, 7, 5, 6};
Curve Loop(2) = {2, 3, 4, -7};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Transfinite Curve {1:7} = cells + 1;
Transfinite Surface {1, 2};
Recombine Surface {1, 2};

Physical Curve("left", 1)    = {6};
Physical Curve("right", 2)   = {3};
Physical Curve("sides", 3)   = {1, 2, 4, 5};
Physical Surface("stiff", 4) = {1};
Physical Surface("soft", 5)  = {2};
