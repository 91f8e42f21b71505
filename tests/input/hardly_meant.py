"""What a case or its mesh says that has no effect, or one that nobody can want: `check` and `run` say so.

    hardly_meant.py PERIMORPH MPIEXEC
"""

import itertools
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from fixture import CASE, Plate, changed, msh, settings

DISPLACEMENTS = "Boundary Conditions/Displacements"
TIP = "Morphing/Seeds/tip"


def held(group, *components):
    return {f"{group} {c}": {"Group": group, "Component": c} for c in components}


def moved(group, component, rate=0.01):
    return {f"pull {component}": {"Group": group, "Component": component, "Rate": rate}}


class Grids:
    """A mesh of rectangles of unit squares, each with nodes of its own; "left" is the first one's left edge, "right" the
    last one's right edge."""

    def __init__(self):
        self.nodes, self.elements, self.corners = [], [], []

    def add(self, x, y, columns, rows, shared=()):
        """Places in `shared` get the nodes that are there already."""
        known = {(node[1], node[2]): node[0] for node in self.nodes}
        at = {}
        for j in range(rows + 1):
            for i in range(columns + 1):
                place = (x + i, y + j)
                if place in shared and place in known:
                    at[i, j] = known[place]
                else:
                    self.nodes.append((len(self.nodes) + 1, *place, 0))
                    at[i, j] = len(self.nodes)
        self.elements += [(3, 3, [at[i, j], at[i + 1, j], at[i + 1, j + 1], at[i, j + 1]])
                          for j in range(rows) for i in range(columns)]
        self.corners.append((at, columns, rows))
        return self

    def text(self):
        (first, _, rows), (last, columns, last_rows) = self.corners[0], self.corners[-1]
        sides = [(1, 1, [first[0, j], first[0, j + 1]]) for j in range(rows)]
        sides += [(1, 2, [last[columns, j], last[columns, j + 1]]) for j in range(last_rows)]
        return msh(['1 1 "left"', '1 2 "right"', '2 3 "body"'], self.nodes, sides + self.elements)


def blocks(*boxes, shared=()):
    """A mesh of boxes of unit cubes (place of the lowest corner, numbers of cubes), each with nodes of its own, but for those at
    places in `shared`; "left" is the first one's left face, "right" the last one's right face."""
    nodes, cubes, faces, known = [], [], [], {}
    for box, (low, counts) in enumerate(boxes):
        at = {}
        for step in itertools.product(*(range(n + 1) for n in counts)):
            place = tuple(a + b for a, b in zip(low, step))
            if place not in shared or place not in known:
                nodes.append((len(nodes) + 1, *place))
                known[place] = len(nodes)
            at[step] = known[place]
        ring = lambda i, j, k: [at[i, j, k], at[i + 1, j, k], at[i + 1, j + 1, k], at[i, j + 1, k]]
        cubes += [(5, 3, ring(i, j, k) + ring(i, j, k + 1)) for i, j, k in itertools.product(*map(range, counts))]
        for group, i in [(1, 0)] * (box == 0) + [(2, counts[0])] * (box == len(boxes) - 1):
            faces += [(3, group, [at[i, j, k], at[i, j + 1, k], at[i, j + 1, k + 1], at[i, j, k + 1]])
                      for j in range(counts[1]) for k in range(counts[2])]
    return msh(['2 1 "left"', '2 2 "right"', '3 3 "body"'], nodes, faces + cubes)


class Checked(Plate):
    def check(self, *options, ranks=1):
        return self.perimorph("check", self.case, *options, ranks=ranks)

    def assert_refused(self, *pieces, options=(), ranks=(1, 2)):
        for command in ["check", "run"]:
            for n in ranks:
                with self.subTest(command=command, ranks=n):
                    run = self.check(*options, ranks=n) if command == "check" else self.run_case("--quiet", *options, ranks=n)
                    self.assertEqual(run.returncode, 2, run.stdout + run.stderr)
                    for piece in pieces:
                        self.assertEqual(run.stderr.count(piece), 1, run.stderr)

    def assert_warned(self, *pieces, options=(), status=0):
        for run in [self.check("--quiet", *options, ranks=2), self.run_case("--quiet", *settings("Loading/Increments=1"), *options)]:
            self.assertEqual(run.returncode, status, run.stdout + run.stderr)
            for piece in pieces:
                self.assertEqual(run.stdout.count(piece), 1, run.stdout)

    def assert_not_warned(self, piece, *options):
        run = self.check(*options)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        self.assertNotIn(piece, run.stdout)


