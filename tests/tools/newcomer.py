"""From a clone to a picture of a broken beam: the README's first two commands, as they are written. Only what they install and
build is there already (tools/checks/fresh-machine does that, too).

    newcomer.py PERIMORPH MPIEXEC RUNS
"""

import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest

import numpy
from PIL import Image

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from fixture import PERIMORPH, ROOT, InFolder, coarsen

del sys.argv[1:]


class Newcomer(InFolder):
    def setUp(self):
        super().setUp()
        self.clone = self.folder / "perimorph"
        for part in ["tools", "inputs/notched_beam"]:
            shutil.copytree(ROOT / part, self.clone / part)
        (self.clone / "tools/build").write_text("#!/bin/sh\n")
        (self.clone / "build/drivers").mkdir(parents=True)
        (self.clone / "build/drivers/perimorph").symlink_to(PERIMORPH)

    def test_two_commands_lead_to_a_picture_of_a_broken_beam(self):
        text = (ROOT / "README.md").read_text()
        section = re.search(r"^## Two commands$(.*?)^## ", text, re.MULTILINE | re.DOTALL).group(1)
        commands = re.findall(r"^    (\S.*?) *#(.*)$", section, re.MULTILINE)
        self.assertEqual(len(commands), 2)
        for command, _ in commands:
            done = subprocess.run(command, shell=True, cwd=self.clone, capture_output=True, text=True, timeout=800)
            self.assertEqual(done.returncode, 0, f"{command}\n{done.stdout}\n{done.stderr}")

        picture = self.clone / re.search(r"\S+\.png", commands[1][1]).group()
        pixels = numpy.asarray(Image.open(picture).convert("RGB")).astype(int)
        red, green, blue = pixels[:, :-300].transpose(2, 0, 1)  # without the legend
        damaged = (red > 200) & (green < 150) & (blue < 100)
        height, width = damaged.shape
        rows, columns = damaged.nonzero()
        self.assertGreater(rows.max() - rows.min(), 0.25 * height)  # a crack, upright
        self.assertLess(columns.max() - columns.min(), 0.15 * width)

    def test_a_run_on_two_ranks_that_is_told_to_end_leaves_a_checkpoint(self):
        """While a solve takes longer than mpirun leaves its processes after a signal, a second."""
        case = self.clone / "inputs/stopped"
        subprocess.run([self.clone / "tools/new-case", case, "--from", "block"], check=True, capture_output=True, timeout=60)
        coarsen(case / "stopped.geo", "dx = 1;", "dx = 0.5;")
        run = subprocess.Popen([self.clone / "tools/run", case / "stopped.xml", "-n", "2", "--output", case / "out"],
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        history = case / "out/history.csv"
        while run.poll() is None and not (history.exists() and len(history.read_text().splitlines()) > 2):
            time.sleep(0.1)
        run.send_signal(signal.SIGUSR1)  # a checkpoint, and on
        while run.poll() is None and not list((case / "out").glob("checkpoint-*.h5")):
            time.sleep(0.1)
        self.assertIsNone(run.poll())
        run.terminate()
        outcome = run.communicate(timeout=100)[1]
        self.assertEqual(run.returncode, 3, outcome)
        self.assertIn("SIGTERM asked it to stop", outcome)
        last = len(history.read_text().splitlines()) - 1
        self.assertTrue((case / f"out/checkpoint-{last:06d}.h5").exists())

    def test_what_cannot_be_installed_is_told(self):
        outcome = subprocess.run(
            [sys.executable, "-c", 'import messages; messages.need("numpy", "no_such_module", programs=["sh", "no_such_program"])'],
            cwd=self.clone / "tools/lib", capture_output=True, text=True, timeout=100)
        self.assertEqual(outcome.returncode, 2, outcome.stderr)
        self.assertIn("missing: no_such_module, no_such_program; tools/install-dependencies view did not install it", outcome.stderr)


if __name__ == "__main__":
    unittest.main()
