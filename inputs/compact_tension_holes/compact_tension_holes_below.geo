// With the crack at another height.
H = -1.6;
Include "compact_tension_holes.geo";
