"""The fracture half of tools/work-precision: the load at which a crack runs, against linear elastic fracture mechanics."""

import csv
import os

import matplotlib.pyplot as plt
import numpy as np

from cases import run, write_case
from precision_runs import E, NU, prescribed, write_mesh, write_rows

G_C = 0.03  # small: strains stay below 1 %
STEP = 0.01  # of K over sqrt(E G_c), an increment
GROWTH = 2.0  # of the crack, in elements
FINE, HALF_WIDTH, GRADING = 18, 100.0, 1.3  # squares of 1 around the tip, then growing ones
DISC = 40.0  # radius of the body of squares throughout

DROPPED, KEPT = "Dropped", "Kept"
ON_DAMAGE, WHOLE_ZONE = "On Damage", "Whole Zone"
DEFAULT = {"l": 1 / 3, "horizon": 4.0, "discontinuous": ON_DAMAGE, "stiffness": DROPPED, "zone": 2.0, "mesh": "squares",
           "direction": 0, "calibration": "Mesh-Consistent"}
POLICIES = {(ON_DAMAGE, DROPPED): "#8a5bb0", (ON_DAMAGE, KEPT): "#1f5fa8", (WHOLE_ZONE, DROPPED): "#c8442c",
            (WHOLE_ZONE, KEPT): "#c98a1b"}
LENGTHS = (0.2, 0.25, 1 / 3, 0.5)


def horizon_for(length):
    """A horizon that cuts off less than 5 % of the micromodulus, or four elements."""
    return 3.0 if length < 0.3 else 4.0


STUDIES = {
    "resistance": [{"l": l, "horizon": horizon_for(l), "discontinuous": discontinuous, "stiffness": stiffness,
                    "calibration": "Analytic"} for discontinuous, stiffness in POLICIES for l in LENGTHS],
    "mesh": [{"l": l, "horizon": horizon_for(l), "mesh": "irregular"} for l in LENGTHS]
            + [{"mesh": "disc", "direction": direction} for direction in (0, 15, 30, 45)],
    "horizon": [{"horizon": 3.0}],
    "zone": [{"zone": 1.5}],
}


def mode_one(points, direction):
    """Displacement of an infinite body around the tip of a crack at the origin, plane stress, K = 1."""
    turn = np.array([[np.cos(direction), -np.sin(direction)], [np.sin(direction), np.cos(direction)]])
    x, y = (points @ turn).T
    r, t = np.hypot(x, y), np.arctan2(y, x)
    mu, k = E / (2 * (1 + NU)), (3 - NU) / (1 + NU)
    size = np.sqrt(r / (2 * np.pi)) / (2 * mu)
    return np.column_stack([size * np.cos(t / 2) * (k - 1 + 2 * np.sin(t / 2) ** 2),
                            size * np.sin(t / 2) * (k + 1 - 2 * np.cos(t / 2) ** 2)]) @ turn.T


# --- Bodies: nodes, quadrilaterals, numbers of the nodes along the crack from its mouth to its tip ---


def lattice(x):
    """The quadrilaterals between the lines x = const. and y = const."""
    nodes = np.column_stack([axis.ravel() for axis in np.meshgrid(x, x)])
    n = len(x)
    first = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).ravel()
    return nodes, np.column_stack([first, first + 1, first + n + 1, first + n])


def squares(is_irregular):
    """A square body, fine around the tip, the crack along a row of edges."""
    half = list(np.arange(FINE + 1.0))
    step = GRADING
    while half[-1] < HALF_WIDTH:
        half.append(half[-1] + step)
        step *= GRADING
    nodes, quads = lattice(np.concatenate([-np.array(half[:0:-1]), half]))
    crack = np.flatnonzero((nodes[:, 1] == 0) & (nodes[:, 0] <= 0))
    if is_irregular:  # inner nodes are moved by up to a quarter of an element
        moved = np.hypot(*nodes.T) < FINE - 1
        moved[crack] = False
        nodes[moved] += np.random.RandomState(1).uniform(-0.25, 0.25, (np.count_nonzero(moved), 2))
    return nodes, quads, crack


def disc(direction):
    """A disc of squares of 1, the crack at an angle to them: a staircase of edges."""
    nodes, quads = lattice(np.arange(-DISC, DISC + 1))
    quads = quads[np.hypot(*nodes[quads].mean(axis=1).T) < DISC]
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


def outer_nodes(quads):
    sides, counts = np.unique(np.sort(np.stack([quads, np.roll(quads, -1, axis=1)], axis=2).reshape(-1, 2)), axis=0,
                              return_counts=True)
    return np.unique(sides[counts == 1])


# --- Measuring ---


