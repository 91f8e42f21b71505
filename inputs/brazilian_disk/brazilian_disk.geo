// Disk with a central slit: diameter 100, slit 30 long at 45 degrees to the vertical load axis. Lengths in mm.
// Quadrilaterals of size dx, irregular, so that cracks may bend; around the slit's tips regular patches of squares
// of size tip, since the size of the elements there decides at which load the first bond breaks. The slit itself is in the
// case file: here it is a line along which edges of elements lie. Recombined quadrilaterals come out smaller than asked for.
DefineConstant[dx = 0.5];  // brazilian_disk_coarse.geo sets another
size = 1.15 * dx;
tip = dx;

radius = 50;
half_slit = 15;
half_contact = 2;  // the loaded part of the circle is 4 wide, at both poles

// Patches of 2 n x 2 n squares; in axes s along and t across the slit.
n = 2;
For side In {0:1}
  p = 100 * (side + 1);
  sign = 1 - 2 * side;
  For j In {0:2}
    For i In {0:2}
      s = sign * (half_slit + (i - 1) * n * tip);
      t = sign * (j - 1) * n * tip;
      Point(p + 10 * j + i) = {(s - t) / Sqrt(2), (s + t) / Sqrt(2), 0, tip};
    EndFor
  EndFor
  For j In {0:2}
    For i In {0:1}
      Line(p + 10 * j + i) = {p + 10 * j + i, p + 10 * j + i + 1};
      Line(p + 50 + 10 * i + j) = {p + 10 * i + j, p + 10 * (i + 1) + j};
      Transfinite Curve{p + 10 * j + i, p + 50 + 10 * i + j} = n + 1;
    EndFor
  EndFor
  For j In {0:1}
    For i In {0:1}
      Curve Loop(p + 10 * j + i) = {p + 10 * j + i, p + 50 + 10 * j + i + 1, -(p + 10 * (j + 1) + i), -(p + 50 + 10 * j + i)};
      Plane Surface(p + 10 * j + i) = {p + 10 * j + i};
      Transfinite Surface{p + 10 * j + i};
    EndFor
  EndFor
EndFor
Line(1) = {210, 110};  // the slit between the patches

// The circle, and the slit's line on to it, so that either half is a simple surface.
half_angle = Asin(half_contact / radius);
angle() = {Pi / 4, Pi / 2 - half_angle, Pi / 2 + half_angle, 5 * Pi / 4, 3 * Pi / 2 - half_angle, 3 * Pi / 2 + half_angle};
Point(10) = {0, 0, 0};
For i In {0:5}
  Point(11 + i) = {radius * Cos(angle(i)), radius * Sin(angle(i)), 0, size};
EndFor
For i In {0:5}
  Circle(11 + i) = {11 + i, 10, 11 + (i + 1) % 6};
EndFor
Line(2) = {112, 11};
Line(3) = {212, 14};

Curve Loop(9001) = {-3, -252, -201, -200, 250, 1, 160, 120, 121, -162, 2, 11, 12, 13};
Plane Surface(9001) = {9001};  // after the patches: gmsh wants regular surfaces first
Curve Loop(9002) = {-2, -152, -101, -100, 150, -1, 260, 220, 221, -262, 3, 14, 15, 16};
Plane Surface(9002) = {9002};
Recombine Surface{:};

Physical Surface("disk") = Surface{:};
Physical Curve("top") = {12};
Physical Curve("bottom") = {15};

Mesh.Algorithm = 6;
Mesh.RecombinationAlgorithm = 3;
