"""tools/preview: what the program says of a case before its first increment, where symbols are drawn, and the page in a browser.

    preview.py PERIMORPH MPIEXEC RUNS
"""

import http.server
import pathlib
import re
import subprocess
import sys
import threading
import unittest
import urllib.error
import urllib.request

import matplotlib.colors
import matplotlib.patches
import numpy
from PIL import Image

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from fixture import N, TOOLS, Plate, page_in_browser

import case_tables
from case_data import CaseData
from case_drawing import CRACK, MEASURED, Drawing, draw_body_and_conditions
from case_look import Look
from case_sheet import Section, Tables, new_figure, scale_of
from case_symbols import FORCE, MOVED, SUPPORT

RUNS = pathlib.Path(sys.argv.pop(1))

STAGES = {
    "Material/Density": 2.0,
    "Boundary Conditions/Pressures/press": {"Group": "right", "Rate": 3.0, "Constant": 0.5},
    "Boundary Conditions/Displacements/hold x": None,
    "Boundary Conditions/Displacements/hold upper x": {"Group": "upper", "Component": "x"},
    "Boundary Conditions/Displacements/hold lower x": {"Group": "lower", "Component": "x"},
    "Boundary Conditions/Displacements/pull down/Rate": 0.0,
    "Boundary Conditions/Self-Weight/Rate": [0.0, -9.81],
    "Loading/Increments": 11,
    "Loading/Steps": {
        "own weight": {"Increments": 2, "Conditions": ["Self-Weight"], "Values": [1.0]},
        "pull": {"Increments": 5, "Conditions": ["pull up", "press"], "Values": [4.0, 2.0]},
        "let go": {"Increments": 8, "Conditions": ["pull up"], "Values": [0.0]},
    },
}
CYCLES = {"Loading": {"Increments": 18, "Steps": {
    "shake": {"Increments": 4, "Cycles": 3, "Conditions": ["pull up", "pull down"], "Values": [1.0, -2.0]},
    "rest": {"Increments": 2, "Cycles": 3, "Conditions": ["pull up"], "Values": [0.0]}}}}
MEASURE = {
    "Boundary Conditions/Tractions/pull right": {"Group": "right", "Rate": [2.0, -1.0], "Constant": [0.0, 0.5]},
    "Boundary Conditions/Displacements": {"hold x": {"Group": "lower", "Component": "x"}, "hold y": {"Group": "lower", "Component": "y"},
                                          "hold": {"Group": "upper", "Component": "x"}},
    "Loading": {"Increments": 10, "Control": "Measure", "Measure": {
        "Group": "right", "Other Point": [0.0, 3.0], "Direction": [1.0, 0.0], "Rate": 0.01}},
}


class Preview(Plate):
    def check(self, *options, folder="preview", ranks=1):
        return self.perimorph("check", self.case, "--preview", self.folder / folder, *options, ranks=ranks)

    def data(self, changes={}, ranks=1):
        self.write_case(changes)
        outcome = self.check(ranks=ranks)
        self.assertEqual(outcome.returncode, 0, outcome.stderr)
        data = CaseData(self.folder / "preview")
        self.addCleanup(data.file.close)
        return data

    def block(self):
        """The small block, in three dimensions."""
        self.case = RUNS / "small_block/small_block.xml"
        self.assertEqual(self.check().returncode, 0)
        data = CaseData(self.folder / "preview")
        self.addCleanup(data.file.close)
        return data


