// SPDX-License-Identifier: LGPL-2.1-or-later
// The plate of kalthoff_winkler.geo, 5 mm thick, in cubes; `-setnumber Size 0.00125` for finer ones.
DefineConstant[ Size = {0.0025, Name "Size of the cubes [m]"} ];
thickness = 0.005;
nx        = Round(0.1 / Size);

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
Transfinite Curve {1, 3, 11, 13} = Round(0.075 / Size) + 1;
Transfinite Curve {2, 12}        = Round(0.05 / Size) + 1;
Transfinite Curve {21 : 24}      = nx + 1;
Transfinite Surface {1 : 3};
Recombine Surface {1 : 3};

out() = {};
For k In {1 : 3}
  solid() = Extrude {0, 0, thickness} { Surface{k}; Layers{Round(thickness / Size)}; Recombine; };
  out() += {solid(1)};
  If (k == 2)
    Physical Surface("impact", 1) = {solid(5)};
  EndIf
EndFor
Physical Volume("plate", 3) = {out()};
