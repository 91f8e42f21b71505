// A beam of section 100 x 100, 270 long, with a notch at 45 degrees to its axis, 50 deep and 5 wide, from the top. The
// axis is the x-axis, up is z, the origin is below the middle of the notch. Lengths in mm.
//
//   y = 50    +------------------ / / ---------+
//             |                 / /            |
//   seen from |               / /              |
//   above     |             / /                |
//             |           / /                  |
//   y = -50   +-------- / / -------------------+
//
// Tetrahedra, so that cracks may turn: of size dx around the notch, larger ones beyond.
SetFactory("OpenCASCADE");
length = 270;
side = 100;
depth = 50;  // of the notch
notch = 5;   // its width
dx = 9;
coarse = 20;

Box(1) = {-length / 2, -side / 2, 0, length, side, side};
Box(2) = {-side, -notch / 2, side - depth, 2 * side, notch, 2 * depth};
Rotate {{0, 0, 1}, {0, 0, 0}, Pi / 4} { Volume{2}; }
BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }

// By the distance from the plane of the notch.
Field[1] = MathEval;
Field[1].F = Sprintf("Min(%g, Max(%g, %g + 0.25 * (Fabs(x - y) / 1.414 - 40)))", coarse, dx, dx);
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;

e = 0.01;
x = length / 2;
y = side / 2;
Physical Volume("beam") = Volume{:};
Physical Curve("left_front") = Curve In BoundingBox{-x - e, -y - e, -e, -x + e, -y + e, side + e};
Physical Curve("left_back") = Curve In BoundingBox{-x - e, y - e, -e, -x + e, y + e, side + e};
Physical Curve("right_front") = Curve In BoundingBox{x - e, -y - e, -e, x + e, -y + e, side + e};
Physical Curve("right_back") = Curve In BoundingBox{x - e, y - e, -e, x + e, y + e, side + e};
Physical Point("foot") = Point In BoundingBox{-x - e, y - e, -e, -x + e, y + e, e};
Physical Point("other_foot") = Point In BoundingBox{-x - e, -y - e, -e, -x + e, -y + e, e};
