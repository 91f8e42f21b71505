// The notch 15 above the bottom.
h = 15;
Include "notched_plate_hole.geo";
