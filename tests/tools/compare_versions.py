"""What tools/studies/compare-versions compares by: two runs of one case, and the same with one value changed.

    compare_versions.py PERIMORPH MPIEXEC RUNS
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import h5py
import netCDF4
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from fixture import PERIMORPH
from identical import first_difference

RUNS = pathlib.Path(sys.argv.pop(1))

SETTINGS = ["Peridynamics/Horizon=6", "Peridynamics/Characteristic Length=0.4", "Loading/Increments=3",
            "Boundary Conditions/Displacements/pull/Rate=0.01", "Output/Crack=true", "Output/Checkpoint Every=1"]


def run(output):
    command = [PERIMORPH, "run", RUNS / "small_plate/small_plate.xml", "--output", output, "--quiet"]
    subprocess.run(command + [part for value in SETTINGS for part in ("--set", value)], check=True, timeout=100)


def neighbour(values, index):
    """The next number, a bit away."""
    values[index] = numpy.nextafter(values[index], numpy.inf)


class CompareVersions(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temporary.cleanup)
        cls.one, cls.other = (pathlib.Path(cls.temporary.name) / name for name in ("one", "other"))
        for output in (cls.one, cls.other):
            run(output)

    def setUp(self):
        self.changed = pathlib.Path(self.temporary.name) / "changed"
        shutil.copytree(self.other, self.changed)
        self.addCleanup(shutil.rmtree, self.changed)

    def difference(self, *ignored):
        return first_difference(str(self.one), str(self.changed), ignored)

    def change_cell(self, name, column, row, value):
        """@param row from 1"""
        lines = [line.split(",") for line in (self.changed / name).read_text().splitlines()]
        lines[row][lines[0].index(column)] = value
        (self.changed / name).write_text("".join(",".join(line) + "\n" for line in lines))

    def test_two_runs_of_one_program_are_equal(self):
        self.assertTrue((self.one / "crack.csv").exists())
        self.assertTrue(list(self.one.glob("checkpoint-*.h5")))
        self.assertIsNone(self.difference())

    def test_seconds_may_differ(self):
        self.change_cell("history.csv", "wall_seconds", 1, "1000")
        self.assertIsNone(self.difference())

    def test_a_cell_of_a_table(self):
        self.change_cell("history.csv", "elastic_energy", 2, "0.5")
        found = self.difference()
        self.assertEqual((found.file, found.place, found.second), ("history.csv", "increment 2, elastic_energy", "0.5"))
        self.assertIsNone(self.difference("history.csv"))

    def test_a_row_less(self):
        table = self.changed / "crack.csv"
        table.write_text("".join(table.read_text().splitlines(keepends=True)[:-1]))
        self.assertEqual(self.difference().place, "number of rows")

    def test_a_bit_of_a_field(self):
        with netCDF4.Dataset(self.changed / "small_plate.e", "a") as file:
            values = file["vals_nod_var1"][:]
            neighbour(values, (0, 3))
            file["vals_nod_var1"][:] = values
        found = self.difference()
        self.assertEqual((found.file, found.place), ("small_plate.e", "vals_nod_var1[0, 3]"))
        self.assertNotEqual(found.first, found.second)

    def test_a_global_variable(self):
        with netCDF4.Dataset(self.changed / "small_plate.e", "a") as file:
            values = file["vals_glo_var"][:]
            neighbour(values, (0, 0))
            file["vals_glo_var"][:] = values
        self.assertEqual(self.difference().place, "global variable load_factor at step[0]")

    def test_the_sign_of_a_zero_in_a_checkpoint(self):
        name = max(path.name for path in self.changed.glob("checkpoint-*.h5"))
        with h5py.File(self.changed / name, "a") as file:
            values = file["displacement"][()]
            row, column = numpy.argwhere(values == 0.0)[0]
            file["displacement"][row, column] = -values[row, column]
            file["results"][0] += 1.0  # seconds
        found = self.difference()
        self.assertEqual((found.file, found.place), (name, f"displacement[{row}, {column}]"))

    def test_a_file_less(self):
        (self.changed / "crack_path.csv").unlink()
        self.assertIn("names of files", str(self.difference()))


if __name__ == "__main__":
    unittest.main()
