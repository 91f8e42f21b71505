"""Perimorph beside a phase field, for tools/studies/benchmark --runs phase_field and tools/studies/phase-field."""

import collections
import math
import os
import subprocess
import sys
import time

import numpy as np

import phase_field_cases as bodies
from cases import rows_of, run
from fields import distances_between
from runs import ExodusFile, all_steps, series_of
from tables import print_table

PHASE_FIELD = os.path.join(os.path.dirname(os.path.realpath(__file__)), "phase_field.py")
LIMIT = 600  # wall seconds of a run
LENGTH = 2.0  # of the phase field, in elements
RELAXATION = 1.5
COLOURS = ("#1f5fa8", "#c8442c", "#c98a1b")
PATHS = os.path.join("results", "phase_field_paths.png")
CRACKED = {"ours": 0.35, "theirs": 0.95}  # damage of an element, d of a node: where a crack is

# rows of the history; whether all increments were done; wall and processor seconds; MiB; places where the crack is
Outcome = collections.namedtuple("Outcome", "rows is_through wall processor memory crack")


def force(row):
    return float(row["reaction_top_y"])


def peak(rows):
    return max(map(force, rows))


def has_dropped(rows):
    """To half of the largest force."""
    return bool(rows) and force(rows[-1]) < 0.5 * peak(rows)


def announce(case, name):
    print(f"{os.path.splitext(os.path.basename(case))[0]}, {name}", file=sys.stderr)


def damaged_elements(output):
    """Their centres, at the last step that was written."""
    for file, step in list(all_steps([ExodusFile(names) for names in series_of(output)]))[-1:]:
        corners = [np.stack([axis[nodes] for axis in file.coordinates()], axis=-1) for nodes in file.connectivity()]
        return np.concatenate([x.mean(axis=1) for x in corners])[file.values("damage", step) > CRACKED["ours"]]
    return np.empty((0, 2))


def run_ours(case, increments, limit=math.inf, is_enough=lambda rows: False):
    announce(case, "Perimorph")
    output, end = os.path.splitext(case)[0] + "-ours", time.monotonic() + limit
    one = run(case, output, is_enough=lambda rows: time.monotonic() > end or is_enough(rows))
    is_through = len(one.history) == increments or is_enough(one.history)
    crack = damaged_elements(output) if is_through else np.empty((0, 2))
    return Outcome(one.history, is_through, one.wall, one.processor, one.memory, crack)


