// Two elements thick.
thickness = 2;
Include "single_edge_block.geo";
