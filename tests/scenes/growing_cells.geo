// A strip of quads whose sizes grow thirtyfold away from a parabola: neighbours differ by a factor of two, and
// the nodes of small cells have a hundred times the members that their own horizon holds.
Point(1) = {-1.25, -.5, 0};
Point(2) = {1.25, -.5, 0};
Point(3) = {1.25, .5, 0};
Point(4) = {-1.25, .5, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Recombine Surface {1};
Physical Curve("left") = {4};
Physical Curve("right") = {2};
Physical Surface("body") = {1};
Field[1] = MathEval;
Field[1].F = "0.01 * (1 + 30 * (y - x * x)^2 + (1 - x)^2)";
Background Field = 1;
