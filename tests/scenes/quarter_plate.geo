// SPDX-License-Identifier: LGPL-2.1-or-later
// A quarter of a plate of 2 x 2 m with a hole of 0.4 m, turned by an angle about the middle of the hole.
If (!Exists(angle))
  angle = 0;
EndIf
radius = 0.2;
c = Cos(angle);
s = Sin(angle);
h = Sqrt(0.5);
Point(1) = {radius*c, radius*s, 0};
Point(2) = {c, s, 0};
Point(3) = {c - s, s + c, 0};
Point(4) = {-s, c, 0};
Point(5) = {-radius*s, radius*c, 0};
Point(6) = {radius*h*(c - s), radius*h*(s + c), 0};
Point(7) = {0, 0, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Circle(5) = {5, 7, 6};
Circle(6) = {6, 7, 1};
Line(7) = {6, 3};
Curve Loop(1) = {1, 2, -7, 6};
Plane Surface(1) = {1};
Curve Loop(2) = {7, 3, 4, 5};
Plane Surface(2) = {2};
Transfinite Curve {1, 7, 4} = 9;
Transfinite Curve {2, 3, 5, 6} = 7;
Transfinite Surface {1, 2};
Recombine Surface {1, 2};
Physical Curve("bottom") = {1};
Physical Curve("right") = {2};
Physical Curve("top") = {3};
Physical Curve("left") = {4};
Physical Curve("hole") = {5, 6};
Physical Surface("plate") = {1, 2};
