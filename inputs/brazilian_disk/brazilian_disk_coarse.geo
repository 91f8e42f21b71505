// Elements of four times the size, to be refined where the zone is.
dx = 2;
Include "brazilian_disk.geo";
