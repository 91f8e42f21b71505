// Double-edge-notched plate (Nooru-Mohamed): 200 x 200, a notch 25 deep and 5 wide on both sides at mid-height.
// Lengths in mm. Quadrilaterals of size dx, irregular, so that cracks may bend; around the notches' tips regular patches
// of smaller elements, since their size decides at which load the first bond breaks.
If (!Exists(dx))
  dx = 1;
  // Both patches: columns beside the notch's end, rows below, in front of and above the notch. Full-quad recombination
  // wants even numbers of elements on every curve.
  columns = 8;
  rows() = {8, 6, 8};
EndIf
size = 1.32 * dx;  // recombined quadrilaterals come out smaller than asked for

depth = 25;       // of the notches
half_notch = 2.5;

tip = 0.72 * dx;
height() = {-half_notch - rows(0) * tip, -half_notch, half_notch, half_notch + rows(2) * tip};

Point(1) = {0, -100, 0, size};
Point(2) = {200, -100, 0, size};
Point(3) = {200, 100, 0, size};
Point(4) = {0, 100, 0, size};
Point(5) = {0, -half_notch, 0, size};
Point(6) = {0, half_notch, 0, size};
Point(7) = {200, -half_notch, 0, size};
Point(8) = {200, half_notch, 0, size};

// side = 0: left notch, x grows into the plate; side = 1: its mirror image.
For side In {0:1}
  s = 1000 * (side + 1);
  sign = 1 - 2 * side;
  For j In {0:3}
    For i In {0:2}
      Point(s + 10 * j + i) = {200 * side + sign * (depth + (i - 1) * columns * tip), height(j), 0, tip};
    EndFor
  EndFor
  For j In {0:3}
    For i In {0:1}
      Line(s + 10 * j + i) = {s + 10 * j + i, s + 10 * j + i + 1};
      Transfinite Curve{s + 10 * j + i} = columns + 1;
    EndFor
  EndFor
  For j In {0:2}
    For i In {0:2}
      If (j != 1 || i > 0)
        Line(s + 100 + 10 * j + i) = {s + 10 * j + i, s + 10 * (j + 1) + i};
        Transfinite Curve{s + 100 + 10 * j + i} = rows(j) + 1;
      EndIf
    EndFor
  EndFor
  For j In {0:2}
    For i In {0:1}
      If (j != 1 || i > 0)
        Curve Loop(s + 10 * j + i) = {sign * (s + 10 * j + i), sign * (s + 100 + 10 * j + i + 1), -sign * (s + 10 * (j + 1) + i), -sign * (s + 100 + 10 * j + i)};
        Plane Surface(s + 10 * j + i) = {s + 10 * j + i};
        Transfinite Surface{s + 10 * j + i};
      EndIf
    EndFor
  EndFor
EndFor

Line(1) = {1, 2};
Line(2) = {2, 7};
Line(3) = {7, 2010};
Line(4) = {2020, 8};
Line(5) = {8, 3};
Line(6) = {3, 4};
Line(7) = {4, 6};
Line(8) = {6, 1020};
Line(9) = {1010, 5};
Line(10) = {5, 1};
Curve Loop(9000) = {1, 2, 3, -2100, 2000, 2001, 2102, 2112, 2122, -2031, -2030, -2120, 4, 5, 6, 7, 8,
                 1120, 1030, 1031, -1122, -1112, -1102, -1001, -1000, 1100, 9, 10};
Plane Surface(9000) = {9000};   // after the patches: gmsh wants regular surfaces first
Recombine Surface{:};

Physical Surface("body") = Surface{:};
Physical Curve("bottom") = {1};
Physical Curve("top") = {6};
Physical Curve("upper_left") = {7};
Physical Curve("lower_right") = {2};

Mesh.Algorithm = 6;
Mesh.RecombinationAlgorithm = 3;
