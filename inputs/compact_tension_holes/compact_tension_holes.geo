// A compact specimen with three holes beside its crack's way, seen from the front: 50 x 48, the origin midway between the pins' holes.
// Lengths in mm. Irregular elements of dx, refined by themselves; edges lie along the crack.
//
//    4 ---------------------------- 3
//    |    (pin)                     |
//    |             (a)              |
//    5 ------ 6          (b)        |      5 to 6: the crack, which opens in the case files; its height is H
//    |               (c)            |
//    |    (pin)                     |
//    1 ---------------------------- 2
SetFactory("OpenCASCADE");
dx = 1;
If (!Exists(H))
  H = 1.6;
EndIf

Rectangle(1) = {-10, -24, 0, 50, 48};
Disk(2) = {0, 11, 0, 5};
Disk(3) = {0, -11, 0, 5};
Disk(4) = {18, 10, 0, 4};
Disk(5) = {30, 0, 0, 2};
Disk(6) = {25, -10, 0, 4};
BooleanDifference(10) = { Surface{1}; Delete; }{ Surface{2:6}; Delete; };
Point(100) = {-10, H, 0};
Point(101) = {8, H, 0};
Line(100) = {100, 101};
BooleanFragments{ Surface{10}; Delete; }{ Curve{100}; Delete; }

MeshSize{:} = dx;
Recombine Surface{:};
Mesh.Algorithm = 6;

Physical Surface("steel") = Surface{:};
Physical Curve("top_pin") = Curve In BoundingBox{-5.1, 5.9, -0.1, 5.1, 16.1, 0.1};
Physical Curve("bottom_pin") = Curve In BoundingBox{-5.1, -16.1, -0.1, 5.1, -5.9, 0.1};
