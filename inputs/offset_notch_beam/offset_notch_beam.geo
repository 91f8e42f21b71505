// A beam on two supports, seen from the front: 250 x 80, span 200, the origin below the platen. Lengths in mm. Squares of dx, which has to go into 5.
//
//        11 ------------------ 12 = 13 ---------- 14      12 to 13: the platen, 10 wide
//        |                                        |
//        |           |                            |       the notch, 20 high, 50 off the middle, stands in offset_notch_beam.xml
//        1 --- 2 ----------------------- 5 ------ 6       2 and 5: the supports
dx = 2.5;
height = 80;
x() = {-125, -100, -5, 5, 100, 125};

For i In {0:5}
  Point(1 + i) = {x(i), 0, 0};
  Point(11 + i) = {x(i), height, 0};
  Line(100 + i) = {1 + i, 11 + i};
  Transfinite Curve{100 + i} = Round(height / dx) + 1;
EndFor
For i In {0:4}
  Line(200 + i) = {1 + i, 2 + i};
  Line(300 + i) = {11 + i, 12 + i};
  Transfinite Curve{200 + i, 300 + i} = Round((x(i + 1) - x(i)) / dx) + 1;
  Curve Loop(i + 1) = {200 + i, 101 + i, -(300 + i), -(100 + i)};
  Plane Surface(i + 1) = {i + 1};
  Transfinite Surface{i + 1};
  Recombine Surface{i + 1};
EndFor

Physical Surface("concrete") = {1, 2, 3, 4, 5};
Physical Point("left") = {2};
Physical Point("right") = {5};
Physical Curve("platen") = {302};