class WhatTheProgramSays(Preview):
    def test_the_values_of_conditions_before_the_first_increment_and_at_the_end_of_each_stage(self):
        data = self.data(STAGES)
        self.assertEqual(data.table["Stages"], {"own weight": {"First Increment": 1, "Last Increment": 2},
                                                "pull": {"First Increment": 3, "Last Increment": 7},
                                                "let go": {"First Increment": 8, "Last Increment": 11}})
        values = {condition.name: condition.values.tolist() for condition in data.conditions}
        self.assertEqual(values["hold y"], [[0], [0], [0], [0]])
        self.assertEqual(values["press"], [[0.5], [0.5], [6.5], [6.5]])
        self.assertEqual(values["Self-Weight"], [[0, 0], [0, -9.81], [0, -9.81], [0, -9.81]])
        numpy.testing.assert_allclose(values["pull up"], [[0], [0], [0.8], [0.4]], rtol=1e-14)  # half of the last stage is run

    def test_temperatures_have_a_profile_and_no_direction(self):
        data = self.data({"Material/Thermal Expansion": 1e-5, "Boundary Conditions/Temperatures": {
            "cold": {"Rate": -20.0, "Blocks": ["body"]},
            "upper side": {"Constant": 5.0, "Direction": [0.0, 1.0], "Positions": [0.0, 12.0], "Factors": [-0.5, 1.0]}}})
        rows = {row[0]: row[1:] for row in case_tables.conditions(data)}
        self.assertEqual(rows["cold"], ["body", "ΔT", "−60"])
        self.assertEqual(rows["upper side"], ["all of the body, along (0, 1) times −0.5 at 0, 1 at 12", "ΔT", "5"])
        self.assertEqual(case_tables.materials(data)[0], ["", "E", "ν", "α_T", "l", "s_crit", "G_c", "blocks"])
        labels = [text.get_text() for text in Drawn(data, 0).axes.texts]
        self.assertIn("cold\n$ΔT$ = −60\nbody", labels)

    def test_without_stages_values_are_those_of_the_last_increment(self):
        data = self.data()
        self.assertEqual(data.stages, ["run"])
        numpy.testing.assert_allclose({c.name: c.values[1] for c in data.conditions}["pull up"], 0.6, rtol=1e-14)

    def test_cycles_that_end_where_they_begin_say_how_far_they_go(self):
        data = self.data(CYCLES)
        self.assertEqual([stage["Last Increment"] for stage in data.table["Stages"].values()], [12, 18])
        rows = {row[0]: row[1:] for row in case_tables.conditions(data)}
        self.assertEqual(rows["pull up"], ["upper", "u_y", "0 (up to 0.2)", "0"])
        self.assertEqual(rows["pull down"], ["lower", "u_y", "0 (up to 0.4)", "0"])
        pulled = Drawn(data, 0).arrows(MOVED)
        self.assertTrue((pulled[:, 1, 1] > pulled[:, 0, 1]).all())  # where they go at most, both up
        self.assertEqual(len(Drawn(data, 1).arrows(MOVED)), 0)

    def test_what_a_stage_releases_is_not_there_any_more(self):
        data = self.data({**STAGES, "Loading/Steps/let go/Released": ["press", "hold upper x"]})
        rows = {row[0]: row[1:] for row in case_tables.conditions(data)}
        self.assertEqual(rows["press"], ["right", "p", "0.5", "6.5", "released"])
        self.assertEqual(rows["hold upper x"], ["upper", "u_x", "0", "0", "released"])
        last = Drawn(data, 2)
        self.assertEqual(len(last.arrows(FORCE)), 0)
        self.assertIn("upper\n$u_{y}$ = 0.4", last.labels())

    def test_a_sheet_has_the_values_of_its_own_stage_where_there_are_many(self):
        steps = {f"stage {k}": {"Increments": 1, "Conditions": ["pull up"], "Values": [float(k)]} for k in range(1, 8)}
        data = self.data({"Loading": {"Increments": 7, "Steps": steps}, "Boundary Conditions/Displacements/pull down/Rate": 0.0})
        self.assertEqual(len(case_tables.conditions(data)[0]), 3 + 7)
        rows = Tables(data, 4).tables["Conditions"]
        self.assertEqual(rows[0][3:], ["stage 5, to 5"])
        self.assertEqual([row[3:] for row in rows if row[0] == "pull up"], [["1"]])

    def test_a_measure_leaves_the_load_factor_open(self):
        data = self.data(MEASURE)
        rows = {row[0]: row[1:] for row in case_tables.conditions(data)}
        self.assertEqual(rows["pull right"], ["right", "t", "(0, 0.5) + (2, −1) λ"])
        self.assertEqual(rows["hold"], ["upper", "u_x", "0"])
        self.assertEqual(case_tables.measure(data)[0][1], "displacement of group right less (0, 3), along (1, 0)")
        self.assertIn("0.1 in increment 10", case_tables.measure(data)[1][1])

    def test_directions_and_rigid_groups(self):
        data = self.data({"Boundary Conditions/Rigid Groups/grip/Group": "right",
                          "Boundary Conditions/Displacements/turn": {"Group": "right", "Component": "rotation z", "Rate": 0.01},
                          "Boundary Conditions/Displacements/pull up": {"Group": "upper", "Direction": [3.0, 4.0], "Rate": 0.1}})
        rows = {row[0]: row[1:3] for row in case_tables.conditions(data)}
        self.assertEqual((rows["turn"], rows["pull up"]), (["right", "φ_z"], ["upper", "u_d"]))
        self.assertIn("along (0.6, 0.8)", case_tables.conditions(data)[-1][-1] + case_tables.conditions(data)[-2][-1])
        drawn = Drawn(data)
        self.assertIn("right, a rigid body", "\n".join(drawn.labels()))
        directions = [(tip - tail) / numpy.linalg.norm(tip - tail) for tail, tip in drawn.arrows(MOVED)]
        self.assertTrue(any(numpy.allclose(direction, [0.6, 0.8], atol=1e-9) for direction in directions))

    def test_planes_of_symmetry(self):
        data = self.data({"Boundary Conditions/Symmetry Planes/middle/Group": "right",
                          "Boundary Conditions/Displacements/hold x": None})
        rows = {row[0]: row[1:3] for row in case_tables.conditions(data)}
        self.assertEqual(rows["middle (plane of symmetry)"], ["right", "u_x"])
        self.assertIn("right, a plane of symmetry", "\n".join(Drawn(data).labels()))

    def test_body_materials_zones_and_cracks(self):
        data = self.data()
        self.assertEqual([corner.tolist() for corner in data.box], [[0, 0], [N, N]])
        self.assertEqual(sum(data.class_counts().values()), N * N)
        self.assertGreater(data.class_counts()["PD"] + data.class_counts()["DGFE"], 0)
        near = numpy.linalg.norm(data.middles() - [5, 6], axis=1)
        alpha = data.alpha_of_elements()
        self.assertEqual((alpha[near < 2.5].min(), alpha[near > 5].max()), (1, 0))
        self.assertEqual(list(data.table["Materials"]["body"])[:2], ["Young's Modulus", "Poisson's Ratio"])
        sizes = dict(case_tables.sizes(data))
        self.assertEqual(sizes["body"], "12 x 12, plane stress")
        self.assertEqual((sizes["crack slit"], sizes["horizon"]), ("5 long", "2 = 2 elements"))

    def test_groups_have_places_and_outward_normals_also_where_elements_have_parted(self):
        data = self.data({"Morphing/Discontinuous Elements": "Whole Zone"})
        self.assertGreater(len(data.places), (N + 1) ** 2 + 4)
        self.assertEqual(len(data.boundary[0]), 4 * N)  # and not the sides of each discontinuous element
        places, normals = data.where("right")
        self.assertEqual((set(places[:, 0]), sorted(places[:, 1])), ({N}, [k + 0.5 for k in range(N)]))
        numpy.testing.assert_allclose(normals, numpy.tile([1, 0], (N, 1)), atol=1e-12)
        numpy.testing.assert_allclose(data.where("upper")[1], [[-0.5**0.5, 0.5**0.5]], atol=1e-12)

    def test_it_is_the_same_on_two_ranks(self):
        one = self.data(STAGES)
        table = (self.folder / "preview/preview.xml").read_text()
        alpha = dict(zip(one.file.element_numbers(), one.alpha_of_elements()))
        two = self.data(STAGES, ranks=2)
        self.assertEqual((self.folder / "preview/preview.xml").read_text(), table)
        self.assertEqual(dict(zip(two.file.element_numbers(), two.alpha_of_elements())), alpha)

    def test_a_folder_with_anything_else_in_it_is_refused(self):
        self.output.mkdir()
        (self.output / "plate.e").write_text("results")
        refused = self.check(folder="out")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("found other files in it; allowed is a folder that is new, empty or an earlier preview's", refused.stderr)
        self.assertEqual([file.name for file in self.output.iterdir()], ["plate.e"])

    def test_check_says_the_same_with_and_without_it(self):
        memory = lambda text: re.sub(r"[\d.]+ GB in all", "", text)
        self.assertEqual(memory(self.check().stdout), memory(self.perimorph("check", self.case).stdout))


