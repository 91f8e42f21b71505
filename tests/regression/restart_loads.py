"""--restart in the midst of load programmes, measures, rigid groups and planes of symmetry.

    restart_loads.py PERIMORPH MPIEXEC
"""

import pathlib
import sys
import unittest

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from fixture import EVERY, HALF, INCREMENTS, GrowingCrack, changed, half_plate_mesh, plate_mesh, settings


class PathFollowing(GrowingCrack):
    """The opening of the slit is prescribed, beside a constant load in the second case."""

    CASE = changed(GrowingCrack.CASE, {"Loading/Control": "Measure", "Loading/Measure": {
        "Point": [1.0, 7.5], "Other Point": [1.0, 4.5], "Direction": [0.0, 1.0], "Rate": 0.1}})
    BESIDE_A_CONSTANT_LOAD = ["--set", "Boundary Conditions/Body Force/Constant={0.2, 0.1}"]

    def test_on_as_many_ranks_it_ends_with_the_same_bits(self):
        for ranks, stop, options in [(1, 12, []), (4, 10, []), (2, 13, self.BESIDE_A_CONSTANT_LOAD)]:
            with self.subTest(ranks=ranks):
                self.run_until(INCREMENTS, *EVERY, *options, ranks=ranks)
                whole = self.outcome()
                self.assertGreater(int(whole[0][-1]["broken_bonds"]), 100)
                self.assert_continues(whole, stop, *EVERY, *options, ranks=ranks)

    def test_on_other_ranks_the_same_bonds_break_at_the_same_loads(self):
        self.run_until(INCREMENTS)
        alone = self.rows()
        self.run_until(INCREMENTS, ranks=4)
        for k, (row, other) in enumerate(zip(alone, self.rows(), strict=True), start=1):
            self.assertAlmostEqual(float(row["measure"]), 0.1 * k, places=6)
            for name in ["broken_bonds", "damaged_elements", "dgfe_elements"]:
                self.assertEqual(row[name], other[name])
            self.assertAlmostEqual(float(row["load_factor"]) / float(other["load_factor"]), 1, places=5)


class LoadSteps(GrowingCrack):
    """Pulled, let go and pulled again; in the second case beside a weight that has come first."""

    STEP = lambda increments, value: {"Increments": increments, "Conditions": ["pull down", "pull up"], "Values": [value, value]}
    CASE = changed(GrowingCrack.CASE, {
        "Loading/Steps": {"pull": STEP(6, 14.0), "let go": STEP(4, 2.0), "pull again": STEP(6, 15.0)}})
    WEIGHT = {"Boundary Conditions/Body Force/Rate": [0.0, -0.1],
              "Loading/Steps/pull/Conditions": ["pull down", "pull up", "Body Force"], "Loading/Steps/pull/Values": [14.0, 14.0, 1.0]}

    def test_on_as_many_ranks_it_ends_with_the_same_bits(self):
        for changes in [{}, self.WEIGHT]:
            self.write_case(changes)
            for ranks, stop in [(1, 5), (1, 8), (2, 13), (4, 6)]:
                with self.subTest(ranks=ranks, stop=stop, changes=changes):
                    self.run_until(INCREMENTS, *EVERY, ranks=ranks)
                    whole = self.outcome()
                    broken = [int(row["broken_bonds"]) for row in whole[0]]
                    self.assertGreater(broken[5], 100)
                    self.assertEqual(broken[5], broken[9])
                    self.assertGreater(broken[-1], broken[9])
                    self.assert_continues(whole, stop, *EVERY, ranks=ranks)


class Heated(GrowingCrack):
    """Cooled more at its bottom than at its top, and then pulled until it breaks."""

    CASE = changed(GrowingCrack.CASE, {
        "Material/Thermal Expansion": 1e-5,
        "Boundary Conditions/Temperatures": {
            "cold": {"Rate": -400.0, "Direction": [0.0, 1.0], "Positions": [0.0, 12.0], "Factors": [1.5, 0.5]}},
        "Loading/Steps": {"cool": {"Increments": 4, "Conditions": ["cold"], "Values": [4.0]},
                          "pull": {"Increments": 12, "Conditions": ["cold", "pull down", "pull up"], "Values": [5.0, 14.0, 14.0]}}})
    SOFT = {"Material/Critical Stretch": None, "Material/Bond Law": "Bilinear", "Material/Tensile Strength": 15.0,
            "Material/Fracture Energy": 2.0}

    def test_on_as_many_ranks_it_ends_with_the_same_bits(self):
        for changes in [{}, {"Material/Poisson's Ratio": 0.2}, {"Peridynamics/Crack Faces": "Contact"}, self.SOFT]:
            self.write_case(changes)
            for ranks, stop in [(1, 3), (1, 13), (2, 14), (4, 2)]:
                with self.subTest(ranks=ranks, stop=stop, changes=changes):
                    self.run_until(INCREMENTS, *EVERY, ranks=ranks)
                    whole = self.outcome()
                    self.assertGreater(float(whole[0][3]["elastic_energy"]), 0.1)
                    self.assertGreater(int(whole[0][-1]["broken_bonds"]), 20)
                    self.assert_continues(whole, stop, *EVERY, ranks=ranks)

    def test_on_more_ranks_the_same_bonds_break(self):
        self.run_until(INCREMENTS)
        alone = self.rows()
        for ranks in [2, 4]:
            self.run_until(INCREMENTS, ranks=ranks)
            for row, other in zip(alone, self.rows(), strict=True):
                self.assertEqual(row["broken_bonds"], other["broken_bonds"])
                self.assertAlmostEqual(float(row["external_work"]), float(other["external_work"]),
                                       delta=1e-4 * float(row["external_work"]))


