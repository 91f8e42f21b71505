"""Checkpoints within an increment: a long one that is interrupted goes on in its middle.

    within.py PERIMORPH MPIEXEC
"""

import os
import pathlib
import re
import signal
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from fixture import EVERY, changed, settings
from whole_run import WholeRun

# The second increment tears the plate, a few bonds at a time.
RATE = 0.8
JUMP = {
    "Boundary Conditions/Displacements/pull down/Rate": -RATE,
    "Boundary Conditions/Displacements/pull up/Rate": RATE,
    "Loading/Increments": 2,
    "Loading/Breaking Fraction": 0.02,
    "Loading/Maximum Damage Iterations": 100000,
    "Loading/Maximum Zone Growths": 100000,
}
WITHIN = r"checkpoint-(\d{6})_(\d{6})\.h5"


class Within(WholeRun):
    CASE = changed(WholeRun.CASE, JUMP)

    def within(self):
        """(increment, solves) of the checkpoints within an increment, the newest at last."""
        found = (re.fullmatch(WITHIN, name) for name in self.checkpoints())
        return [(int(match[1]), int(match[2])) for match in found if match]

    def interrupted(self, *options, name="SIGTERM", ranks=1, increment=1):
        """A run that gets a signal (SIGKILL: once it has written a checkpoint) in the middle of the increment after that one;
        returns what it said."""
        run = self.start(*options, ranks=ranks)
        end = time.monotonic() + 60
        while not self.is_within(increment, needs_checkpoint=name == "SIGKILL"):
            self.assertLess(time.monotonic(), end, "nothing happened")
            self.assertIsNone(run.poll(), "it is done already")
            time.sleep(0.005)
        process = run.pid
        if name != "SIGKILL":
            if ranks > 1:
                process = int(pathlib.Path(f"/proc/{run.pid}/task/{run.pid}/children").read_text().split()[0])
            while not self.catches(process, getattr(signal, name)):  # one that goes on has a history before it begins
                time.sleep(0.005)
            end = self.time_used(process) + 0.4  # of some seconds
            while self.time_used(process) < end:
                time.sleep(0.005)
        os.kill(process, getattr(signal, name))
        message = run.stderr.read()
        self.assertEqual(run.wait(timeout=60), -signal.SIGKILL if name == "SIGKILL" else 3, message)
        return message

    @staticmethod
    def time_used(process):
        """[s] by the processor, however many others wait for it."""
        numbers = pathlib.Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(numbers[11]) + int(numbers[12])) / os.sysconf("SC_CLK_TCK")

    @staticmethod
    def catches(process, number):
        caught = re.search(r"SigCgt:\s*(\w+)", pathlib.Path(f"/proc/{process}/status").read_text())[1]
        return int(caught, 16) >> (number - 1) & 1

    def is_within(self, increment, needs_checkpoint):
        history = self.output / "history.csv"
        if needs_checkpoint:
            return any(number == increment for number, _ in self.within())
        return history.exists() and len(history.read_bytes().splitlines()) > increment

    def continued(self, *options, ranks=1):
        run = self.run_case(*options, "--restart", ranks=ranks)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run.stdout

    def test_with_checkpoint_every_it_ends_with_the_same_bits(self):
        often = [*EVERY, *settings("Output/Checkpoint Minutes=0.0002")]
        for ranks in [1, 2]:
            expected = self.whole(ranks=ranks)
            for name, increment, options in [("SIGTERM", 1, EVERY), ("SIGKILL", 1, often), ("SIGKILL", 0, often)]:
                with self.subTest(ranks=ranks, name=name, increment=increment):
                    self.interrupted(*options, name=name, ranks=ranks, increment=increment)
                    newest = max(self.within())
                    self.assertGreaterEqual(newest[0], increment)
                    self.assertEqual(newest[1] % 20, 0)

                    log = self.continued(*EVERY, ranks=ranks)

                    self.assertRegex(log, r"restart          after increment \d, \d+ broken bonds, and \d+0 solves of the next")
                    self.assertEqual(self.difference(self.everything(), expected), "")
                    self.forget()

    def forget(self):
        for path in self.output.iterdir():
            path.unlink()

    def test_without_it_the_present_solve_is_kept(self):
        for before, after in [(1, 1), (2, 1), (1, 2)]:
            with self.subTest(before=before, after=after):
                message = self.interrupted(ranks=before)
                (increment, solves), = self.within()
                self.assertEqual(increment, 1)
                self.assertIn(f"--restart goes on after increment 1, and {solves} solves of the next", message)
                self.assertEqual(len(self.history()), 1)

                log = self.continued(ranks=after)

                self.assertIn(f", and {solves} solves of the next", log)
                rows = self.history()
                self.assertEqual([row["increment"] for row in rows], ["1", "2"])
                self.assertGreater(int(rows[1]["linear_solves"]), 400)  # also those before
                self.assertGreater(float(rows[1]["broken_bonds"]), 2500)
                self.assertEqual(self.checkpoints()[-1], "checkpoint-000002.h5")
                self.forget()

    def test_sigusr1_writes_one_and_the_run_goes_on(self):
        run = self.start()
        while not self.is_within(1, needs_checkpoint=False):
            time.sleep(0.01)
        for n in [1, 2]:
            before = self.within()
            time.sleep(0.2)
            os.kill(run.pid, signal.SIGUSR1)
            end = time.monotonic() + 20
            while self.within() == before:
                self.assertLess(time.monotonic(), end)
                time.sleep(0.005)
            self.assertEqual(len(self.within()), n)
        self.assertEqual(run.wait(timeout=60), 0, run.stderr.read())
        self.assertEqual(self.checkpoints()[-1], "checkpoint-000002.h5")

    def test_twice_in_the_same_increment(self):
        expected = self.whole()
        for _ in range(2):
            self.interrupted(*EVERY, *(["--restart"] if self.output.exists() else []))
        self.assertEqual(len(self.history()), 1)
        self.continued(*EVERY)
        self.assertEqual(self.difference(self.everything(), expected), "")

    def test_a_limit_that_is_passed_can_be_raised(self):
        expected = self.whole()
        run = self.run_case(*EVERY, *settings("Loading/Maximum Damage Iterations=500"))
        self.assertEqual(run.returncode, 3, run.stderr)
        self.assertEqual(max(self.within()), (1, 500))
        self.continued(*EVERY)
        self.assertEqual(self.difference(self.everything(), expected), "")


if __name__ == "__main__":
    unittest.main()
