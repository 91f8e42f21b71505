// Elements of twice the size, to be refined around the hole.
dx = 3;
Include "plate_with_hole.geo";
