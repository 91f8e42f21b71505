// The mesh of plate_with_hole.geo, drawn out in z to a slab two elements thick. Lengths in mm.
Include "../plate_with_hole/plate_with_hole.geo";
thickness = 2 * dx;

Delete Physicals;  // those of the plate
faces() = Surface{:};
Extrude {0, 0, thickness} { Surface{faces()}; Layers{Round(thickness / dx)}; Recombine; }

e = 0.01;
Physical Volume("slab") = Volume{:};
Physical Surface("left") = Surface In BoundingBox{-100 - e, -50 - e, -e, -100 + e, 50 + e, thickness + e};
Physical Surface("right") = Surface In BoundingBox{100 - e, -50 - e, -e, 100 + e, 50 + e, thickness + e};
Physical Surface("back") = {faces()};
Physical Surface("front") = Surface In BoundingBox{-100 - e, -50 - e, thickness - e, 100 + e, 50 + e, thickness + e};
Physical Curve("left_middle") = Curve In BoundingBox{-100 - e, -e, -e, -100 + e, e, thickness + e};
