// A disk of diameter 100, pressed on two arcs at its poles. Lengths in mm. Quadrilaterals of size dx: irregular, so that cracks may
// bend, or regular (regular = 1): a square in the middle and four pieces around it. Recombined ones come out smaller than asked for.
dx = 1.25;
regular = 0;
radius = 50;
half_arc = 8 * Pi / 180;

Point(1) = {0, 0, 0, 1.15 * dx};
angle() = {Pi / 4, Pi / 2 - half_arc, Pi / 2 + half_arc, 3 * Pi / 4, 5 * Pi / 4, 3 * Pi / 2 - half_arc, 3 * Pi / 2 + half_arc, 7 * Pi / 4};
For i In {0:7}
  Point(11 + i) = {radius * Cos(angle(i)), radius * Sin(angle(i)), 0, 1.15 * dx};
EndFor
For i In {0:7}
  Circle(11 + i) = {11 + i, 1, 11 + (i + 1) % 8};
EndFor
If (regular)
  half = 25;  // of the square's side
  n_arc = Ceil(2 * radius * half_arc / dx / 2) * 2;
  n_rest = Round((half - 0.5 * n_arc * dx) / dx);
  strip = half * n_arc / (n_arc + 2 * n_rest);
  Point(21) = {half, half, 0}; Point(22) = {strip, half, 0}; Point(23) = {-strip, half, 0}; Point(24) = {-half, half, 0};
  Point(25) = {-half, -half, 0}; Point(26) = {-strip, -half, 0}; Point(27) = {strip, -half, 0}; Point(28) = {half, -half, 0};
  For i In {0:7}
    Line(21 + i) = {21 + i, 21 + (i + 1) % 8};
    Line(31 + i) = {21 + i, 11 + i};
    Transfinite Curve{31 + i} = Round(25 / dx) + 1;
    n = (i == 1 || i == 5) ? n_arc : ((i == 3 || i == 7) ? n_arc + 2 * n_rest : n_rest);
    Transfinite Curve{11 + i, 21 + i} = n + 1;
  EndFor
  For i In {0:7}
    Curve Loop(1 + i) = {21 + i, 31 + (i + 1) % 8, -(11 + i), -(31 + i)};
    Plane Surface(1 + i) = {1 + i};
    Transfinite Surface{1 + i};
  EndFor
  Curve Loop(9) = {21:28};
  Plane Surface(9) = {9};
  Transfinite Surface{9} = {21, 24, 25, 28};
Else
  Curve Loop(1) = {11:18};
  Plane Surface(1) = {1};
EndIf
Recombine Surface{:};

Physical Surface("disk") = Surface{:};
Physical Curve("top") = {12};
Physical Curve("bottom") = {16};
Physical Point("left") = {14};
Physical Point("right") = {11};