class Cycles(GrowingCrack):
    """Pulled and let go twice, further in the second stage, whose course is that of a table."""

    CASE = changed(GrowingCrack.CASE, {"Loading/Steps": {
        "pull": {"Increments": 4, "Cycles": 2, "Conditions": ["pull down", "pull up"], "Values": [14.0, 14.0]},
        "table": {"Increments": 4, "Cycles": 2,
                  "Tables": {"pull down": {"File": "pull.csv"}, "pull up": {"File": "pull.csv"}}}}})

    def setUp(self):
        super().setUp()
        self.write_table(15.0)

    def write_table(self, most):
        (self.folder / "pull.csv").write_text(f"time [s], factor\n0, 0\n3, {most}\n4, 0\n")

    def test_on_as_many_ranks_it_ends_with_the_same_bits(self):
        for ranks, stop in [(1, 3), (1, 10), (2, 11), (4, 5)]:
            with self.subTest(ranks=ranks, stop=stop):
                self.run_until(INCREMENTS, *EVERY, ranks=ranks)
                whole = self.outcome()
                broken = [int(row["broken_bonds"]) for row in whole[0]]
                self.assertGreater(broken[1], 100)
                self.assertEqual(broken[1], broken[7])
                self.assertGreater(broken[10], broken[7])
                self.assertEqual(broken[10], broken[15])
                self.assert_continues(whole, stop, *EVERY, ranks=ranks)

    def test_the_checkpoint_of_another_table_is_refused(self):
        self.run_until(2)
        self.write_table(16.0)
        run = self.run_case("--restart")
        self.assertEqual(run.returncode, 2)
        self.assertIn('there "/Loading/Steps/table/Tables/pull down: row 2 = 3, 15", '
                      'here "/Loading/Steps/table/Tables/pull down: row 2 = 3, 16"', run.stderr)


class Constraints(GrowingCrack):
    """The right side is gripped by a block that may turn, and the upper corner pulled along a slanting line."""

    CASE = changed(GrowingCrack.CASE, {
        "Boundary Conditions/Rigid Groups/grip/Group": "right",
        "Boundary Conditions/Displacements/pull up": {"Group": "upper", "Direction": [0.3, 1.0], "Rate": 0.06}})

    def test_on_as_many_ranks_it_ends_with_the_same_bits(self):
        for ranks, stop in [(1, 13), (2, 14), (4, 11)]:
            with self.subTest(ranks=ranks, stop=stop):
                self.run_until(INCREMENTS, *EVERY, ranks=ranks)
                whole = self.outcome()
                last = {name: float(value) for name, value in whole[0][-1].items()}
                self.assertGreater(last["broken_bonds"], 100)
                self.assertGreater(abs(last["displacement_right_rotation_z"]), 1e-3)
                self.assertAlmostEqual(last["reaction_right_rotation_z"], 0, delta=1e-3 * abs(last["reaction_upper_y"]))
                along = (0.3 * last["displacement_upper_x"] + last["displacement_upper_y"]) / 1.09**0.5
                self.assertAlmostEqual(along, 0.06 * INCREMENTS, places=9)
                self.assert_continues(whole, stop, *EVERY, ranks=ranks)


