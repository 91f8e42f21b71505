"""Makes the runs that the tests of the tools look at: the templates "plate" and "block" with elements of 2 instead of 1.

    small_runs.py PERIMORPH FOLDER
"""

import pathlib
import shutil
import subprocess
import sys

TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"
PERIMORPH, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])

COARSER = {
    "plate": ["Peridynamics/Horizon=6", "Peridynamics/Characteristic Length=0.4", "Boundary Conditions/Displacements/pull/Rate=0.003", "Loading/Increments=10"],
    "block": ["Peridynamics/Horizon=4", "Peridynamics/Characteristic Length=0.4",
              "Morphing/Seeds/front of the crack/Inner Radius=8", "Morphing/Seeds/front of the crack/Outer Radius=12",
              "Boundary Conditions/Displacements/pull/Rate=0.002", "Loading/Increments=8"],
}


def run(template, settings):
    """FOLDER/small_<template>, with the results in out."""
    case = FOLDER / f"small_{template}"
    subprocess.run([TOOLS / "new-case", case, "--from", template], check=True)
    geometry = case / f"{case.name}.geo"
    coarse = geometry.read_text().replace("dx = 1;", "dx = 2;")
    assert "dx = 2;" in coarse
    geometry.write_text(coarse)
    subprocess.run([PERIMORPH, "run", case / f"{case.name}.xml", "--output", case / "out", "--quiet",
                    *(part for value in settings for part in ("--set", value))], check=True)


shutil.rmtree(FOLDER, ignore_errors=True)
for template, settings in COARSER.items():
    run(template, settings)
