// Elements of four times the size, to be refined where the zone is.
dx = 4;
columns = 2;
rows() = {2, 2, 2};
Include "double_edge_notched_plate.geo";
