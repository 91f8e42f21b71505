"""Many more ranks than cores: they break the same bonds as one, go on from any number to any other, and end in order.

    many_ranks.py PERIMORPH MPIEXEC SLEEPING_RANKS NO_MEMORY

PERIMORPH_RANKS is how many ranks are tried; "16" if it is not set.
"""

import os
import pathlib
import signal
import sys
import unittest

import numpy

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parents[1] / folder) for folder in ("support", "regression")]
SLEEPING_RANKS, NO_MEMORY = sys.argv[3:5]
del sys.argv[3:5]
import fixture
import in_3d
import refinement
import restart_materials
from fields import read_vtp
from fixture import EVERY, GrowingCrack, changed, settings, until

os.environ["LD_PRELOAD"] = SLEEPING_RANKS
RANKS = sorted(map(int, os.environ.get("PERIMORPH_RANKS", "16").split()))
SECONDS = 30  # until nothing is left of a run that ends: a rank may have to finish a solve, on a core that it shares


def time_limit(ranks):
    """[s] of a run. Of each rank the start alone takes the better part of a second."""
    return 300 + 40 * ranks


class OnManyRanks(GrowingCrack):
    """A case, and how it ends on one rank."""

    END = 6
    SAME = ["broken_bonds", "damaged_elements", "dgfe_elements", "unknowns"]
    # Of the largest reaction. The residual is 1e-6 of the reactions, and a condition number amplifies it; between solves that break
    # bonds it is Damage Tolerance, 1e-4, and with it what broken bonds held.
    FORCE_TOLERANCE, ENERGY_TOLERANCE = 1e-5, 1e-4

    def setUp(self):
        super().setUp()
        self.run_to(self.END)
        self.alone, self.alone_broken = self.rows(), self.broken()
        self.assertEqual(len(self.alone_broken), int(self.alone[-1]["broken_bonds"]))
        self.assertGreater(len(self.alone_broken), 40)
        self.output = self.folder / "many"

    def run_to(self, increment, *options, ranks=1):
        bonds = settings(f"Output/Bonds={{{self.END}}}")
        run = self.run_case("--quiet", *EVERY, *settings(f"Loading/Increments={increment}"), *bonds, *options, ranks=ranks,
                            timeout=time_limit(ranks))
        self.assertEqual(run.returncode, 0, run.stderr)

    def broken(self):
        """The broken bonds at the end, each by the places of its points."""
        bonds = read_vtp(self.output / f"bonds-{self.END:06d}.vtp")
        points = [tuple(place) for place in numpy.round(bonds["points"], 8) + 0.0]  # no -0
        ends = bonds["connectivity"].reshape(-1, 2)[bonds["broken"].ravel() != 0]
        return {frozenset((points[one], points[other])) for one, other in ends}

    def assert_as_alone(self):
        rows = self.rows()
        reactions = [name for name in rows[0] if name.startswith("reaction_")]
        largest = max(abs(float(row[name])) for row in self.alone for name in reactions)
        energy = float(self.alone[-1]["dissipated_energy"])
        for row, other in zip(rows, self.alone, strict=True):
            for name in self.SAME:
                self.assertEqual(row[name], other[name], f"{name} in increment {row['increment']}")
            for name in reactions:
                self.assertAlmostEqual(float(row[name]), float(other[name]), delta=self.FORCE_TOLERANCE * largest, msg=name)
            self.assertAlmostEqual(float(row["dissipated_energy"]), float(other["dissipated_energy"]), delta=self.ENERGY_TOLERANCE * energy)
        self.assertEqual(self.broken(), self.alone_broken)


class Bonds:
    """What is asked of each case."""

    def test_the_same_break_on_any_number_of_ranks(self):
        for ranks in RANKS:
            with self.subTest(ranks=ranks):
                self.run_to(self.END, ranks=ranks)
                self.assert_as_alone()

    def test_the_same_break_where_each_part_of_a_run_has_another_number_of_ranks(self):
        """From one to the most, to the fewest, and back."""
        route = [1, RANKS[-1], RANKS[0], 2, RANKS[-1], 1] if len(RANKS) > 1 else [1, RANKS[0], 2, RANKS[0], 1]
        for increment, ranks in enumerate(route, self.END - len(route) + 1):
            self.run_to(increment, "--restart", ranks=ranks)
        self.assert_as_alone()


def pulled(rate):
    return {"Boundary Conditions/Displacements/pull down/Rate": -rate, "Boundary Conditions/Displacements/pull up/Rate": rate}


class Few(OnManyRanks):
    """Fewer elements than 64 ranks: some have none."""

    MESH = fixture.plate_mesh(columns=6, rows=6)
    CASE = changed(fixture.CASE, {**pulled(0.1), "Morphing/Seeds/tip": {"Center": [2, 3], "Inner Radius": 3.0, "Outer Radius": 4.0},
                                  "Pre-Cracks/slit/Points": [0, 3, 2, 3]})


class FewElements(Bonds, Few):
    pass


class Plate(Bonds, OnManyRanks):
    CASE = changed(fixture.CASE, pulled(0.1))
    END = 8


class Block(Bonds, OnManyRanks):
    """In three dimensions."""

    MESH = in_3d.mesh()
    CASE = changed(in_3d.InThreeDimensions.CASE, pulled(0.1))


