"""What a run writes on request beside its history and fields: probes, crack, bonds.

    exports.py PERIMORPH MPIEXEC
"""

import csv
import pathlib
import sys
import unittest

import netCDF4
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from fixture import EVERY, HALF, INCREMENTS, N, GrowingCrack, changed, half_plate_mesh, text_of
from fields import read_vtp

OUTPUT = {
    "Crack": True,
    "Bonds": [11, 16],
    "Probes": {"corner": {"Points": [0, 12]}, "ahead, of the tip": {"Points": [7.25, 6.25, 12, 6.25], "Divisions": 4}},
}
TABLES = ["probes.csv", "crack.csv", "crack_path.csv"]


class Exports(GrowingCrack):
    CASE = changed(GrowingCrack.CASE, {"Output": OUTPUT})

    def table(self, name):
        with open(self.output / name, newline="") as file:
            return list(csv.DictReader(file))

    def numbers(self, name):
        return [{key: value if key == "probe" else float(value) for key, value in row.items()} for row in self.table(name)]

    def bonds(self, increment):
        return read_vtp(self.output / f"bonds-{increment:06d}.vtp")

    def assert_bonds_agree_with_points_and_history(self, increment):
        bonds = self.bonds(increment)
        self.assertEqual(int(bonds["broken"].sum()), int(self.history()[increment - 1]["broken_bonds"]))
        ends = bonds["connectivity"].reshape(-1, 2)
        self.assertLess(ends.max(), len(bonds["points"]))
        xi = bonds["points"][ends[:, 1]] - bonds["points"][ends[:, 0]]
        eta = bonds["displacement"][ends[:, 1]] - bonds["displacement"][ends[:, 0]]
        length = numpy.linalg.norm(xi, axis=1)
        self.assertLessEqual(length.max(), 2 * (1 + 1e-12))  # the horizon
        numpy.testing.assert_allclose(numpy.linalg.norm(xi + eta, axis=1) / length - 1, bonds["stretch"][:, 0], atol=1e-12)
        self.assertEqual(list(bonds["offsets"][:, 0]), list(range(2, 2 * len(length) + 2, 2)))


class Content(Exports):
    def setUp(self):
        super().setUp()
        self.run_until(INCREMENTS)

    def test_probes_have_a_row_for_each_increment_and_place(self):
        rows = self.numbers("probes.csv")
        self.assertEqual([(row["increment"], row["probe"], row["place"]) for row in rows],
                         [(n, probe, place) for n in range(1, INCREMENTS + 1)
                          for probe, place in [("corner", 1)] + [("ahead, of the tip", k) for k in range(1, 6)]])
        self.assertEqual([row["x"] for row in rows[1:6]], [7.25, 8.4375, 9.625, 10.8125, 12])
        for row in rows:
            if row["probe"] == "corner":  # it is pulled
                self.assertAlmostEqual(row["displacement_y"], 0.05 * row["increment"])
        last_place = [row for row in rows if row["place"] == 5]
        for row in last_place:  # on the edge that is held
            self.assertAlmostEqual(row["displacement_x"], 0)
            self.assertAlmostEqual(row["displacement_y"], 0)

    def test_stress_of_a_probe_in_the_middle_of_a_classical_element_is_the_elements(self):
        """(10.5, 6.5) is such a middle: stress is linear to both sides of it, and the file has the mean."""
        self.run_until(2, "--set", "Output/Probes/middle/Points={10.5, 6.5}")
        probe = next(row for row in self.numbers("probes.csv") if row["probe"] == "middle" and row["increment"] == 2)
        with netCDF4.Dataset(self.series()[0]) as file:
            names = text_of(file["name_elem_var"])
            ids = file["elem_num_map"][:]
            for name in ["stress_xx", "stress_yy", "stress_xy"]:
                blocks = range(1, len(file.dimensions["num_el_blk"]) + 1)
                values = numpy.concatenate([file[f"vals_elem_var{names.index(name) + 1}eb{b}"][1] for b in blocks])
                self.assertAlmostEqual(probe[name], float(values[ids == 6 * N + 10 + 1][0]), places=8)
        self.assertGreater(abs(probe["stress_yy"]), 0.1)

    def test_the_crack_grows_from_the_tip_of_the_slit(self):
        rows, path = self.numbers("crack.csv"), self.numbers("crack_path.csv")
        self.assertEqual([row["increment"] for row in rows], list(range(1, INCREMENTS + 1)))
        self.assertEqual(rows[10]["open_sides"], 0)
        lengths = [row["crack_length"] for row in rows]
        self.assertEqual(lengths, sorted(lengths))
        self.assertEqual(rows[-1]["open_sides"], len(path))
        self.assertEqual(rows[-1]["side_length"], len(path))  # all sides have length 1
        self.assertEqual(len({(row["element_1"], row["element_2"]) for row in path}), len(path))
        for n in range(1, INCREMENTS + 1):
            self.assertEqual(rows[n - 1]["open_sides"], sum(row["increment"] <= n for row in path))
        ahead = [row for row in path if row["y_1"] == row["y_2"] == 6]
        self.assertGreater(len(ahead), 0)
        self.assertEqual(min(min(row["x_1"], row["x_2"]) for row in ahead), 5)  # where the slit ends

    def test_bonds_are_all_there_with_positions_stretch_and_whether_they_are_broken(self):
        self.assertEqual(sorted(p.name for p in self.output.glob("bonds*")), ["bonds-000011.vtp", "bonds-000016.vtp"])
        for increment in [11, 16]:
            self.assert_bonds_agree_with_points_and_history(increment)
        self.assertGreater(self.bonds(16)["broken"].sum(), 0)

    def test_a_new_run_removes_the_bonds_of_an_older_one(self):
        self.run_until(3)
        self.assertEqual(list(self.output.glob("bonds*")), [])


