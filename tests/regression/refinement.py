"""A mesh that is refined around a crack, and follows it.

    refinement.py PERIMORPH MPIEXEC

PERIMORPH_KILLS: see whole_run.py.
"""

import itertools
import pathlib
import sys
import unittest

import netCDF4
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import whole_run
from fixture import CASE, EVERY, HALF, GrowingCrack, case_file, changed, msh, settings

SIZE = 4.0  # of the elements in the file: four finest ones
EVERYWHERE = settings("Mesh/Refinement/Margin=1000")
COUNTS = ["broken_bonds", "damaged_elements", "dgfe_elements", "unknowns"]


def wide_plate(n=12):
    """A square of n x n elements: block "body", the right edge "right", and two elements of the lower and the upper edge beside
    the left one "lower" and "upper"."""
    node = lambda i, j: j * (n + 1) + i + 1
    nodes = [(node(i, j), i * SIZE, j * SIZE, 0) for j in range(n + 1) for i in range(n + 1)]
    elements = [(1, group, [node(i, j), node(i + 1, j)]) for group, j in [(1, 0), (2, n)] for i in range(2)]
    elements += [(1, 3, [node(n, j), node(n, j + 1)]) for j in range(n)]
    elements += [(3, 4, [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)]) for j in range(n) for i in range(n)]
    return msh(['1 1 "lower"', '1 2 "upper"', '1 3 "right"', '2 4 "body"'], nodes, elements)


