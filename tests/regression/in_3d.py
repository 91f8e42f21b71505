"""The program in three dimensions: results, the broken surface, restart, check, and mistakes.

    in_3d.py PERIMORPH MPIEXEC
"""

import itertools
import pathlib
import sys
import unittest

import netCDF4
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from fixture import CASE, EVERY, SLOWLY, GrowingCrack, changed, msh, plate_mesh, text_of

NX, NY, NZ = 10, 8, 2  # cubes of size 1


def mesh(is_mixed=False, size=(NX, NY, NZ), has_stiff=False):
    """gmsh's format 2.2: block "body", the right face "right", the two left edges "lower" and "upper"; every third layer across
    x in a block "stiff" if there is one. If it is mixed, two cubes are cut into wedges, and one into pyramids and tetrahedra
    around its middle."""
    NX, NY, NZ = size
    names = ['1 1 "lower"', '1 2 "upper"', '2 3 "right"', '3 4 "body"'] + ['3 5 "stiff"'] * has_stiff
    node = lambda i, j, k: (k * (NY + 1) + j) * (NX + 1) + i + 1
    nodes = [(node(i, j, k), i, j, k) for k in range(NZ + 1) for j in range(NY + 1) for i in range(NX + 1)]
    ring = lambda i, j, k: [node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)]
    elements = [(1, group, [node(0, j, k), node(0, j, k + 1)]) for group, j in [(1, 0), (2, NY)] for k in range(NZ)]
    elements += [(3, 3, [node(NX, j, k), node(NX, j + 1, k), node(NX, j + 1, k + 1), node(NX, j, k + 1)])
                 for k in range(NZ) for j in range(NY)]
    nodes.append((len(nodes) + 1, 8.5, 1.5, 0.5))
    middle = len(nodes)
    for k, j, i in itertools.product(range(NZ), range(NY), range(NX)):
        below, above = ring(i, j, k), ring(i, j, k + 1)
        if is_mixed and (i, j) == (6, 6):
            elements += [(6, 4, [lower[c] for lower in (below, above) for c in corners]) for corners in [(0, 1, 2), (0, 2, 3)]]
        elif is_mixed and (i, j, k) == (8, 1, 0):
            around = [[below[c], above[c], above[(c + 1) % 4], below[(c + 1) % 4]] for c in range(4)]
            elements += [(7, 4, [*base, middle]) for base in [above[::-1], *around]]
            elements += [(4, 4, [*(below[c] for c in corners), middle]) for corners in [(0, 1, 2), (0, 2, 3)]]
        else:
            elements.append((5, 5 if has_stiff and i % 3 == 0 else 4, below + above))
    if not is_mixed:
        nodes.pop()
    return msh(names, nodes, elements)


INCREMENTS = 14


class InThreeDimensions(GrowingCrack):
    """The plate's case with a slit through the thickness."""

    CASE = changed(CASE, {
        **SLOWLY,
        "Dimension": 3,
        "Material/Poisson's Ratio": 0.25,
        "Material/Elastic Model": "Three-Dimensional",
        "Morphing/Seeds/tip": {"Shape": "Cylinder", "Start": [4, 4, 0], "End": [4, 4, 2], "Inner Radius": 3.5, "Outer Radius": 5.0},
        "Pre-Cracks/slit": {"Shape": "Polygon", "Points": [0, 4, 0, 4, 4, 0, 4, 4, 2, 0, 4, 2]},
        "Boundary Conditions/Displacements/hold z": {"Group": "right", "Component": "z"},
        "Loading/Increments": INCREMENTS,
    })
    MESH = mesh()


