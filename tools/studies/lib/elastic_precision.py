"""The elastic half of tools/studies/work-precision: error of the displacement around a hole."""

import os
import subprocess

import matplotlib.pyplot as plt
import numpy as np

from case_file import write_case
from cases import run
from fields import Displacement
from messages import fail
from precision_runs import material, plane_constants, prescribed, write_body, write_rows

HALF, RADIUS = 75.0, 15.0
STRESS = 300.0
SMALLER = 1.08  # recombined quadrilaterals come out smaller than asked for by this

GEOMETRY = """
size = {size};
half = {half};
radius = {radius};
Point(5) = {{0, 0, 0, size}};
For i In {{0:3}}
  Point(1 + i) = {{half * Sqrt(2) * Cos((i + 0.5) * Pi / 2), half * Sqrt(2) * Sin((i + 0.5) * Pi / 2), 0, size}};
  Point(6 + i) = {{radius * Cos(i * Pi / 2), radius * Sin(i * Pi / 2), 0, size}};
EndFor
For i In {{0:3}}
  Line(1 + i) = {{1 + i, 1 + (i + 1) % 4}};
  Circle(5 + i) = {{6 + i, 5, 6 + (i + 1) % 4}};
EndFor
Curve Loop(1) = {{1:4}};
Curve Loop(2) = {{5:8}};
Plane Surface(1) = {{1, 2}};
Recombine Surface{{1}};
Mesh.Algorithm = 6;
Mesh.RecombinationAlgorithm = 3;
"""

RADII = {"Inner Radius": 30.0, "Outer Radius": 60.0}
CIRCLE = {**RADII, "Center": [0, 0]}
EVERYTHING = {"Shape": "Everything"}
# name: seed, which elements are discontinuous, what becomes of E(x); colour
VARIANTS = {
    "finite elements": (None, "On Damage", "Dropped", "#4a4a4a"),
    "hybrid, Whole Zone, Dropped (WHL19)": (CIRCLE, "Whole Zone", "Dropped", "#c8442c"),
    "hybrid, Whole Zone, Kept": (CIRCLE, "Whole Zone", "Kept", "#c98a1b"),
    "hybrid, On Damage, Dropped": (CIRCLE, "On Damage", "Dropped", "#8a5bb0"),
    "hybrid, On Damage, Kept": (CIRCLE, "On Damage", "Kept", "#1f5fa8"),
    "all peridynamic, Whole Zone, Dropped": (EVERYTHING, "Whole Zone", "Dropped", "#e08f80"),
    "all peridynamic, On Damage, Kept": (EVERYTHING, "On Damage", "Kept", "#7fb0de"),
}


def kirsch(points, layers):
    """Displacement of an infinite body with a round hole under tension along x."""
    mu, k, _ = plane_constants(layers)
    r, t = np.hypot(points[:, 0], points[:, 1]) / RADIUS, np.arctan2(points[:, 1], points[:, 0])
    x = r * (k + 1) * np.cos(t) + 2 / r * ((1 + k) * np.cos(t) + np.cos(3 * t)) - 2 / r**3 * np.cos(3 * t)
    y = r * (k - 3) * np.sin(t) + 2 / r * ((1 - k) * np.sin(t) + np.sin(3 * t)) - 2 / r**3 * np.sin(3 * t)
    return STRESS * RADIUS / (8 * mu) * np.column_stack([x, y])


def meshed(stem, size, half=HALF):
    """Nodes and quadrilaterals of the body."""
    with open(stem + ".geo", "w") as out:
        out.write(GEOMETRY.format(size=size, half=half, radius=RADIUS))
    made = subprocess.run(["gmsh", "-2", "-v", "0", "-format", "msh22", stem + ".geo", "-o", stem + ".msh"])
    if made.returncode != 0:
        fail(f"gmsh could not mesh {stem}.geo")
    with open(stem + ".msh") as file:
        lines = file.read().split("\n")
    first = lines.index("$Nodes") + 2
    all_nodes = np.array([line.split()[1:3] for line in lines[first:lines.index("$EndNodes")]], dtype=float)
    first = lines.index("$Elements") + 2
    quads = np.array([line.split()[-4:] for line in lines[first:lines.index("$EndElements")] if line.split()[1] == "3"],
                     dtype=int) - 1
    used, quads = np.unique(quads, return_inverse=True)  # not the hole's centre
    return all_nodes[used], quads.reshape(-1, 4)


