"""inputs/plate_with_hole_3d against inputs/plate_with_hole by tools/compare-slab, both with elements of 5 instead of 1.5.

    compare_slab.py PERIMORPH MPIEXEC RUNS
"""

import pathlib
import re
import shutil
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from fixture import PERIMORPH, ROOT, InFolder, coarsen, settings

del sys.argv[1:]

PLANE_STRAIN = ["Material/Elastic Model=Plane Strain", "Material/Poisson's Ratio=0.25",
                "Morphing/Discontinuous Elements=On Damage", "Morphing/Stiffness in Peridynamic Zone=Kept"]
COARSER = ["Peridynamics/Horizon=15", "Peridynamics/Characteristic Length=1.6"]
SMALL = ["Morphing/Seeds/hole/Inner Radius=1e-9", "Morphing/Seeds/hole/Outer Radius=2e-9"]  # no element is in it
NO_ZONE = {"plate_with_hole": [*SMALL, "Morphing/Seeds/hole/Center={61,31}", "Mesh/Thickness=3"],
           "plate_with_hole_3d": [*SMALL, "Morphing/Seeds/hole/Start={61,31,-100}", "Morphing/Seeds/hole/End={61,31,100}"]}


class CompareSlab(InFolder):
    def setUp(self):
        super().setUp()
        for name in ["plate_with_hole", "plate_with_hole_3d"]:
            shutil.copytree(ROOT / "inputs" / name, self.folder / name)
        coarsen(self.folder / "plate_with_hole/plate_with_hole.geo", "dx = 1.5]", "dx = 5]")

    def run_case(self, name, changes):
        command = [PERIMORPH, "run", self.folder / name / f"{name}.xml", "--output", self.folder / name / "out", "--quiet"]
        subprocess.run(command + settings(*changes), check=True, timeout=100)
        return self.folder / name / "out"

    def compare(self, slab, plate):
        return subprocess.run([ROOT / "tools/compare-slab", slab, plate], capture_output=True, text=True, timeout=60)

    def differences(self, changes, of_each={}):
        """Of u_x, u_y, u_z in all layers of nodes, and of the reactions."""
        done = self.compare(self.run_case("plate_with_hole_3d", COARSER + changes + of_each.get("plate_with_hole_3d", [])),
                            self.run_case("plate_with_hole", PLANE_STRAIN + COARSER + changes + of_each.get("plate_with_hole", [])))
        self.assertEqual(done.returncode, 0, done.stderr)
        layers = re.findall(r"^z = \S+ +u_x (\S+) +u_y (\S+) +u_z (\S+)$", done.stdout, re.MULTILINE)
        self.assertEqual(len(layers), 3, done.stdout)
        reactions = re.findall(r"^reaction_right_x: .* (\S+)$", done.stdout, re.MULTILINE)
        self.assertEqual(len(reactions), 1, done.stdout)
        return [max(map(float, component)) for component in zip(*layers)], abs(float(reactions[0]))

    def test_finite_elements_alone_are_the_same_and_a_zone_differs_by_the_faces(self):
        tight = ["Solver/Tolerance=1e-10"]
        displacements, reaction = self.differences(tight, NO_ZONE)
        self.assertLess(max(displacements), 1e-7)  # the tolerance times the condition number, some hundreds
        self.assertLess(reaction, 1e-7)
        displacements, reaction = self.differences(tight)
        self.assertLess(displacements[0], 0.0066)  # 0.0059
        self.assertLess(displacements[1], 0.037)  # 0.034
        self.assertLess(reaction, 0.0017)  # 0.0015
        self.assertGreater(displacements[1], 1e-4)  # the zone is there

    def test_runs_that_do_not_fit_are_refused(self):
        plate = self.run_case("plate_with_hole", PLANE_STRAIN + COARSER)
        done = self.compare(plate, plate)
        self.assertEqual(done.returncode, 2)
        self.assertIn("expected a run in 3 dimensions, found 2", done.stderr)


if __name__ == "__main__":
    unittest.main()