def half_of_wide_plate(n=12):
    """Its upper half, with its lower edge beside the slit as "ligament"."""
    node = lambda i, j: j * (n + 1) + i + 1
    nodes = [(node(i, j), i * SIZE, (n // 2 + j) * SIZE, 0) for j in range(n // 2 + 1) for i in range(n + 1)]
    elements = [(1, 1, [node(i, n // 2), node(i + 1, n // 2)]) for i in range(2)]
    elements += [(1, 2, [node(i, 0), node(i + 1, 0)]) for i in range(3, n)]
    elements += [(1, 3, [node(n, j), node(n, j + 1)]) for j in range(n // 2)]
    elements += [(3, 4, [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)]) for j in range(n // 2) for i in range(n)]
    return msh(['1 1 "upper"', '1 2 "ligament"', '1 3 "right"', '2 4 "body"'], nodes, elements)


def wide_block(n=(16, 10, 1)):
    """The same in three dimensions, of elements of size 2, its right face, and the faces of two columns of elements."""
    size = [count + 1 for count in n]
    node = lambda i, j, k: (k * size[1] + j) * size[0] + i + 1
    nodes = [(node(i, j, k), 2 * i, 2 * j, 2 * k) for k in range(size[2]) for j in range(size[1]) for i in range(size[0])]
    ring = lambda i, j, k: [node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)]
    elements = [(3, group, [node(i, j, k), node(i + 1, j, k), node(i + 1, j, k + 1), node(i, j, k + 1)])
                for group, j in [(1, 0), (2, n[1])] for k in range(n[2]) for i in range(2)]
    elements += [(3, 3, [node(n[0], j, k), node(n[0], j + 1, k), node(n[0], j + 1, k + 1), node(n[0], j, k + 1)])
                 for k in range(n[2]) for j in range(n[1])]
    elements += [(5, 4, ring(i, j, k) + ring(i, j, k + 1)) for k, j, i in itertools.product(*map(range, n[::-1]))]
    return msh(['2 1 "lower"', '2 2 "upper"', '2 3 "right"', '3 4 "body"'], nodes, elements)


class Refined(GrowingCrack):
    MESH = wide_plate()
    CASE = changed(CASE, {
        "Mesh/Refinement/Levels": 2, "Mesh/Refinement/Margin": 2.0, "Mesh/Refinement/Look-Ahead": 4.0,
        "Pre-Cracks/slit/Points": [0.0, 24.0, 12.0, 24.0], "Morphing/Seeds/tip/Center": [12, 24],
        "Boundary Conditions/Displacements/pull down/Rate": -0.2, "Boundary Conditions/Displacements/pull up/Rate": 0.2,
        "Loading/Increments": 8})
    END = 8

    def refinements(self):
        """How many elements there are after each."""
        lines = [line for line in (self.output / "run.log").read_text().splitlines() if line.startswith("refined ")]
        return [int(line.split(" become ")[1].split(",")[0]) for line in lines]

    def counts(self):
        return [[row[name] for name in COUNTS] for row in self.rows()]


class Following(Refined):
    def test_it_breaks_what_the_mesh_breaks_that_is_fine_everywhere(self):
        self.run_until(self.END, *EVERYWHERE)
        fine = self.rows()
        self.run_until(self.END)
        rows = self.rows()
        first = next(k for k, row in enumerate(fine) if int(row["broken_bonds"]) > 0)
        self.assertGreater(first, 0)
        self.assertLess(int(rows[0]["unknowns"]), 0.5 * int(fine[0]["unknowns"]))
        sizes = self.refinements()
        self.assertGreater(len(sizes), 2)
        self.assertEqual(sizes, sorted(set(sizes)))
        self.assertGreater(int(rows[first]["broken_bonds"]), 0)
        for row, other in zip(rows[:first], fine):
            self.assertEqual(row["broken_bonds"], "0")
            self.assertAlmostEqual(float(row["reaction_upper_y"]) / float(other["reaction_upper_y"]), 1.0, delta=0.04)
        last = [int(run[-1]["damaged_elements"]) for run in (rows, fine)]
        self.assertAlmostEqual(last[0] / last[1], 1.0, delta=0.1)

    def test_any_number_of_ranks_windows_and_a_matrix_break_the_same(self):
        self.run_until(self.END)
        alone, energy, sizes = self.counts(), float(self.rows()[-1]["elastic_energy"]), self.refinements()
        windows = settings("Solver/Largest Window=0.9", "Solver/Window Radius=3")
        for ranks, options in [(2, []), (4, []), (1, windows), (2, windows), (2, settings("Solver/Operator=CRS", "Solver/Preconditioner Matrix=Coupled"))]:
            with self.subTest(ranks=ranks, options=options):
                self.run_until(self.END, *options, ranks=ranks)
                self.assertEqual(self.counts(), alone)
                self.assertEqual(self.refinements(), sizes)
                self.assertAlmostEqual(float(self.rows()[-1]["elastic_energy"]) / energy, 1.0, places=4)

    def test_a_group_that_is_not_in_the_mesh_is_refused(self):
        check = self.perimorph("check", self.case, *settings("Mesh/Refinement/Groups={nowhere}"))
        self.assertEqual(check.returncode, 2)
        self.assertIn('/Mesh/Refinement/Groups: the mesh plate.msh has no group of nodes called "nowhere"', check.stderr)
        check = self.perimorph("check", self.case, *settings("Mesh/Refinement/Groups={lower}"))
        self.assertEqual(check.returncode, 0, check.stderr)

    def test_no_crack_opens_where_sizes_meet(self):
        """Each node within an edge of another element is in its middle, displaced by the mean of its ends."""
        self.run_until(2)
        with netCDF4.Dataset(self.series()[0]) as file:
            place = numpy.column_stack([file["coordx"][:], file["coordy"][:]])
            moved = numpy.column_stack([file["vals_nod_var1"][-1], file["vals_nod_var2"][-1]])
            corners = numpy.concatenate([file[name][:] - 1 for name in file.variables if name.startswith("connect")])
        node_at = {tuple(x): n for n, x in enumerate(place)}
        n_hanging = 0
        for element in corners:
            for one, other in zip(element, numpy.roll(element, -1)):
                middle = node_at.get(tuple((place[one] + place[other]) / 2))
                if middle is None:
                    continue
                n_hanging += 1
                numpy.testing.assert_allclose(moved[middle], (moved[one] + moved[other]) / 2, rtol=0, atol=1e-14)
        self.assertGreater(n_hanging, 20)


class Continued(Refined):
    def test_on_as_many_ranks_it_ends_with_the_same_bits(self):
        for ranks, stops, options in [(1, [3, 5], []), (2, [4], settings("Mesh/Perturbation=0.2")), (4, [6], [])]:
            options = [*EVERY, *options]
            self.run_until(self.END, *options, ranks=ranks)
            whole = self.outcome()
            for stop in stops:
                with self.subTest(ranks=ranks, stop=stop):
                    self.assert_continues(whole, stop, *options, ranks=ranks)

    def test_stopped_in_the_midst_of_an_increment_it_ends_with_the_same_bits(self):
        self.run_until(self.END, *EVERY)
        whole = self.outcome()
        most = max(int(row["linear_solves"]) for row in whole[0])
        self.assertGreater(most, 50)
        run = self.run_case("--quiet", *EVERY, *settings(f"Loading/Maximum Damage Iterations={most - 5}"))
        self.assertEqual(run.returncode, 3, run.stderr)
        self.run_until(self.END, *EVERY, "--restart")
        self.assert_same(self.outcome(), whole)

    def test_it_goes_on_with_any_number_of_ranks(self):
        self.run_until(self.END)
        whole = self.counts()
        for before, after in [(1, 4), (4, 2)]:
            with self.subTest(before=before, after=after):
                self.run_until(5, ranks=before)
                self.run_until(self.END, "--restart", ranks=after)
                self.assertEqual(self.counts(), whole)

    def test_increments_that_are_cut_go_back_to_the_mesh_they_began_with(self):
        cut = [*EVERY, *settings("Loading/Largest Break per Increment=150")]
        self.run_until(self.END, *cut)
        whole = self.outcome()
        self.assertGreater(len(whole[0]), self.END)
        sizes = self.refinements()
        self.assertLess(min(b - a for a, b in zip(sizes, sizes[1:])), 0)
        self.run_until(5, *cut)
        self.run_until(self.END, *cut, "--restart")
        self.assert_same(self.outcome(), whole)


# Refined in a few increments, in the second and the third, with all that a run can write.
SHORT = changed(Refined.CASE, {
    "Output": {"Crack": True, "Bonds": [2, 3], "Probes": {"ahead": {"Points": [14.5, 24.5, 40, 24.5], "Divisions": 4}}},
    "Boundary Conditions/Displacements/pull down/Rate": -0.35, "Boundary Conditions/Displacements/pull up/Rate": 0.35,
    "Loading/Increments": 3})


class Killed(whole_run.Killed, whole_run.WholeRun):
    """At moments within refinements, too."""

    MESH = Refined.MESH
    CASE = SHORT
    RANKS = [1, 2]


class Half(Refined):
    """The crack on a plane of symmetry: bonds with images, whose ids change with the mesh as well."""

    MESH = half_of_wide_plate()
    CASE = changed(Refined.CASE, HALF)

    def test_it_is_half_of_the_whole_and_goes_on_with_the_same_bits(self):
        self.run_until(self.END, *EVERY, ranks=2)
        half = self.rows()
        self.assertGreater(len(self.refinements()), 2)
        self.assert_continues(self.outcome(), 5, *EVERY, ranks=2)
        (self.folder / "plate.msh").write_text(wide_plate())
        case_file.write_case(self.case, changed(Refined.CASE, {"Boundary Conditions/Displacements/hold y": None}))
        self.output = self.folder / "whole"
        self.run_until(self.END)
        for row, whole in zip(half, self.rows(), strict=True):
            self.assertEqual(2 * int(row["damaged_elements"]), int(whole["damaged_elements"]))
            self.assertAlmostEqual(2 * float(row["elastic_energy"]) / float(whole["elastic_energy"]), 1, places=5)


class Block(Refined):
    """In three dimensions: a slit through the thickness."""

    MESH = wide_block()
    CASE = changed(Refined.CASE, {
        "Dimension": 3, "Material/Poisson's Ratio": 0.25, "Material/Elastic Model": "Three-Dimensional",
        "Mesh/Refinement/Levels": 1, "Peridynamics/Horizon": 2.0,
        "Morphing/Seeds/tip": {"Shape": "Cylinder", "Start": [6, 10, 0], "End": [6, 10, 2], "Inner Radius": 3.5, "Outer Radius": 4.0},
        "Pre-Cracks/slit": {"Shape": "Polygon", "Points": [0, 10, 0, 6, 10, 0, 6, 10, 2, 0, 10, 2]},
        "Boundary Conditions/Displacements/hold z": {"Group": "right", "Component": "z"},
        "Loading/Increments": 4})
    END = 4

    def test_any_number_of_ranks_breaks_the_same_and_goes_on_with_the_same_bits(self):
        self.run_until(self.END)
        alone = self.counts()
        self.assertGreater(int(alone[-1][0]), 100)
        self.assertGreater(len(self.refinements()), 1)
        for ranks in [2, 4]:
            with self.subTest(ranks=ranks):
                self.run_until(self.END, *EVERY, ranks=ranks)
                self.assertEqual(self.counts(), alone)
                self.assert_continues(self.outcome(), 3, *EVERY, ranks=ranks)


if __name__ == "__main__":
    unittest.main()
