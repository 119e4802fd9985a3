// SPDX-License-Identifier: LGPL-2.1-or-later
// Unit square of 20 x 20 quadrilaterals that grow from the lower left corner, each by 3 % in either direction:
// the largest has three times the area of the smallest.
Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0};
Point(3) = {1, 1, 0};
Point(4) = {0, 1, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {4, 3};
Line(4) = {1, 4};
Transfinite Curve {1, 2, 3, 4} = 21 Using Progression 1.03;
Curve Loop(1) = {1, 2, -3, -4};
Plane Surface(1) = {1};
Transfinite Surface {1};
Recombine Surface {1};
Physical Curve("edges") = {1, 2, 3, 4};
Physical Surface("plate") = {1};
