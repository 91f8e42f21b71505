// A square plate of 1 x 1, seen from the front, its centre the origin. Lengths in mm. Squares of dx, refined by themselves.
//
//          top: moved
//    4 ----------------- 3
//    |                   |
//    |---------          |     the notch, 0.5 long, stands in the case files
//    |                   |
//    1 ----------------- 2
//         bottom: held
dx = 0.05;  // has to go into 0.5

Point(1) = {-0.5, -0.5, 0};
Point(2) = {0.5, -0.5, 0};
Point(3) = {0.5, 0.5, 0};
Point(4) = {-0.5, 0.5, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve{:} = Round(1 / dx) + 1;
Transfinite Surface{1};
Recombine Surface{1};

Physical Surface("plate") = {1};
Physical Curve("bottom") = {1};
Physical Curve("right") = {2};
Physical Curve("top") = {3};
Physical Curve("left") = {4};
