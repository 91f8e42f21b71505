"""The fracture half of tools/studies/work-precision: the load at which a crack runs, against linear elastic fracture mechanics."""

import csv
import os

import matplotlib.pyplot as plt
import numpy as np

from case_file import write_case
from cases import make_mesh, run
from messages import fail
from precision_runs import lattice, material, plane_constants, prescribed, write_body, write_rows

G_C = 0.03  # small: strains stay below 1 %
STEP = 0.01  # of K over sqrt(E G_c), an increment
GROWTH = 2.0  # of the crack, in elements
FINE, FINE_IN_SLAB, GRADING = 18, 13, 1.3  # elements of 1 around the tip, then growing ones

DROPPED, KEPT = "Dropped", "Kept"
ON_DAMAGE, WHOLE_ZONE, NEVER = "On Damage", "Whole Zone", "Never"
DEFAULT = {"l": 1 / 3, "horizon": 4.0, "discontinuous": ON_DAMAGE, "stiffness": DROPPED, "zone": 2.0, "mesh": "squares",
           "direction": 0, "calibration": "Mesh-Consistent", "half_width": 100.0, "points": 2, "fraction": 1.0,
           "layers": 0,  # 0: a plate in plane stress, else a slab in plane strain
           "ratio": None}  # Poisson's; None: that of bonds alone
POLICIES = {(ON_DAMAGE, DROPPED): "#8a5bb0", (ON_DAMAGE, KEPT): "#1f5fa8", (WHOLE_ZONE, DROPPED): "#c8442c",
            (WHOLE_ZONE, KEPT): "#c98a1b"}
LENGTHS = (0.2, 0.25, 1 / 3, 0.5)


def horizon_for(length):
    """A horizon that cuts off less than 5 % of the micromodulus, or four elements."""
    return 3.0 if length < 0.3 else 4.0




def slab(length, horizon, **changes):
    """A setting in three dimensions; the zone as small as may be, two elements wider than a horizon."""
    return {"layers": 4, "calibration": "Analytic", "half_width": 50.0, "l": length, "horizon": horizon,
            "zone": 1.0 + 2.0 / horizon, **changes}

PERTURBATION = 0.25  # of the edges
LEVELS = 2  # of refinement, from coarse meshes

STUDIES = {2: {
    "resistance": [{"l": l, "horizon": horizon_for(l), "discontinuous": discontinuous, "stiffness": stiffness,
                    "calibration": "Analytic"} for discontinuous, stiffness in POLICIES for l in LENGTHS],
    "never": [{"l": l, "horizon": horizon_for(l), "discontinuous": NEVER, "stiffness": stiffness, "calibration": "Analytic"}
              for stiffness in (DROPPED, KEPT) for l in LENGTHS[1:]],
    "mesh": [{"l": l, "horizon": horizon_for(l), "mesh": "irregular"} for l in LENGTHS]
            + [{"mesh": "disc", "direction": direction, "half_width": 40.0} for direction in (0, 15, 30, 45)],
    "perturbation": [{"mesh": "perturbed disc", "direction": direction, "half_width": 40.0} for direction in (0, 15, 30, 45)],
    "refinement": [{"l": l, "horizon": horizon_for(l), "mesh": perturbed + size + "squares"} for l in (0.2, 1 / 3)
                   for perturbed in ("", "perturbed ") for size in ("", "coarse ")],
    "kind": [{"mesh": mesh} for mesh in ("triangles", "gmsh", "gmsh triangles")],
    "points": [{"l": l, "horizon": horizon_for(l), "points": 3, "calibration": "Analytic"} for l in LENGTHS],
    "rule": [{"fraction": 0.3}],
    "boundary": [{"half_width": half_width} for half_width in (25.0, 50.0, 100.0, 400.0)],
    "horizon": [{"horizon": 3.0}],
    "zone": [{"zone": 1.5}],
    "ratio": [{"ratio": ratio} for ratio in (0.15, 0.2)],
}, 3: {
    "resistance": [slab(l, horizon_for(l), discontinuous=discontinuous, stiffness=stiffness)
                   for discontinuous, stiffness in POLICIES for l in LENGTHS[:3]],
    "thickness": [slab(l, horizon_for(l), layers=layers) for l in LENGTHS[:3] for layers in (2, 8)],
    "horizon": [slab(l, 2.0) for l in LENGTHS[:2]],
    "points": [slab(0.2, 2.0, points=3)],
    "ratio": [slab(1 / 3, 4.0, ratio=ratio) for ratio in (0.15, 0.4)],
}}


