// SPDX-License-Identifier: LGPL-2.1-or-later
// Beam of 50 mm in depth in equal squares, about x = 0 (Gregoire, Rojas-Solano and Pijaudier-Cabot 2013, the smallest
// size). "left" and "right" are one square each whose middle is 62.5 mm from that of the beam, "load" the two squares in
// the middle of the upper edge; the ends are half a square longer than 25 mm behind the supports.
DefineConstant[ Rows = 18 ]; // squares over the depth; two more than a multiple of four
h   = 0.05 / Rows;
x[] = {-Ceil(0.0875 / h) * h, -0.0625 - h / 2, -0.0625 + h / 2, -h, h, 0.0625 - h / 2, 0.0625 + h / 2, Ceil(0.0875 / h) * h};
For i In {0 : 7}
  Point(1 + i)  = {x[i], 0, 0};
  Point(11 + i) = {x[i], 0.05, 0};
  Line(31 + i)  = {1 + i, 11 + i};
EndFor
Transfinite Curve {31 : 38} = Rows + 1;
For i In {1 : 7}
  Line(i)      = {i, i + 1};
  Line(10 + i) = {10 + i, 11 + i};
  Transfinite Curve {i, 10 + i} = Round((x[i] - x[i - 1]) / h) + 1;
  Curve Loop(i)    = {i, 31 + i, -(10 + i), -(30 + i)};
  Plane Surface(i) = {i};
EndFor
Transfinite Surface {1 : 7};
Recombine Surface {1 : 7};

Physical Curve("left", 1)   = {2};
Physical Curve("right", 2)  = {6};
Physical Curve("load", 3)   = {14};
Physical Curve("bottom", 4) = {1, 3, 4, 5, 7};
Physical Curve("top", 5)    = {11 : 13, 15 : 17};
Physical Curve("ends", 6)   = {31, 38};
Physical Surface("beam", 7) = {1 : 7};
