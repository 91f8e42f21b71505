// A block with an edge crack through its thickness, 16 x 16 x 4. Lengths in mm.
//
//           top: pulled up
//         _________________
//        /                /|
//       /________________/ |
//       |               |  |        y  z
//       |-------        |  |        | /
//       |               | /         |/___ x
//       |_______________|/
//         bottom: held        The crack, 6 long, stands in @NAME@.xml.
size = 16;
thickness = 4;
dx = 1;  // of the elements; the horizon in @NAME@.xml is twice this

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

// A regular grid of squares, drawn out to cubes. Without Transfinite and Recombine gmsh makes tetrahedra of size dx.
Transfinite Curve{:} = Round(size / dx) + 1;
Transfinite Surface{1};
Recombine Surface{1};
Extrude {0, 0, thickness} { Surface{1}; Layers{Round(thickness / dx)}; Recombine; }

// Groups: the names that @NAME@.xml refers to. One volume is the body; surfaces, curves and points are held and loaded.
e = 0.01;
Physical Volume("block") = {1};
Physical Surface("bottom") = Surface In BoundingBox{-e, -size / 2 - e, -e, size + e, -size / 2 + e, thickness + e};
Physical Surface("top") = Surface In BoundingBox{-e, size / 2 - e, -e, size + e, size / 2 + e, thickness + e};
Physical Curve("edge") = Curve In BoundingBox{-e, -size / 2 - e, -e, e, -size / 2 + e, thickness + e};
Physical Point("corner") = {1};
