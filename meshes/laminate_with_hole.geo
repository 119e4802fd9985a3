// SPDX-License-Identifier: LGPL-2.1-or-later
// Plate of 150 mm x 50 mm about the origin with a circular hole of 20 mm: an O-grid of eight blocks in a square of
// 30 mm around the hole, equal squares elsewhere; 7,440 quadrilaterals at 1 mm. The square is as small as it is
// because the circle is divided like the square's sides: the farther away these are, the narrower its cells.
DefineConstant[ Size = 1e-3 ]; // of the squares [m]; divides 5 mm. Other than that: -setnumber Size 5e-4
length = 0.15;
width  = 0.05;
radius = 0.01;
half   = 0.015; // of the square
growth = 1.3;   // of the cell size, from the hole to the square

around = Round(half / Size);       // cells, of each of the eight arcs
radial = Round(0.007 / Size);      // from the circle to the square
beside = Round((length / 2 - half) / Size);
above  = Round((width / 2 - half) / Size);

Point(1) = {0, 0, 0};
// circle and square, counter-clockwise from the x axis in steps of 45 degrees
square_x[] = {half, half, 0, -half, -half, -half, 0, half};
square_y[] = {0, half, half, half, 0, -half, -half, -half};
For b In {0:7}
  Point(10 + b) = {radius * Cos(b * Pi / 4), radius * Sin(b * Pi / 4), 0};
  Point(20 + b) = {square_x[b], square_y[b], 0};
  Line(30 + b)  = {10 + b, 20 + b};
EndFor
For b In {0:7}
  next = (b + 1) % 8;
  Circle(10 + b) = {10 + b, 1, 10 + next};
  Line(20 + b)   = {20 + b, 20 + next};
  Transfinite Curve {30 + b}         = radial + 1 Using Progression growth^(1 / radial);
  Transfinite Curve {10 + b, 20 + b} = around + 1;
EndFor
For b In {0:7}
  next = (b + 1) % 8;
  Curve Loop(b + 1)    = {30 + b, 20 + b, -(30 + next), -(10 + b)};
  Plane Surface(b + 1) = {b + 1};
EndFor

// The rest: lines x = const between y = -width/2, -half, 0, half, width/2, those of the square left out.
x[] = {-length / 2, -half, 0, half, length / 2};
y[] = {-width / 2, -half, 0, half, width / 2};
nx[] = {beside, around, around, beside};
ny[] = {above, around, around, above};
// Points 40 + 5 i + j; on the square they exist.
For i In {0:4}
  For j In {0:4}
    point[5 * i + j] = 40 + 5 * i + j;
    If (i == 0 || i == 4 || j == 0 || j == 4)
      Point(40 + 5 * i + j) = {x[i], y[j], 0};
    EndIf
  EndFor
EndFor
point[5 + 1]  = 25;
point[5 + 2]  = 24;
point[5 + 3]  = 23;
point[10 + 1] = 26;
point[10 + 3] = 22;
point[15 + 1] = 27;
point[15 + 2] = 20;
point[15 + 3] = 21;
// Curves 100 + 5 i + j along x and 200 + 5 i + j along y, from the point i, j on
For i In {0:4}
  For j In {0:4}
    along_x[5 * i + j] = 100 + 5 * i + j;
    along_y[5 * i + j] = 200 + 5 * i + j;
    in_square_x = i >= 1 && i <= 2 && j >= 1 && j <= 3;
    in_square_y = j >= 1 && j <= 2 && i >= 1 && i <= 3;
    If (i < 4 && !in_square_x)
      Line(100 + 5 * i + j) = {point[5 * i + j], point[5 * (i + 1) + j]};
      Transfinite Curve {100 + 5 * i + j} = nx[i] + 1;
    EndIf
    If (j < 4 && !in_square_y)
      Line(200 + 5 * i + j) = {point[5 * i + j], point[5 * i + j + 1]};
      Transfinite Curve {200 + 5 * i + j} = ny[j] + 1;
    EndIf
  EndFor
EndFor
along_x[5 + 1]  = 25;
along_x[10 + 1] = 26;
along_x[5 + 3]  = -22;
along_x[10 + 3] = -21;
along_y[5 + 1]  = -24;
along_y[5 + 2]  = -23;
along_y[15 + 1] = 27;
along_y[15 + 2] = 20;
For i In {0:3}
  For j In {0:3}
    If (i == 0 || i == 3 || j == 0 || j == 3)
      s = 50 + 4 * i + j;
      Curve Loop(s) = {along_x[5 * i + j], along_y[5 * (i + 1) + j], -along_x[5 * i + j + 1], -along_y[5 * i + j]};
      Plane Surface(s) = {s};
    EndIf
  EndFor
EndFor
surfaces[] = Surface{:};
Transfinite Surface {surfaces[]};
Recombine Surface {surfaces[]};

Physical Curve("left", 1)    = {200:203};
Physical Curve("right", 2)   = {220:223};
Physical Curve("bottom", 3)  = {100, 105, 110, 115};
Physical Curve("top", 4)     = {104, 109, 114, 119};
Physical Curve("hole", 5)    = {10:17};
Physical Surface("plate", 6) = {surfaces[]};