def critical_displacement(points, direction, layers, ratio):
    """Displacement of an infinite body around the tip of a crack at the origin, K = sqrt(E' G_c)."""
    mu, k, modulus = plane_constants(layers, ratio)
    turn = np.array([[np.cos(direction), -np.sin(direction)], [np.sin(direction), np.cos(direction)]])
    x, y = (points @ turn).T
    r, t = np.hypot(x, y), np.arctan2(y, x)
    size = np.sqrt(modulus * G_C * r / (2 * np.pi)) / (2 * mu)
    return np.column_stack([size * np.cos(t / 2) * (k - 1 + 2 * np.sin(t / 2) ** 2),
                            size * np.sin(t / 2) * (k + 1 - 2 * np.cos(t / 2) ** 2)]) @ turn.T


# --- Bodies: nodes, elements of one kind, numbers of the nodes along the crack from its mouth to its tip ---


def squares(half_width, is_irregular=False, fine=FINE):
    """A square body, fine around the tip, the crack along a row of edges."""
    half = list(np.arange(fine + 1.0))
    step = GRADING
    while half[-1] < half_width:
        half.append(half[-1] + step)
        step *= GRADING
    nodes, quads = lattice(np.concatenate([-np.array(half[:0:-1]), half]))
    crack = np.flatnonzero((nodes[:, 1] == 0) & (nodes[:, 0] <= 0))
    if is_irregular:  # inner nodes are moved by up to a quarter of an element
        moved = np.hypot(*nodes.T) < fine - 1
        moved[crack] = False
        nodes[moved] += np.random.RandomState(1).uniform(-0.25, 0.25, (np.count_nonzero(moved), 2))
    return nodes, quads, crack


def coarse_squares(half_width):
    """A square body of equal elements that become those of 1 when they are refined."""
    size = 2**LEVELS
    count = round(half_width / size)
    nodes, quads = lattice(size * np.arange(-count, count + 1.0))
    return nodes, quads, np.flatnonzero((nodes[:, 1] == 0) & (nodes[:, 0] <= 0))


def triangles(half_width):
    """The squares, each cut along the diagonal that its neighbours' meet."""
    nodes, quads, crack = squares(half_width)
    n = round(len(quads) ** 0.5)
    turned = (np.add.outer(np.arange(n), np.arange(n)) % 2 == 1).ravel()
    quads = np.where(turned[:, None], np.roll(quads, -1, axis=1), quads)
    return nodes, np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]), crack


GEOMETRY = """
h = {half_width};
Point(1) = {{-h, -h, 0}}; Point(2) = {{h, -h, 0}}; Point(3) = {{h, h, 0}}; Point(4) = {{-h, h, 0}};
Point(5) = {{-h, 0, 0}}; Point(6) = {{0, 0, 0}};
Line(1) = {{1, 2}}; Line(2) = {{2, 3}}; Line(3) = {{3, 4}}; Line(4) = {{4, 5}}; Line(5) = {{5, 1}}; Line(6) = {{5, 6}};
Curve Loop(1) = {{1, 2, 3, 4, 5}}; Plane Surface(1) = {{1}};
Line{{6}} In Surface{{1}};
Field[1] = MathEval;
Field[1].F = "{size} * (1 + 0.125 * (Sqrt(x^2 + y^2) - {fine} + Fabs(Sqrt(x^2 + y^2) - {fine})))";
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0; Mesh.MeshSizeFromPoints = 0;
Mesh.Algorithm = 6; Mesh.RecombinationAlgorithm = 1; Mesh.MshFileVersion = 2.2;
{recombine}
Physical Surface("plate") = {{1}}; Physical Curve("crack") = {{6}};
"""


