// The plane section.
thickness = 0;
Include "single_edge_block.geo";