class Runs(InThreeDimensions):
    def test_results_have_all_three_components(self):
        self.run_until(INCREMENTS)

        rows = [{key: float(value) for key, value in row.items()} for row in self.history()]
        self.assertEqual(rows[0]["broken_bonds"], 0)
        self.assertGreater(rows[-1]["broken_bonds"], 100)
        for row in rows:
            for c in "xyz":
                forces = [row[f"reaction_{group}_{c}"] for group in ["upper", "lower", "right"]]
                self.assertLess(abs(sum(forces)), 1e-5 * abs(row["reaction_upper_y"]))
        with netCDF4.Dataset(self.series()[-1]) as file:
            self.assertEqual(text_of(file["name_nod_var"]), [f"displacement_{c}" for c in "xyz"])
            for name in ["stress_zz", "stress_yz", "stress_xz"]:
                self.assertIn(name, text_of(file["name_elem_var"]))
            self.assertEqual(file["connect1"].elem_type, "HEX8")
            self.assertIn("body_DGFE", text_of(file["eb_names"]))

    def test_the_broken_surface_is_where_the_crack_runs(self):
        """Both faces of the crack, elements' sides, are a side set; it is empty before the first break."""
        sizes = []
        for ranks in [1, 2]:
            self.run_until(INCREMENTS, ranks=ranks)
            with netCDF4.Dataset(self.series()[0]) as file:
                self.assertEqual(self.surface(file).shape, (0, 4, 3))
            with netCDF4.Dataset(self.series()[-1]) as file:
                faces = self.surface(file)
            self.assertGreater(len(faces), 3)
            sizes.append(len(faces))
            middle = faces.mean(axis=1)
            self.assertLess(abs(middle[:, 1] - 4).max(), 1.6)  # straight on from the slit's tip at (4, 4)
            self.assertGreater(middle[:, 0].min(), 3)
            for face in middle:  # each has its counterpart on the other side of the crack
                self.assertEqual((abs(middle - face).max(axis=1) < 1e-9).sum(), 2)
        self.assertEqual(sizes[0], sizes[1])

    def test_elements_of_one_block_may_be_of_all_shapes(self):
        """Each shape is in blocks of its own, with a name and an id for each class."""
        (self.folder / "plate.msh").write_text(mesh(is_mixed=True))
        found = set()
        for ranks in [1, 2]:
            self.run_until(INCREMENTS, ranks=ranks)
            for part in self.series():
                with netCDF4.Dataset(part) as file:
                    types = [file[f"connect{b}"].elem_type for b in range(1, len(file["eb_prop1"]) + 1)]
                    found |= set(zip(text_of(file["eb_names"]), map(int, file["eb_prop1"][:]), types))
        first_ids = {"TETRA": 11, "PYRAMID": 21, "WEDGE": 31, "HEX8": 41}
        self.assertEqual({shape for _, _, shape in found}, set(first_ids))
        for name, number, shape in found:
            kind = ["FE", "MORPH", "PD", "DGFE"][number - first_ids[shape]]
            self.assertEqual(name, f"body_{kind}" if shape == "TETRA" else f"body_{kind}_{shape}")
        self.assertIn(("body_DGFE_HEX8", 44, "HEX8"), found)
        self.assertIn(("body_MORPH_PYRAMID", 22, "PYRAMID"), found)

    HEX_SIDES = [[0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [0, 4, 7, 3], [0, 3, 2, 1], [4, 5, 6, 7]]

    def surface(self, file):
        """Corners of the faces, (faces, 4, 3)."""
        number = text_of(file["ss_names"]).index("broken_surface") + 1
        if f"elem_ss{number}" not in file.variables:
            return numpy.zeros((0, 4, 3))
        corners = numpy.concatenate([file[f"connect{b}"][:] - 1 for b in range(1, len(file.dimensions["num_el_blk"]) + 1)])
        places = numpy.column_stack([file[f"coord{c}"][:] for c in "xyz"])
        return numpy.array([places[corners[e - 1][self.HEX_SIDES[s - 1]]]
                            for e, s in zip(file[f"elem_ss{number}"][:], file[f"side_ss{number}"][:])])

    def test_small_blocks_on_many_ranks(self):
        """The aggregates of multigrid are then as small as they get, and some ranks have none on coarse levels."""
        for nx, ny, nz in [(8, 6, 3), (6, 6, 4), (9, 5, 2)]:
            with self.subTest(size=(nx, ny, nz)):
                (self.folder / "plate.msh").write_text(mesh(size=(nx, ny, nz)))
                tip = [4, ny // 2]
                self.write_case({
                    "Loading/Increments": 6,
                    "Morphing/Seeds/tip": {"Shape": "Cylinder", "Start": [*tip, 0], "End": [*tip, nz], "Inner Radius": 3.0, "Outer Radius": 4.0},
                    "Pre-Cracks/slit/Points": [0, tip[1], 0, *tip, 0, *tip, nz, 0, tip[1], nz],
                    "Boundary Conditions/Displacements/pull down/Rate": -0.12,
                    "Boundary Conditions/Displacements/pull up/Rate": 0.12})
                broken = []
                for ranks in [4, 1]:
                    run = self.run_case("--quiet", ranks=ranks, timeout=120)
                    self.assertEqual(run.returncode, 0, run.stderr)
                    broken.append([row["broken_bonds"] for row in self.history()])
                self.assertEqual(*broken)
                self.assertGreater(int(broken[0][-1]), 0)

    def test_check_says_what_the_case_would_cost(self):
        run = self.perimorph("check", self.case)
        self.assertEqual(run.returncode, 0, run.stderr)
        # 11 x 9 x 3 nodes, and 4 x 3 more along the slit, whose tip is closed.
        for piece in ["160 elements, 309 nodes", "927 unknowns", "bonds", "memory"]:
            self.assertIn(piece, run.stdout)


class Continued(InThreeDimensions):
    def test_on_as_many_ranks_a_restart_ends_with_the_same_bits(self):
        for ranks, stops in [(1, [6, INCREMENTS - 2]), (2, [INCREMENTS - 1])]:
            self.output = self.folder / f"whole-{ranks}"
            self.run_until(INCREMENTS, *EVERY, ranks=ranks)
            whole = self.outcome()
            self.assertGreater(float(whole[0][-1]["broken_bonds"]), 100)
            self.output = self.folder / f"out-{ranks}"
            for stop in stops:
                with self.subTest(ranks=ranks, stop=stop):
                    self.assert_continues(whole, stop, *EVERY, ranks=ranks)

    def test_on_other_ranks_the_same_bonds_break(self):
        self.run_until(INCREMENTS)
        alone = self.rows()
        self.run_until(INCREMENTS - 1, ranks=3)
        self.run_until(INCREMENTS, "--restart", ranks=2)
        for row, other in zip(alone, self.rows(), strict=True):
            for name in ["increment", "broken_bonds", "damaged_elements", "dgfe_elements", "unknowns"]:
                self.assertEqual(row[name], other[name])


class Restart(InThreeDimensions):
    """To the last bit, for the kinds of bonds and of loads."""

    MESH = mesh(has_stiff=True)
    KINDS = {
        "materials": {
            "Materials": {"stiff": {"Blocks": ["stiff"], "Young's Modulus": 3000.0, "Poisson's Ratio": 0.2, "Critical Stretch": 0.05}},
            "Interfaces": {"between": {"Materials": ["body", "stiff"], "Critical Stretch": 0.04}}},
        "softening": {"Material/Critical Stretch": None, "Material/Bond Law": "Exponential", "Material/Tensile Strength": 15.0,
                      "Material/Fracture Energy": 2.0, "Material/Poisson's Ratio": 0.2},
        "measure": {"Loading/Control": "Measure", "Loading/Measure": {
            "Group": "upper", "Other Point": [1.0, 2.5, 1.0], "Direction": [0.0, 1.0, 0.0], "Rate": 0.1}},
        "contact": {"Peridynamics/Crack Faces": "Contact", "Peridynamics/Friction Coefficient": 0.3, "Loading/Steps": {
            "pull": {"Increments": 4, "Conditions": ["pull down", "pull up"], "Values": [12.0, 12.0]},
            "press": {"Increments": 6, "Conditions": ["pull down", "pull up"], "Values": [-4.0, -2.0]},
            "further": {"Increments": 4, "Conditions": ["pull down", "pull up"], "Values": [14.0, 14.0]}}},
        "steps": {"Loading/Steps": {
            "pull": {"Increments": 4, "Cycles": 2, "Conditions": ["pull down", "pull up"], "Values": [12.0, 12.0]},
            "let go": {"Increments": 3, "Released": ["hold z"]},
            "further": {"Increments": 3, "Conditions": ["pull down", "pull up"], "Values": [14.0, 14.0]}}},
        "cut": {"Loading/Largest Break per Increment": 40},
        "constraints": {
            "Boundary Conditions/Rigid Groups/grip/Group": "right",
            "Boundary Conditions/Displacements/no turn": {"Group": "right", "Component": "rotation y"},
            "Boundary Conditions/Displacements/pull up": {"Group": "upper", "Direction": [0.2, 1.0, 0.0], "Rate": 0.05}},
        "symmetry": {"Boundary Conditions/Symmetry Planes/end/Group": "right", "Boundary Conditions/Displacements/hold x": None,
                     "Morphing/Seeds/tip/Outer Radius": 7.0},
    }

    def test_it_ends_with_the_same_bits(self):
        for kind, changes in self.KINDS.items():
            self.write_case(changes)
            for ranks in [1, 2]:
                with self.subTest(kind=kind, ranks=ranks):
                    self.output = self.folder / f"whole-{kind}-{ranks}"
                    self.run_until(INCREMENTS, *EVERY, ranks=ranks)
                    whole = self.outcome()
                    last = whole[0][-1]
                    self.assertGreater(float(last["dissipated_energy"]), 1)
                    self.assertAlmostEqual(float(last.get("measure", 0.1 * INCREMENTS)), 0.1 * INCREMENTS, places=6)
                    self.output = self.folder / f"out-{kind}-{ranks}"
                    self.assert_continues(whole, 12 if kind == "cut" else 10, *EVERY, ranks=ranks, end=INCREMENTS)


class Mistakes(InThreeDimensions):
    """Status 2 on any number of ranks, with a message that says where and what."""

    def assert_refused(self, *pieces, options=()):
        for ranks in [1, 2]:
            run = self.run_case(*options, ranks=ranks)
            self.assertEqual(run.returncode, 2, run.stderr)
            for piece in pieces:
                self.assertIn(piece, run.stderr)

    def test_a_mesh_of_two_dimensions(self):
        (self.folder / "plate.msh").write_text(plate_mesh())
        self.assert_refused("plate.msh: the mesh has no elements of dimension 3, its highest is 2")

    def test_a_body_that_is_free_to_move(self):
        self.write_case({"Boundary Conditions/Displacements/hold z": {"Group": "lower", "Component": "x"}})
        self.assert_refused("/Boundary Conditions/Displacements: the body can move as a whole: translation in z;")

    def test_a_pre_crack_through_elements_outside_of_the_zone(self):
        self.assert_refused("/Pre-Cracks: a pre-crack cuts through the element at (", "which is not peridynamic",
                            options=["--set", "Pre-Cracks/slit/Points={0, 4.5, 0, 4, 4.5, 0, 4, 4.5, 2, 0, 4.5, 2}"])


if __name__ == "__main__":
    unittest.main()