def gmshs_own(half_width, folder, of_triangles):
    """The square body as gmsh meshes it."""
    stem = os.path.join(folder, "body")
    make_mesh(stem, GEOMETRY.format(half_width=half_width, fine=FINE, size=1.0 if of_triangles else 1.05,
                                    recombine="" if of_triangles else "Recombine Surface{1};"))
    with open(stem + ".msh") as file:
        lines = file.read().split("\n")
    section = lambda name: [line.split() for line in lines[lines.index("$" + name) + 2:lines.index("$End" + name)]]
    nodes = np.array([line[1:3] for line in section("Nodes")], dtype=float)
    numbers = lambda is_line: np.array([line[5:] for line in section("Elements") if (line[1] == "1") == is_line], dtype=int) - 1
    crack = np.unique(numbers(True))
    return nodes, numbers(False), crack[np.argsort(nodes[crack, 0])]


def disc(radius, direction):
    """A disc of squares of 1, the crack at an angle to them: a staircase of edges."""
    nodes, quads = lattice(np.arange(-radius, radius + 1))
    quads = quads[np.hypot(*nodes[quads].mean(axis=1).T) < radius]
    used, quads = np.unique(quads, return_inverse=True)
    nodes, quads = nodes[used], quads.reshape(-1, 4)
    ahead = np.array([np.cos(direction), np.sin(direction)])
    is_above = nodes[quads].mean(axis=1) @ np.array([-ahead[1], ahead[0]]) > -1e-9
    sides = {}
    for quad, above in zip(quads, is_above):
        for side in zip(quad, np.roll(quad, -1)):
            sides.setdefault(tuple(sorted(side)), []).append(above)
    steps = [side for side, above in sides.items() if len(set(above)) == 2 and nodes[list(side)].mean(axis=0) @ ahead < 0]
    neighbours = {}
    for a, b in steps:
        neighbours.setdefault(a, []).append(b)
        neighbours.setdefault(b, []).append(a)
    ends = [node for node, others in neighbours.items() if len(others) == 1]
    crack = [min(ends, key=lambda node: nodes[node] @ ahead)]
    while ahead_of := [node for node in neighbours[crack[-1]] if node not in crack[-2:]]:
        crack.append(ahead_of[0])
    return nodes, quads, np.array(crack)


def body_of(setting, folder):
    mesh, half_width = setting["mesh"], setting["half_width"]
    if mesh.endswith("disc"):
        return disc(half_width, np.radians(setting["direction"]))
    if mesh.startswith("gmsh"):
        return gmshs_own(half_width, folder, mesh == "gmsh triangles")
    if mesh.endswith("coarse squares"):
        return coarse_squares(half_width)
    if mesh == "triangles":
        return triangles(half_width)
    return squares(half_width, mesh == "irregular", FINE_IN_SLAB if setting["layers"] else FINE)


def outer_nodes(elements):
    sides, counts = np.unique(np.sort(np.stack([elements, np.roll(elements, -1, axis=1)], axis=2).reshape(-1, 2)), axis=0,
                              return_counts=True)
    return np.unique(sides[counts == 1])


# --- Measuring ---


