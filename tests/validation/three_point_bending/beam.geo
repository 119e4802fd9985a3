// SPDX-License-Identifier: LGPL-2.1-or-later
// Beam in equal squares, about x = 0 (Gregoire, Rojas-Solano and Pijaudier-Cabot 2013). "left" and "right" are one square
// each whose middle is 1.25 depths from that of the beam, "load" the two squares in the middle of the upper edge; the ends
// are up to a square longer than 25 mm behind the supports.
DefineConstant[ Depth = 0.05 ]; // 0.05, 0.1, 0.2, 0.4
DefineConstant[ Rows = 18 ];   // squares over the depth; two more than a multiple of four
h   = Depth / Rows;
a   = 1.25 * Depth;
x[] = {-Ceil((a + 0.025) / h) * h, -a - h / 2, -a + h / 2, -h, h, a - h / 2, a + h / 2, Ceil((a + 0.025) / h) * h};
For i In {0 : 7}
  Point(1 + i)  = {x[i], 0, 0};
  Point(11 + i) = {x[i], Depth, 0};
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