class Drawn:
    """What is in the drawing of a body and its conditions."""

    def __init__(self, data, stage=0, without=(), turn=0.0):
        look = Look(data.n_dimensions, turn)
        self.drawing = Drawing(data, look, scale_of(data, look))
        self.drawing.open(new_figure(*self.drawing.size), 0, 0, "")
        draw_body_and_conditions(self.drawing, stage, without)
        self.axes = self.drawing.axes

    def arrows(self, colour):
        """(tail, tip) of all of a colour."""
        wanted = matplotlib.colors.to_rgb(colour)
        return numpy.array([[text.xyann, text.xy] for text in self.axes.texts
                            if getattr(text, "arrow_patch", None) and text.arrow_patch.get_edgecolor()[:3] == wanted])

    def supports(self):
        """(tip, middle of the base) of each triangle."""
        corners = [patch.get_xy() for patch in self.axes.patches if isinstance(patch, matplotlib.patches.Polygon)]
        return numpy.array([[xy[0], 0.5 * (xy[1] + xy[2])] for xy in corners])

    def labels(self):
        return [text.get_text() for text in self.axes.texts if text.get_text()]


class Symbols(Preview):
    def test_supports_stand_outside_the_body_at_their_groups(self):
        supports = Drawn(self.data()).supports()
        self.assertGreater(len(supports), 4)
        self.assertEqual(set(supports[:, 0, 0]), {N})  # of the group "right", held in both directions
        self.assertTrue((supports[:, 1, 0] > N).all())
        numpy.testing.assert_allclose(supports[:, 1, 1], supports[:, 0, 1], atol=1e-12)

    def test_arrows_point_where_the_body_is_moved(self):
        arrows = Drawn(self.data()).arrows(MOVED)
        tails = {tuple(tail): tip - tail for tail, tip in arrows}
        self.assertEqual(set(tails), {(0, 0), (0, N)})
        self.assertTrue(tails[0, 0][1] < 0 < tails[0, N][1])
        self.assertEqual((tails[0, 0][0], tails[0, N][0]), (0, 0))

    def test_labels_say_the_values_at_the_end_of_the_stage(self):
        data = self.data(STAGES)
        for stage, upper, right in [(0, "0", "0.5"), (1, "0.8", "6.5"), (2, "0.4", "6.5")]:
            labels = Drawn(data, stage).labels()
            self.assertIn(f"upper\n$u_{{y}}$ = {upper}\n$u_{{x}}$ = 0", labels)
            self.assertIn(f"right\n$u_{{y}}$ = 0\n$p$ = {right}", labels)
            self.assertIn("Self-Weight\n$g$ = (0, −9.81)", labels)
        self.assertIn("slit: 5 long", labels)

    def test_what_is_idle_or_turned_off_is_not_drawn(self):
        data = self.data(STAGES)
        self.assertEqual(len(Drawn(data, 0).arrows(MOVED)), 0)  # held until it is pulled
        pulled = Drawn(data, 1)
        self.assertEqual(pulled.arrows(MOVED)[:, 0].tolist(), [[0, N]])
        press = [c.name for c in data.conditions].index("press")
        self.assertGreater(len(pulled.arrows(FORCE)), 3)
        without = Drawn(data, 1, [press])
        self.assertEqual(len(without.arrows(FORCE)), 0)
        self.assertIn("right\n$u_{y}$ = 0", without.labels())

    def test_pressure_points_at_the_body_and_traction_where_it_pulls(self):
        pressed = Drawn(self.data(STAGES), 1).arrows(FORCE)
        self.assertEqual(set(pressed[:, 1, 0]), {N})
        self.assertTrue((pressed[:, 0, 0] > N).all())
        pulled = Drawn(self.data(MEASURE)).arrows(FORCE)
        self.assertEqual(set(pulled[:, 0, 0]), {N})
        direction = pulled[0, 1] - pulled[0, 0]
        numpy.testing.assert_allclose(direction / numpy.linalg.norm(direction), numpy.array([2, -0.5]) / 4.25**0.5, atol=1e-12)

    def test_a_measure_is_drawn_at_its_two_places(self):
        apart = Drawn(self.data(MEASURE)).arrows(MEASURED)
        numpy.testing.assert_allclose(apart[:, 0], [[N, 6], [0, 3]], atol=1e-12)
        self.assertTrue(apart[0, 1, 0] > N and apart[1, 1, 0] < 0)

    def test_labels_hide_neither_the_body_nor_symbols_nor_each_other(self):
        drawn = Drawn(self.data(STAGES), 1)
        renderer = drawn.axes.figure.canvas.get_renderer()
        boxes = {text.get_text(): text.get_window_extent(renderer) for text in drawn.axes.texts
                 if "\n" in text.get_text() and "Self-Weight" not in text.get_text()}
        self.assertEqual(len(boxes), 3)
        low, high = drawn.axes.transData.transform([[0, 0], [N, N]])
        for text, box in boxes.items():
            self.assertTrue(box.x1 < low[0] or box.x0 > high[0] or box.y1 < low[1] or box.y0 > high[1], text)
            for ends in [*drawn.arrows(MOVED), *drawn.arrows(FORCE)]:
                for point in drawn.axes.transData.transform(numpy.linspace(*ends, 20)):
                    self.assertFalse(box.contains(*point), text)

    def test_three_dimensions_are_seen_from_a_corner(self):
        data = self.block()
        drawn = Drawn(data)
        look = drawn.drawing.look
        places = data.places[data.nodes_of("top")]
        self.assertEqual(set(places[:, 1]), {8})
        pulled = drawn.arrows(MOVED)
        self.assertGreater(len(pulled), 3)
        for tail, tip in pulled:  # along y as it is seen
            self.assertLess(numpy.linalg.norm(look.flat(places) - tail, axis=1).min(), 1.5)
            self.assertAlmostEqual(numpy.cross(tip - tail, look.flat([0, 1, 0])), 0, places=10)
            self.assertGreater((tip - tail) @ look.flat([0, 1, 0]), 0)
        self.assertGreater(len(drawn.supports()), 3)
        opposite = Drawn(data, turn=180).arrows(MOVED)
        self.assertLess((opposite[0, 1] - opposite[0, 0]) @ (pulled[0, 1] - pulled[0, 0]), 0)
        self.assertIn("top\n$u_{y}$ = 0.012", [re.sub(r"0\.0\d+", "0.012", label) for label in drawn.labels()])

    def test_the_section_cuts_elements_and_cracks_in_three_dimensions(self):
        section = Section(self.block())
        self.assertEqual((section.axis, section.kept, section.place), (2, [0, 1], 2))
        elements = section.elements()
        self.assertGreater(len(elements), 9)
        area = lambda p: 0.5 * abs(p[:, 0] @ numpy.roll(p[:, 1], 1) - p[:, 1] @ numpy.roll(p[:, 0], 1))
        for corners, _ in elements:
            self.assertAlmostEqual(area(corners), 4)  # squares of size 2
        lengths = [numpy.linalg.norm(line[1] - line[0]) for line in section.cracks()]
        self.assertAlmostEqual(sum(lengths), 6)


