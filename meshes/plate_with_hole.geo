// SPDX-License-Identifier: LGPL-2.1-or-later
// Square plate with a central circular hole in eight transfinite blocks:
// 30 cells around x 32 across each, 7,680 quadrilaterals. The generator
// "plate with hole" makes the same mesh without Gmsh.
side   = 1;   // [m]
radius = 0.1; // [m]
around = 30;  // cells around each block
radial = 32;  // cells from the hole to the edge
growth = 6;   // of the cell size, from the hole to the edge

half = side / 2;
Point(1) = {0, 0, 0};
// the hole and the square, counter-clockwise from the x axis in steps of 45 degrees
outer_x[] = {half, half, 0, -half, -half, -half, 0, half};
outer_y[] = {0, half, half, half, 0, -half, -half, -half};
For b In {0:7}
  Point(10 + b) = {radius * Cos(b * Pi / 4), radius * Sin(b * Pi / 4), 0};
  Point(20 + b) = {outer_x[b], outer_y[b], 0};
  Line(30 + b)  = {10 + b, 20 + b};
EndFor
For b In {0:7}
  next = (b + 1) % 8;
  Circle(10 + b) = {10 + b, 1, 10 + next};
  Line(20 + b)   = {20 + b, 20 + next};
EndFor
For b In {0:7}
  next = (b + 1) % 8;
  Curve Loop(b + 1)    = {30 + b, 20 + b, -(30 + next), -(10 + b)};
  Plane Surface(b + 1) = {b + 1};
  Transfinite Curve {30 + b} = radial + 1 Using Progression growth^(1 / radial);
  Transfinite Curve {10 + b, 20 + b} = around + 1;
  Transfinite Surface {b + 1};
  Recombine Surface {b + 1};
EndFor

Physical Curve("left", 1)    = {23, 24};
Physical Curve("right", 2)   = {27, 20};
Physical Curve("bottom", 3)  = {25, 26};
Physical Curve("top", 4)     = {21, 22};
Physical Curve("hole", 5)    = {10:17};
Physical Surface("plate", 6) = {1:8};