def case_of(folder, setting):
    direction = np.radians(setting["direction"])
    nodes, elements, crack = body_of(setting, folder)
    boundary = np.setdiff1d(outer_nodes(elements), crack[0])  # the crack's mouth is free
    horizon, radius, layers = setting["horizon"], setting["zone"], setting["layers"]
    displacements = STEP * critical_displacement(nodes[boundary], direction, layers, setting["ratio"])
    write_body(os.path.join(folder, "crack.msh"), nodes, elements, boundary, layers)
    tip, line = {"Center": [0, 0]}, {"Points": list(nodes[crack].ravel())}
    if layers > 0:
        mouth = nodes[crack[0]][0]
        tip = {"Shape": "Cylinder", "Start": [0, 0, -1], "End": [0, 0, layers + 1]}
        line = {"Shape": "Polygon", "Points": [mouth, 0, 0, 0, 0, 0, 0, 0, layers, mouth, 0, layers]}
    return {
        "Title": "A crack under the displacement of mode I on the outer boundary",
        "Dimension": 3 if layers else 2,
        "Mesh": {"File": "crack.msh", "Perturbation": PERTURBATION if setting["mesh"].startswith("perturbed") else 0.0,
                 "Refinement": {"Levels": LEVELS if "coarse" in setting["mesh"] else 0}},
        "Material": {**material(layers, setting["ratio"]), "Fracture Energy": G_C, "Calibration": setting["calibration"]},
        "Peridynamics": {"Horizon": horizon, "Characteristic Length": setting["l"],
                         "Points per Direction": setting["points"]},
        "Morphing": {"Discontinuous Elements": setting["discontinuous"],
                     "Stiffness in Peridynamic Zone": setting["stiffness"],
                     "Growth Inner Radius": radius, "Growth Outer Radius": 2 * radius,
                     "Seeds": {"tip": {**tip, "Inner Radius": radius * horizon, "Outer Radius": 2 * radius * horizon}}},
        "Pre-Cracks": {"crack": line},
        "Boundary Conditions": {"Displacements": prescribed(boundary, displacements, layers)},
        "Loading": {"Increments": 250, "Breaking Fraction": setting["fraction"]},
        "Output": {"Every": 1000, "Reactions": [f"n{boundary[0]}"]},
    }


def energy(row, name, setting):
    """By thickness, over G_c."""
    return float(row[name]) / (G_C * max(1, setting["layers"]))


def load_and_growth(row, setting):
    """K over sqrt(E' G_c) as prescribed, and how far the crack has grown: the energy it took, over K^2 / E'."""
    load = STEP * float(row["load_factor"])
    return load, (energy(row, "dissipated_energy", setting) + energy(row, "jump_loss", setting)) / load**2


def has_grown(rows, setting):
    return bool(rows) and load_and_growth(rows[-1], setting)[1] >= GROWTH


def measured(rows, setting):
    """K over sqrt(E' G_c): at the first broken bond, the mean while the crack grows, the largest; energies over G_c."""
    loads, growths = [], [0.0]
    for row in rows:
        load, growth = load_and_growth(row, setting)
        # The boundary holds the displacement of a crack that has not grown, so that K falls by 1/2 of growth over half
        # width: the study "boundary" shows that this makes up for it, from a half width of 50 on.
        loads.append(load * (1 - 0.5 * growths[-1] / setting["half_width"]))
        growths.append(growth)
        if growth >= GROWTH:
            break
    first = next(STEP * float(row["load_factor"]) for row in rows if int(row["broken_bonds"]) > 0)
    mean = np.dot(loads, np.diff(growths)) / growths[-1]
    return {"first": f"{first:.3f}", "load": f"{mean:.3f}", "largest": f"{max(loads):.3f}", "growth": f"{growths[-1]:.2f}",
            "dissipated": f"{energy(row, 'dissipated_energy', setting):.3f}", "jump_loss": f"{energy(row, 'jump_loss', setting):.3f}"}


