"""The elastic part of tools/studies/work-precision from coarse meshes: what it costs in accuracy that only the zone is fine."""

import os

import numpy as np

from cases import ROOT, run
from case_file import write_case
from elastic_precision import SMALLER, VARIANTS, case_of, errors, meshed, written
from fields import Displacement
from precision_runs import write_rows

HALF = 150.0  # of the body: where displacements are prescribed, node by node, elements must not be divided
FINEST = 1.5
ZONES = ("hybrid, Whole Zone, Dropped (WHL19)", "hybrid, On Damage, Kept")
EXAMPLE = os.path.join(ROOT, "inputs", "plate_with_hole", "plate_with_hole.xml")


def divided(nodes, quads):
    """Each quadrilateral into four, as the program does it."""
    sides = np.sort(np.stack([quads, np.roll(quads, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    ends, side_of = np.unique(sides, axis=0, return_inverse=True)
    middle = len(nodes) + side_of.reshape(-1, 4)  # of the side from each corner to the next
    center = len(nodes) + len(ends) + np.arange(len(quads))
    parts = [np.column_stack([quads[:, k], middle[:, k], center, middle[:, k - 1]]) for k in range(4)]
    return np.concatenate([nodes, nodes[ends].mean(axis=1), nodes[quads].mean(axis=1)]), np.concatenate(parts)


def hole(folder, levels):
    """Of the infinite plate with a hole, by zone: the run's counts, and errors against the exact displacement, on the coarse mesh
    that is refined, on the same mesh divided everywhere, and on one that follows the circle."""
    stem = os.path.join(folder, "hole")
    root = meshed(stem, SMALLER * FINEST * 2**levels, HALF)
    everywhere = root
    for _ in range(levels):
        everywhere = divided(*everywhere)
    meshes = {"refined": (root, levels), "fine everywhere": (everywhere, 0), "fine, a rounder hole": (meshed(stem, SMALLER * FINEST, HALF), 0)}
    for name in ZONES:
        for mesh, (body, divisions) in meshes.items():
            dx, boundary, positions = written(stem, *body)
            case = case_of(stem + ".msh", dx / 2**divisions, boundary, positions, 0, VARIANTS[name])
            case["Mesh"]["Refinement"] = {"Levels": divisions}
            write_case(stem + ".xml", case)
            one = run(stem + ".xml", stem)
            x, y = errors(stem, 0)
            yield row(f"hole, {name}", levels, mesh, one, f"{100 * x:.3f}", f"{100 * y:.3f}")


def row(body, levels, mesh, one, x, y):
    """x, y: in % of the largest displacement of the component."""
    return {"body": body, "levels": levels, "mesh": mesh, "unknowns": one.history[-1]["unknowns"], "seconds": f"{one.processor:.3g}",
            "memory_mb": f"{one.memory:.0f}", "error_x": x, "error_y": y}


def difference(output, other):
    """Largest at the nodes that both meshes have, for each component over its largest, in %."""
    one, two = ({tuple(np.round(x, 6)): u for x, u in zip(result.coordinates, result.values)}
                for result in map(Displacement, (output, other)))
    both = sorted(one.keys() & two.keys())
    first, second = (np.array([run[x] for x in both]) for run in (one, two))
    return 100 * np.abs(first - second).max(axis=0) / np.abs(second).max(axis=0)


def example(folder):
    """The plate with a hole of inputs, against the same coarse mesh refined everywhere."""
    outputs = {mesh: os.path.join(folder, mesh) for mesh in ("everywhere", "refined")}
    runs = {mesh: run(EXAMPLE, output, settings=["Mesh/File=plate_with_hole_coarse.geo", "Mesh/Refinement/Levels=1",
                                                 f"Mesh/Refinement/Margin={3 if mesh == 'refined' else 100000}"])
            for mesh, output in outputs.items()}
    x, y = difference(outputs["refined"], outputs["everywhere"])
    yield row("plate_with_hole", 1, "fine everywhere", runs["everywhere"], "", "")
    yield row("plate_with_hole", 1, "refined, from fine everywhere", runs["refined"], f"{x:.3f}", f"{y:.3f}")


def measure(folder):
    rows = []
    for found in (*(hole(folder, levels) for levels in (1, 2)), example(folder)):
        for one in found:
            print("  ".join(f"{key} {value}" for key, value in one.items()), flush=True)
            rows.append(one)
    write_rows(os.path.join(folder, "refined.csv"), rows)
