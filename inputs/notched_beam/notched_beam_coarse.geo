// Elements of four times the size, to be refined where the zone is.
dx = 2;
n() = {2, 2, 2};
Include "notched_beam.geo";
