// Elements of about half the size.
dx = 0.48;
Include "single_edge_block.geo";
