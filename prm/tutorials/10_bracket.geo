size = 0.004; // of the triangles before subdivision: cells are half as large
Mesh.RecombineAll         = 1;
Mesh.SubdivisionAlgorithm = 1; // quadrilaterals only

Point(1) = {0, 0, 0, size};
Point(2) = {0.10, 0, 0, size};
Point(3) = {0.10, 0.04, 0, size};
Point(4) = {0.04, 0.04, 0, size};
Point(5) = {0.04, 0.10, 0, size};
Point(6) = {0, 0.10, 0, size};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Curve Loop(1) = {1:6};
Plane Surface(1) = {1};

Physical Curve("top", 1)       = {5};
Physical Curve("end", 2)       = {2};
Physical Surface("bracket", 3) = {1};