def share_of(colour, file):
    """The share of a picture's pixels that are nearly of a colour."""
    pixels = numpy.asarray(Image.open(file).convert("RGB")).astype(int)
    wanted = 255 * numpy.array(matplotlib.colors.to_rgb(colour))
    return float((numpy.abs(pixels - wanted).max(axis=2) < 12).mean())


class Pictures(Preview):
    def preview(self, *options):
        return subprocess.run([TOOLS / "preview", self.case, *options], capture_output=True, text=True, timeout=250, cwd=self.folder)

    def test_one_for_each_stage(self):
        self.write_case(STAGES)
        made = self.preview()
        self.assertEqual(made.returncode, 0, made.stderr)
        names = [f"plate-preview-{stage}.png" for stage in ["own_weight", "pull", "let_go"]]
        self.assertEqual(made.stdout.splitlines(), names)
        blue = [share_of(MOVED, self.folder / name) for name in names]
        self.assertEqual(blue[0], 0)
        self.assertGreater(blue[1], 0)
        for colour in (FORCE, SUPPORT, CRACK):
            self.assertGreater(share_of(colour, self.folder / names[1]), 0)

    def test_the_stage_and_the_conditions_that_are_asked_for(self):
        self.write_case(STAGES)
        made = self.preview("--stage", "pull", "--without", "press", "-o", "p.png")
        self.assertEqual((made.returncode, made.stdout), (0, "p-pull.png\n"), made.stderr)
        self.assertEqual([file.name for file in self.folder.glob("*.png")], ["p-pull.png"])
        self.assertEqual(share_of(FORCE, self.folder / "p-pull.png"), 0)

    def test_mistakes_are_told_and_nothing_is_drawn(self):
        for changes, options, piece in [
            ({}, ["--stage", "pul"], '--stage pul: the case has none of this name; there are run'),
            ({}, ["--without", "pull upp"], 'did you mean "pull up"'),
            ({}, ["-o", "p.svg"], 'found the ending ".svg"; allowed is .png'),
            ({}, ["-o", "absent/p.png"], "no such directory"),
            ({}, ["--turn", "30"], "--turn: only for three-dimensional cases"),
            ({}, ["--serve", "--without", "pull up"], "--without: allowed only without --serve"),
            ({}, ["--port", "0"], "--port: allowed only with --serve"),
            ({"Boundary Conditions/Displacements/pull up/Group": "uper"}, [], 'plate.xml:'),
            ({"Boundary Conditions/Displacements/pull up/Group": "uper"}, [], 'did you mean "upper"'),
        ]:
            self.write_case(changes)
            refused = self.preview(*options)
            self.assertEqual(refused.returncode, 2, refused.stderr)
            self.assertIn(piece, refused.stderr)
            self.assertEqual(list(self.folder.glob("*.png")), [])

    def test_a_parameter_that_is_replaced_is_drawn_as_it_is_then(self):
        made = self.preview("--set", "Boundary Conditions/Displacements/pull up/Rate=0", "--set", "Boundary Conditions/Displacements/pull down/Rate=0",
                            "-o", "held.png")
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertEqual(share_of(MOVED, self.folder / "held.png"), 0)


