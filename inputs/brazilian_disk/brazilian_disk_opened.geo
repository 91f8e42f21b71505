// The disk of brazilian_disk.geo with an opened notch of 1 in place of its slit: 30 long over its round ends, at 45 degrees to the
// vertical load axis. Lengths in mm. Quadrilaterals of size dx, irregular; two along each quarter of an end.
dx = 0.5;
size = 1.15 * dx;

radius = 50;
half_length = 15;
half_width = 0.5;
half_contact = 2;  // the loaded part of the circle is 4 wide, at both poles

// The notch, in axes s along and t across it: its sides end where the quarter circles of its ends begin.
straight = half_length - half_width;
s() = {straight, half_length, straight, -straight, -half_length, -straight};
t() = {-half_width, 0, half_width, half_width, 0, -half_width};
For i In {0:5}
  Point(1 + i) = {(s(i) - t(i)) / Sqrt(2), (s(i) + t(i)) / Sqrt(2), 0, size};
EndFor
Point(7) = {straight / Sqrt(2), straight / Sqrt(2), 0, size};
Point(8) = {-straight / Sqrt(2), -straight / Sqrt(2), 0, size};
Circle(1) = {1, 7, 2};
Circle(2) = {2, 7, 3};
Line(3) = {3, 4};
Circle(4) = {4, 8, 5};
Circle(5) = {5, 8, 6};
Line(6) = {6, 1};
Transfinite Curve{1, 2, 4, 5} = 3;

half_angle = Asin(half_contact / radius);
angle() = {Pi / 2 - half_angle, Pi / 2 + half_angle, 3 * Pi / 2 - half_angle, 3 * Pi / 2 + half_angle};
Point(10) = {0, 0, 0};
For i In {0:3}
  Point(11 + i) = {radius * Cos(angle(i)), radius * Sin(angle(i)), 0, size};
EndFor
For i In {0:3}
  Circle(11 + i) = {11 + i, 10, 11 + (i + 1) % 4};
EndFor

Curve Loop(1) = {11, 12, 13, 14};
Curve Loop(2) = {1, 2, 3, 4, 5, 6};
Plane Surface(1) = {1, 2};
Recombine Surface{1};

Physical Surface("disk") = {1};
Physical Curve("top") = {11};
Physical Curve("bottom") = {13};

Mesh.Algorithm = 6;
Mesh.RecombinationAlgorithm = 3;