class Places(Checked):
    """The plate is from (0, 0) to (12, 12), in elements of 1."""

    def test_a_pre_crack_outside_the_body(self):
        self.assert_refused("/Pre-Cracks/slit: found a crack from (60, 6) to (90, 6): it is outside the body, which is from (0, 0) to (12, 12)",
                            "Scaled by 0.1 it would be: are the units those of the mesh?",
                            options=settings("Pre-Cracks/slit/Points={60, 6, 90, 6}"))

    def test_a_pre_crack_beside_the_body_or_on_its_edge(self):
        for points in ["{-5, 13, 20, 13}", "{0, 0, 12, 0}", "{12, 3, 12, 8}", "{-3, 6, 0, 6}"]:
            with self.subTest(points):
                self.assert_refused("/Pre-Cracks/slit: found a crack", "it is outside the body",
                                    options=settings(f"Pre-Cracks/slit/Points={points}"), ranks=[1])

    def test_a_pre_crack_that_was_not_scaled_with_the_mesh(self):
        lengths = settings("Mesh/Scale=1000", "Peridynamics/Horizon=2000", "Peridynamics/Characteristic Length=200",
                           f"{TIP}/Center={{5000, 6000}}", f"{TIP}/Inner Radius=3500", f"{TIP}/Outer Radius=4000")
        self.assert_refused("/Pre-Cracks/slit: found a crack from (0, 6) to (5, 6): it is much shorter than the elements there",
                            "Scaled by 1000, as the mesh is (/Mesh/Scale), it would be", options=lengths, ranks=[1])
        self.assertEqual(self.check(*lengths, *settings("Pre-Cracks/slit/Points={0, 6000, 5000, 6000}")).returncode, 0)

    def test_one_of_several_pre_cracks(self):
        self.write_case({"Pre-Cracks/far": {"Points": [20, 20, 25, 20]}})
        self.assert_refused("1 mistake in", "/Pre-Cracks/far: found a crack")

    def test_a_pre_crack_that_leaves_the_body_is_none_of_these(self):
        self.assertEqual(self.check(*settings("Pre-Cracks/slit/Points={-9, 6, 5, 6}")).returncode, 0)

    def test_seeds_outside_the_body(self):
        self.assert_refused("/Morphing/Seeds/tip: found a zone around (500, 6): it is outside the body, which is from (0, 0) to (12, 12)",
                            "Scaled by 0.01 it would be: are the units those of the mesh?",
                            options=settings(f"{TIP}/Center={{500, 6}}"))

    def test_seeds_of_other_shapes_and_one_of_two(self):
        self.write_case({"Morphing/Seeds/far": {"Shape": "Box", "Lower Corner": [13, 0], "Upper Corner": [17, 4], "Rim": 0.5}})
        self.assert_refused("/Morphing/Seeds/far: found a zone around (15, 2)", ranks=[1])

    def test_seeds_that_only_touch_the_body_let_nothing_break(self):
        self.assert_refused("/Morphing/Seeds: no element is peridynamic, so that nothing can ever break",
                            options=settings(f"{TIP}/Center={{-3.8, 6}}"))

    def test_seeds_smaller_than_the_horizon_let_nothing_break(self):
        self.assert_refused("/Morphing/Seeds: no element is peridynamic", options=settings(f"{TIP}/Inner Radius=1.5"), ranks=[1])


