// A beam on two supports, cracked at mid-span, seen from the front. Lengths in mm.
//
//        6 ------------------ 5 ------------------ 4      5: pressed down
//        |                                         |
//        |                    |                    |      the crack, 5 high, stands in @NAME@.xml
//        1 ------------------ 2 ------------------ 3
//      left                                      right: supports
length = 80;
height = 20;
dx = 1;  // of the elements; the horizon in @NAME@.xml is four times this

Point(1) = {0, 0, 0};
Point(2) = {length / 2, 0, 0};
Point(3) = {length, 0, 0};
Point(4) = {length, height, 0};
Point(5) = {length / 2, height, 0};
Point(6) = {0, height, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6};
Plane Surface(1) = {1};

// A regular grid of squares; the four corners are named, since there are six points around it.
Transfinite Curve{1, 2, 4, 5} = Round(length / 2 / dx) + 1;
Transfinite Curve{3, 6} = Round(height / dx) + 1;
Transfinite Surface{1} = {1, 3, 4, 6};
Recombine Surface{1};

// Groups: the names that @NAME@.xml refers to. One surface is the body; curves and points are held and loaded.
Physical Surface("beam") = {1};
Physical Point("left") = {1};
Physical Point("right") = {3};
Physical Point("press") = {5};
