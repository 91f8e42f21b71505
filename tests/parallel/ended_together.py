"""Who is left when tools/run, mpirun or a rank is killed: nobody, within seconds.

    ended_together.py PERIMORPH MPIEXEC
"""

import os
import pathlib
import re
import signal
import subprocess
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from fixture import PERIMORPH, TOOLS, GrowingCrack, settings, until

SECONDS = 20  # a rank that is asked to end may finish a solve first


class Started(GrowingCrack):
    def pids(self, name):
        """Of the processes of that name that work on this test's case."""
        found = subprocess.run(["pgrep", "-f", f"^[^ ]*{name} .*{self.case}"], capture_output=True, text=True)
        return [int(pid) for pid in found.stdout.split()]

    def launch(self):
        run = subprocess.Popen([TOOLS / "run", self.case, "-n", "2", "--output", self.output, *settings("Loading/Increments=100000")],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        self.addCleanup(lambda: [os.kill(pid, signal.SIGKILL) for pid in self.pids("(perimorph|mpirun)")])
        self.addCleanup(run.kill)
        return run

    def start(self):
        run = self.launch()
        self.wait_for(lambda: self.has_rows(2))
        self.assertEqual(len(self.pids(PERIMORPH)), 2)
        return run

    def assert_nothing_goes_on(self):
        self.assertTrue(until(lambda: not self.pids("(perimorph|mpirun)"), SECONDS), self.pids("(perimorph|mpirun)"))


class Killed(Started):
    def test_the_script(self):
        run = self.start()
        run.kill()
        run.wait(SECONDS)
        self.assert_nothing_goes_on()

    def test_mpirun(self):
        run = self.start()
        for pid in self.pids("mpirun"):
            os.kill(pid, signal.SIGKILL)
        self.assertNotEqual(run.wait(SECONDS), 0)
        self.assert_nothing_goes_on()

    def test_a_rank(self):
        run = self.start()
        os.kill(self.pids(PERIMORPH)[1], signal.SIGKILL)
        self.assertNotEqual(run.wait(SECONDS), 0)
        self.assert_nothing_goes_on()


class Signalled(Started):
    """However soon after the start: while it looks whether there is something to build, and before the ranks are there."""

    def test_a_signal_to_end_is_not_lost(self):
        for number in [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]:
            for moment in [0.02, 0.15, 0.3, 0.45, 0.6]:
                with self.subTest(number=number, moment=moment):
                    run = self.launch()
                    time.sleep(moment)
                    run.send_signal(number)
                    self.assertNotEqual(run.wait(SECONDS), 0)
                    self.assert_nothing_goes_on()

    def test_a_request_for_a_checkpoint_ends_nothing(self):
        run = self.launch()
        self.assertTrue(until(lambda: self.heeds(run.pid, signal.SIGUSR1)))
        while not self.has_rows(2):
            self.assertIsNone(run.poll())
            run.send_signal(signal.SIGUSR1)
            time.sleep(0.05)
        time.sleep(1)  # until they have been passed on
        self.assertIsNone(run.poll())
        run.terminate()
        self.assertEqual(run.wait(SECONDS), 3)

    @staticmethod
    def heeds(process, number):
        """Whether a signal does something else than to end it."""
        status = pathlib.Path(f"/proc/{process}/status").read_text()
        masks = [int(mask, 16) for mask in re.findall(r"Sig(?:Ign|Cgt):\s*(\w+)", status)]
        return any(mask >> (number - 1) & 1 for mask in masks)


if __name__ == "__main__":
    unittest.main()