class PlacesIn3D(Checked):
    """A block from (0, 0, 0) to (8, 6, 3), in elements of 1."""

    CASE = changed(CASE, {"Dimension": 3, "Material/Poisson's Ratio": 0.25, "Material/Elastic Model": "Three-Dimensional",
                          TIP: {"Shape": "Cylinder", "Start": [4, 3, 0], "End": [4, 3, 3], "Inner Radius": 3.0, "Outer Radius": 4.0},
                          "Pre-Cracks/slit": {"Shape": "Polygon", "Points": [0, 3, 0, 4, 3, 0, 4, 3, 3, 0, 3, 3]},
                          DISPLACEMENTS: held("left", "x", "y", "z") | moved("right", "x")})
    MESH = blocks(((0, 0, 0), (8, 6, 3)))

    def test_the_case_that_the_others_spoil_is_sound(self):
        self.assertEqual(self.check().returncode, 0)

    def test_pre_cracks_outside_the_body(self):
        outside = {"a disc above it": {"Shape": "Disc", "Center": [4, 3, 30], "Normal": [0, 0, 1], "Radius": 2.0},
                   "a polygon that was not scaled": {"Shape": "Polygon", "Points": [0, 30, 0, 40, 30, 0, 40, 30, 30, 0, 30, 30]},
                   "a disc on its face": {"Shape": "Disc", "Center": [4, 3, 3], "Normal": [0, 0, 1], "Radius": 1.0}}
        for what, crack in outside.items():
            with self.subTest(what):
                self.write_case({"Pre-Cracks/slit": crack})
                self.assert_refused("/Pre-Cracks/slit: found a crack", "it is outside the body", ranks=[1])

    def test_seeds_outside_the_body(self):
        self.assert_refused("/Morphing/Seeds/tip: found a zone around", "it is outside the body",
                            options=settings(f"{TIP}/Start={{4, 3, 40}}", f"{TIP}/End={{4, 3, 70}}"), ranks=[2])
        for seed in [{"Shape": "Sphere", "Center": [4, 30, 1], "Inner Radius": 3.0, "Outer Radius": 4.0},
                     {"Shape": "Box", "Lower Corner": [20, 0, 0], "Upper Corner": [24, 6, 3], "Rim": 1.0}]:
            self.write_case({"Morphing/Seeds": {"tip": seed}})
            self.assert_refused("/Morphing/Seeds/tip: found a zone around", ranks=[1])


class Numbers(Checked):
    def test_a_horizon_of_absurd_length(self):
        for horizon in ["1e200", "1e155", "21"]:
            self.assert_refused('/Peridynamics/Horizon: found', 'allowed is up to 100 times "Characteristic Length", which is 0.2',
                                options=settings(f"Peridynamics/Horizon={horizon}"))

    def test_a_horizon_longer_than_the_body(self):
        self.assert_refused("/Peridynamics/Horizon: found 18; allowed is up to 16.9706, the longest distance in the body",
                            options=settings("Peridynamics/Horizon=18"))

    def test_a_characteristic_length_of_nothing(self):
        self.assert_refused('which is 0.001', options=settings("Peridynamics/Characteristic Length=0.001"), ranks=[1])

    def test_numbers_that_give_none_together(self):
        for options in [settings("Material/Critical Stretch=1e200"), settings("Material/Critical Stretch=1e-200"),
                        settings("Peridynamics/Horizon=1e-99", "Peridynamics/Characteristic Length=1e-100", TIP + "/Shape=Automatic")]:
            run = self.check(*options)
            self.assertEqual(run.returncode, 2, run.stdout)
            self.assertNotIn("bug", run.stderr)

    def test_loads_that_are_too_large_for_any_number_end_in_order(self):
        for rate in ["1e308", "-1.7e308"]:
            run = self.run_case("--quiet", *settings(f"{DISPLACEMENTS}/pull up/Rate={rate}"), ranks=2)
            self.assertEqual(run.returncode, 3, run.stdout + run.stderr)
            self.assertIn("the forces are no finite numbers", run.stderr)

    def test_what_check_prints_is_finite(self):
        for options in [(), settings("Material/Young's Modulus=1e300"), settings("Material/Young's Modulus=1e-290"),
                        settings(f"{DISPLACEMENTS}/pull up/Rate=1e200"),
                        settings(f"{DISPLACEMENTS}/pull up/Rate=1e308"), settings(f"{DISPLACEMENTS}/pull up/Rate=0", f"{DISPLACEMENTS}/pull down/Rate=0")]:
            run = self.check(*options)
            self.assertNotRegex(run.stdout, r"(?i)\bnan\b|\binf\b", options)


