"""Checkpoints and --restart: a run that was ended in any way goes on as if it had not been.

    restart.py PERIMORPH MPIEXEC

PERIMORPH_KILLS is how often the test with SIGKILL kills its run; 3 if it is not set.
"""

import os
import pathlib
import random
import resource
import signal
import subprocess
import sys
import time
import unittest

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from fixture import ENDLESS, EVERY, INCREMENTS, N, GrowingCrack, changed, plate_mesh, settings


class Continued(GrowingCrack):
    def test_on_as_many_ranks_it_ends_with_the_same_bits(self):
        for ranks, stops in [(1, [1, 11, 12, 15]), (2, [14])]:
            whole = self.uninterrupted(ranks)
            for stop in stops:  # before damage, at the first breaks, after growths, between two growths
                with self.subTest(ranks=ranks, stop=stop):
                    self.assert_continues(whole, stop, *EVERY, ranks=ranks)

    def test_with_dilatation_it_ends_with_the_same_bits(self):
        volume = [*EVERY, "--set", "Material/Poisson's Ratio=0.2"]
        for ranks in [1, 2]:
            with self.subTest(ranks=ranks):
                self.run_until(INCREMENTS, *volume, ranks=ranks)
                whole = self.outcome()
                self.assertGreater(int(whole[0][-1]["broken_bonds"]), 0)
                self.assert_continues(whole, 14, *volume, ranks=ranks)

    def test_on_other_ranks_the_same_bonds_break(self):
        rows, times, steps = self.uninterrupted()
        for before, after in [(1, 2), (3, 1)]:
            with self.subTest(before=before, after=after):
                self.run_until(13, ranks=before)
                self.run_until(INCREMENTS, "--restart", ranks=after)

                for row, other in zip(rows, self.rows(), strict=True):
                    for name in ["increment", "broken_bonds", "damaged_elements", "dgfe_elements", "unknowns"]:
                        self.assertEqual(row[name], other[name])
                    # Tolerance, 1e-6 of the reactions; energies of bonds that break while it is Damage Tolerance, 1e-4.
                    self.assertAlmostEqual(float(row["reaction_upper_y"]) / float(other["reaction_upper_y"]), 1, places=5)
                    self.assertAlmostEqual(float(row["dissipated_energy"]), float(other["dissipated_energy"]), delta=1e-4)
                self.assertEqual(self.fields()[0], times)
                last = self.fields()[1][-1]
                for c in "12":  # nodes are numbered by rank
                    ours, theirs = (numpy.sort(s[f"vals_nod_var{c}"]) for s in [steps[-1], last])
                    numpy.testing.assert_allclose(ours, theirs, atol=1e-5)  # displacements are up to 0.8

    def test_a_run_that_is_repartitioned_on_its_way_breaks_the_same_bonds_and_can_be_continued(self):
        repartitioned = [*EVERY, "--set", "Solver/Largest Imbalance=1"]
        for ranks in [2, 4]:
            with self.subTest(ranks=ranks):
                self.run_until(INCREMENTS, *EVERY, "--set", "Solver/Largest Imbalance=1000", ranks=ranks)
                once = self.rows()
                self.run_until(INCREMENTS, *repartitioned, ranks=ranks)
                log, whole = (self.output / "run.log").read_text(), self.outcome()
                self.assertIn("repartitioned ", log)
                for row, other in zip(once, whole[0], strict=True):
                    for name in ["increment", "broken_bonds", "damaged_elements", "dgfe_elements", "unknowns"]:
                        self.assertEqual(row[name], other[name])
                    self.assertAlmostEqual(float(row["reaction_upper_y"]) / float(other["reaction_upper_y"]), 1, places=5)

                for stop in [12, 14]:
                    self.assert_continues(whole, stop, *repartitioned, ranks=ranks)

    def test_a_run_that_is_done_can_go_further(self):
        self.run_until(3)
        self.run_until(3, "--restart")
        self.assertEqual([row["increment"] for row in self.rows()], ["1", "2", "3"])
        self.run_until(5, "--restart")
        self.assertEqual([row["increment"] for row in self.rows()], ["1", "2", "3", "4", "5"])
        self.assertIn("after increment 3", (self.output / "run.log").read_text())

    def test_without_a_checkpoint_it_starts_from_the_beginning(self):
        run = self.run_case("--set", "Loading/Increments=2", "--restart")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("no checkpoint found: starting from the beginning", run.stdout)
        self.assertEqual(len(self.rows()), 2)

    def test_a_new_run_removes_the_checkpoints_of_an_older_one(self):
        self.run_until(8, *EVERY)
        self.run_until(3)
        self.assertEqual(self.checkpoints(), ["checkpoint-000003.h5"])

    def test_rows_and_steps_after_the_checkpoint_are_computed_again(self):
        whole = self.uninterrupted()
        self.run_until(13, *EVERY)
        older = {p: p.read_bytes() for p in self.output.glob("checkpoint*")}
        self.run_until(15, *EVERY, "--restart")
        for path in self.output.glob("checkpoint*"):
            path.unlink()
        for path, content in older.items():
            path.write_bytes(content)
        self.run_until(INCREMENTS, *EVERY, "--restart")
        self.assert_same(self.outcome(), whole)

    def test_the_last_two_are_kept_and_the_older_serves_if_the_newest_is_damaged(self):
        whole = self.uninterrupted()
        for harm in [lambda b: b[: len(b) // 2], lambda b: b[:-1], lambda b: b"", lambda b: b[:9000] + b"spoilt" + b[9006:]]:
            self.run_until(14, *EVERY)
            self.assertEqual(self.checkpoints(), ["checkpoint-000013.h5", "checkpoint-000014.h5"])
            newest = self.output / "checkpoint-000014.h5"
            newest.write_bytes(harm(newest.read_bytes()))

            run = self.run_case("--restart", *EVERY)

            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertIn("checkpoint-000014.h5: the checkpoint cannot be read, or is damaged", run.stdout)
            self.assertIn("after increment 13", run.stdout)
            self.assert_same(self.outcome(), whole)
            self.assertEqual(self.checkpoints(), ["checkpoint-000015.h5", "checkpoint-000016.h5"])


class Softening(GrowingCrack):
    """The same plate of bonds that soften, in all increments and between them."""

    CASE = changed(GrowingCrack.CASE, {"Material/Critical Stretch": None, "Material/Bond Law": "Bilinear",
                                       "Material/Tensile Strength": 15.0, "Material/Fracture Energy": 2.0})

    def whole(self, *options, ranks):
        self.output = self.folder / "whole"
        self.run_until(INCREMENTS, *EVERY, *options, ranks=ranks)
        outcome = self.outcome()
        self.output = self.folder / "out"
        self.assertGreater(int(outcome[0][-1]["broken_bonds"]), 20)
        return outcome

    def test_on_as_many_ranks_it_ends_with_the_same_bits(self):
        for ranks, stops in [(1, [6, 12]), (2, [11]), (4, [11])]:
            whole = self.whole(ranks=ranks)
            for stop in stops:
                with self.subTest(ranks=ranks, stop=stop):
                    self.assert_continues(whole, stop, *EVERY, ranks=ranks)

    def test_with_dilatation_and_as_a_matrix_it_ends_with_the_same_bits(self):
        for option in ["Material/Poisson's Ratio=0.2", "Solver/Operator=CRS", "Material/Bond Law=Exponential"]:
            with self.subTest(option=option):
                whole = self.whole("--set", option, ranks=2)
                self.assert_continues(whole, 12, *EVERY, "--set", option, ranks=2)

    def test_stopped_in_the_midst_of_an_increment_it_ends_with_the_same_bits(self):
        often = [*EVERY, "--set", "Loading/Softening Tolerance=1e-5"]  # more solves, between which checkpoints are kept
        whole = self.whole("--set", "Loading/Softening Tolerance=1e-5", ranks=1)
        run = self.run_case("--quiet", *often, "--set", "Loading/Maximum Damage Iterations=25")
        self.assertEqual(run.returncode, 3, run.stderr)
        self.assertLess(len(self.rows()), INCREMENTS)
        self.run_until(INCREMENTS, *often, "--restart")
        self.assert_same(self.outcome(), whole)

    def test_on_other_ranks_it_softens_alike(self):
        rows = self.whole(ranks=1)[0]
        for before, after in [(1, 2)]:
            with self.subTest(before=before, after=after):
                self.run_until(11, ranks=before)
                self.run_until(INCREMENTS, "--restart", ranks=after)
                for row, other in zip(rows, self.rows(), strict=True):
                    self.assertEqual(row["damaged_elements"], other["damaged_elements"])
                    # Where softening stops within an increment depends on Damage Tolerance, 1e-4.
                    self.assertAlmostEqual(float(row["reaction_upper_y"]) / float(other["reaction_upper_y"]), 1, places=2)
                    self.assertAlmostEqual(float(row["dissipated_energy"]), float(other["dissipated_energy"]),
                                           delta=0.01 * float(rows[-1]["dissipated_energy"]))


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


class Compression(GrowingCrack):
    """Beside a crack that is pulled open the plate is pressed along it, and has a compressive strength."""

    CASE = changed(GrowingCrack.CASE, {"Boundary Conditions/Body Force/Rate": [0.5, 0.0], "Material/Compressive Strength": 300.0})

    def test_on_as_many_ranks_it_ends_with_the_same_bits(self):
        for ranks, stop, options in [(1, 12, []), (4, 10, []), (2, 13, settings("Material/Poisson's Ratio=0.25"))]:
            with self.subTest(ranks=ranks):
                self.run_until(INCREMENTS, *EVERY, *options, ranks=ranks)
                whole = self.outcome()
                self.assertGreater(int(whole[0][-1]["broken_bonds"]), 100)
                self.assert_continues(whole, stop, *EVERY, *options, ranks=ranks)

    def test_it_breaks_less_and_on_any_number_of_ranks_the_same(self):
        self.write_case({"Material/Compressive Strength": None})
        self.run_until(INCREMENTS)
        by_stretch = self.rows()
        self.write_case()
        self.run_until(INCREMENTS)
        alone = self.rows()
        self.assertLess(int(alone[-1]["broken_bonds"]), int(by_stretch[-1]["broken_bonds"]))
        for ranks in [2, 4]:
            self.run_until(INCREMENTS, ranks=ranks)
            for row, other in zip(alone, self.rows(), strict=True):
                for name in ["broken_bonds", "damaged_elements", "dgfe_elements"]:
                    self.assertEqual(row[name], other[name])


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


class Contact(GrowingCrack):
    """A crack is pulled open, pressed together while one side slides along the other, and pulled again."""

    STAGE = lambda increments, pull, slide: {"Increments": increments, "Conditions": ["pull down", "pull up", "slide"],
                                             "Values": [pull, pull, slide]}
    CASE = changed(GrowingCrack.CASE, {
        "Peridynamics/Crack Faces": "Contact", "Peridynamics/Friction Coefficient": 0.3,
        "Morphing/Seeds/mouth": {"Center": [1, 6], "Inner Radius": 4.0, "Outer Radius": 5.0},
        "Boundary Conditions/Displacements/slide": {"Group": "upper", "Component": "x", "Rate": 0.01},
        "Loading/Steps": {"pull": STAGE(5, 14.0, 0.0), "press": STAGE(5, -6.0, 8.0), "pull again": STAGE(6, 15.0, 0.0)}})
    SOFT = {"Material/Critical Stretch": None, "Material/Bond Law": "Exponential", "Material/Tensile Strength": 25.0,
            "Material/Fracture Energy": 4.0}
    PRESSED = 9  # the row of the tenth increment

    def column(self, name):
        return [float(row[name]) for row in self.rows()]

    def test_on_as_many_ranks_it_ends_with_the_same_bits(self):
        for changes, ranks, stop in [({}, 1, 4), ({}, 1, 8), ({}, 2, 9), ({}, 4, 13), (self.SOFT, 2, 8)]:
            self.write_case(changes)
            with self.subTest(ranks=ranks, stop=stop, changes=changes):
                self.run_until(INCREMENTS, *EVERY, ranks=ranks)
                friction = self.column("friction_energy")
                self.assertGreater(friction[self.PRESSED], friction[4] + 0.01)
                self.assert_continues(self.outcome(), stop, *EVERY, ranks=ranks)

    def test_the_faces_stay_apart_on_any_number_of_ranks_and_the_energy_closes(self):
        self.run_until(INCREMENTS, "--set", "Peridynamics/Crack Faces=Free", "--set", "Peridynamics/Friction Coefficient=0")
        through = self.column("overlap")[self.PRESSED]
        self.run_until(INCREMENTS)
        alone = self.rows()
        self.assertGreater(through, 0.1)
        self.assertLess(self.column("overlap")[self.PRESSED], 0.1 * through)
        lost = self.column("jump_loss")
        self.assertAlmostEqual(lost[self.PRESSED], lost[4], delta=0.02 * self.column("elastic_energy")[self.PRESSED])
        for ranks in [2, 4]:
            self.run_until(INCREMENTS, ranks=ranks)
            for row, other in zip(alone, self.rows(), strict=True):
                self.assertEqual(row["broken_bonds"], other["broken_bonds"])
                self.assertAlmostEqual(float(row["elastic_energy"]), float(other["elastic_energy"]), delta=1e-4)
                self.assertAlmostEqual(float(row["friction_energy"]), float(other["friction_energy"]), delta=1e-4)


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


class SeveralMaterials(GrowingCrack):
    """Two materials in a pattern, and interfaces weaker than both."""

    MESH = plate_mesh(has_stiff=True)
    CASE = changed(GrowingCrack.CASE, {
        "Materials": {"stiff": {"Blocks": ["stiff"], "Young's Modulus": 3000.0, "Poisson's Ratio": 0.2, "Critical Stretch": 0.05}},
        "Interfaces": {"between": {"Materials": ["body", "stiff"], "Critical Stretch": 0.04}}})

    def test_on_as_many_ranks_it_ends_with_the_same_bits(self):
        for ranks in [1, 4]:
            with self.subTest(ranks=ranks):
                self.run_until(INCREMENTS, *EVERY, ranks=ranks)
                whole = self.outcome()
                self.assertGreater(int(whole[0][-1]["broken_bonds"]), 100)
                self.assert_continues(whole, 13, *EVERY, ranks=ranks)


class Refused(GrowingCrack):
    """Status 2, what differs, and nothing changed."""

    def setUp(self):
        super().setUp()
        self.run_until(2)

    def assert_refused(self, *pieces, options=()):
        before = {p.name: p.read_bytes() for p in self.output.iterdir()}
        for ranks in [1, 2]:
            run = self.run_case("--restart", *options, ranks=ranks)
            self.assertEqual(run.returncode, 2, run.stderr)
            for piece in pieces:
                self.assertEqual(run.stderr.count(piece), 1, run.stderr)
            after = {p.name: p.read_bytes() for p in self.output.iterdir()}
            self.assertEqual(after.keys(), before.keys())
            self.assertEqual([n for n in before if before[n] != after[n]], [])

    def test_another_case(self):
        self.assert_refused(
            "belongs to another case",
            'there "/Material/Critical Stretch = 0.05", here "/Material/Critical Stretch = 0.050000000001"',
            options=["--set", "Material/Critical Stretch=0.050000000001"],
        )

    def test_another_seed(self):
        self.write_case({"Morphing/Seeds/tip/Center": [5, 6.5]})
        self.assert_refused("/Morphing/Seeds/tip/Center = {5, 6}", "/Morphing/Seeds/tip/Center = {5, 6.5}")

    def test_another_mesh(self):
        file = self.folder / "plate.msh"
        file.write_text(file.read_text().replace("\n30 3 2 0\n", "\n30 3.0001 2 0\n"))
        self.assert_refused("belongs to another mesh: as large as this one, but with other coordinates")

    def test_a_mesh_of_another_size(self):
        (self.folder / "plate.msh").write_text(plate_mesh(columns=N + 1))
        self.assert_refused("belongs to another mesh: there 144 elements and 174 nodes, here 156 and 187")

    def test_only_damaged_checkpoints(self):
        for path in self.output.glob("checkpoint*"):
            path.write_bytes(b"none")
        self.assert_refused("damaged, and so are all others")

    def test_a_history_that_is_gone(self):
        (self.output / "history.csv").write_text("")
        self.assert_refused("history.csv: it cannot be continued")

    def test_what_only_says_how_to_compute_may_differ(self):
        self.run_until(3, "--restart", "--set", "Solver/Operator=CRS", "--set", "Output/Every=2", "--set", "Title=other")
        self.assertEqual(len(self.rows()), 3)


class Ended(GrowingCrack):
    """By signals, errors and a full disk: status 3 in order, or at once by SIGKILL."""

    def test_a_signal_ends_it_after_writing_the_last_accepted_increment(self):
        for name, ranks in [("SIGTERM", 1), ("SIGINT", 1), ("SIGTERM", 2)]:
            with self.subTest(name=name, ranks=ranks):
                run = self.start(*ENDLESS, ranks=ranks)
                self.wait_for(lambda: self.has_rows(5))
                process = run.pid
                if ranks > 1:  # one of them alone
                    process = int(pathlib.Path(f"/proc/{run.pid}/task/{run.pid}/children").read_text().split()[0])
                os.kill(process, getattr(signal, name))

                self.assertEqual(run.wait(timeout=60), 3)
                last = self.rows()[-1]["increment"]
                self.assertIn(f"{name} asked it to stop; --restart goes on after increment {last}", run.stderr.read())
                self.assertEqual(self.checkpoints(), [f"checkpoint-{int(last):06d}.h5"])
                (self.output / "history.csv").unlink()

    def test_the_clock_writes_them_too(self):
        run = self.start(*ENDLESS, "--set", "Output/Checkpoint Minutes=0.005")
        self.wait_for(lambda: self.checkpoints() and ".part" not in str(self.checkpoints()))
        first = self.checkpoints()
        self.wait_for(lambda: self.checkpoints()[-1:] != first[-1:])
        self.assertIsNone(run.poll())

    def test_sigusr1_writes_one_and_the_run_goes_on(self):
        run = self.start(*ENDLESS)
        self.wait_for(lambda: self.has_rows(1))
        for n in [1, 2, 2]:
            before = self.checkpoints()
            os.kill(run.pid, signal.SIGUSR1)
            self.wait_for(lambda: self.checkpoints()[-1:] != before[-1:] and ".part" not in str(self.checkpoints()))
            self.assertLessEqual(n, len(self.checkpoints()))
            self.assertIsNone(run.poll())

    def test_an_error_leaves_a_checkpoint_to_go_on_from(self):
        run = self.run_case("--set", "Loading/Maximum Damage Iterations=5")
        self.assertEqual(run.returncode, 3, run.stderr)
        self.assertEqual((len(self.rows()), self.checkpoints()), (11, ["checkpoint-000011.h5"]))
        self.run_until(INCREMENTS, "--restart")
        self.assertEqual(len(self.rows()), INCREMENTS)

    def test_killed_while_it_wrote_one_the_half_of_it_does_not_count(self):
        self.run_until(14, *EVERY)
        newest = self.output / "checkpoint-000014.h5"
        content = newest.read_bytes()
        newest.rename(newest.with_suffix(".h5.part")).write_bytes(content[: len(content) // 2])
        run = self.run_case("--restart", *EVERY)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("after increment 13", run.stdout)
        self.assertEqual(self.checkpoints()[-1], "checkpoint-000016.h5")

    def test_killed_at_any_moment_it_loses_and_doubles_nothing(self):
        kills = int(os.environ.get("PERIMORPH_KILLS", 3))
        seed = random.randrange(10**6)
        chance = random.Random(seed)
        whole = self.uninterrupted()
        begin = time.monotonic()
        self.assertEqual(self.start(*EVERY).wait(timeout=60), 0)
        duration = time.monotonic() - begin
        with self.subTest(seed=seed):
            for kill in range(kills):
                options = ["--restart"] if kill % 8 else []  # now and then from the beginning
                run = self.start(*EVERY, *options)
                time.sleep(chance.uniform(0.2, 1) * duration)
                run.kill()
                run.wait()
                resumed = self.start(*EVERY, "--restart", "--set", f"Loading/Increments={chance.randint(10, INCREMENTS)}")
                self.assertEqual(resumed.wait(timeout=60), 0, resumed.stderr.read())
                found = self.rows()
                self.assertEqual(found, whole[0][: len(found)])
                self.assertEqual(self.fields()[0], whole[1][: len(found)])
            self.run_until(INCREMENTS, *EVERY, "--restart")
            self.assert_same(self.outcome(), whole)

    def test_files_that_may_not_grow_end_it_in_order_as_a_full_disk_does(self):
        # For who is not root. The first part of the series reaches 100,000 bytes in increment 7, checkpoints have 56,000.
        # Open MPI itself would need larger files: for its shared memory, unless it does without.
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (100000, 100000))
        without_files = dict(os.environ, PMIX_MCA_gds="hash", OMPI_MCA_btl="self,tcp")
        for ranks in [1, 2]:
            with self.subTest(ranks=ranks):
                whole = self.uninterrupted(ranks)
                run = self.start(*EVERY, ranks=ranks, preexec_fn=limit, env=without_files)
                message = run.stderr.read()
                self.assertEqual(run.wait(timeout=60), 3, message)
                self.assertIn("File too large", message)
                self.assertRegex(str(self.checkpoints()), r"^\['checkpoint-00000\d.h5', 'checkpoint-00000\d.h5'\]$")
                self.run_until(INCREMENTS, *EVERY, "--restart", ranks=ranks)
                self.assert_same(self.outcome(), whole)

    def test_a_full_disk_ends_it_in_order_and_the_last_checkpoint_serves(self):
        whole = self.uninterrupted()
        for kilobytes in [250, 350]:
            with self.subTest(kilobytes=kilobytes):
                disk = self.folder / f"disk-{kilobytes}"
                disk.mkdir()
                mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={kilobytes}k", "tmpfs", disk], capture_output=True)
                if mounted.returncode != 0:
                    self.skipTest("only root can make a small disk")
                self.addCleanup(subprocess.run, ["umount", disk], check=True)
                self.output = disk

                run = self.run_case(*EVERY)

                self.assertEqual(run.returncode, 3, run.stderr)
                self.assertIn("No space left on device", run.stderr)
                self.assertNotIn(".part", str(self.checkpoints()))
                subprocess.run(["mount", "-o", "remount,size=4m", disk], check=True)
                self.run_until(INCREMENTS, *EVERY, "--restart")
                self.assert_same(self.outcome(), whole)


if __name__ == "__main__":
    unittest.main()
