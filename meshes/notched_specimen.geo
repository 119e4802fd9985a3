// SPDX-License-Identifier: LGPL-2.1-or-later
// Square of 200 mm x 200 mm in equal squares with two notches, 25 mm long and 5 mm high, at half its height
// (Nooru-Mohamed, Schlangen and van Mier 1993); left and right edge by what is above and below them.
DefineConstant[ Size = 2.5e-3 ]; // of the squares [m]; divides 2.5 mm. 6,360 of them
x[] = {0, 0.025, 0.175, 0.2};
y[] = {0, 0.0975, 0.1025, 0.2};

// Points 10 j + i + 1; curves 100 + 10 j + i along x and 200 + 10 j + i along y, from the point i, j on; surfaces
// 10 j + i + 1. The notches are the blocks 0, 1 and 2, 1.
For j In {0 : 3}
  For i In {0 : 3}
    Point(10 * j + i + 1) = {x[i], y[j], 0};
  EndFor
EndFor
For j In {0 : 3}
  For i In {0 : 3}
    p = 10 * j + i;
    If (i < 3)
      Line(100 + p) = {p + 1, p + 2};
      Transfinite Curve {100 + p} = Round((x[i + 1] - x[i]) / Size) + 1;
    EndIf
    If (j < 3 && !(j == 1 && (i == 0 || i == 3)))
      Line(200 + p) = {p + 1, p + 11};
      Transfinite Curve {200 + p} = Round((y[j + 1] - y[j]) / Size) + 1;
    EndIf
  EndFor
EndFor
For j In {0 : 2}
  For i In {0 : 2}
    p = 10 * j + i;
    If (!(j == 1 && i != 1))
      Curve Loop(p + 1)    = {100 + p, 201 + p, -(110 + p), -(200 + p)};
      Plane Surface(p + 1) = {p + 1};
    EndIf
  EndFor
EndFor
surfaces[] = Surface{:};
Transfinite Surface {surfaces[]};
Recombine Surface {surfaces[]};

Physical Curve("bottom", 1)      = {100 : 102};
Physical Curve("top", 2)         = {130 : 132};
Physical Curve("left_lower", 3)  = {200};
Physical Curve("left_upper", 4)  = {220};
Physical Curve("right_lower", 5) = {203};
Physical Curve("right_upper", 6) = {223};
Physical Curve("notches", 7)     = {110, 112, 120, 122, 211, 212};
Physical Surface("specimen", 8)  = {surfaces[]};
