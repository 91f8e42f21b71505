// An eighth of penny_crack.geo: x, y, z >= 0. The crack is the part of z = 0 that no group has.
SetFactory("OpenCASCADE");
side = 24;
radius = 6;
dx = 1;      // of the elements, and thickness of the layers around the crack
fine = 6;    // so far above it
coarse = 2;  // thickness of the layers beyond

h = side / 2;
Rectangle(1) = {0, 0, 0, h, h};
Disk(2) = {0, 0, 0, radius};
BooleanIntersection(3) = { Surface{2}; Delete; }{ Surface{1}; };
BooleanFragments{ Surface{1}; Delete; }{ Surface{3}; Delete; }

MeshSize{:} = 1.1 * dx;  // recombined quadrilaterals come out smaller than asked for
Mesh.Algorithm = 5;
Mesh.RecombinationAlgorithm = 1;
Recombine Surface{:};

Extrude {0, 0, h} {
  Surface{:};
  Layers{ {Round(fine / dx), Round((h - fine) / coarse)}, {fine / h, 1} };
  Recombine;
}

e = 0.01;
inside() = Surface In BoundingBox{-e, -e, -e, radius + e, radius + e, e};
plane() = Surface In BoundingBox{-e, -e, -e, h + e, h + e, e};
plane() -= inside();
Physical Volume("cube") = Volume{:};
Physical Surface("ligament") = plane();
Physical Surface("top") = Surface In BoundingBox{-e, -e, h - e, h + e, h + e, h + e};
Physical Surface("x_plane") = Surface In BoundingBox{-e, -e, -e, e, h + e, h + e};
Physical Surface("y_plane") = Surface In BoundingBox{-e, -e, -e, h + e, e, h + e};
