"""Makes the run that the tests of the tools look at: the template "plate" with elements of 2 instead of 1.

    small_plate.py PERIMORPH FOLDER
"""

import pathlib
import shutil
import subprocess
import sys

TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"
PERIMORPH, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])

shutil.rmtree(FOLDER, ignore_errors=True)
subprocess.run([TOOLS / "new-case", FOLDER, "--from", "plate"], check=True)
geometry = FOLDER / "small_plate.geo"
coarse = geometry.read_text().replace("dx = 1;", "dx = 2;")
assert "dx = 2;" in coarse
geometry.write_text(coarse)
coarser = ["Peridynamics/Horizon=6", "Peridynamics/Characteristic Length=0.4", "Morphing/Seeds/tip of the crack/Inner Radius=8",
           "Boundary Conditions/Displacements/pull/Rate=0.003", "Loading/Increments=10"]
subprocess.run([PERIMORPH, "run", FOLDER / "small_plate.xml", "--output", FOLDER / "out", "--quiet",
                *(part for value in coarser for part in ("--set", value))], check=True)
