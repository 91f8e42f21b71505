// A block with an edge crack through its thickness, 24 x 48, pulled at two hinges; of thickness 0 its plane section.
// Lengths in mm.
//
//       6 ----- 5 ----- 4   y = 24    upper hinge: the line through 5
//       |       |       |
//       |       |       |
//       |-------|       |   y = 0     the crack, 12 long, stands in the .xml
//       |       |       |
//       |       |       |
//       1 ----- 2 ----- 3   y = -24   lower hinge: the line through 2
If (!Exists(thickness))
  thickness = 6;
EndIf
If (!Exists(dx))
  dx = 1;  // of the elements
EndIf
width = 24;
height = 48;

Point(1) = {0, -height / 2, 0};
Point(2) = {width / 2, -height / 2, 0};
Point(3) = {width, -height / 2, 0};
Point(4) = {width, height / 2, 0};
Point(5) = {width / 2, height / 2, 0};
Point(6) = {0, height / 2, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Line(7) = {2, 5};
Curve Loop(1) = {1, 7, 5, 6};
Plane Surface(1) = {1};
Curve Loop(2) = {2, 3, 4, -7};
Plane Surface(2) = {2};

Transfinite Curve{1, 2, 4, 5} = Round(width / 2 / dx) + 1;
Transfinite Curve{3, 6, 7} = Round(height / dx) + 1;
Transfinite Surface{:};
Recombine Surface{:};

If (thickness == 0)
  Physical Surface("block") = Surface{:};
  Physical Point("lower_hinge") = {2};
  Physical Point("upper_hinge") = {5};
Else
Extrude {0, 0, thickness} { Surface{1, 2}; Layers{Round(thickness / dx)}; Recombine; }
e = 0.01;
Physical Volume("block") = Volume{:};
Physical Curve("lower_hinge") =
    Curve In BoundingBox{width / 2 - e, -height / 2 - e, -e, width / 2 + e, -height / 2 + e, thickness + e};
Physical Curve("upper_hinge") =
    Curve In BoundingBox{width / 2 - e, height / 2 - e, -e, width / 2 + e, height / 2 + e, thickness + e};
Physical Point("hinge_end") = {2};
Physical Surface("bottom") =
    Surface In BoundingBox{-e, -height / 2 - e, -e, width + e, -height / 2 + e, thickness + e};
Physical Surface("top") =
    Surface In BoundingBox{-e, height / 2 - e, -e, width + e, height / 2 + e, thickness + e};
EndIf
