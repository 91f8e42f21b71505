"""Who is left when tools/run, mpirun or a rank is killed: nobody, within seconds.

    ended_together.py PERIMORPH MPIEXEC
"""

import os
import pathlib
import signal
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from fixture import PERIMORPH, TOOLS, GrowingCrack, settings, until

SECONDS = 20  # a rank that is asked to end may finish a solve first


class Killed(GrowingCrack):
    def pids(self, name):
        """Of the processes of that name that work on this test's case."""
        found = subprocess.run(["pgrep", "-f", f"^[^ ]*{name} .*{self.case}"], capture_output=True, text=True)
        return [int(pid) for pid in found.stdout.split()]

    def start(self):
        run = subprocess.Popen([TOOLS / "run", self.case, "-n", "2", "--output", self.output, *settings("Loading/Increments=100000")],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        self.addCleanup(lambda: [os.kill(pid, signal.SIGKILL) for pid in self.pids("(perimorph|mpirun)")])
        self.addCleanup(run.kill)
        self.wait_for(lambda: self.has_rows(2))
        self.assertEqual(len(self.pids(PERIMORPH)), 2)
        return run

    def assert_nothing_goes_on(self):
        self.assertTrue(until(lambda: not self.pids("(perimorph|mpirun)"), SECONDS), self.pids("(perimorph|mpirun)"))

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


if __name__ == "__main__":
    unittest.main()
