// A cube with a disc crack in its middle, where the origin is. Lengths in mm.
// Quadrilaterals in the plane of the crack, irregular and with edges along its rim, are drawn out in z: fine layers around
// the crack, coarse ones at the ends.
SetFactory("OpenCASCADE");
side = 24;
radius = 6;
dx = 1;      // of the elements, and thickness of the layers around the crack
fine = 6;    // so far above and below it
coarse = 2;  // thickness of the layers beyond

h = side / 2;
Rectangle(1) = {-h, -h, -h, side, side};
Disk(2) = {0, 0, -h, radius};
BooleanFragments{ Surface{1}; Delete; }{ Surface{2}; Delete; }

MeshSize{:} = 1.1 * dx;  // recombined quadrilaterals come out smaller than asked for
Mesh.Algorithm = 5;
Mesh.RecombinationAlgorithm = 1;
Recombine Surface{:};

ends = Round((h - fine) / coarse);
Extrude {0, 0, side} {
  Surface{:};
  Layers{ {ends, Round(2 * fine / dx), ends}, {(h - fine) / side, (h + fine) / side, 1} };
  Recombine;
}

e = 0.01;
Physical Volume("cube") = Volume{:};
Physical Surface("bottom") = Surface In BoundingBox{-h - e, -h - e, -h - e, h + e, h + e, -h + e};
Physical Surface("top") = Surface In BoundingBox{-h - e, -h - e, h - e, h + e, h + e, h + e};
Physical Curve("edge") = Curve In BoundingBox{-h - e, -h - e, -h - e, -h + e, h + e, -h + e};
Physical Point("corner") = Point In BoundingBox{-h - e, -h - e, -h - e, -h + e, -h + e, -h + e};
