"""The bodies that tools/studies/benchmark --runs phase_field breaks with Perimorph and with a phase field. All in mm, N and MPa; meshes
of quadrilaterals or hexahedra in the format MSH 2.2, which both read."""

import os
import re

import numpy as np

from case_file import read_case, write_case
from cases import ROOT, make_mesh
from precision_runs import lattice, write_mesh

INPUTS = os.path.join(ROOT, "inputs")
DEFAULT, LENGTH_IN_3D = 1 / 3, 0.2  # characteristic length of ours, in elements
HORIZONS = {2: 4.0, 3: 2.0}  # in elements, by dimension
TIP, SIDE, WIDTH, HEIGHT, THICKNESS = 25.0, 100.0, 24.0, 48.0, 6.0


def ours(dimension, size, length=DEFAULT, horizon=None):
    """Parameters of peridynamics, lengths in elements, and radii that suit them."""
    horizon = horizon or HORIZONS[dimension]
    return {"Peridynamics": {"Horizon": horizon * size, "Characteristic Length": length * size}}, 2 * horizon * size


def increments_of(case):
    return read_case(case)["Loading"]["Increments"]


def circle(center, radius):
    return {"Center": center, "Inner Radius": radius, "Outer Radius": 2 * radius}


def pulled(bottom, top, rate, constant=0.0):
    """Displacements between grips that are free to narrow, but for a corner."""
    return {"hold": {"Group": bottom, "Component": "y"}, "corner": {"Group": "corner", "Component": "x"},
            "pull": {"Group": top, "Component": "y", "Rate": rate, "Constant": constant}}


def written(file, mesh, size, material, displacements, increments, seeds, cracks=None, length=DEFAULT, dimension=2):
    peridynamics, radius = ours(dimension, size, length)
    write_case(file, {
        "Dimension": dimension, "Mesh": {"File": mesh},
        "Material": {"Young's Modulus": 30000.0, "Poisson's Ratio": 1 / 3, "Elastic Model": "Plane Stress", **material},
        **peridynamics, "Morphing": {"Seeds": seeds(radius)}, "Pre-Cracks": cracks or {},
        "Boundary Conditions": {"Displacements": displacements}, "Loading": {"Increments": increments},
        "Output": {"Every": 1000, "Reactions": ["top"]}})
    return file


def edge_crack(folder, size=1.0, is_irregular=False, tip=TIP, length=DEFAULT, rate=0.0014, constant=0.0, increments=24, is_whole=False):
    """A plate of 100 x 100, an edge crack of 25 at half its height. @param is_whole classical throughout"""
    nodes, cells = lattice(size * np.arange(round(SIDE / size) + 1))
    nodes[:, 1] -= SIDE / 2
    groups = {"bottom": np.flatnonzero(nodes[:, 1] == -SIDE / 2), "top": np.flatnonzero(nodes[:, 1] == SIDE / 2), "corner": [0]}
    if is_irregular:
        inner = np.all((nodes > [0, -SIDE / 2]) & (nodes < [SIDE, SIDE / 2]), axis=1) & ((nodes[:, 1] != 0) | (nodes[:, 0] > TIP))
        nodes[inner] += size * np.random.RandomState(1).uniform(-0.25, 0.25, (np.count_nonzero(inner), 2))
    write_mesh(os.path.join(folder, "edge_crack.msh"), nodes, cells, groups)
    return written(os.path.join(folder, "edge_crack.xml"), "edge_crack.msh", size, {"Fracture Energy": 0.1},
                   pulled("bottom", "top", rate, constant), increments,
                   lambda radius: {} if is_whole else {"tip": circle([tip, 0.0], radius)},
                   {"crack": {"Points": [0.0, 0.0, tip, 0.0]}}, length)


def meshed(folder, case, changes):
    """A mesh of a geometry of inputs/ with other values of its variables."""
    stem = os.path.join(INPUTS, case)
    with open(stem + ".geo", encoding="utf-8") as file:
        geometry = file.read()
    for name, value in changes.items():
        geometry = re.sub(rf"^( *{re.escape(name)} =) [^;]+;", rf"\g<1> {value};", geometry, count=1, flags=re.MULTILINE)
    name = os.path.basename(case)
    make_mesh(os.path.join(folder, name), geometry, "-format", "msh22")
    return name + ".msh"


def double_notch(folder, size=2.0):
    """inputs/double_edge_notched_plate on a coarser mesh, by the fracture energy that belongs to its critical stretch."""
    mesh = meshed(folder, "double_edge_notched_plate/double_edge_notched_plate", {"dx": size, "columns": 4, "rows()": "{4, 4, 4}"})
    move = lambda group, component, rate: {"Group": group, "Component": component, "Rate": rate}
    return written(os.path.join(folder, "double_notch.xml"), mesh, size, {"Fracture Energy": 342.1},
                   {"up": move("top", "y", 0.08), "down": move("bottom", "y", -0.08), "right": move("upper_left", "x", 0.02),
                    "left": move("lower_right", "x", -0.02)}, 40,
                   lambda radius: {"left": circle([25.0, 0.0], radius), "right": circle([175.0, 0.0], radius)})


def hole(folder, size=0.5):
    """inputs/notched_plate_hole, the notch 10 above the bottom, on a coarser mesh, by the same."""
    mesh = meshed(folder, "notched_plate_hole/notched_plate_hole", {"dx": size})
    return written(os.path.join(folder, "hole.xml"), mesh, size, {"Young's Modulus": 71400.0, "Fracture Energy": 203.6},
                   pulled("bottom", "top", 0.03), 60, lambda radius: {"tip": circle([10.5, 10.0], radius)})


def block(folder, size=1.0, tip=WIDTH / 2, is_whole=False):
    """inputs/single_edge_block, 24 x 48 x 6, an edge crack of 12, pulled between two grips."""
    n = [round(side / size) for side in (WIDTH, HEIGHT, THICKNESS)]
    x, y, z = (np.linspace(0, side, k + 1) for side, k in zip((WIDTH, HEIGHT, THICKNESS), n))
    nodes = np.column_stack([axis.ravel() for axis in np.meshgrid(x, y - HEIGHT / 2, z, indexing="ij")])
    number = np.arange(len(nodes)).reshape([k + 1 for k in n])
    corner = lambda i, j, k: number[i:n[0] + i, j:n[1] + j, k:n[2] + k].ravel()
    around = [(0, 0), (1, 0), (1, 1), (0, 1)]
    cells = np.column_stack([corner(i, j, k) for k in (0, 1) for i, j in around])
    write_mesh(os.path.join(folder, "block.msh"), nodes, cells,
               {"bottom": number[:, 0].ravel(), "top": number[:, -1].ravel(), "corner": number[0, 0], "end": [number[0, 0, 0]]})
    return written(os.path.join(folder, "block.xml"), "block.msh", size,
                   {"Fracture Energy": 0.1, "Poisson's Ratio": 0.25, "Elastic Model": "Three-Dimensional"},
                   {**pulled("bottom", "top", 0.0005), "z": {"Group": "end", "Component": "z"}}, 60,
                   lambda radius: {} if is_whole else {"front": {
                       "Shape": "Cylinder", "Start": [tip, 0.0, 0.0], "End": [tip, 0.0, THICKNESS], "Inner Radius": radius,
                       "Outer Radius": 2 * radius}},
                   {"crack": {"Shape": "Polygon",
                              "Points": [0.0, 0.0, 0.0, tip, 0.0, 0.0, tip, 0.0, THICKNESS, 0.0, 0.0, THICKNESS]}},
                   LENGTH_IN_3D, dimension=3)
