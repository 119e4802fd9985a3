// SPDX-License-Identifier: LGPL-2.1-or-later
// L-shaped panel of 500 mm x 500 mm in equal squares, without its lower right quarter (Winkler, Hofstetter and
// Lehar 2004): the leg stands on "bottom", the arm is pushed up at "load", 20 mm of its lower edge about the
// point 30 mm from its free end.
DefineConstant[ Size = 0.01 ]; // of the squares [m]; divides 10 mm. 1,875 of them; other than that: -setnumber Size 5e-3
x[] = {0, 0.25, 0.46, 0.48, 0.5};

// the foot, and the lower and upper edge of the arm and what it stands on
Point(1) = {0, 0, 0};
Point(2) = {0.25, 0, 0};
For i In {0 : 4}
  Point(11 + i) = {x[i], 0.25, 0};
  Point(21 + i) = {x[i], 0.5, 0};
  Line(31 + i)  = {11 + i, 21 + i};
EndFor
Line(1) = {1, 2};
Line(2) = {2, 12};
Line(3) = {1, 11};
For i In {1 : 4}
  Line(10 + i) = {10 + i, 11 + i};
  Line(20 + i) = {20 + i, 21 + i};
  Transfinite Curve {10 + i, 20 + i} = Round((x[i] - x[i - 1]) / Size) + 1;
  Curve Loop(1 + i)    = {10 + i, 31 + i, -(20 + i), -(30 + i)};
  Plane Surface(1 + i) = {1 + i};
EndFor
Curve Loop(1)    = {1, 2, -11, -3};
Plane Surface(1) = {1};
Transfinite Curve {1, 2, 3, 31 : 35} = Round(0.25 / Size) + 1;
Transfinite Surface {1 : 5};
Recombine Surface {1 : 5};

Physical Curve("bottom", 1)  = {1};
Physical Curve("load", 2)    = {13};
Physical Curve("left", 3)    = {3, 31};
Physical Curve("top", 4)     = {21 : 24};
Physical Curve("right", 5)   = {35};
Physical Curve("inner", 6)   = {2, 12, 14};
Physical Surface("panel", 7) = {1 : 5};
