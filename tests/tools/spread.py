"""Spread files: what the program writes, tools/join, and the tools that draw them.

    spread.py PERIMORPH MPIEXEC RUNS
"""

import ast
import os
import pathlib
import subprocess
import sys
import unittest

import netCDF4
import numpy
from PIL import Image

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from fixture import EVERY, INCREMENTS, N, TOOLS, GrowingCrack, settings, text_of

import runs

del sys.argv[1:]

SPREAD = settings("Output/Spread Files=true")


class Spread(GrowingCrack):
    def tool(self, name, *arguments):
        return subprocess.run([TOOLS / name, *map(str, arguments)], capture_output=True, text=True, timeout=200)

    def files(self):
        return sorted(path.name for path in self.output.glob("plate.e*"))

    def joined(self):
        """The whole series as the tools read it."""
        return [runs.ExodusFile(files) for files in runs.series_of(str(self.output))]

    def damage(self):
        """{increment: damage by element}"""
        return {file.times[index]: file.values("damage", index)[numpy.argsort(file.element_numbers())]
                for file, index in runs.all_steps(self.joined())}


class Files(Spread):
    def test_joined_they_are_the_gathered_ones(self):
        for ranks in [1, 2, 4]:
            with self.subTest(ranks=ranks):
                self.output = self.folder / f"gathered-{ranks}"
                self.run_until(INCREMENTS, ranks=ranks)
                gathered = self.series()
                self.output = self.folder / f"spread-{ranks}"
                self.run_until(INCREMENTS, *SPREAD, ranks=ranks)
                self.assertEqual(self.files(), sorted(f"{file.name}.{ranks}.{rank}" for file in gathered for rank in range(ranks)))
                self.assertGreater(len(gathered), 2)
                (self.folder / f"joined-{ranks}").mkdir()

                join = self.tool("join", self.output, "-o", self.folder / f"joined-{ranks}")

                self.assertEqual(join.returncode, 0, join.stderr)
                for file in gathered:
                    self.assert_same_file(self.folder / f"joined-{ranks}" / file.name, file)

    def assert_same_file(self, one, other):
        """All dimensions, variables, types and values to the last bit, but for clocks and the parameter itself."""
        with netCDF4.Dataset(one) as a, netCDF4.Dataset(other) as b:
            sizes = lambda file: {name: len(size) for name, size in file.dimensions.items() if name != "num_info"}
            self.assertEqual(sizes(a), sizes(b))
            self.assertEqual(set(a.variables), set(b.variables))
            self.assertEqual(a.data_model, b.data_model)
            seconds = text_of(b["name_glo_var"]).index("wall_seconds")
            for name in set(b.variables) - {"qa_records", "info_records"}:
                ours, theirs = a[name][:].data, b[name][:].data
                self.assertEqual((a[name].dtype, a[name].dimensions), (b[name].dtype, b[name].dimensions), name)
                if name == "vals_glo_var":
                    ours, theirs = (numpy.delete(values, seconds, axis=1) for values in (ours, theirs))
                numpy.testing.assert_array_equal(ours, theirs, name)
            self.assertEqual({k: a.getncattr(k) for k in a.ncattrs()}, {k: b.getncattr(k) for k in b.ncattrs()})

    def test_a_run_goes_on_with_them_on_any_number_of_ranks(self):
        self.run_until(INCREMENTS)
        whole = self.damage()
        self.run_until(13, *SPREAD, ranks=2)
        before = set(self.files())
        self.run_until(INCREMENTS, *SPREAD, "--restart", ranks=3)
        self.assertTrue(all(name.endswith((".2.0", ".2.1")) for name in before))
        self.assertTrue(all(name.endswith((".3.0", ".3.1", ".3.2")) for name in set(self.files()) - before))
        damage = self.damage()
        self.assertEqual(list(damage), list(whole))
        for increment in whole:
            numpy.testing.assert_allclose(damage[increment], whole[increment], atol=1e-12)

    def test_steps_after_the_checkpoint_are_written_again(self):
        self.run_until(13, *SPREAD, *EVERY, ranks=2)
        older = {path: path.read_bytes() for path in self.output.glob("checkpoint*")}
        self.run_until(15, *SPREAD, *EVERY, "--restart", ranks=2)
        for path in self.output.glob("checkpoint*"):
            path.unlink()
        for path, content in older.items():
            path.write_bytes(content)
        self.run_until(INCREMENTS, *SPREAD, *EVERY, "--restart", ranks=2)
        times = [time for file in self.joined() for time in file.times]
        self.assertEqual(times, list(range(1, INCREMENTS + 1)))

    def test_a_joined_file_counts_until_a_rank_writes_again(self):
        self.run_until(13, *SPREAD, ranks=2)
        shown = lambda: [time for file in self.joined() for time in file.times]
        used = lambda: {len(file.files) for file in self.joined()}
        self.assertEqual(self.tool("join", self.output).returncode, 0)
        self.assertEqual((shown()[-1], used()), (13, {1}))
        self.run_until(INCREMENTS, *SPREAD, "--restart", ranks=2)
        self.assertEqual(shown(), list(range(1, INCREMENTS + 1)))
        self.assertIn(2, used())
        self.assertEqual(self.tool("join", self.output).returncode, 0)
        self.assertEqual((shown()[-1], used()), (INCREMENTS, {1}))
        file = self.joined()[-1].files[0]
        os.utime(file + ".2.1")  # as if the run went on in this very file
        self.assertEqual((shown()[-1], used()), (INCREMENTS, {1, 2}))

    def test_a_new_run_leaves_none_of_an_older_one(self):
        self.run_until(INCREMENTS, *SPREAD, ranks=2)
        self.run_until(2, *SPREAD, ranks=3)
        self.assertEqual(self.files(), [f"plate.e.3.{rank}" for rank in range(3)])
        self.run_until(2)
        self.assertEqual(self.files(), ["plate.e"])
        self.run_until(2, *SPREAD)
        self.assertEqual(self.files(), ["plate.e.1.0"])