class Mirrored(Exports):
    """The upper half of the plate: bonds reach beyond the plane of symmetry."""

    MESH = half_plate_mesh()
    CASE = changed(Exports.CASE, HALF)

    def test_bonds_end_in_points_each_counts_once_and_no_rank_leaves_any_out(self):
        all_bonds = []
        for ranks in [1, 2]:
            self.run_until(INCREMENTS, ranks=ranks)
            self.assert_bonds_agree_with_points_and_history(16)
            all_bonds.append(self.bonds(16))
            self.assertLess(all_bonds[-1]["points"][all_bonds[-1]["connectivity"].ravel(), 1].min(), 6)
        for name in ["connectivity", "broken", "id"]:
            numpy.testing.assert_array_equal(all_bonds[0][name], all_bonds[1][name])


class Ranks(Exports):
    def test_one_two_and_four_write_the_same(self):
        self.run_until(INCREMENTS)
        probes, crack, path, bonds = self.numbers("probes.csv"), *map(self.table, TABLES[1:]), self.bonds(16)
        for ranks, options in [(2, []), (4, []), (2, ["--set", "Solver/Largest Imbalance=1"])]:  # repartitioned on its way
            with self.subTest(ranks=ranks, options=options):
                self.run_until(INCREMENTS, *options, ranks=ranks)
                self.assertEqual("repartitioned " in (self.output / "run.log").read_text(), bool(options))
                for row, other in zip(probes, self.numbers("probes.csv"), strict=True):
                    for name in row:  # displacements are up to 0.8, stresses up to 50; the tolerance is 1e-6 of the reactions
                        if name == "probe":
                            self.assertEqual(row[name], other[name])
                        else:
                            self.assertAlmostEqual(row[name], other[name], delta=2e-3 if "stress" in name else 2e-5)
                self.assertEqual(self.table("crack.csv"), crack)
                self.assertEqual(self.table("crack_path.csv"), path)
                others = self.bonds(16)
                for name in ["id", "points", "connectivity", "offsets", "broken"]:
                    numpy.testing.assert_array_equal(others[name], bonds[name])
                numpy.testing.assert_allclose(others["stretch"], bonds["stretch"], atol=1e-4)


class Continued(Exports):
    def everything(self):
        return [(self.output / name).read_bytes() for name in TABLES + ["bonds-000016.vtp"]]

    def test_no_row_is_lost_or_doubled(self):
        self.run_until(INCREMENTS, *EVERY)
        whole = self.everything()
        for stop in [1, 12, 13]:  # before the crack, in it
            with self.subTest(stop=stop):
                self.run_until(stop, *EVERY)
                with open(self.output / "probes.csv", "a") as file:  # of an increment that was not finished
                    file.write(f"{stop + 1},1,corner,1,0,0\n{stop + 1},1")
                self.run_until(INCREMENTS, *EVERY, "--restart")
                self.assertEqual(self.everything(), whole)

    def test_without_the_table_of_the_earlier_run_it_is_refused(self):
        self.run_until(2)
        for name in TABLES:
            with self.subTest(name):
                file = self.output / name
                kept = file.read_bytes()
                file.unlink()
                run = self.run_case("--restart", ranks=2)
                self.assertEqual(run.returncode, 2, run.stderr)
                self.assertEqual(run.stderr.count(f"{name}: it cannot be continued"), 1, run.stderr)
                file.write_bytes(kept)


class Mistakes(Exports):
    def test_a_place_outside_the_body_names_the_probe(self):
        for ranks in [1, 2]:
            for command in ["run", "check"]:
                run = self.perimorph(command, self.case, "--set", "Output/Probes/corner/Points={6, 6, 14, 6}", ranks=ranks)
                self.assertEqual(run.returncode, 2, run.stderr)
                self.assertIn("/Output/Probes/corner/Points: (14, 6) is outside the body; allowed are places in it, the "
                              "nearest node of which is at (12, 6)", run.stderr)

    def test_numbers_that_are_no_points(self):
        for points, found in [("{}", 0), ("{1, 2, 3}", 3)]:
            run = self.run_case("--set", f"Output/Probes/corner/Points={points}")
            self.assertEqual(run.returncode, 2)
            self.assertIn(f"/Output/Probes/corner/Points: found {found} numbers; allowed are one point or more", run.stderr)

    def test_increments_below_one(self):
        run = self.run_case("--set", "Output/Bonds={0, 3}")
        self.assertEqual(run.returncode, 2)
        self.assertIn("/Output/Bonds: found", run.stderr)
        self.assertIn("allowed is a list of increments", run.stderr)


if __name__ == "__main__":
    unittest.main()
