// With the crack at another height.
H = 0.8;
Include "compact_tension_holes.geo";
