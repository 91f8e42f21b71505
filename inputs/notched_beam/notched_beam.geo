// Notched beam under four-point bending: 200 x 50, span 180, notch 10 deep and 2 wide from the bottom at mid-span.
// Lengths in mm. Quadrilaterals of size dx, irregular; around the notch's tip a regular patch of 0.8 dx, since the size of the
// elements there decides at which load the first bond breaks. Recombined quadrilaterals come out smaller than asked for.
DefineConstant[dx = 0.5];  // notched_beam_coarse.geo sets another, and n
size = 1.08 * dx;
tip = 0.8 * dx;

// The beam around the notch and its patch.
Point(1) = {0, 0, 0, size};
Point(2) = {10, 0, 0, size};
Point(3) = {99, 0, 0, size};
Point(4) = {101, 0, 0, size};
Point(5) = {190, 0, 0, size};
Point(6) = {200, 0, 0, size};
Point(7) = {200, 50, 0, size};
Point(8) = {130, 50, 0, size};
Point(9) = {70, 50, 0, size};
Point(10) = {0, 50, 0, size};

// The patch: columns beside the notch (left, over it, right), rows beside and above its tip.
x() = {95, 99, 101, 105};
y() = {6, 10, 14};
If (!Exists(n))
  n() = {10, 4, 10};  // columns of elements; full-quad recombination wants even numbers
EndIf
For j In {0:2}
  For i In {0:3}
    Point(100 + 10 * j + i) = {x(i), y(j), 0, tip};
  EndFor
EndFor
For j In {0:2}
  For i In {0:2}
    If (j > 0 || i != 1)
      Line(100 + 10 * j + i) = {100 + 10 * j + i, 100 + 10 * j + i + 1};
      Transfinite Curve{100 + 10 * j + i} = n(i) + 1;
    EndIf
  EndFor
EndFor
For j In {0:1}
  For i In {0:3}
    Line(200 + 10 * j + i) = {100 + 10 * j + i, 110 + 10 * j + i};
    Transfinite Curve{200 + 10 * j + i} = 2 * Round((y(j + 1) - y(j)) / tip / 2) + 1;
  EndFor
EndFor
For j In {0:1}
  For i In {0:2}
    If (j > 0 || i != 1)
      Curve Loop(10 * j + i + 1) = {100 + 10 * j + i, 200 + 10 * j + i + 1, -(110 + 10 * j + i), -(200 + 10 * j + i)};
      Plane Surface(10 * j + i + 1) = {10 * j + i + 1};
      Transfinite Surface{10 * j + i + 1};
    EndIf
  EndFor
EndFor

Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 101};
Line(4) = {102, 4};
Line(5) = {4, 5};
Line(6) = {5, 6};
Line(7) = {6, 7};
Line(8) = {7, 8};
Line(9) = {8, 9};
Line(10) = {9, 10};
Line(11) = {10, 1};
Curve Loop(100) = {1, 2, 3, -100, 200, 210, 120, 121, 122, -213, -203, -102, 4, 5, 6, 7, 8, 9, 10, 11};
Plane Surface(100) = {100};
Recombine Surface{:};

Physical Surface("body") = {1, 3, 11, 12, 13, 100};
Physical Point("bottom_left") = {2};
Physical Point("bottom_right") = {5};
Physical Point("top_left") = {9};
Physical Point("top_right") = {8};

Mesh.Algorithm = 6;
Mesh.RecombinationAlgorithm = 3;