class Mistakes(Spread):
    def test_a_spread_file_that_is_missing_is_told(self):
        self.run_until(1, *SPREAD, ranks=2)
        (self.output / "plate.e.2.0").unlink()
        for tool in ["join", "report", "render"]:
            outcome = self.tool(tool, self.output)
            self.assertEqual(outcome.returncode, 2, outcome.stderr)
            self.assertIn("plate.e.2.1 are not those of one run; expected plate.e.2.0, plate.e.2.1", outcome.stderr)

    def test_a_run_without_spread_files_is_told(self):
        self.run_until(1)
        outcome = self.tool("join", self.output)
        self.assertEqual(outcome.returncode, 2)
        self.assertIn("no spread files", outcome.stderr)


class Pictures(Spread):
    def setUp(self):
        super().setUp()
        self.run_until(INCREMENTS, *SPREAD, ranks=2)

    def test_are_those_of_the_joined_files(self):
        (self.folder / "joined").mkdir()
        self.assertEqual(self.tool("join", self.output, "-o", self.folder / "joined").returncode, 0)
        for run in [self.output, self.folder / "joined"]:
            drawn = self.tool("render", run, "--field", "damage", "-o", self.folder / f"{run.name}.png")
            self.assertEqual(drawn.returncode, 0, drawn.stderr)
        spread, joined = (numpy.asarray(Image.open(self.folder / name).convert("RGB")).astype(int)
                          for name in ["out.png", "joined.png"])
        self.assertEqual(spread.shape, joined.shape)
        self.assertLess((abs(spread - joined).max(axis=2) > 8).mean(), 1e-3)
        self.assertGreater((joined.min(axis=2) < 200).mean(), 0.05)  # there is something to see

    def test_paraview_opens_the_whole_series(self):
        state = self.folder / "state.pvsm"
        saved = self.tool("paraview", self.output, "--save", state)
        self.assertEqual(saved.returncode, 0, saved.stderr)
        loaded = subprocess.run(
            ["timeout", "--kill-after=5", "90", "xvfb-run", "--auto-servernum", "--server-args=-screen 0 1280x1024x24 -noreset",
             "pvbatch", pathlib.Path(__file__).with_name("paraview_inside.py"), state], capture_output=True, text=True, timeout=200)
        self.assertEqual(loaded.returncode, 0, loaded.stderr)
        counts = ast.literal_eval(loaded.stdout)["counts"]
        self.assertEqual(list(counts), [float(n) for n in range(1, INCREMENTS + 1)])
        for at_time in counts.values():
            self.assertEqual(at_time["series"], N**2)


if __name__ == "__main__":
    unittest.main()
