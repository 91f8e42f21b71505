// Double-edge-notched plate (Nooru-Mohamed): 200 x 200, a notch 25 deep and 5 wide on both sides at mid-height.
// Lengths in mm. A regular grid of size dx with the notches on grid lines; six rows in the notches' height.
dx = 1;
notch_rows = 6;

width = 200;
depth = 25;      // of the notches
half_notch = 2.5;
half_height = 100;

// The plate as columns x rows of rectangles; the two beside the middle row are the notches and stay empty.
x() = {0, depth, width - depth, width};
y() = {-half_height, -half_notch, half_notch, half_height};
For j In {0:3}
  For i In {0:3}
    Point(4 * j + i + 1) = {x(i), y(j), 0};
  EndFor
EndFor
For j In {0:3}
  For i In {0:2}
    Line(10 * j + i + 1) = {4 * j + i + 1, 4 * j + i + 2};
    Transfinite Curve{10 * j + i + 1} = Round((x(i + 1) - x(i)) / dx) + 1;
  EndFor
EndFor
For j In {0:2}
  For i In {0:3}
    Line(100 + 10 * j + i + 1) = {4 * j + i + 1, 4 * j + i + 5};
    Transfinite Curve{100 + 10 * j + i + 1} = (j == 1 ? notch_rows : Round((y(j + 1) - y(j)) / dx)) + 1;
  EndFor
EndFor
For j In {0:2}
  For i In {0:2}
    If (j != 1 || i == 1)
      s = 3 * j + i + 1;
      Curve Loop(s) = {10 * j + i + 1, 100 + 10 * j + i + 2, -(10 * (j + 1) + i + 1), -(100 + 10 * j + i + 1)};
      Plane Surface(s) = {s};
      Transfinite Surface{s};
      Recombine Surface{s};
    EndIf
  EndFor
EndFor

Physical Surface("body") = {1, 2, 3, 5, 7, 8, 9};
Physical Curve("bottom") = {1, 2, 3};
Physical Curve("top") = {31, 32, 33};
Physical Curve("upper_left") = {121};
Physical Curve("lower_right") = {104};
