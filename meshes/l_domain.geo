// SPDX-License-Identifier: LGPL-2.1-or-later
// The square [-1, 1] x [-1, 1] m without its quarter x > 0, y < 0: three squares of 4 x 4 cells.
Mesh.RecombineAll = 1;
Mesh.MshFileVersion = 4.1;

Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0};
Point(3) = {1, 1, 0};
Point(4) = {0, 1, 0};
Point(5) = {-1, 1, 0};
Point(6) = {-1, 0, 0};
Point(7) = {-1, -1, 0};
Point(8) = {0, -1, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Line(5) = {4, 5};
Line(6) = {5, 6};
Line(7) = {6, 1};
Line(8) = {6, 7};
Line(9) = {7, 8};
Line(10) = {8, 1};
Curve Loop(1) = {1, 2, 3, 4};
Curve Loop(2) = {-4, 5, 6, 7};
Curve Loop(3) = {-7, 8, 9, 10};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Plane Surface(3) = {3};
Transfinite Curve {1:10} = 5;
Transfinite Surface {1:3};

Physical Curve("corner", 1) = {1, 10};
Physical Curve("rim", 2)    = {2, 3, 5, 6, 8, 9};
Physical Surface("body", 3) = {1:3};