def written(stem, nodes, quads, layers=0):
    """Writes the body's mesh; returns the mean edge in the plane, the boundary's nodes and their positions."""
    boundary = np.flatnonzero(np.abs(nodes).max(axis=1) > np.abs(nodes).max() * (1 - 1e-9))
    corners = nodes[quads]
    dx = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).mean()
    write_body(stem + ".msh", nodes, quads, boundary, layers, dx)
    return dx, boundary, nodes[boundary]


def case_of(mesh, dx, boundary, positions, layers, variant):
    seed, discontinuous, stiffness, _ = variant
    morphing = {"Discontinuous Elements": discontinuous, "Stiffness in Peridynamic Zone": stiffness}
    if seed == CIRCLE and layers:
        seed = {**RADII, "Shape": "Cylinder", "Start": [0, 0, -float(dx)], "End": [0, 0, float((layers + 1) * dx)]}
    if seed is not None:
        morphing["Seeds"] = {"zone": seed}
    return {
        "Title": "Body with a hole, the exact displacement around it",
        "Dimension": 3 if layers else 2,
        "Mesh": {"File": os.path.abspath(mesh)},
        "Material": material(layers),
        "Peridynamics": {"Horizon": 3 * float(dx), "Characteristic Length": 0.2 * float(dx)},
        "Morphing": morphing,
        "Boundary Conditions": {"Displacements": prescribed(boundary, kirsch(positions, layers), layers)},
        "Loading": {"Increments": 1},
        "Output": {"Reactions": [f"n{boundary[0]}"]},
    }


def errors(output, layers):
    """Largest over all nodes, for each component in the plane over its largest displacement."""
    result = Displacement(output)
    exact = kirsch(result.coordinates, layers)
    return np.abs(result.values[:, :2] - exact).max(axis=0) / np.abs(exact).max(axis=0)


def measure(layers, sizes, repeat, folder):
    rows = []
    for size in sorted(sizes, reverse=True):
        stem = os.path.join(folder, f"plate-{size:g}")
        body = meshed(stem, SMALLER * size)
        dx, boundary, positions = written(stem, *body, layers)
        for name, variant in VARIANTS.items():
            write_case(stem + ".xml", case_of(stem + ".msh", dx, boundary, positions, layers, variant))
            fastest = min((run(stem + ".xml", stem) for _ in range(repeat)), key=lambda one: one.processor)
            error = errors(stem, layers)
            rows.append({"variant": name, "dx": f"{dx:.4g}", "unknowns": fastest.history[-1]["unknowns"],
                         "seconds": f"{fastest.processor:.3g}", "memory_mb": f"{fastest.memory:.0f}", "error_x": f"{error[0]:.3e}",
                         "error_y": f"{error[1]:.3e}"})
            print("  ".join(f"{key} {value}" for key, value in rows[-1].items()), flush=True)
    result = os.path.join(folder, "elastic_3d" if layers else "elastic")
    write_rows(result + ".csv", rows)
    draw(rows, result + ".png")


def draw(rows, file):
    figure, panels = plt.subplots(1, 3, sharey=True, figsize=(12, 5))
    for panel, (column, label) in zip(panels, (("seconds", "processor time [s]"), ("unknowns", "unknowns"),
                                               ("memory_mb", "memory [MB]"))):
        for name, (_, _, _, colour) in VARIANTS.items():
            mine = [row for row in rows if row["variant"] == name]
            panel.loglog([float(row[column]) for row in mine],
                         [100 * max(float(row["error_x"]), float(row["error_y"])) for row in mine],
                         color=colour, marker="o", markersize=4, label=name)
        panel.set_xlabel(label)
        panel.grid(True, which="both", color="#e4e4e4", linewidth=0.6)
        for side in ("top", "right"):
            panel.spines[side].set_visible(False)
    panels[0].set_ylabel("largest error of the displacement [%]")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="lower center", ncol=3, frameon=False)
    figure.subplots_adjust(left=0.07, right=0.99, top=0.97, bottom=0.28, wspace=0.06)
    figure.savefig(file, dpi=150)
