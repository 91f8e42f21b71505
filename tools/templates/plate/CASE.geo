// A square plate with an edge crack, 40 x 40, seen from the front. Lengths in mm.
//
//              top: pulled up
//        4 ----------------- 3
//        |                   |
//        |-------            |     the crack, 10 long, stands in @NAME@.xml
//        |                   |
//        1 ----------------- 2
//     corner   bottom: held
size = 40;
dx = 1;  // of the elements; the horizon in @NAME@.xml is four times this

Point(1) = {0, -size / 2, 0};
Point(2) = {size, -size / 2, 0};
Point(3) = {size, size / 2, 0};
Point(4) = {0, size / 2, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};

// A regular grid of squares. Without the two Transfinite lines gmsh makes an irregular mesh of size dx.
Transfinite Curve{:} = Round(size / dx) + 1;
Transfinite Surface{1};
Recombine Surface{1};

// Groups: the names that @NAME@.xml refers to. One surface is the body; curves and points are held and loaded.
Physical Surface("plate") = {1};
Physical Curve("bottom") = {1};
Physical Curve("top") = {3};
Physical Point("corner") = {1};