# Clicks on the page as a person would, once it is there.
CLICKS = """<script>
const click = (selector, number) => document.querySelectorAll(selector)[number].click();
const wait = () => setTimeout(() => document.querySelectorAll("#conditions input").length ? start() : wait(), 50);
const start = () => { click("#conditions input[type=radio]", 1); click("#conditions input[type=checkbox]", 2); };
wait();
</script></body>"""


class Page(Preview):
    def serve(self):
        server = subprocess.Popen([TOOLS / "preview", self.case, "--serve", "--port", "0"], stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, text=True)
        self.addCleanup(server.stderr.close)
        self.addCleanup(server.stdout.close)
        self.addCleanup(server.wait)
        self.addCleanup(server.terminate)
        return re.match(r"http://[^/]*", server.stdout.readline()).group()

    def clicking(self, address):
        """A server that hands all on, but for clicks that it adds to the page; and what it was asked for."""
        asked = []

        class Handler(http.server.BaseHTTPRequestHandler):
            def do_GET(self):
                asked.append(self.path)
                if self.path == "/favicon.ico":
                    return self.send_error(404)
                with urllib.request.urlopen(address + self.path, timeout=60) as answer:
                    content = answer.read().replace(b"</body>", CLICKS.encode()) if self.path == "/" else answer.read()
                    self.send_response(200)
                    self.send_header("Content-Type", answer.headers["Content-Type"])
                    self.end_headers()
                    self.wfile.write(content)

            def log_message(self, *_):
                pass

        server = http.server.ThreadingHTTPServer(("localhost", 0), Handler)
        self.addCleanup(server.server_close)
        self.addCleanup(server.shutdown)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        return f"http://localhost:{server.server_port}", asked

    def test_a_browser_turns_stages_and_conditions_on_and_off(self):
        self.write_case(STAGES)
        address = self.serve()
        clicking, asked = self.clicking(address)
        page = page_in_browser(clicking, milliseconds=10000)
        self.assertIn("Before its first increment.", page)
        self.assertRegex(page, r'<div id="run" hidden')
        for piece in ["own weight, to 2", "let go, to 11", "−9.81", "5 long", "12 x 12, plane stress"]:
            self.assertIn(piece, page)
        self.assertEqual(len(re.findall(r'src="blob:http', page)), 3)
        self.assertIn("/picture/conditions?stage=0&without=&turn=0", asked)
        self.assertIn("/picture/conditions?stage=1&without=2&turn=0", asked)

    def test_gives_pictures_for_what_there_is_and_nothing_else(self):
        self.write_case(STAGES)
        address = self.serve()
        seen = {query: self.picture(address, query) for query in ["", "?stage=1", "?stage=1&without=0,1,2,3,4", "?turn=30"]}
        self.assertEqual(len({picture for picture in seen.values() if picture}), 3)  # in the plane nothing turns
        for query in ["?stage=3", "?stage=-1", "?without=99", "?stage=x", "?turn=nan", "?without=../.."]:
            self.assertIsNone(self.picture(address, query), query)

    def picture(self, address, query):
        try:
            with urllib.request.urlopen(f"{address}/picture/conditions{query}", timeout=60) as answer:
                return answer.read()
        except urllib.error.HTTPError as error:
            self.assertEqual(error.code, 404)


if __name__ == "__main__":
    unittest.main()
