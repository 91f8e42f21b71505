// Notched beam under four-point bending: 200 x 50, span 180, notch 10 deep and 2 wide from the bottom at mid-span.
// Lengths in mm. Unstructured quadrilaterals of size dx, a little coarser away from where the crack runs.
dx = 0.5;

Point(1) = {0, 0, 0, dx};
Point(2) = {10, 0, 0, dx};
Point(3) = {99, 0, 0, dx};
Point(4) = {99, 10, 0, dx};
Point(5) = {101, 10, 0, dx};
Point(6) = {101, 0, 0, dx};
Point(7) = {190, 0, 0, dx};
Point(8) = {200, 0, 0, dx};
Point(9) = {200, 50, 0, dx};
Point(10) = {130, 50, 0, dx};
Point(11) = {70, 50, 0, dx};
Point(12) = {0, 50, 0, dx};
For i In {1:11}
  Line(i) = {i, i + 1};
EndFor
Line(12) = {12, 1};
Curve Loop(1) = {1:12};
Plane Surface(1) = {1};

Physical Surface("body") = {1};
Physical Point("bottom_left") = {2};
Physical Point("bottom_right") = {7};
Physical Point("top_left") = {11};
Physical Point("top_right") = {10};

Recombine Surface{1};
Mesh.Algorithm = 6;
Mesh.RecombinationAlgorithm = 2;
