"""tools/report and tools/plot-history on a finished run; and what they share: events, log, parameters.

    report.py PERIMORPH MPIEXEC RUNS
"""

import html.parser
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from fixture import PERIMORPH, TOOLS, InFolder

import case_file
import runs

RUN = pathlib.Path(sys.argv.pop(1)) / "small_plate/out"


class Page(html.parser.HTMLParser):
    """Its text, tags and whatever its tags refer to."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.references, self.text = [], [], ""
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        self.references += [value for name, value in attributes if name in ("src", "href", "xlink:href", "data")]

    def handle_data(self, data):
        self.text += data


class Report(InFolder):
    def report(self, run, *options):
        command = [TOOLS / "report", run, "-o", self.folder / "report.html", *options]
        return subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=100)

    def page(self, *options, run=RUN):
        made = self.report(run, *options)
        self.assertEqual(made.returncode, 0, made.stderr)
        return Page((self.folder / "report.html").read_text())

    def assert_stands_alone(self, page):
        for reference in page.references:
            self.assertTrue(reference.startswith(("data:image/png;base64,", "#")), reference[:80])
        self.assertNotIn("script", page.tags)

    def test_tells_what_was_run_and_what_happened(self):
        page = self.page("--no-pictures")

        self.assert_stands_alone(page)
        self.assertEqual(page.tags.count("svg"), 2)
        events = runs.events_of(runs.History(str(RUN)), "reaction_top_y")
        for piece in ["Plate with an edge crack, pulled apart", "perimorph 0.", "400 elements", "on 1 rank",
                      "/Peridynamics/Horizon", "/Solver/Tolerance", "preconditioner", "first break", "jump loss",
                      f"{len(events)}. Increment"]:
            self.assertIn(piece, page.text)
        self.assertRegex(page.text, r"Warnings\s*None\.")

    def test_has_pictures_of_each_event(self):
        self.assertEqual(self.page().tags.count("img"), 3 * len(runs.events_of(runs.History(str(RUN)), "reaction_top_y")))

    def test_warns_of_a_run_that_was_ended(self):
        run = self.folder / "run"
        shutil.copytree(RUN, run)
        lines = (run / "history.csv").read_text().splitlines(keepends=True)
        (run / "history.csv").write_text("".join(lines[:3]))
        (run / "run.log").write_text("".join((RUN / "run.log").read_text().partition("  step ")[:1]))

        page = self.page("--no-pictures", run=run)

        self.assertIn("has reached increment 2 of 10", page.text)
        self.assertIn("No bond has broken.", page.text)
        self.assertIn("The run is not over.", page.text)

    def test_tells_the_warnings_of_the_run(self):
        """Pressed together, the faces of the crack overlap."""
        pressed = self.folder / "pressed"
        subprocess.run([PERIMORPH, "run", RUN.parent / "small_plate.xml", "--output", pressed, "--quiet",
                        "--set", "Loading/Increments=1", "--set", "Boundary Conditions/Displacements/pull/Rate=-0.1"],
                       check=True, capture_output=True, timeout=60)
        page = self.page("--no-pictures", run=pressed)
        self.assertRegex(page.text, r"Warnings\s*warning: crack faces overlap, by [\d.e-]+ at \(")

    def test_tells_of_a_run_that_failed_before_its_first_increment(self):
        failed = self.folder / "failed"
        run = subprocess.run([PERIMORPH, "run", RUN.parent / "small_plate.xml", "--output", failed, "--quiet",
                              "--set", "Solver/Maximum Iterations=1", "--set", "Solver/Tolerance=1e-16"],
                             capture_output=True, text=True, timeout=60)
        self.assertEqual(run.returncode, 3, run.stderr)
        page = self.page(run=failed)
        self.assert_stands_alone(page)
        self.assertRegex(page.text, r"The run ended with an error: \S.*")
        for piece in ["Plate with an edge crack, pulled apart", "400 elements", "/Peridynamics/Horizon", "preconditioner"]:
            self.assertIn(piece, page.text)
        self.assertNotIn("svg", page.tags)

    def test_tells_of_numbers_that_are_not_finite(self):
        run = self.folder / "run"
        shutil.copytree(RUN, run)
        lines = (run / "history.csv").read_text().splitlines()
        for row, value in [(5, "nan"), (7, "-inf")]:
            cells = lines[row].split(",")
            cells[lines[0].split(",").index("reaction_top_y")] = value
            lines[row] = ",".join(cells)
        (run / "history.csv").write_text("\n".join([*lines, ""]))
        self.assertIn("reaction_top_y is not finite from row 5 of history.csv on", self.page("--no-pictures", run=run).text)

    def test_what_is_no_run_is_refused(self):
        for run, piece in [(self.folder / "absent", "no such directory"), (self.folder, "history.csv")]:
            made = self.report(run)
            self.assertEqual(made.returncode, 2)
            self.assertIn(piece, made.stderr)

    def test_the_curve_alone_is_a_picture(self):
        picture = self.folder / "curve.png"
        made = subprocess.run([TOOLS / "plot-history", RUN, "-o", picture], capture_output=True, text=True, timeout=60)
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertEqual(picture.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")


class Curves(InFolder):
    """A top that is pulled in y, and a left side, held in x, that shares its upper corner."""

    ROWS = ["increment,load_factor,broken_bonds,reaction_top_y,displacement_top_y,reaction_left_y,displacement_left_y",
            "1,1,0,10,0.1,2,0.05", "2,2,0,20,0.2,4,0.1"]

    def curves(self, *groups):
        """With the given groups moved."""
        (self.folder / "history.csv").write_text("\n".join([*self.ROWS, ""]))
        case = {"Boundary Conditions": {"Displacements": {"hold": {"Group": "left", "Component": "x"},
                                                          **{group: {"Group": group, "Component": "y", "Rate": 0.1} for group in groups}}}}
        case_file.write_case(self.folder / "resolved.xml", case)
        return runs.curves_of(runs.History(str(self.folder)))

    def test_are_over_the_measure_where_increments_prescribe_one(self):
        (self.folder / "history.csv").write_text("increment,load_factor,broken_bonds,measure,reaction_top_y\n1,7,0,0.1,10\n")
        history = runs.History(str(self.folder))
        self.assertEqual(runs.curves_of(history), [("measure", "reaction_top_y")])
        self.assertEqual(runs.curves_of(history, y=["load_factor"]), [("measure", "load_factor")])
        self.assertEqual(runs.curves_of(history, x="increment", y=["load_factor"]), [("increment", "load_factor")])

    def test_are_those_of_groups_that_are_moved(self):
        self.assertEqual(self.curves("top"), [("displacement_top_y", "reaction_top_y")])
        self.assertEqual(len(self.curves("top", "left")), 2)

    def test_of_a_body_that_only_tractions_load_are_over_the_load(self):
        self.assertEqual(self.curves(), [("load_factor", "reaction_top_y"), ("load_factor", "reaction_left_y")])

    def test_of_a_history_alone_are_all_that_move(self):
        self.curves()
        (self.folder / "resolved.xml").unlink()
        self.assertEqual(len(runs.curves_of(runs.History(str(self.folder)))), 2)


class Events(InFolder):
    def history(self, forces, broken):
        rows = [f"{n},{count},{force}" for n, (force, count) in enumerate(zip(forces, broken), start=1)]
        file = self.folder / "history.csv"
        file.write_text("\n".join(["increment,broken_bonds,reaction_top_y", *rows, ""]))
        return runs.History(str(file))

    def test_are_the_first_break_large_drops_and_the_end(self):
        history = self.history([-1, -2, -3, -2.9, -4, -1, -1.5], [0, 0, 3, 4, 5, 90, 90])
        found = runs.events_of(history, "reaction_top_y")
        self.assertEqual([event.row for event in found], [2, 5, 6])
        self.assertEqual([event.text for event in found], ["first break", "drop from 4 to 1", "last increment"])

    def test_that_fall_together_are_one(self):
        found = runs.events_of(self.history([1, 2, 0.1], [0, 0, 50]), "reaction_top_y")
        self.assertEqual([(event.row, event.text) for event in found], [(2, "first break, drop from 2 to 0.1")])

    def test_do_not_come_from_numbers_that_are_none(self):
        found = runs.events_of(self.history([1, "nan", 2, "inf", 0.1], [0, 0, 0, 0, 0]), "reaction_top_y")
        self.assertEqual([event.text for event in found][-1], "last increment")


class LogFile(unittest.TestCase):
    def test_of_a_finished_run_gives_ranks_and_profile(self):
        log = runs.Log(str(RUN))
        self.assertEqual((log.ranks, log.is_over, log.error, log.warnings), (1, True, "", []))
        self.assertEqual([row[0] for row in log.profile][-1], "total")
        self.assertTrue(all(re.fullmatch(r"\d+\.\d+", row[1]) for row in log.profile), log.profile)

    def test_of_a_run_that_failed_gives_the_reason(self):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "run.log").write_text(
                "Plate\nmesh  p.msh: 4 elements, 9 nodes on 12 ranks\n\nincrement 3: more than 1 solves\n"
                "phase     seconds    share     calls\nread        1.000   100.0%         1\n")
            log = runs.Log(folder)
        self.assertEqual((log.ranks, log.error), (12, "increment 3: more than 1 solves"))


if __name__ == "__main__":
    unittest.main()
