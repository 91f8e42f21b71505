// A cantilever of two materials, 40 x 8, the softer one 3 thick below. Squares of dx. Lengths in mm.
dx = 0.5;
length = 40;
lower = 3;
depth = 8;

Point(1) = {0, 0, 0};
Point(2) = {length, 0, 0};
Point(3) = {length, lower, 0};
Point(4) = {0, lower, 0};
Point(5) = {length, depth, 0};
Point(6) = {0, depth, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Line(5) = {3, 5};
Line(6) = {5, 6};
Line(7) = {6, 4};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Curve Loop(2) = {-3, 5, 6, 7};
Plane Surface(2) = {2};
Transfinite Curve{1, 3, 6} = length / dx + 1;
Transfinite Curve{2, 4} = lower / dx + 1;
Transfinite Curve{5, 7} = (depth - lower) / dx + 1;
Transfinite Surface{1, 2};
Recombine Surface{:};

Physical Surface("soft") = {1};
Physical Surface("stiff") = {2};
Physical Curve("clamp") = {4, 7};
Physical Curve("end") = {2, 5};
