// A round particle in a square matrix, above the way of a crack from the left edge. Lengths in mm. Irregular quadrilaterals of dx.
dx = 1;
size = 1.08 * dx;  // recombined quadrilaterals come out smaller than asked for
width = 40;
x = 20; y = 23; r = 5;

Point(1) = {0, 0, 0, size};
Point(2) = {width, 0, 0, size};
Point(3) = {width, width, 0, size};
Point(4) = {0, width, 0, size};
Point(5) = {0, 20, 0, size};
Point(6) = {8, 20, 0, size};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 1};
Line(6) = {5, 6};

Point(10) = {x, y, 0, size};
Point(11) = {x + r, y, 0, size};
Point(12) = {x, y + r, 0, size};
Point(13) = {x - r, y, 0, size};
Point(14) = {x, y - r, 0, size};
Circle(11) = {11, 10, 12};
Circle(12) = {12, 10, 13};
Circle(13) = {13, 10, 14};
Circle(14) = {14, 10, 11};

Curve Loop(1) = {1, 2, 3, 4, 5};
Curve Loop(2) = {11, 12, 13, 14};
Plane Surface(1) = {1, 2};
Plane Surface(2) = {2};
Line{6} In Surface{1};
Recombine Surface{1, 2};
Mesh.RecombinationAlgorithm = 1;

Physical Surface("matrix") = {1};
Physical Surface("particle") = {2};
Physical Curve("bottom") = {1};
Physical Curve("top") = {3};
Physical Point("corner") = {1};
