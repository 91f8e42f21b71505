// An L-shaped panel, 500 x 500 less 250 x 250, seen from the front, its inner corner the origin. Lengths in mm. Squares of dx, refined by themselves.
//
//    8 ------ 7 ------- 6 - 5
//    |        |         |   |
//    9 ------ 1 ------- 3 - 4      3: lifted, 30 from the end
//    |        |
//   12 ------ 11
//   10 ------ 2                    10 to 2: held; up to 12 and 11 nothing breaks
dx = 10;  // has to go into 30

Point(1) = {0, 0, 0};
Point(2) = {0, -250, 0};
Point(3) = {220, 0, 0};
Point(4) = {250, 0, 0};
Point(5) = {250, 250, 0};
Point(6) = {220, 250, 0};
Point(7) = {0, 250, 0};
Point(8) = {-250, 250, 0};
Point(9) = {-250, 0, 0};
Point(10) = {-250, -250, 0};
Point(11) = {0, -150, 0};
Point(12) = {-250, -150, 0};
Line(1) = {10, 2};
Line(2) = {11, 1};
Line(3) = {1, 9};
Line(4) = {9, 12};
Line(5) = {1, 3};
Line(6) = {3, 4};
Line(7) = {4, 5};
Line(8) = {5, 6};
Line(9) = {6, 7};
Line(10) = {7, 8};
Line(11) = {8, 9};
Line(12) = {1, 7};
Line(13) = {3, 6};
Line(14) = {12, 11};
Line(15) = {2, 11};
Line(16) = {12, 10};
Curve Loop(1) = {14, 2, 3, 4};
Curve Loop(2) = {-3, 12, 10, 11};
Curve Loop(3) = {5, 13, 9, -12};
Curve Loop(4) = {6, 7, 8, -13};
Curve Loop(5) = {1, 15, -14, 16};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Plane Surface(3) = {3};
Plane Surface(4) = {4};
Plane Surface(5) = {5};
Transfinite Curve{1, 3, 7, 10, 11, 12, 13, 14} = Round(250 / dx) + 1;
Transfinite Curve{2, 4} = Round(150 / dx) + 1;
Transfinite Curve{15, 16} = Round(100 / dx) + 1;
Transfinite Curve{5, 9} = Round(220 / dx) + 1;
Transfinite Curve{6, 8} = Round(30 / dx) + 1;
Transfinite Surface{:};
Recombine Surface{:};

Physical Surface("concrete") = {1, 2, 3, 4};
Physical Surface("foot") = {5};
Physical Curve("bottom") = {1};
Physical Point("lift") = {3};