class SolverLists(Checked):
    """Parameters that are handed on."""

    def test_names_that_the_libraries_do_not_know(self):
        self.assert_refused('/Solver/MueLu/aggregation: drop toll: MueLu knows no parameter of that name - did you mean "aggregation: drop tol"?',
                            '/Solver/Belos/Verbosty: Belos knows no parameter of that name - did you mean "Verbosity"?',
                            options=settings("Solver/MueLu/aggregation: drop toll=0.1", "Solver/Belos/Verbosty=1"))

    def test_values_of_another_type(self):
        self.assert_refused('/Solver/MueLu/max levels: found a value of type "double"; MueLu takes "int"',
                            options=settings("Solver/MueLu/max levels=2.5"), ranks=[1])
        self.assert_refused('/Solver/Belos/Use Single Reduction: found a value of type "string"; Belos takes "bool"',
                            options=settings("Solver/Belos/Use Single Reduction=yes"), ranks=[1])

    def test_values_on_which_they_crash_or_wait(self):
        self.assert_refused("/Solver/MueLu/xml parameter file: found a file; allowed are the parameters themselves",
                            options=settings("Solver/MueLu/xml parameter file=/etc/hostname"))
        for parameter in ["MueLu/max levels", "Belos/Block Size"]:
            for value in [0, -1]:
                self.assert_refused(f"/Solver/{parameter}: found {value}; allowed is 1 or more",
                                    options=settings(f"Solver/{parameter}={value}"), ranks=[1])
        for parameter in ["rap: triple product", "repartition: enable"]:
            self.assert_refused(f"/Solver/MueLu/{parameter}: found true; allowed is false", options=settings(f"Solver/MueLu/{parameter}=true"),
                                ranks=[1])
        self.assert_refused('/Solver/MueLu/aggregation: type: found "brick"', options=settings("Solver/MueLu/aggregation: type=brick"))

    def test_when_they_cannot_be_used_it_is_told_what_serves_instead(self):
        """Not known before a preconditioner is made of them."""
        for parameter in ["multigrid algorithm=foo", "cycle type=Z", "reuse: type=foo"]:
            self.assert_warned("/Solver: the usual multigrid failed (the preconditioner could not be set up: ",
                               options=settings("Solver/MueLu/coarse: max size=20", f"Solver/MueLu/{parameter}"))

    def test_names_that_they_know(self):
        options = settings("Solver/MueLu/max levels=3", "Solver/MueLu/smoother: params/relaxation: sweeps=2", "Solver/MueLu/sa: damping factor=1.2",
                           "Solver/MueLu/level 1/smoother: type=RELAXATION", "Solver/Belos/Verbosity=0", "Solver/Belos/Use Single Reduction=false")
        self.assertEqual(self.check(*options).returncode, 0)


