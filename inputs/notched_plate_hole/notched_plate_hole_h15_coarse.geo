// Elements of twice the size, to be refined where the zone is; as many around the tip, which would else become a polygon.
dx = 0.5;
Include "notched_plate_hole_h15.geo";