def run_theirs(case, model, length, limit=1e9, options=()):
    announce(case, f"{model}, length {length:g}")
    folder = f"{os.path.splitext(case)[0]}-{model}"
    command = [PHASE_FIELD, case, folder, "--model", model, "--length", str(length), "--seconds", str(limit),
               "--relaxation", str(RELAXATION), *options]
    begin = time.monotonic()
    process = subprocess.Popen(command, env=dict(os.environ, OPENBLAS_NUM_THREADS="1"), stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    wall, status = time.monotonic() - begin, os.waitstatus_to_exitcode(status)
    if status not in (0, 3):
        sys.exit(f"{' '.join(command)}: ended with status {status}")
    field = np.load(os.path.join(folder, "damage.npz"))
    return Outcome(rows_of(folder), status == 0, wall, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024,
                   field["nodes"][(field["damage"] > CRACKED["theirs"]) & ~field["is_pre_crack"]])


def compile_forms(case, model, length):
    """FEniCSx compiles each form once and keeps it; that is in no figure."""
    run_theirs(case, model, length, 0)


def fracture_mechanics(folder, body, tip, size, thickness, g_c):
    """Force and displacement at which the crack runs, from the energies of finite elements with a shorter and a longer crack."""
    energies, forces, moved = [], [], []
    for end in (tip - 2 * size, tip + 2 * size):
        case = body(folder, size, tip=end, is_whole=True)
        first = run(case, os.path.join(folder, "classical"), settings=["Loading/Increments=1"]).history[0]
        energies.append(float(first["elastic_energy"]))
        forces.append(force(first))
        moved.append(float(first["displacement_top_y"]))
    released = (energies[0] - energies[1]) / (4 * size * thickness)
    load = float(np.sqrt(g_c / released))
    return load * float(np.mean(forces)), load * float(np.mean(moved))


def between(one, other, size):
    """Mean distance of each place from the nearest one of the other crack, in elements."""
    gaps = distances_between(one, other)
    return f"{gaps.mean() / size:.2f}" if gaps.size else "-"


def solves(outcome):
    """Of displacements, up to the end."""
    theirs = "processor_seconds" in outcome.rows[-1]
    return int(outcome.rows[-1]["linear_solves"]) if theirs else sum(int(row["linear_solves"]) for row in outcome.rows)


def cells(name, program, outcome, ours, exact, size):
    top = peak(outcome.rows)
    until = "" if outcome.is_through else f"not through after {LIMIT} s"
    return [name, program, f"{top:.5g}", f"{top / exact:.3f}" if exact else "", f"{top / peak(ours.rows):.3f}",
            "" if outcome is ours else between(outcome.crack, ours.crack, size), str(solves(outcome)), f"{outcome.processor:.1f}",
            f"{outcome.processor / ours.processor:.2f}", f"{outcome.wall:.1f}", f"{outcome.memory:.0f}", until]


def draw_paths(outcomes, file):
    """outcomes: {body: {program: outcome}}; of a block what is seen from its side."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, panels = plt.subplots(1, len(outcomes), figsize=(3.2 * len(outcomes), 3.8), squeeze=False)
    for panel, (body, programs) in zip(panels[0], outcomes.items()):
        for (program, outcome), colour in zip(programs.items(), COLOURS):
            panel.plot(*outcome.crack[:, :2].T, ".", markersize=2.5, color=colour, label=program)
        panel.set_title(body, fontsize=10)
        panel.set_aspect("equal", adjustable="datalim")
        panel.tick_params(labelsize=7)
    figure.legend(*panels[0][0].get_legend_handles_labels(), loc="lower center", ncol=3, markerscale=4, frameon=False)
    figure.subplots_adjust(left=0.04, right=0.99, top=0.95, bottom=0.14)
    figure.savefig(file, dpi=150)


def print_table_of_bodies(folder, scale):
    """The same bodies, meshes and increments with both, one after the other, on one core."""
    fitting = lambda length, size: length / max(1, round(length / size))  # so that tips are at nodes
    plane, solid = fitting(bodies.TIP, scale ** (-1 / 2)), fitting(bodies.THICKNESS, scale ** (-1 / 3))
    exact = {bodies.edge_crack: fracture_mechanics(folder, bodies.edge_crack, bodies.TIP, plane, 1.0, 0.1)[0],
             bodies.block: fracture_mechanics(folder, bodies.block, bodies.WIDTH / 2, solid, bodies.THICKNESS, 0.1)[0]}
    rows, outcomes = [], {}
    for name, body, size, options in (
            ("edge crack, squares", bodies.edge_crack, plane, {}),
            ("edge crack, irregular", bodies.edge_crack, plane, {"is_irregular": True}),
            ("double notch", bodies.double_notch, 2 * plane, {}), ("notch and hole", bodies.hole, plane / 2, {}),
            ("block", bodies.block, solid, {})):
        case = body(folder, size, **options)
        increments = bodies.increments_of(case)
        ours = run_ours(case, increments, LIMIT)
        outcomes[name] = {"Perimorph": ours}
        rows.append(cells(name, "Perimorph", ours, ours, exact.get(body), size))
        for model in ("AT1", "AT2"):
            compile_forms(case, model, LENGTH * size)
            theirs = outcomes[name][model] = run_theirs(case, model, LENGTH * size, LIMIT)
            rows.append(cells("", model, theirs, ours, exact.get(body), size))
    print_table(f"Perimorph and a phase field on FEniCSx (tools/studies/lib/phase_field.py, length {LENGTH:g} elements, over-relaxed "
                f"by {RELAXATION}), the same meshes and increments, one core. Path: mean distance from ours, in elements; {PATHS} shows "
                "them.",
                ["body", "program", "largest force [N]", "/ fracture mechanics", "/ ours", "path", "solves", "processor [s]", "/ ours",
                 "wall [s]", "MB", ""], rows)
    os.makedirs(os.path.dirname(PATHS), exist_ok=True)
    draw_paths(outcomes, PATHS)
