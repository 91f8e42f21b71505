"""What the Python tests share: the program, a folder for each test, and one small case, a plate with a slit that is pulled open.

All are called as   TEST.py PERIMORPH MPIEXEC [...]
"""

import copy
import csv
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

import netCDF4
import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
TOOLS = ROOT / "tools"
sys.path[:0] = [str(TOOLS / "lib"), str(TOOLS / "studies/lib")]
import case_file

PERIMORPH, MPIEXEC = sys.argv[1:3]
del sys.argv[1:3]

N = 12  # elements along each side of the plate, of size 1

# A slit from the left edge to the middle; the corners pull it open. The first bonds break in the third increment.
CASE = {
    "Mesh": {"File": "plate.msh"},
    "Material": {"Young's Modulus": 1000.0, "Poisson's Ratio": 0.3333, "Elastic Model": "Plane Stress", "Critical Stretch": 0.05},
    "Peridynamics": {"Horizon": 2.0, "Characteristic Length": 0.2},
    "Morphing": {"Seeds": {"tip": {"Center": [5, 6], "Inner Radius": 3.5, "Outer Radius": 4.0}}},
    "Pre-Cracks": {"slit": {"Points": [0, 6, 5, 6]}},
    "Boundary Conditions": {"Displacements": {
        "hold x": {"Group": "right", "Component": "x"},
        "hold y": {"Group": "right", "Component": "y"},
        "pull down": {"Group": "lower", "Component": "y", "Rate": -0.2},
        "pull up": {"Group": "upper", "Component": "y", "Rate": 0.2},
    }},
    "Loading": {"Increments": 3},
}
# Bonds break in increments 12 to 16, and the zone grows in 12, 13 and 15.
INCREMENTS = 16
SLOWLY = {"Boundary Conditions/Displacements/pull down/Rate": -0.05, "Boundary Conditions/Displacements/pull up/Rate": 0.05}
EVERY = ["--set", "Output/Checkpoint Every=1"]


def changed(case, changes):
    """A copy of a case with other parameters or lists, by their path; None takes one away."""
    case = copy.deepcopy(case)
    for path, value in changes.items():
        *lists, name = path.split("/")
        place = case
        for part in lists:
            place = place.setdefault(part, {})
        if value is None:
            del place[name]
        else:
            place[name] = value
    return case


def launch(ranks):
    """What comes before the program on so many ranks."""
    return [MPIEXEC, "-n", str(ranks)] if ranks > 1 else []


def settings(*texts):
    """Options that replace parameters, such as "Loading/Increments=2"."""
    return [option for text in texts for option in ("--set", text)]


# A run that has to be ended.
ENDLESS = settings("Loading/Increments=1000000", "Output/Every=1000000", "Material/Critical Stretch=1e3")


def coarsen(geometry, text, coarser):
    """Changes the size of elements in gmsh's geometry."""
    before = geometry.read_text()
    assert text in before, f"{geometry}: no {text}"
    geometry.write_text(before.replace(text, coarser))


def msh(groups, nodes, elements):
    """gmsh's format 2.2. groups: lines such as '1 3 "right"'; nodes: (number, x, y, z); elements: (shape, group, corners)."""
    lines = [f"{k} {shape} 2 {group} {group} {' '.join(map(str, corners))}" for k, (shape, group, corners) in enumerate(elements, 1)]
    section = lambda name, content: [f"${name}", str(len(content)), *content, f"$End{name}"]
    return "\n".join(["$MeshFormat", "2.2 0 8", "$EndMeshFormat"] + section("PhysicalNames", groups)
                     + section("Nodes", [" ".join(map(str, node)) for node in nodes]) + section("Elements", lines) + [""])


def plate_mesh(columns=N, rows=N, has_stiff=False, clamp=None):
    """Block "body", the right edge "right", and the two left corners "lower" and "upper"; every third column in a block
    "stiff" if there is one; the nodes of one column on the lower and the upper edge as "clamp" if that is said."""
    node = lambda i, j: j * (columns + 1) + i + 1
    nodes = [(node(i, j), i, j, 0) for j in range(rows + 1) for i in range(columns + 1)]
    elements = [(15, 1, [node(0, 0)]), (15, 2, [node(0, rows)])]
    elements += [(1, 3, [node(columns, j), node(columns, j + 1)]) for j in range(rows)]
    block = lambda i, j: 5 if has_stiff and i % 3 == 0 else 4
    elements += [(3, block(i, j), [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)])
                 for j in range(rows) for i in range(columns)]
    names = ['0 1 "lower"', '0 2 "upper"', '1 3 "right"', '2 4 "body"'] + ['2 5 "stiff"'] * has_stiff
    if clamp is not None:
        names.append('0 6 "clamp"')
        elements += [(15, 6, [node(clamp, j)]) for j in [0, rows]]
    return msh(names, nodes, elements)


def half_plate_mesh():
    """The upper half of that plate, with its lower edge beside the slit as "ligament"."""
    node = lambda i, j: j * (N + 1) + i + 1
    rows = N // 2
    nodes = [(node(i, j), i, N - rows + j, 0) for j in range(rows + 1) for i in range(N + 1)]
    elements = [(15, 1, [node(0, rows)])]
    elements += [(1, 2, [node(i, 0), node(i + 1, 0)]) for i in range(5, N)]
    elements += [(1, 3, [node(N, j), node(N, j + 1)]) for j in range(rows)]
    elements += [(3, 4, [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)]) for j in range(rows) for i in range(N)]
    return msh(['0 1 "upper"', '1 2 "ligament"', '1 3 "right"', '2 4 "body"'], nodes, elements)