def measure(dimension, studies, folder):
    stem = os.path.join(folder, "fracture" if dimension == 2 else "fracture_3d")
    file = stem + ".csv"
    rows = []
    if os.path.exists(file):  # studies that are not run again keep their rows
        with open(file) as stream:
            rows = [row for row in csv.DictReader(stream) if row["study"] not in studies]
    for study in studies:
        for changes in STUDIES[dimension][study]:
            setting = {**DEFAULT, **changes}
            case = case_of(folder, setting)
            write_case(os.path.join(folder, "crack.xml"), case)
            one = run(os.path.join(folder, "crack.xml"), os.path.join(folder, "crack"),
                      is_enough=lambda so_far: has_grown(so_far, setting))
            if not has_grown(one.history, setting):
                fail(f"study {study}: the crack did not grow by {GROWTH:g} elements with {changes}")
            shown = {key: f"{value:.3g}" if isinstance(value, float) else value for key, value in setting.items()}
            rows.append({"study": study, **shown, **measured(one.history, setting), "unknowns": one.history[-1]["unknowns"],
                         "seconds": f"{one.processor:.3g}", "memory_mb": f"{one.memory:.0f}"})
            print("  ".join(f"{key} {value}" for key, value in rows[-1].items()), flush=True)
            write_rows(file, rows)
    draw(rows, OTHERS[dimension], stem + ".png")


# --- Drawing ---

# Markers beside the lines of "resistance": label, marker, which rows.
OTHERS = {2: [(f"{ON_DAMAGE}, {DROPPED}, analytic, 3 x 3 points", "+", lambda row: row["study"] == "points"),
              (f"{ON_DAMAGE}, {DROPPED}, calibrated to the mesh: other meshes, horizon, zone, rule, ratio", "x",
               lambda row: row["calibration"] == "Mesh-Consistent" and row["study"] != "boundary")],
          3: [(f"{ON_DAMAGE}, {DROPPED}, two layers", "v", lambda row: row["study"] == "thickness" and int(row["layers"]) == 2),
              (f"{ON_DAMAGE}, {DROPPED}, eight layers", "^", lambda row: row["study"] == "thickness" and int(row["layers"]) == 8),
              (f"{ON_DAMAGE}, {DROPPED}, horizon 2", "x", lambda row: row["study"] == "horizon"),
              (f"{ON_DAMAGE}, {DROPPED}, horizon 2, 3 x 3 x 3 points", "+", lambda row: row["study"] == "points")]}


def draw(rows, others, file):
    figure, panels = plt.subplots(1, 4, figsize=(13, 5))
    lengths, *costs = panels

    def plot(mine, *style, **styles):
        lengths.plot([float(row["l"]) for row in mine], [float(row["load"]) for row in mine], *style, **styles)
        for panel, column in zip(costs, ("seconds", "unknowns", "memory_mb")):
            panel.plot([float(row[column]) for row in mine], [100 * abs(float(row["load"]) - 1) for row in mine], *style, **styles)

    for (discontinuous, stiffness), colour in POLICIES.items():
        mine = [row for row in rows if row["study"] == "resistance"
                and (row["discontinuous"], row["stiffness"]) == (discontinuous, stiffness)]
        plot(mine, color=colour, marker="o", markersize=4, label=f"{discontinuous}, {stiffness}, analytic")
    for label, marker, belongs in others:
        plot([row for row in rows if belongs(row)], marker, color="black", label=label)
    lengths.axhspan(0.95, 1.05, color="#eeeeee", zorder=0)
    for panel, label in zip(panels, ("characteristic length / element size", "processor time [s]", "unknowns", "memory [MB]")):
        panel.set_xlabel(label)
        panel.grid(True, color="#e4e4e4", linewidth=0.6)
        for side in ("top", "right"):
            panel.spines[side].set_visible(False)
    lengths.set_ylabel("load at which the crack runs / LEFM")
    costs[0].set_ylabel("error of this load [%]")
    figure.legend(*lengths.get_legend_handles_labels(), loc="lower center", ncol=3, frameon=False)
    figure.subplots_adjust(left=0.06, right=0.99, top=0.97, bottom=0.32, wspace=0.25)
    figure.savefig(file, dpi=150)