def case_of(folder, setting):
    direction = np.radians(setting["direction"])
    nodes, quads, crack = disc(direction) if setting["mesh"] == "disc" else squares(setting["mesh"] == "irregular")
    boundary = np.setdiff1d(outer_nodes(quads), crack[0])  # the crack's mouth is free
    write_mesh(os.path.join(folder, "crack.msh"), nodes, quads, boundary)
    horizon, radius = setting["horizon"], setting["zone"]
    return {
        "Title": "A crack under the displacement of mode I on the outer boundary",
        "Mesh": {"File": "crack.msh"},
        "Material": {"Young's Modulus": E, "Poisson's Ratio": NU, "Elastic Model": "Plane Stress", "Fracture Energy": G_C,
                     "Calibration": setting["calibration"]},
        "Peridynamics": {"Horizon": horizon, "Characteristic Length": setting["l"]},
        "Morphing": {"Discontinuous Elements": setting["discontinuous"],
                     "Stiffness in Peridynamic Zone": setting["stiffness"],
                     "Growth Inner Radius": radius, "Growth Outer Radius": 2 * radius,
                     "Seeds": {"tip": {"Center": [0, 0], "Inner Radius": radius * horizon,
                                       "Outer Radius": 2 * radius * horizon}}},
        "Pre-Cracks": {"crack": {"Points": list(nodes[crack].ravel())}},
        "Boundary Conditions": {"Displacements": prescribed(
            boundary, STEP * np.sqrt(E * G_C) * mode_one(nodes[boundary], direction))},
        "Loading": {"Increments": 250},
        "Output": {"Every": 1000, "Reactions": "{n%d}" % boundary[0]},
    }


def load_and_growth(row):
    """K over sqrt(E G_c) as prescribed, and how far the crack has grown: the energy it took, over K^2 / E."""
    load = STEP * float(row["load_factor"])
    return load, (float(row["dissipated_energy"]) + float(row["jump_loss"])) / (G_C * load**2)


def has_grown(rows):
    return bool(rows) and load_and_growth(rows[-1])[1] >= GROWTH


def measured(rows, setting):
    """K over sqrt(E G_c): at the first broken bond, the mean while the crack grows, the largest; energies over G_c."""
    half_width = DISC if setting["mesh"] == "disc" else HALF_WIDTH
    loads, growths = [], [0.0]
    for row in rows:
        load, growth = load_and_growth(row)
        # The boundary holds the displacement of a crack that has not grown: K falls by 1/2 of growth over half width,
        # which brings half widths of 100 and 400 together.
        loads.append(load * (1 - 0.5 * growths[-1] / half_width))
        growths.append(growth)
        if growth >= GROWTH:
            break
    first = next(STEP * float(row["load_factor"]) for row in rows if int(row["broken_bonds"]) > 0)
    mean = np.dot(loads, np.diff(growths)) / growths[-1]
    return {"first": f"{first:.3f}", "load": f"{mean:.3f}", "largest": f"{max(loads):.3f}", "growth": f"{growths[-1]:.2f}",
            "dissipated": f"{float(row['dissipated_energy']) / G_C:.3f}", "jump_loss": f"{float(row['jump_loss']) / G_C:.3f}"}


def measure(studies, folder):
    file = os.path.join(folder, "fracture.csv")
    rows = []
    if os.path.exists(file):  # studies that are not run again keep their rows
        with open(file) as stream:
            rows = [row for row in csv.DictReader(stream) if row["study"] not in studies]
    for study in studies:
        for changes in STUDIES[study]:
            setting = {**DEFAULT, **changes}
            case = case_of(folder, setting)
            write_case(os.path.join(folder, "crack.xml"), case)
            one = run(os.path.join(folder, "crack.xml"), os.path.join(folder, "crack"), is_enough=has_grown)
            shown = {key: f"{value:.3g}" if isinstance(value, float) else value for key, value in setting.items()}
            rows.append({"study": study, **shown, **measured(one.history, setting), "unknowns": one.history[-1]["unknowns"],
                         "seconds": f"{one.processor:.3g}", "memory_mb": f"{one.memory:.0f}"})
            print("  ".join(f"{key} {value}" for key, value in rows[-1].items()), flush=True)
            write_rows(file, rows)
    draw(rows, os.path.join(folder, "fracture.png"))


# --- Drawing ---


def draw(rows, file):
    figure, panels = plt.subplots(1, 4, figsize=(13, 5))
    lengths, *costs = panels
    for (discontinuous, stiffness), colour in POLICIES.items():
        mine = [row for row in rows if row["study"] == "resistance"
                and (row["discontinuous"], row["stiffness"]) == (discontinuous, stiffness)]
        style = {"color": colour, "marker": "o", "markersize": 4, "label": f"{discontinuous}, {stiffness}, analytic"}
        lengths.plot([float(row["l"]) for row in mine], [float(row["load"]) for row in mine], **style)
        error = [100 * abs(float(row["load"]) - 1) for row in mine]
        for panel, column in zip(costs, ("seconds", "unknowns", "memory_mb")):
            panel.plot([float(row[column]) for row in mine], error, **style)
    calibrated = [row for row in rows if row["study"] != "resistance"]
    lengths.plot([float(row["l"]) for row in calibrated], [float(row["load"]) for row in calibrated], "x", color="black",
                 label=f"{ON_DAMAGE}, {DROPPED}, calibrated to the mesh: irregular, turned, horizon, zone")
    for panel, column in zip(costs, ("seconds", "unknowns", "memory_mb")):
        panel.plot([float(row[column]) for row in calibrated], [100 * abs(float(row["load"]) - 1) for row in calibrated], "x",
                   color="black")
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
