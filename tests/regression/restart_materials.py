"""--restart with what materials and crack faces remember.

    restart_materials.py PERIMORPH MPIEXEC
"""

import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from fixture import EVERY, HALF, INCREMENTS, GrowingCrack, changed, half_plate_mesh, plate_mesh, settings


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


class SofteningAcrossAPlane(GrowingCrack):
    """The upper half of the plate of bonds that soften: also bonds with mirror images are remembered."""

    MESH = half_plate_mesh()
    CASE = changed(Softening.CASE, HALF)

    def test_it_goes_on(self):
        for ranks, stop in [(1, 12), (2, 11)]:
            with self.subTest(ranks=ranks, stop=stop):
                self.run_until(INCREMENTS, *EVERY, ranks=ranks)
                whole = self.outcome()
                self.assertGreater(int(whole[0][-1]["broken_bonds"]), 20)
                self.assert_continues(whole, stop, *EVERY, ranks=ranks)


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


if __name__ == "__main__":
    unittest.main()