class Refined(Bonds, OnManyRanks):
    """A mesh that follows the crack."""

    MESH = refinement.wide_plate()
    CASE = changed(refinement.Refined.CASE, pulled(0.1))


class Softening(Bonds, Few):
    """Bonds that soften, of two materials in a pattern, with a dilatation."""

    SOFT = {"Poisson's Ratio": 0.2, "Bond Law": "Bilinear", "Tensile Strength": 15.0, "Fracture Energy": 2.0}
    MESH = fixture.plate_mesh(columns=6, rows=6, has_stiff=True)
    CASE = changed(Few.CASE, {**{f"Material/{name}": value for name, value in SOFT.items()}, "Material/Critical Stretch": None,
                              "Materials/stiff": {**SOFT, "Blocks": ["stiff"], "Young's Modulus": 3000.0}})
    # Where softening stops within an increment depends on Damage Tolerance, 1e-4.
    FORCE_TOLERANCE = ENERGY_TOLERANCE = 1e-2


class Contact(Bonds, OnManyRanks):
    """A crack is pulled open, and pressed together while its faces rub."""

    CASE = restart_materials.Contact.CASE
    END = 10


class Ended(Few):
    """When one rank is killed, is asked to stop or has no memory left, all end, and --restart goes on after the newest checkpoint."""

    def started(self, ranks):
        """A run that has come to its first breaks, and the process of each of its ranks."""
        run = self.start(*EVERY, *settings("Loading/Increments=100000"), ranks=ranks)
        self.assertTrue(until(lambda: run.poll() is not None or self.has_rows(4), time_limit(ranks)), "nothing happened")
        lists = pathlib.Path(f"/proc/{run.pid}/task").glob("*/children")  # several of mpiexec's threads start ranks
        processes = [process for children in lists for process in children.read_text().split()]
        return run, {self.rank_of(process): int(process) for process in processes}

    @staticmethod
    def rank_of(process):
        variables = pathlib.Path(f"/proc/{process}/environ").read_text().split("\0")
        return next(int(text.partition("=")[2]) for text in variables if text.startswith("OMPI_COMM_WORLD_RANK="))

    @staticmethod
    def is_left(process):
        try:
            return pathlib.Path(f"/proc/{process}/cmdline").read_bytes() != b""  # empty: nobody has asked yet how it ended
        except OSError:
            return False

    def end_by(self, number, ranks, rank):
        """Sends a signal to one rank; returns the status of the run."""
        run, processes = self.started(ranks)
        self.assertEqual(sorted(processes), list(range(ranks)))
        os.kill(processes[rank], number)
        status = run.wait(SECONDS)
        self.assertTrue(until(lambda: not any(map(self.is_left, processes.values())), SECONDS), "some ranks are left")
        return status

    def assert_goes_on(self):
        """On one rank, to what it would have come to anyway."""
        newest = int(self.checkpoints()[-1][len("checkpoint-"):][:6])
        self.assertGreaterEqual(newest, 3)
        for path in [*self.output.glob("checkpoint*")]:
            self.assertNotIn(".part", path.name)
        if newest > self.END:
            self.skipTest("it had come too far")
        self.run_to(self.END, "--restart")
        self.assertIn(f"after increment {newest}", (self.output / "run.log").read_text())
        self.assert_as_alone()

    def test_one_rank_is_killed(self):
        for ranks, rank in [(RANKS[0], 0), *((ranks, ranks - 1) for ranks in RANKS)]:
            with self.subTest(ranks=ranks, rank=rank):
                self.output = self.folder / f"killed-{ranks}-{rank}"
                self.assertNotEqual(self.end_by(signal.SIGKILL, ranks, rank), 0)
                self.assert_goes_on()

    def test_one_rank_is_asked_to_stop(self):
        for ranks in RANKS:
            with self.subTest(ranks=ranks):
                self.output = self.folder / f"stopped-{ranks}"
                self.assertEqual(self.end_by(signal.SIGTERM, ranks, ranks - 1), 3)
                self.assert_goes_on()

    def test_one_rank_has_no_memory_left(self):
        for ranks in RANKS:
            count = self.folder / f"count-{ranks}"
            self.assertEqual(self.without_memory(ranks, ranks - 1, count=count).returncode, 0)
            n_allocations = int(count.read_text())
            for share in [0.3, 0.6, 0.9]:
                with self.subTest(ranks=ranks, share=share):
                    run = self.without_memory(ranks, ranks - 1, at=int(share * n_allocations))
                    if run.returncode != 0:  # libraries do without some buffers
                        self.assertEqual(run.returncode, 3, run.stderr)
                        self.assertIn("there is no memory left", run.stderr)

    def without_memory(self, ranks, rank, **what):
        what = {f"NO_MEMORY_{key.upper()}": str(value) for key, value in what.items()}
        environment = {**os.environ, "LD_PRELOAD": f"{SLEEPING_RANKS}:{NO_MEMORY}", "NO_MEMORY_RANK": str(rank), **what}
        return self.run_case("--quiet", *settings("Loading/Increments=4"), ranks=ranks, timeout=time_limit(ranks), env=environment)


if __name__ == "__main__":
    unittest.main()
