// The notch 10 above the bottom.
h = 10;
Include "notched_plate_hole.geo";
