"""Makes the runs that the tests of the tools look at: the templates "plate" and "block" with elements of 2 instead of 1.

    small_runs.py PERIMORPH MPIEXEC FOLDER
"""

import pathlib
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from fixture import PERIMORPH, TOOLS, coarsen, settings

FOLDER = pathlib.Path(sys.argv[1])

COARSER = {
    "plate": ["Peridynamics/Horizon=6", "Peridynamics/Characteristic Length=0.4", "Boundary Conditions/Displacements/pull/Rate=0.003", "Loading/Increments=10"],
    "block": ["Peridynamics/Horizon=4", "Peridynamics/Characteristic Length=0.4",
              "Morphing/Seeds/front of the crack/Inner Radius=8", "Morphing/Seeds/front of the crack/Outer Radius=12",
              "Boundary Conditions/Displacements/pull/Rate=0.002", "Loading/Increments=8"],
}


def run(template, changes):
    """FOLDER/small_<template>, with the results in out."""
    case = FOLDER / f"small_{template}"
    subprocess.run([TOOLS / "new-case", case, "--from", template], check=True)
    coarsen(case / f"{case.name}.geo", "dx = 1;", "dx = 2;")
    subprocess.run([PERIMORPH, "run", case / f"{case.name}.xml", "--output", case / "out", "--quiet",
                    *settings(*changes)], check=True)


shutil.rmtree(FOLDER, ignore_errors=True)
for template, changes in COARSER.items():
    run(template, changes)
