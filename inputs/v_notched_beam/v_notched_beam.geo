// A beam of 8 x 2 with a notch of 90 degrees, 0.4 high, seen from the front. Lengths in mm. Irregular quadrilaterals of dx, refined by themselves.
//
//    9 ------------- 8 == 7 ------------- 6      8 to 7: pressed down, 0.5 wide
//    |                                    |
//    |                 3                  |
//    |               /   \                |
//    0 = 1 -------- 2     4 -------- 5 = 10      0 to 1 and 5 to 10: the supports, 0.1 wide
dx = 0.1;

x() = {-4, -3.9, -0.2, 0, 0.2, 3.9, 4, 0.25, -0.25, -4, 4};
y() = {0, 0, 0, 0.4, 0, 0, 2, 2, 2, 2, 0};
order() = {0, 1, 2, 3, 4, 5, 10, 6, 7, 8, 9};
For i In {0:10}
  Point(i) = {x(i), y(i), 0, 1.1 * dx};  // recombined quadrilaterals come out smaller than asked for
EndFor
For i In {0:10}
  Line(i + 1) = {order(i), order((i + 1) % 11)};
EndFor
Curve Loop(1) = {1:11};
Plane Surface(1) = {1};
Recombine Surface{1};
Mesh.Algorithm = 6;
Mesh.RecombinationAlgorithm = 3;

Physical Surface("beam") = {1};
Physical Curve("left") = {1};
Physical Curve("right") = {6};
Physical Curve("platen") = {9};
