"""Runs that are killed at any of their operations on files: --restart goes on, and nothing is lost, doubled or different.

    faults.py PERIMORPH MPIEXEC FILE_FAULTS

PERIMORPH_FAULTS is how many operations of each run are tried, spread evenly; "all" is every one. 4 if it is not set.
"""

import os
import pathlib
import shutil
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
FILE_FAULTS = sys.argv.pop(3)
import fixture
import in_3d
import refinement
from fixture import EVERY, changed, settings
from whole_run import EXPORTS, WholeRun

NUMBER = os.environ.get("PERIMORPH_FAULTS", "4")
KINDS = ["before", "torn", "after"]


class Faults:
    """With a run: 1 or 2 ranks, gathered or spread files."""

    RANKS, OPTIONS = 1, []

    def killed(self, at, kind, *options, ranks=1, rank=0):
        """A run that is killed at an operation; 0: at none. Returns its status, and how many operations there were if it ended."""
        count = self.folder / "count"
        count.unlink(missing_ok=True)
        environment = {"FAULT_FOLDER": self.output, "FAULT_RANK": rank, "FAULT_AT": at, "FAULT_KIND": kind, "FAULT_COUNT": count,
                       "LD_PRELOAD": FILE_FAULTS}
        command = self.command(*EVERY, *self.OPTIONS, *options)
        preload = ["env", *(f"{name}={value}" for name, value in environment.items())]  # not mpirun itself
        run = subprocess.run([*fixture.launch(ranks), *preload, *command], capture_output=True, text=True, timeout=250)
        return run.returncode, int(count.read_text()) if count.exists() else None

    def prepare(self, before):
        """What the folder holds before a run: nothing, or what another one has left."""
        shutil.rmtree(self.output, ignore_errors=True)
        if before:
            shutil.copytree(before, self.output)

    def moments(self, *options, rank, before=None):
        """(operation, kind) to be tried."""
        self.prepare(before)
        status, number = self.killed(0, "before", *options, ranks=self.RANKS, rank=rank)
        self.assertEqual(status, 0)
        self.assertGreater(number, 20 if rank == 0 else 0)
        step = 1 if NUMBER == "all" else max(1, number // int(NUMBER))
        return [(at, kind) for i, at in enumerate(range(number, 0, -step)) for kind in
                (KINDS if NUMBER == "all" else [KINDS[i % len(KINDS)]])]

    def continued(self, *options):
        return subprocess.run(self.command(*EVERY, *self.OPTIONS, *options, "--restart", ranks=self.RANKS), capture_output=True,
                              text=True, timeout=250)

    def test_a_run_that_is_killed_goes_on(self):
        expected = self.whole(*self.OPTIONS, ranks=self.RANKS)
        for rank in range(self.RANKS):
            for at, kind in self.moments(rank=rank):
                with self.subTest(rank=rank, at=at, kind=kind):
                    self.prepare(None)
                    self.killed(at, kind, ranks=self.RANKS, rank=rank)
                    run = self.continued()
                    self.assertEqual(run.returncode, 0, run.stderr)
                    self.assertEqual(self.difference(self.everything(), expected), "")

    def test_a_restart_that_is_killed_goes_on(self):
        expected = self.whole(*self.OPTIONS, ranks=self.RANKS)
        run = subprocess.run(self.command(*EVERY, *self.OPTIONS, *settings("Loading/Increments=2"), ranks=self.RANKS))
        self.assertEqual(run.returncode, 0)
        self.output.rename(self.folder / "begun")
        for at, kind in self.moments("--restart", rank=0, before=self.folder / "begun"):
            with self.subTest(at=at, kind=kind):
                self.prepare(self.folder / "begun")
                self.killed(at, kind, "--restart", ranks=self.RANKS)
                run = self.continued()
                self.assertEqual(run.returncode, 0, run.stderr)
                self.assertEqual(self.difference(self.everything(), expected), "")

    def test_over_the_results_of_another_case_either_is_there(self):
        """The old run's end, until the new one has begun; then the new one's beginning."""
        other = settings("Material/Young's Modulus=2000")
        expected, old = self.whole(*self.OPTIONS, ranks=self.RANKS), self.folder / "old"
        run = subprocess.run(self.command(*EVERY, *self.OPTIONS, *other, ranks=self.RANKS, output=old))
        self.assertEqual(run.returncode, 0)
        expected_of_old = self.everything(old)
        outcomes = set()
        for at, kind in self.moments(rank=0, before=old):
            with self.subTest(at=at, kind=kind):
                self.prepare(old)
                self.killed(at, kind, ranks=self.RANKS)
                run = self.continued()
                outcomes.add(run.returncode)
                if run.returncode != 0:
                    self.assertIn("belongs to another case", run.stderr)
                    run = self.continued(*other)
                    self.assertEqual(run.returncode, 0, run.stderr)
                    self.assertIn("after increment 3", run.stdout + (self.output / "run.log").read_text())
                    self.assertEqual(self.difference(self.everything(), expected_of_old), "")
                else:
                    self.assertEqual(self.difference(self.everything(), expected), "")
        self.assertEqual(outcomes, {0, 2} if NUMBER == "all" else outcomes)


class Plate(Faults, WholeRun):
    CASE = changed(fixture.CASE, {"Output": EXPORTS})


class PlateOnTwo(Plate):
    RANKS = 2


class PlateSpread(Plate):
    RANKS, OPTIONS = 2, settings("Output/Spread Files=true")


class Block(Faults, WholeRun):
    """In three dimensions."""

    CASE = changed(in_3d.InThreeDimensions.CASE, {
        "Output": {"Crack": True, "Bonds": [3], "Probes": {"ahead": {"Points": [6, 4, 1]}}},
        "Boundary Conditions/Displacements/pull up/Rate": 0.2,
        "Boundary Conditions/Displacements/pull down/Rate": -0.2,
        "Loading/Increments": 3,
    })
    MESH = in_3d.mesh()


class Refined(Faults, WholeRun):
    """With a mesh that is refined on the way."""

    CASE = refinement.SHORT
    MESH = refinement.Refined.MESH


class RefinedOnTwo(Refined):
    RANKS = 2


if __name__ == "__main__":
    unittest.main()