# What makes the plate's case that of its upper half.
HALF = {"Pre-Cracks": None, "Boundary Conditions/Displacements/pull down": None, "Boundary Conditions/Displacements/hold y": None,
        "Boundary Conditions/Symmetry Planes/middle/Group": "ligament"}


def text_of(variable):
    """The names that a variable of characters holds."""
    return [bytes(name).decode() for name in netCDF4.chartostring(variable[:], encoding="bytes")]


def until(condition, seconds=60):
    """Waits for a condition; returns whether it came true in time."""
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            return False
        time.sleep(0.01)
    return True


def page_in_browser(address, milliseconds):
    """What a browser makes of a page, as HTML. @param milliseconds of the page's own time until then"""
    with tempfile.TemporaryDirectory() as profile:
        return subprocess.run(
            ["timeout", "--kill-after=5", "100", "chromium", "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={profile}",
             f"--virtual-time-budget={milliseconds}", "--dump-dom", address],
            capture_output=True, text=True, timeout=120).stdout


class InFolder(unittest.TestCase):
    """A folder of its own for each test."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)


class Plate(InFolder):
    """The plate, its case as plate.xml, and the program run on it."""

    CASE = CASE
    MESH = plate_mesh()

    def setUp(self):
        super().setUp()
        self.output = self.folder / "out"
        self.unfinished = self.output / "unfinished" / "plate.e"
        self.case = self.folder / "plate.xml"
        (self.folder / "plate.msh").write_text(self.MESH)
        self.write_case()

    def write_case(self, changes={}):
        case_file.write_case(self.case, changed(self.CASE, changes))

    def perimorph(self, *arguments, ranks=1, timeout=250, env=None):
        return subprocess.run([*launch(ranks), PERIMORPH, *map(str, arguments)], capture_output=True, text=True, timeout=timeout, env=env)

    def run_case(self, *options, **how):
        return self.perimorph("run", self.case, "--output", self.output, *options, **how)

    def history(self):
        with open(self.output / "history.csv", newline="") as file:
            return list(csv.DictReader(line for line in file if not line.startswith("#")))

    def series(self):
        return sorted(self.output.glob("plate.e*"))


class GrowingCrack(Plate):
    """The plate pulled slowly, through INCREMENTS, and all that comes out."""

    CASE = changed(CASE, {**SLOWLY, "Loading/Increments": INCREMENTS})

    def run_until(self, increment, *options, ranks=1):
        run = self.run_case("--quiet", *settings(f"Loading/Increments={increment}"), *options, ranks=ranks)
        self.assertEqual(run.returncode, 0, run.stderr)

    def command(self, *options, ranks=1, output=None):
        return [*launch(ranks), PERIMORPH, "run", self.case, "--output", output or self.output, "--quiet", *options]

    def start(self, *options, ranks=1, output=None, **process):
        run = subprocess.Popen(self.command(*options, ranks=ranks, output=output), stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True, **process)
        self.addCleanup(run.stderr.close)
        self.addCleanup(run.wait)
        self.addCleanup(run.kill)
        return run

    def wait_for(self, condition):
        self.assertTrue(until(condition), "nothing happened")

    def has_rows(self, n):
        """Whether the history has so many increments or more."""
        file = self.output / "history.csv"
        return file.exists() and len(file.read_bytes().splitlines()) > n

    def checkpoints(self):
        return sorted(p.name for p in self.output.glob("checkpoint*"))

    def rows(self):
        """The history without the seconds."""
        return [{name: value for name, value in row.items() if name != "wall_seconds"} for row in self.history()]

    def fields(self):
        """By variable: all steps of the series, each from its own file."""
        times, steps = [], []
        for part in self.series():
            with netCDF4.Dataset(part) as file:
                times += list(file["time_whole"][:].data)
                for i in range(len(file["time_whole"])):
                    steps.append({name: file[name][i].data for name in file.variables if name.startswith(("vals_nod", "vals_elem"))})
        return times, steps

    def outcome(self):
        return self.rows(), *self.fields()

    def uninterrupted(self, ranks=1):
        whole = self.output
        self.output = self.folder / f"uninterrupted-{ranks}"
        self.run_until(INCREMENTS, *EVERY, ranks=ranks)
        outcome = self.outcome()
        self.output = whole
        self.assertEqual(len(outcome[0]), INCREMENTS)
        self.assertGreater(float(outcome[0][-1]["broken_bonds"]), 150)
        return outcome

    def assert_continues(self, whole, stop, *options, ranks=1, end=None):
        """A run with checkpoints that stops after an increment and goes on ends as the whole one did. end: its increments, if
        history.csv has others."""
        self.run_until(stop, *options, ranks=ranks)
        self.run_until(end or len(whole[0]), *options, "--restart", ranks=ranks)
        self.assert_same(self.outcome(), whole)

    def assert_same(self, outcome, other):
        """To the last bit."""
        self.assertEqual(outcome[0], other[0])
        self.assertEqual(outcome[1], other[1])
        for step, other_step in zip(outcome[2], other[2], strict=True):
            self.assertEqual(step.keys(), other_step.keys())
            for name in step:
                numpy.testing.assert_array_equal(step[name], other_step[name])