class Parts(Checked):
    """Two bodies of 4 x 4 elements."""

    CASE = changed(CASE, {"Mesh/File": "plate.msh", "Pre-Cracks": None, "Peridynamics/Horizon": 1.5, "Peridynamics/Characteristic Length": 0.2,
                          "Morphing/Seeds": {}, "Material/Critical Stretch": None,
                          DISPLACEMENTS: held("left", "x", "y") | held("right", "y") | moved("right", "x"), "Loading/Increments": 1})

    def write_mesh(self, grids):
        (self.folder / "plate.msh").write_text(grids.text())

    def test_parts_that_touch_at_coincident_nodes(self):
        self.write_mesh(Grids().add(0, 0, 4, 4).add(4, 0, 4, 4))
        self.assert_warned("warning: ", "part 1 of 2 of the body (16 elements, from (0, 0) to (4, 4)) and part 2 of 2 of the body (16 "
                           "elements, from (4, 0) to (8, 4)) touch at 10 nodes, the first at (4, 0), but share none", "Coherence")

    def test_parts_whose_nodes_do_not_meet(self):
        self.write_mesh(Grids().add(0, 0, 4, 4).add(4, 0.5, 4, 3))
        self.assert_warned("touch at 7 nodes, the first at")

    def test_parts_that_overlap(self):
        self.write_mesh(Grids().add(0, 0, 4, 4).add(2.5, 0.5, 4, 3))
        self.assert_warned("overlap at")

    def test_a_part_within_another(self):
        self.write_mesh(Grids().add(0, 0, 8, 8).add(2.25, 2.25, 3, 3))
        self.assert_warned("overlap at")

    def test_a_seam_within_one_part(self):
        seam = Grids().add(0, 0, 4, 4).add(4, 0, 4, 4, shared={(4, 0), (4, 1), (4, 4)})
        self.write_mesh(seam)
        self.assert_warned("2 pairs of nodes lie at the same place, the first at (4, 2): the body is open there")

    def test_a_seam_that_is_closed_at_both_ends(self):
        self.write_mesh(Grids().add(0, 0, 4, 4).add(4, 0, 4, 4, shared={(4, 0), (4, 4)}))
        self.assert_warned("3 pairs of nodes lie at the same place, the first at (4, 1): the body is open there")

    def test_seams_that_cross(self):
        grids = Grids().add(0, 0, 2, 2)
        for x, y in [(2, 0), (0, 2), (2, 2)]:
            grids.add(x, y, 2, 2, shared={(2, 0), (2, 4), (0, 2), (4, 2)})
        self.write_mesh(grids)
        self.assert_warned("lie at the same place", "the body is open there")

    def test_parts_that_are_apart_or_connected_are_none_of_these(self):
        for grids in [Grids().add(0, 0, 4, 4).add(4.5, 0, 4, 4),
                      Grids().add(0, 0, 4, 4).add(4, 0, 4, 4, shared={(4, j) for j in range(5)})]:
            self.write_mesh(grids)
            self.assert_not_warned("warning")

    def test_a_pre_crack_is_no_seam(self):
        (self.folder / "plate.msh").write_text(Plate.MESH)
        self.case.unlink()
        self.CASE = CASE
        self.write_case()
        self.assert_not_warned("warning")

    def test_a_hinge_that_is_held(self):
        self.write_mesh(Grids().add(0, 0, 4, 4).add(4, 4, 4, 4, shared={(4, 4)}))
        self.assert_warned("the body has hinges: at 1 node, the first at (4, 4), elements meet that share no edge")

    def test_a_hinge_on_which_a_part_turns(self):
        self.write_mesh(Grids().add(0, 0, 4, 4).add(4, 4, 4, 4, shared={(4, 4)}))
        self.write_case({DISPLACEMENTS: held("left", "x", "y"), "Boundary Conditions/Tractions/t": {"Group": "right", "Rate": [0.1, 0]}})
        self.assert_refused("/Boundary Conditions/Displacements: part 2 of 2 of the body (16 elements, from (4, 4) to (8, 8)) can move: "
                            "it hangs on the rest by a hinge, the node at (4, 4)")

    def test_two_hinges_hold_a_part(self):
        grids = Grids().add(0, 0, 4, 4).add(0, 4, 1, 1, shared={(0, 4), (1, 4)}).add(3, 4, 1, 1, shared={(3, 4), (4, 4)})
        grids.add(1, 5, 2, 2, shared={(1, 5), (3, 5)})
        self.write_mesh(grids)
        self.write_case({DISPLACEMENTS: held("left", "x", "y")})
        self.assert_warned("the body has hinges: at 2 nodes, the first at (1, 5)")

    def test_a_chain_of_hinges(self):
        grids = Grids().add(0, 0, 2, 2).add(2, 2, 2, 2, shared={(2, 2)}).add(4, 4, 2, 2, shared={(4, 4)})
        self.write_mesh(grids)
        self.assert_warned("the body has hinges: at 2 nodes")  # both ends are held
        self.write_case({DISPLACEMENTS: held("left", "x", "y")})
        self.assert_refused("part 2 of 3 of the body", "part 3 of 3 of the body", ranks=[1])


class PartsIn3D(Checked):
    """Two blocks of 3 x 2 x 2 elements."""

    CASE = changed(PlacesIn3D.CASE, {"Pre-Cracks": None, "Morphing/Seeds": {}, "Material/Critical Stretch": None, "Loading/Increments": 1,
                                     "Peridynamics/Horizon": 1.5, DISPLACEMENTS: held("left", "x", "y", "z")
                                     | held("right", "y", "z") | moved("right", "x")})
    FIRST = (0, 0, 0), (3, 2, 2)

    def write_mesh(self, low, shared=()):
        (self.folder / "plate.msh").write_text(blocks(self.FIRST, (low, (3, 2, 2)), shared=shared))

    def test_parts_that_touch_or_overlap(self):
        for low, what in [((3, 0, 0), "touch at 18 nodes, the first at (3, 0, 0), but share none"), ((3, 0.5, 0.5), "touch at"),
                          ((1.5, 0.5, 0.5), "overlap at"), ((3, 2, 2), "touch at 2 nodes, the first at (3, 2, 2), but share none")]:
            with self.subTest(low=low):
                self.write_mesh(low)
                self.assert_warned(what)

    def test_hinges(self):
        free = {DISPLACEMENTS: held("left", "x", "y", "z")}
        node, edge = {(3, 2, 2)}, {(3, 2, 0), (3, 2, 1), (3, 2, 2)}
        for low, shared, what in [((3, 2, 2), node, "the node at (3, 2, 2)"), ((3, 2, 0), edge, "the node at (3, 2, 0)")]:
            with self.subTest(shared=shared):
                self.write_case()
                self.write_mesh(low, shared)
                self.assert_warned("the body has hinges: ")
                self.write_case(free)
                self.assert_refused("can move: it hangs on the rest by a hinge", what, ranks=[1])

    def test_parts_that_are_connected_are_none_of_these(self):
        self.write_mesh((3, 0, 0), {(3, j, k) for j in range(3) for k in range(3)})
        self.assert_not_warned("warning")


