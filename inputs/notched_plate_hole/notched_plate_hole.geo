// Notched plate with an off-centre hole: 30 x 47; hole of radius 7.5 at (12, 28); notch from the left edge, 1 wide, its
// axis at height h, 10 long to a round tip of radius 0.5. Lengths in mm.
// Quadrilaterals of size dx, irregular, so that cracks may bend. The elements at the round tip decide at which load the
// first bond breaks. Recombined quadrilaterals come out smaller than asked for.
// The files that include this one set h, those of coarse meshes also dx.
DefineConstant[h = 10, dx = 0.25];
size = 1.08 * dx;

length = 10;
half_width = 0.5;

// A ring of regular elements around the round tip.
layers = 2;
around = 4;  // elements on a quarter of it
width = 1.75 * dx;

Point(1) = {0, 0, 0, size};
Point(2) = {30, 0, 0, size};
Point(3) = {30, 47, 0, size};
Point(4) = {0, 47, 0, size};
Point(5) = {0, h + half_width, 0, size};
Point(6) = {0, h - half_width, 0, size};
Point(10) = {length, h, 0};
For i In {0:2}
  Point(11 + i) = {length + half_width * Sin(i * Pi / 2), h + half_width * Cos(i * Pi / 2), 0, dx};
  Point(14 + i) = {length + (half_width + width) * Sin(i * Pi / 2), h + (half_width + width) * Cos(i * Pi / 2), 0, dx};
  Line(14 + i) = {11 + i, 14 + i};
  Transfinite Curve{14 + i} = layers + 1;
EndFor
For i In {0:1}
  Circle(10 + i) = {11 + i, 10, 12 + i};
  Circle(12 + i) = {14 + i, 10, 15 + i};
  Transfinite Curve{10 + i, 12 + i} = around + 1;
  Curve Loop(1 + i) = {10 + i, 15 + i, -(12 + i), -(14 + i)};
  Plane Surface(1 + i) = {1 + i};
  Transfinite Surface{1 + i};
EndFor

Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 11};
Line(6) = {13, 6};
Line(7) = {6, 1};
Curve Loop(3) = {1:5, 14, 12, 13, -16, 6, 7};
Point(20) = {12, 28, 0};
For i In {0:3}
  Point(21 + i) = {12 + 7.5 * Cos(i * Pi / 2), 28 + 7.5 * Sin(i * Pi / 2), 0, size};
EndFor
For i In {0:3}
  Circle(20 + i) = {21 + i, 20, 21 + (i + 1) % 4};
EndFor
Curve Loop(4) = {20:23};
Plane Surface(3) = {3, 4};
Recombine Surface{:};

Physical Surface("plate") = Surface{:};
Physical Curve("bottom") = {1};
Physical Curve("top") = {3};
Physical Point("corner") = {1};

Mesh.Algorithm = 6;
Mesh.RecombinationAlgorithm = 3;
