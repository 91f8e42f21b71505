"""Checkpoints and --restart: a run that was ended in any way goes on as if it had not been.

    restart.py PERIMORPH MPIEXEC

PERIMORPH_KILLS: see whole_run.py.
"""

import os
import pathlib
import resource
import signal
import subprocess
import sys
import unittest

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import whole_run
from fixture import ENDLESS, EVERY, INCREMENTS, N, GrowingCrack, changed, plate_mesh, settings


class Continued(GrowingCrack):
    def test_on_as_many_ranks_it_ends_with_the_same_bits(self):
        for ranks, stops in [(1, [1, 11, 12, 15]), (2, [14])]:
            whole = self.uninterrupted(ranks)
            for stop in stops:  # before damage, at the first breaks, after growths, between two growths
                with self.subTest(ranks=ranks, stop=stop):
                    self.assert_continues(whole, stop, *EVERY, ranks=ranks)

    def test_with_dilatation_and_windows_it_ends_with_the_same_bits(self):
        volume = settings("Material/Poisson's Ratio=0.2")
        windows = settings("Solver/Largest Window=0.9", "Solver/Window Radius=1")
        for options in [volume, windows, [*volume, *windows]]:
            for ranks in [1, 2]:
                with self.subTest(options=options, ranks=ranks):
                    self.run_until(INCREMENTS, *EVERY, *options, ranks=ranks)
                    whole = self.outcome()
                    self.assertGreater(int(whole[0][-1]["broken_bonds"]), 0)
                    self.assert_continues(whole, 14, *EVERY, *options, ranks=ranks)

    def test_on_other_ranks_the_same_bonds_break(self):
        rows, times, steps = self.uninterrupted()
        for before, after in [(1, 2), (3, 1)]:
            with self.subTest(before=before, after=after):
                self.run_until(13, ranks=before)
                self.run_until(INCREMENTS, "--restart", ranks=after)

                for row, other in zip(rows, self.rows(), strict=True):
                    for name in ["increment", "broken_bonds", "damaged_elements", "dgfe_elements", "unknowns"]:
                        self.assertEqual(row[name], other[name])
                    # Tolerance, 1e-6 of the reactions; energies of bonds that break while it is Damage Tolerance, 1e-4.
                    self.assertAlmostEqual(float(row["reaction_upper_y"]) / float(other["reaction_upper_y"]), 1, places=5)
                    self.assertAlmostEqual(float(row["dissipated_energy"]), float(other["dissipated_energy"]), delta=1e-4)
                self.assertEqual(self.fields()[0], times)
                last = self.fields()[1][-1]
                for c in "12":  # nodes are numbered by rank
                    ours, theirs = (numpy.sort(s[f"vals_nod_var{c}"]) for s in [steps[-1], last])
                    numpy.testing.assert_allclose(ours, theirs, atol=1e-5)  # displacements are up to 0.8

    def test_a_run_that_is_repartitioned_on_its_way_breaks_the_same_bonds_and_can_be_continued(self):
        repartitioned = [*EVERY, "--set", "Solver/Largest Imbalance=1"]
        for ranks in [2, 4]:
            with self.subTest(ranks=ranks):
                self.run_until(INCREMENTS, *EVERY, "--set", "Solver/Largest Imbalance=1000", ranks=ranks)
                once = self.rows()
                self.run_until(INCREMENTS, *repartitioned, ranks=ranks)
                log, whole = (self.output / "run.log").read_text(), self.outcome()
                self.assertIn("repartitioned ", log)
                for row, other in zip(once, whole[0], strict=True):
                    for name in ["increment", "broken_bonds", "damaged_elements", "dgfe_elements", "unknowns"]:
                        self.assertEqual(row[name], other[name])
                    self.assertAlmostEqual(float(row["reaction_upper_y"]) / float(other["reaction_upper_y"]), 1, places=5)

                for stop in [12, 14]:
                    self.assert_continues(whole, stop, *repartitioned, ranks=ranks)

    def test_a_run_that_is_done_can_go_further(self):
        self.run_until(3)
        self.run_until(3, "--restart")
        self.assertEqual([row["increment"] for row in self.rows()], ["1", "2", "3"])
        self.run_until(5, "--restart")
        self.assertEqual([row["increment"] for row in self.rows()], ["1", "2", "3", "4", "5"])
        self.assertIn("after increment 3", (self.output / "run.log").read_text())

    def test_without_a_checkpoint_it_starts_from_the_beginning(self):
        run = self.run_case("--set", "Loading/Increments=2", "--restart")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("no checkpoint found: starting from the beginning", run.stdout)
        self.assertEqual(len(self.rows()), 2)

    def test_a_new_run_removes_the_checkpoints_of_an_older_one(self):
        self.run_until(8, *EVERY)
        self.run_until(3)
        self.assertEqual(self.checkpoints(), ["checkpoint-000003.h5"])

    def test_rows_and_steps_after_the_checkpoint_are_computed_again(self):
        whole = self.uninterrupted()
        self.run_until(13, *EVERY)
        older = {p: p.read_bytes() for p in self.output.glob("checkpoint*")}
        self.run_until(15, *EVERY, "--restart")
        for path in self.output.glob("checkpoint*"):
            path.unlink()
        for path, content in older.items():
            path.write_bytes(content)
        self.run_until(INCREMENTS, *EVERY, "--restart")
        self.assert_same(self.outcome(), whole)

    def test_the_last_two_are_kept_and_the_older_serves_if_the_newest_is_damaged(self):
        whole = self.uninterrupted()
        for harm in [lambda b: b[: len(b) // 2], lambda b: b[:-1], lambda b: b"", lambda b: b[:9000] + b"spoilt" + b[9006:]]:
            self.run_until(14, *EVERY)
            self.assertEqual(self.checkpoints(), ["checkpoint-000013.h5", "checkpoint-000014.h5"])
            newest = self.output / "checkpoint-000014.h5"
            newest.write_bytes(harm(newest.read_bytes()))

            run = self.run_case("--restart", *EVERY)

            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertIn("checkpoint-000014.h5: the checkpoint cannot be read, or is damaged", run.stdout)
            self.assertIn("after increment 13", run.stdout)
            self.assert_same(self.outcome(), whole)
            self.assertEqual(self.checkpoints(), ["checkpoint-000015.h5", "checkpoint-000016.h5"])


class Refused(GrowingCrack):
    """Status 2, what differs, and nothing changed."""

    def setUp(self):
        super().setUp()
        self.run_until(2)

    def assert_refused(self, *pieces, options=()):
        before = {p.name: p.read_bytes() for p in self.output.iterdir()}
        for ranks in [1, 2]:
            run = self.run_case("--restart", *options, ranks=ranks)
            self.assertEqual(run.returncode, 2, run.stderr)
            for piece in pieces:
                self.assertEqual(run.stderr.count(piece), 1, run.stderr)
            after = {p.name: p.read_bytes() for p in self.output.iterdir()}
            self.assertEqual(after.keys(), before.keys())
            self.assertEqual([n for n in before if before[n] != after[n]], [])

    def test_another_case(self):
        self.assert_refused(
            "belongs to another case",
            'there "/Material/Critical Stretch = 0.05", here "/Material/Critical Stretch = 0.050000000001"',
            options=["--set", "Material/Critical Stretch=0.050000000001"],
        )

    def test_another_seed(self):
        self.write_case({"Morphing/Seeds/tip/Center": [5, 6.5]})
        self.assert_refused("/Morphing/Seeds/tip/Center = {5, 6}", "/Morphing/Seeds/tip/Center = {5, 6.5}")

    def test_another_mesh(self):
        file = self.folder / "plate.msh"
        file.write_text(file.read_text().replace("\n30 3 2 0\n", "\n30 3.0001 2 0\n"))
        self.assert_refused("belongs to another mesh: as large as this one, but with other coordinates")

    def test_a_mesh_of_another_size(self):
        (self.folder / "plate.msh").write_text(plate_mesh(columns=N + 1))
        self.assert_refused("belongs to another mesh: there 144 elements and 174 nodes, here 156 and 187")

    def test_only_damaged_checkpoints(self):
        for path in self.output.glob("checkpoint*"):
            path.write_bytes(b"none")
        self.assert_refused("damaged, and so are all others")

    def test_a_history_that_is_gone(self):
        (self.output / "history.csv").write_text("")
        self.assert_refused("history.csv: it cannot be continued")

    def test_what_only_says_how_to_compute_may_differ(self):
        self.run_until(3, "--restart", "--set", "Solver/Operator=CRS", "--set", "Output/Every=2", "--set", "Title=other")
        self.assertEqual(len(self.rows()), 3)


class Ended(GrowingCrack):
    """By signals, errors and a full disk: status 3 in order, or at once by SIGKILL."""

    def test_a_signal_ends_it_after_writing_the_last_accepted_increment(self):
        for name, ranks in [("SIGTERM", 1), ("SIGINT", 1), ("SIGTERM", 2)]:
            with self.subTest(name=name, ranks=ranks):
                run = self.start(*ENDLESS, ranks=ranks)
                self.wait_for(lambda: self.has_rows(5))
                process = run.pid
                if ranks > 1:  # one of them alone
                    process = int(pathlib.Path(f"/proc/{run.pid}/task/{run.pid}/children").read_text().split()[0])
                os.kill(process, getattr(signal, name))

                self.assertEqual(run.wait(timeout=60), 3)
                last = self.rows()[-1]["increment"]
                self.assertIn(f"{name} asked it to stop; --restart goes on after increment {last}", run.stderr.read())
                self.assertEqual(self.checkpoints(), [f"checkpoint-{int(last):06d}.h5"])
                (self.output / "history.csv").unlink()

    def test_the_clock_writes_them_too(self):
        run = self.start(*ENDLESS, "--set", "Output/Checkpoint Minutes=0.005")
        self.wait_for(lambda: self.checkpoints() and ".part" not in str(self.checkpoints()))
        first = self.checkpoints()
        self.wait_for(lambda: self.checkpoints()[-1:] != first[-1:])
        self.assertIsNone(run.poll())

    def test_sigusr1_writes_one_and_the_run_goes_on(self):
        run = self.start(*ENDLESS)
        for n in [1, 2, 2]:
            rows = len(self.history()) if n > 1 else 0
            self.wait_for(lambda: self.has_rows(rows + 1))  # what is on the disk already is not written again
            before = self.checkpoints()
            os.kill(run.pid, signal.SIGUSR1)
            self.wait_for(lambda: self.checkpoints()[-1:] != before[-1:] and ".part" not in str(self.checkpoints()))
            self.assertLessEqual(n, len(self.checkpoints()))
            self.assertIsNone(run.poll())

    def test_an_error_leaves_a_checkpoint_to_go_on_from(self):
        run = self.run_case("--set", "Loading/Maximum Damage Iterations=5")
        self.assertEqual(run.returncode, 3, run.stderr)
        self.assertEqual((len(self.rows()), self.checkpoints()), (11, ["checkpoint-000011.h5"]))
        self.run_until(INCREMENTS, "--restart")
        self.assertEqual(len(self.rows()), INCREMENTS)

    def test_killed_while_it_wrote_one_the_half_of_it_does_not_count(self):
        self.run_until(14, *EVERY)
        newest = self.output / "checkpoint-000014.h5"
        content = newest.read_bytes()
        newest.rename(newest.with_suffix(".h5.part")).write_bytes(content[: len(content) // 2])
        run = self.run_case("--restart", *EVERY)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("after increment 13", run.stdout)
        self.assertEqual(self.checkpoints()[-1], "checkpoint-000016.h5")

    def test_files_that_may_not_grow_end_it_in_order_as_a_full_disk_does(self):
        # For who is not root. The first part of the series reaches 100,000 bytes in increment 7, checkpoints have 56,000.
        # Open MPI itself would need larger files: for its shared memory, unless it does without.
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (100000, 100000))
        without_files = dict(os.environ, PMIX_MCA_gds="hash", OMPI_MCA_btl="self,tcp")
        for ranks in [1, 2]:
            with self.subTest(ranks=ranks):
                whole = self.uninterrupted(ranks)
                run = self.start(*EVERY, ranks=ranks, preexec_fn=limit, env=without_files)
                message = run.stderr.read()
                self.assertEqual(run.wait(timeout=60), 3, message)
                self.assertIn("File too large", message)
                self.assertRegex(str(self.checkpoints()), r"^\['checkpoint-00000\d.h5', 'checkpoint-00000\d.h5'\]$")
                self.run_until(INCREMENTS, *EVERY, "--restart", ranks=ranks)
                self.assert_same(self.outcome(), whole)

    def test_a_full_disk_ends_it_in_order_and_the_last_checkpoint_serves(self):
        whole = self.uninterrupted()
        for kilobytes in [250, 350]:
            with self.subTest(kilobytes=kilobytes):
                disk = self.folder / f"disk-{kilobytes}"
                disk.mkdir()
                mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={kilobytes}k", "tmpfs", disk], capture_output=True)
                if mounted.returncode != 0:
                    self.skipTest("only root can make a small disk")
                self.addCleanup(subprocess.run, ["umount", disk], check=True)
                self.output = disk

                run = self.run_case(*EVERY)

                self.assertEqual(run.returncode, 3, run.stderr)
                self.assertIn("No space left on device", run.stderr)
                self.assertNotIn(".part", str(self.checkpoints()))
                subprocess.run(["mount", "-o", "remount,size=4m", disk], check=True)
                self.run_until(INCREMENTS, *EVERY, "--restart")
                self.assert_same(self.outcome(), whole)


class Killed(whole_run.Killed, whole_run.WholeRun):
    pass


if __name__ == "__main__":
    unittest.main()