class Supports(Checked):
    """The plate's right edge, held across it only."""

    SYMMETRY = {DISPLACEMENTS: held("right", "x") | held("lower", "y") | moved("upper", "y"), f"{TIP}/Center": [10, 6]}

    def test_a_plane_of_symmetry_in_a_zone(self):
        self.write_case(self.SYMMETRY)
        self.assert_warned(f"warning: {self.case}: /Boundary Conditions/Displacements/right x: holds a straight side of the body across it, "
                           "inside a peridynamic zone (from (12, 2) to (12, 10)). If it is a plane of symmetry, the bonds across it are missing")

    def test_as_a_plane_of_symmetry_it_is_none(self):
        self.write_case({DISPLACEMENTS: held("lower", "y") | moved("upper", "y"), f"{TIP}/Center": [10, 6],
                         "Boundary Conditions/Symmetry Planes/middle/Group": "right"})
        self.assert_not_warned("symmetry")

    def test_what_is_no_plane_of_symmetry(self):
        planes = "Boundary Conditions/Symmetry Planes"
        for changes, message in [
                ({f"{planes}/middle/Group": "right", DISPLACEMENTS: held("right", "x")},
                 "/Boundary Conditions/Symmetry Planes/middle: has the node at (12, 0), and others perhaps, in common with "
                 "/Boundary Conditions/Displacements/right x, which moves it across the plane"),
                ({f"{planes}/middle/Group": "right", f"{planes}/again/Group": "right"}, "again: is parallel to middle; allowed is one across each axis"),
                ({f"{planes}/middle/Group": "right", "Peridynamics/Crack Faces": "Contact"},
                 '/Peridynamics/Crack Faces: found "Contact"; with /Boundary Conditions/Symmetry Planes allowed is "Free"'),
                ({f"{planes}/middle/Group": "lower"}, 'has no group of sides called "lower"')]:
            with self.subTest(message=message):
                self.write_case({DISPLACEMENTS: held("lower", "y") | moved("upper", "y")} | changes)
                self.assert_refused(message)

    def test_one_away_from_zones_and_a_clamp_are_none(self):
        self.write_case(self.SYMMETRY | {f"{TIP}/Center": [5, 6]})
        self.assert_not_warned("symmetry")
        self.write_case({f"{TIP}/Center": [10, 6]})
        self.assert_not_warned("symmetry")
        self.write_case(self.SYMMETRY | {"Material/Critical Stretch": None})  # nothing breaks
        self.assert_not_warned("symmetry")