class SymmetryPlanes(GrowingCrack):
    """The upper half of the plate: the crack runs along the plane of symmetry."""

    MESH = half_plate_mesh()
    CASE = changed(GrowingCrack.CASE, HALF)
    KINDS = [[], settings("Material/Poisson's Ratio=0.2"), settings("Solver/Operator=CRS"), settings("Solver/Operator=On-the-Fly")]

    def test_on_as_many_ranks_it_ends_with_the_same_bits(self):
        for (ranks, stop), options in zip([(1, 13), (2, 12), (4, 14), (2, 14)], self.KINDS):
            with self.subTest(ranks=ranks, options=options):
                self.run_until(INCREMENTS, *EVERY, *options, ranks=ranks)
                whole = self.outcome()
                self.assertGreater(int(whole[0][-1]["broken_bonds"]), 50)
                self.assert_continues(whole, stop, *EVERY, *options, ranks=ranks)

    def test_on_any_number_of_ranks_and_with_any_operator_the_same_bonds_break(self):
        self.run_until(INCREMENTS)
        alone = self.rows()
        self.assertEqual(alone[0]["broken_bonds"], "0")
        self.assertGreater(int(alone[-1]["broken_bonds"]), 50)
        for ranks, options in [(2, []), (4, []), (2, settings("Solver/Operator=CRS")), (3, settings("Solver/Operator=On-the-Fly"))]:
            with self.subTest(ranks=ranks, options=options):
                self.run_until(INCREMENTS, *options, ranks=ranks)
                for row, other in zip(alone, self.rows(), strict=True):
                    for name in ["broken_bonds", "damaged_elements", "dgfe_elements"]:
                        self.assertEqual(row[name], other[name])
                    self.assertAlmostEqual(float(row["elastic_energy"]) / float(other["elastic_energy"]), 1, places=5)


class Released(GrowingCrack):
    """Pulled open against a clamp, which is then let go: the crack grows."""

    MESH = plate_mesh(clamp=3)
    PULL = lambda increments, value: {"Increments": increments, "Conditions": ["pull down", "pull up"], "Values": [value, value]}
    CASE = changed(GrowingCrack.CASE, {
        "Boundary Conditions/Displacements/clamp": {"Group": "clamp", "Component": "y"},
        "Loading/Steps": {"pull": PULL(6, 14.0), "let go": {"Increments": 3, "Released": ["clamp"]}, "further": PULL(7, 17.0)}})

    def test_on_as_many_ranks_it_ends_with_the_same_bits(self):
        for ranks, stops in [(1, [4, 6, 7, 12]), (2, [6]), (4, [8])]:
            self.run_until(INCREMENTS, *EVERY, ranks=ranks)
            whole = self.outcome()
            broken = [int(row["broken_bonds"]) for row in whole[0]]
            self.assertGreater(broken[6], broken[5])
            for stop in stops:
                with self.subTest(ranks=ranks, stop=stop):
                    self.assert_continues(whole, stop, *EVERY, ranks=ranks)

    def test_stopped_in_the_increment_in_which_it_lets_go_it_ends_with_the_same_bits(self):
        self.write_case({"Loading/Breaking Fraction": 0.05})  # more solves, between which checkpoints are kept
        for ranks in [1, 2]:
            with self.subTest(ranks=ranks):
                self.run_until(INCREMENTS, *EVERY, ranks=ranks)
                whole = self.outcome()
                self.run_until(6, *EVERY, ranks=ranks)
                run = self.run_case("--quiet", *EVERY, "--restart", "--set", "Loading/Maximum Damage Iterations=25", ranks=ranks)
                self.assertEqual(run.returncode, 3, run.stderr)
                self.assertIn("checkpoint-000006_000020.h5", self.checkpoints())
                self.run_until(INCREMENTS, *EVERY, "--restart", ranks=ranks)
                self.assert_same(self.outcome(), whole)


class Started(GrowingCrack):
    """Pulled open by forces, then held where it is, and pulled further by displacements; in another case cut."""

    CASE = changed(GrowingCrack.CASE, {
        "Boundary Conditions/Body Force/Rate": [0.0, -0.02],
        "Boundary Conditions/Displacements/grip": {"Group": "upper", "Component": "x"},
        "Loading/Steps": {
            "pull": {"Increments": 6, "Conditions": ["pull down", "pull up", "Body Force"], "Values": [14.0, 14.0, 4.0]},
            "hold": {"Increments": 4, "Started": ["grip"], "Conditions": ["Body Force"], "Values": [0.0]},
            "further": {"Increments": 6, "Conditions": ["pull down", "pull up"], "Values": [17.0, 17.0]}}})

    def test_on_as_many_ranks_it_ends_with_the_same_bits(self):
        for ranks, stops, options in [(1, [5, 6, 8, 12], []), (2, [7], settings("Loading/Largest Break per Increment=40")), (4, [9], [])]:
            self.run_until(INCREMENTS, *EVERY, *options, ranks=ranks)
            whole = self.outcome()
            rows = whole[0]
            self.assertGreater(int(rows[-1]["broken_bonds"]), 100)
            held = [float(row["displacement_upper_x"]) for row in rows if float(row["load_factor"]) > 6]
            self.assertGreater(abs(held[0]), 1e-3)
            numpy.testing.assert_allclose(held, held[0], rtol=1e-9)
            for stop in stops:
                with self.subTest(ranks=ranks, stop=stop):
                    self.assert_continues(whole, stop, *EVERY, *options, ranks=ranks, end=INCREMENTS)


