// SPDX-License-Identifier: LGPL-2.1-or-later
// A plate of 100 mm x 200 mm in equal squares, struck on its left edge between y = 75 mm and 125 mm.
size = 0.0025; // of the squares [m]; divides 25 mm
nx   = Round(0.1 / size);

Point(1) = {0, 0, 0};
Point(2) = {0, 0.075, 0};
Point(3) = {0, 0.125, 0};
Point(4) = {0, 0.2, 0};
Point(5) = {0.1, 0, 0};
Point(6) = {0.1, 0.075, 0};
Point(7) = {0.1, 0.125, 0};
Point(8) = {0.1, 0.2, 0};
For k In {1 : 3}
  Line(k)      = {k, k + 1};
  Line(10 + k) = {k + 4, k + 5};
EndFor
For k In {1 : 4}
  Line(20 + k) = {k, k + 4};
EndFor
For k In {1 : 3}
  Curve Loop(k)    = {20 + k, 10 + k, -(21 + k), -k};
  Plane Surface(k) = {k};
EndFor
Transfinite Curve {1, 3, 11, 13} = Round(0.075 / size) + 1;
Transfinite Curve {2, 12}        = Round(0.05 / size) + 1;
Transfinite Curve {21 : 24}      = nx + 1;
Transfinite Surface {1 : 3};
Recombine Surface {1 : 3};

Physical Curve("impact", 1) = {2};
Physical Curve("free", 2)   = {1, 3, 11, 12, 13, 21, 24};
Physical Surface("plate", 3) = {1 : 3};