class Plausibility(Checked):
    def test_check_tells_strength_and_first_break(self):
        run = self.check(ranks=2)
        self.assertIn("strength         E s_crit = 50: ", run.stdout)
        self.assertIn("strength         in uniaxial compression 150, 3 times that in tension: bonds across it", run.stdout)
        self.assertIn("first break      at load 2.", run.stdout)
        self.assertIn("in increment 3 of 3, reaction", run.stdout)
        self.assertEqual(self.run_case("--quiet").returncode, 0)
        self.assertEqual([float(row["broken_bonds"]) > 0 for row in self.history()], [False, False, True])

    def test_the_compressive_strength_is_told_and_one_below_that_of_the_stretch_is_refused(self):
        told = self.check("--set", "Material/Compressive Strength=500").stdout
        self.assertIn("strength         in uniaxial compression 500, 10 times that in tension: of the stretch across it only", told)
        self.assertIn("strength         in uniaxial compression bonds across it soften from", self.check_soft())
        self.write_case({"Material/Poisson's Ratio": -0.1})
        self.assertIn("strength         no uniaxial compression breaks it: with nu = -0.1", self.check().stdout)
        self.write_case({"Material/Compressive Strength": 100.0})
        for ranks in [1, 2]:
            run = self.check(ranks=ranks)
            self.assertEqual(run.returncode, 2, run.stdout)
            self.assertIn("plate.xml: /Material/Compressive Strength: found 100; allowed is 150 or more", run.stderr)

    def check_soft(self):
        self.write_case(self.SOFT)
        return self.check().stdout

    def test_loads_that_break_nothing_or_all_at_once(self):
        slow = settings(*[f"{DISPLACEMENTS}/pull {way}/Rate={rate}" for way, rate in [("up", 1e-6), ("down", -1e-6)]])
        self.assertIn("/Loading/Increments: nothing breaks in 3 increments", self.check(*slow).stdout)
        self.assertIn("Are loads in the units of material and mesh?", self.check(*slow).stdout)
        fast = settings(*[f"{DISPLACEMENTS}/pull {way}/Rate={rate}" for way, rate in [("up", 1e3), ("down", -1e3)]])
        self.assertRegex(self.check(*fast).stdout, r"the first increment is already [\d.e+]+ times the load at which the first bond breaks")

    def test_a_stretch_that_no_brittle_solid_has(self):
        for energy, what in [("1e6", "The model is one of small strains"), ("1e-16", "Brittle solids break at")]:
            self.write_case({"Material/Critical Stretch": None, "Material/Fracture Energy": float(energy)})
            run = self.check("--quiet")
            self.assertIn("/Material/Fracture Energy: bonds break at a stretch of", run.stdout)
            self.assertIn(what, run.stdout)

    SOFT = {"Material/Critical Stretch": None, "Material/Bond Law": "Bilinear", "Material/Tensile Strength": 15.0,
            "Material/Fracture Energy": 2.0}

    def test_bonds_that_soften_too_slowly_for_their_elements(self):
        self.write_case(self.SOFT)
        run = self.check()
        self.assertIn("/Peridynamics/Characteristic Length: 0.2 is 0.20 of an element; of bonds that soften it is a length of the "
                      "material", run.stdout)
        self.assertIn("length           l = 0.2 is one of the material: keep it, and the horizon, on other meshes", run.stdout)
        self.assertIn("first softening  at load ", run.stdout)
        self.assertNotIn("a length of the material", self.check(*settings("Peridynamics/Characteristic Length=0.4")).stdout)

    def test_the_brittleness_number(self):
        for size, what in [(3.0, "0.9, strength and fracture energy decide together"),
                           (300.0, "0.009, strength alone decides"),
                           (0.25, "11, it breaks like a brittle one")]:
            self.write_case({**self.SOFT, "Material/Fracture Energy": size})  # E G_f / f_t^2 = 1000 G_f / 225, the plate is 12
            self.assertIn(f"brittleness number {what}", self.check().stdout)

    def test_a_fracture_energy_below_that_of_brittle_bonds(self):
        self.write_case({**self.SOFT, "Material/Fracture Energy": 0.01})
        run = self.check()
        self.assertEqual(run.returncode, 2, run.stdout)
        self.assertRegex(run.stderr, r'plate.xml: /Material/Fracture Energy: found 0.01; with "Tensile Strength" = 15 and a '
                                     r'characteristic length of 0.2 allowed is above 0\.\d+, or a length below 0\.\d+ with a '
                                     r'horizon in proportion, or a strength below \d')

    def test_run_gives_the_advice_of_check(self):
        advice = [sorted(line for line in run.stdout.splitlines() if line.startswith("advice"))
                  for run in [self.check(), self.run_case()]]
        self.assertEqual(*advice)
        self.assertGreater(len(advice[0]), 2)

    def test_automatic_seeds_that_cover_everything(self):
        self.write_case({"Morphing/Seeds": {"where": {"Shape": "Automatic", "Inner Radius": 14.0, "Outer Radius": 20.0}}})
        self.assert_warned("/Morphing/Seeds: automatic seeds cover 100 % of the elements")
        self.assert_not_warned("automatic seeds cover", *settings("Morphing/Seeds/where/Inner Radius=4", "Morphing/Seeds/where/Outer Radius=8"))


if __name__ == "__main__":
    unittest.main()
