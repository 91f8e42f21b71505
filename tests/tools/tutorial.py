"""The README's "Your own part in ten minutes", done as it is written: its files, its changes, its commands.

    tutorial.py PERIMORPH MPIEXEC RUNS
"""

import copy
import csv
import math
import pathlib
import re
import shlex
import subprocess
import sys
import unittest
import xml.etree.ElementTree as ElementTree

import numpy
from PIL import Image

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from fixture import PERIMORPH, ROOT, InFolder

del sys.argv[1:]


def tutorial():
    text = (ROOT / "README.md").read_text()
    return re.search(r"^## Your own part in ten minutes$(.*?)^## ", text, re.MULTILINE | re.DOTALL).group(1)


def replace_list(root, new):
    """Puts a parameter list in the place of the one with its name."""
    places = [(parent, n) for parent in root.iter() for n, child in enumerate(parent) if child.get("name") == new.get("name")]
    assert len(places) == 1, new.get("name")
    parent, n = places[0]
    parent[n] = new


class Tutorial(InFolder):
    def setUp(self):
        super().setUp()
        (self.folder / "tools").symlink_to(ROOT / "tools")
        (self.folder / "build/drivers").mkdir(parents=True)
        (self.folder / "build/drivers/perimorph").symlink_to(PERIMORPH)

    def run_command(self, command):
        words = shlex.split(command)
        if words[0] == "tools/run":  # what is built is here; it must not build another
            words = ["build/drivers/perimorph", "run", *words[1:]]
        done = subprocess.run(words, cwd=self.folder, capture_output=True, text=True, timeout=500)
        self.assertEqual(done.returncode, 0, f"{command}\n{done.stdout}\n{done.stderr}")
        return done.stdout

    def assert_automatic_seeds_go_beside_the_hole(self, tree):
        tree = copy.deepcopy(tree)
        replace_list(tree.getroot(), ElementTree.fromstring(
            '<ParameterList name="Seeds"><ParameterList name="auto">'
            '<Parameter name="Shape" type="string" value="Automatic"/></ParameterList></ParameterList>'))
        tree.write(self.folder / "inputs/bracket/automatic.xml")
        printed = self.run_command("build/drivers/perimorph check inputs/bracket/automatic.xml")
        places = sorted(tuple(map(float, place)) for place in re.findall(r"^seed .* auto: at \((\S+), (\S+)\)", printed, re.MULTILINE))
        self.assertEqual(len(places), 2, printed)
        for place, wanted in zip(places, [(13, 20), (23, 20)]):  # centroids of elements of size 1
            self.assertLess(math.dist(place, wanted), 1.5)

    def assert_gmshs_window_shows_the_part(self, command):
        """gmsh draws into a file what its window shows, and closes it."""
        (self.folder / "print.geo").write_text('Print "window.png";\nExit;\n')
        self.run_command(f"xvfb-run --auto-servernum {command} print.geo")
        shown = numpy.asarray(Image.open(self.folder / "window.png").convert("RGB")).astype(int)
        curves = (shown[:, :, 2] > shown[:, :, 0] + 80) & (shown[:, :, 0] < 120)  # blue
        rows, columns = curves.nonzero()
        self.assertAlmostEqual((rows.max() - rows.min()) / (columns.max() - columns.min()), 40 / 30, delta=0.05)

    def assert_an_editor_takes_the_case(self, command):
        subprocess.run(command, shell=True, cwd=self.folder, check=True, timeout=60)
        self.run_command("xmllint --noout --relaxng perimorph.rng inputs/bracket/bracket.xml")

    def steps(self, run):
        with open(self.folder / run / "history.csv", newline="") as stream:
            rows = list(csv.DictReader(stream))
        return rows, next(n for n, row in enumerate(rows) if int(row["broken_bonds"]) > 0)

    def test_runs_as_it_is_written(self):
        text = tutorial()
        commands = re.findall(r"^    (\S.*)$", re.sub(r"```.*?```", "", text, flags=re.DOTALL), re.MULTILINE)
        self.assertEqual(len(commands), 7)
        self.run_command(commands[0])

        geometry, = re.findall(r"```geo\n(.*?)```", text, re.DOTALL)
        case = self.folder / "inputs/bracket/bracket.xml"
        (self.folder / "inputs/bracket/bracket.geo").write_text(geometry)
        tree = ElementTree.parse(case)
        changes = re.findall(r"```xml\n(.*?)```", text, re.DOTALL)
        self.assertEqual(len(changes), 4)
        for change in changes:
            replace_list(tree.getroot(), ElementTree.fromstring(change))
        tree.write(case)
        self.assert_automatic_seeds_go_beside_the_hole(tree)

        printed = [self.run_command(command) for command in commands[1:]]

        stretch = re.search(r"critical\s+stretch\s+s_crit\s+=\s+([\d.]+)", printed[0]).group(1)
        self.assertIn(f"{float(stretch):.4f}", text)  # what the tutorial says about the results
        rows, first = self.steps("results/bracket")
        forces = [float(row["reaction_top_y"]) for row in rows]
        self.assertIn(f"in step {first + 1}", text)
        before, after = map(float, re.search(r"from\s+(\d+)\s+to\s+(\d+)\s+N", text).groups())
        self.assertAlmostEqual(max(forces) / before, 1, delta=0.02)
        self.assertLess(abs(forces[forces.index(max(forces)) + 1] - after), 0.05 * before)  # what a few bonds hold, more or less
        self.assertTrue((self.folder / "bracket-preview.png").exists())
        self.assertTrue((self.folder / "results/bracket/history.png").exists())
        self.assertTrue((self.folder / "results/bracket/report.html").exists())

        spans = re.findall(r"`([^`\n]+)`", re.sub(r"```.*?```", "", text, flags=re.DOTALL))
        window, schema, setting = (span for span in spans if span.startswith(("gmsh ", "build/", "tools/", "--set ")))
        self.assert_gmshs_window_shows_the_part(window)
        self.assert_an_editor_takes_the_case(schema)
        self.run_command(f"{commands[3]} {setting} --output results/whole")
        other_rows, other_first = self.steps("results/whole")
        self.assertEqual(other_first, first)
        self.assertAlmostEqual(int(other_rows[-1]["dgfe_elements"]) / int(rows[-1]["dgfe_elements"]), 2, delta=0.2)


if __name__ == "__main__":
    unittest.main()