class Cut(GrowingCrack):
    """Increments that break more than 25 bonds are taken back and repeated with half the load."""

    MOST, LAST = 25, 6
    CASE = changed(GrowingCrack.CASE, {
        "Boundary Conditions/Displacements/pull down/Rate": -0.15, "Boundary Conditions/Displacements/pull up/Rate": 0.15,
        "Loading/Increments": LAST, "Loading/Largest Break per Increment": MOST})

    def whole(self, *options, ranks=1):
        self.run_until(self.LAST, *EVERY, *options, ranks=ranks)
        return self.outcome()

    def test_few_bonds_break_in_each_and_all_of_the_load_is_reached(self):
        rows = self.whole()[0]
        loads = [0.0] + [float(row["load_factor"]) for row in rows]
        broken = [0] + [int(row["broken_bonds"]) for row in rows]
        self.assertEqual([int(row["increment"]) for row in rows], list(range(1, len(rows) + 1)))
        self.assertGreater(len(rows), self.LAST)
        self.assertEqual(loads[-1], self.LAST)
        self.assertGreater(broken[-1], 150)
        steps = numpy.diff(loads)
        self.assertTrue(set(steps) <= {0.5**n for n in range(9)})
        self.assertEqual(set(range(1, self.LAST + 1)) - set(loads), set())  # whole increments are among them
        for step, newly in zip(steps, numpy.diff(broken)):
            self.assertTrue(newly <= self.MOST or step == 0.5**8, (step, newly))
        log = (self.output / "run.log").read_text()
        self.assertIn("cut              step ", log)

        uncut = self.folder / "uncut"
        self.output = uncut
        self.write_case({"Loading/Largest Break per Increment": None})
        self.run_until(self.LAST)
        self.assertLess(float(rows[-1]["jump_loss"]), float(self.rows()[-1]["jump_loss"]))

    def test_on_as_many_ranks_it_ends_with_the_same_bits(self):
        for ranks, stop in [(1, 3), (1, 4), (2, 4), (4, 5)]:
            whole = self.whole(ranks=ranks)
            with self.subTest(ranks=ranks, stop=stop):
                self.assert_continues(whole, stop, *EVERY, ranks=ranks, end=self.LAST)

    def test_with_a_measure_or_stages_it_ends_with_the_same_bits(self):
        turns = {"pull": {"Increments": 4, "Conditions": ["pull down", "pull up"], "Values": [4.5, 4.5]},
                 "let go": {"Increments": 1, "Released": ["pull down"]},
                 "again": {"Increments": 1, "Conditions": ["pull up"], "Values": [9.0]}}
        measure = changed(PathFollowing.CASE, {})["Loading"]["Measure"]
        for changes in [{"Loading/Control": "Measure", "Loading/Measure": {**measure, "Rate": 0.25}}, {"Loading/Steps": turns}]:
            self.write_case(changes)
            for ranks, stop in [(1, 4), (2, 5)]:
                whole = self.whole(ranks=ranks)
                self.assertGreater(len(whole[0]), self.LAST)
                with self.subTest(ranks=ranks, changes=changes):
                    self.assert_continues(whole, stop, *EVERY, ranks=ranks, end=self.LAST)

    def test_ended_between_two_parts_of_an_increment_it_ends_with_the_same_bits(self):
        for ranks in [1, 2]:
            with self.subTest(ranks=ranks):
                whole = self.whole(ranks=ranks)
                solves = [int(row["linear_solves"]) for row in whole[0]]
                run = self.run_case("--quiet", *EVERY, *settings(f"Loading/Maximum Damage Iterations={max(solves) - 1}"), ranks=ranks)
                self.assertEqual(run.returncode, 3, run.stderr)
                self.assertNotEqual(float(self.rows()[-1]["load_factor"]) % 1, 0)
                self.run_until(self.LAST, *EVERY, "--restart", ranks=ranks)
                self.assert_same(self.outcome(), whole)

    def test_on_other_ranks_the_same_bonds_break(self):
        alone = self.whole()[0]
        self.run_until(4)
        self.run_until(self.LAST, "--restart", ranks=2)
        for row, other in zip(alone, self.rows(), strict=True):
            for name in ["load_factor", "broken_bonds", "damaged_elements", "dgfe_elements"]:
                self.assertEqual(row[name], other[name])


if __name__ == "__main__":
    unittest.main()
