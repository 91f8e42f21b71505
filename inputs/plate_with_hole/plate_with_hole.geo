// Plate with a central hole: 200 x 100, radius 10, origin at the hole's centre. Lengths in mm.
// Quadrilaterals of size dx, irregular. The lines y = 0, x = 0 and x = 30, along which results are compared, are edges of
// elements. Recombined quadrilaterals come out smaller than asked for.
DefineConstant[dx = 1.5];  // plate_with_hole_coarse.geo sets another
size = 1.12 * dx;
radius = 10;

Point(1) = {-100, -50, 0, size};
Point(2) = {0, -50, 0, size};
Point(3) = {30, -50, 0, size};
Point(4) = {100, -50, 0, size};
Point(5) = {-100, 0, 0, size};
Point(6) = {30, 0, 0, size};
Point(7) = {100, 0, 0, size};
Point(8) = {-100, 50, 0, size};
Point(9) = {0, 50, 0, size};
Point(10) = {30, 50, 0, size};
Point(11) = {100, 50, 0, size};

Point(20) = {0, 0, 0};
Point(21) = {radius, 0, 0, dx};
Point(22) = {0, radius, 0, dx};
Point(23) = {-radius, 0, 0, dx};
Point(24) = {0, -radius, 0, dx};
For i In {0:3}
  Circle(20 + i) = {21 + i, 20, 21 + (i + 1) % 4};
EndFor

Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {1, 5};
Line(5) = {2, 24};
Line(6) = {3, 6};
Line(7) = {4, 7};
Line(8) = {5, 23};
Line(9) = {21, 6};
Line(10) = {6, 7};
Line(11) = {5, 8};
Line(12) = {22, 9};
Line(13) = {6, 10};
Line(14) = {7, 11};
Line(15) = {8, 9};
Line(16) = {9, 10};
Line(17) = {10, 11};

Curve Loop(1) = {1, 5, -22, -8, -4};
Curve Loop(2) = {2, 6, -9, -23, -5};
Curve Loop(3) = {3, 7, -10, -6};
Curve Loop(4) = {8, -21, 12, -15, -11};
Curve Loop(5) = {9, 13, -16, -12, -20};
Curve Loop(6) = {10, 14, -17, -13};
For i In {1:6}
  Plane Surface(i) = {i};
EndFor
Recombine Surface{:};

Physical Surface("plate") = Surface{:};
Physical Curve("left") = {4, 11};
Physical Curve("right") = {7, 14};
Physical Point("left_middle") = {5};

Mesh.Algorithm = 6;
Mesh.RecombinationAlgorithm = 3;
