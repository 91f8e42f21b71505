// A disk with an upright crack in its middle, radius 12, pressed between two plates. Lengths in mm.
//
//             5 - 4          top: pressed down
//          .         .
//        6      |      3     the crack, from y = -4 to 4, stands in @NAME@.xml too
//          .         .
//             1 - 2          bottom: held
radius = 12;
half = 2;         // of the width on which the plates press
half_crack = 4;
dx = 1;           // of the elements; the horizon in @NAME@.xml is four times this
size = dx;

y = Sqrt(radius^2 - half^2);
Point(1) = {-half, -y, 0, size};
Point(2) = {half, -y, 0, size};
Point(3) = {radius, 0, 0, size};
Point(4) = {half, y, 0, size};
Point(5) = {-half, y, 0, size};
Point(6) = {-radius, 0, 0, size};
Point(7) = {0, 0, 0, size};
Circle(1) = {2, 7, 3};
Circle(2) = {3, 7, 4};
Line(3) = {4, 5};
Circle(4) = {5, 7, 6};
Circle(5) = {6, 7, 1};
Line(6) = {1, 2};
Curve Loop(1) = {1, 2, 3, 4, 5, 6};
Plane Surface(1) = {1};

// Edges of elements must lie along the crack: a line inside the surface sees to that.
Point(8) = {0, -half_crack, 0, size};
Point(9) = {0, half_crack, 0, size};
Line(7) = {8, 9};
Line{7} In Surface{1};

Recombine Surface{1};
Mesh.Algorithm = 6;
Mesh.RecombinationAlgorithm = 1;  // 3 would halve edges along the crack and move their middles off it

// Groups: the names that @NAME@.xml refers to. One surface is the body; curves and points are held and loaded.
Physical Surface("disk") = {1};
Physical Curve("bottom") = {6};
Physical Curve("top") = {3};
