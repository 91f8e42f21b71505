// Elements of four times the size of the fine ones, to be refined where the zone is.
dx = 2;
Include "single_edge_block.geo";
