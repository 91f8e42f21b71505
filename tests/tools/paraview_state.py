"""tools/paraview: the state it writes, loaded again by ParaView (paraview_inside.py).

    paraview_state.py PERIMORPH MPIEXEC RUNS
"""

import ast
import pathlib
import subprocess
import sys
import unittest

import numpy
from PIL import Image

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from fixture import TOOLS, InFolder

RUN = pathlib.Path(sys.argv.pop(1)) / "small_plate/out"


class ParaView(InFolder):
    def paraview(self, *arguments):
        return subprocess.run([TOOLS / "paraview", *arguments], capture_output=True, text=True, timeout=60,
                              cwd=self.folder)

    def test_the_state_has_the_series_warped_and_damage_and_slice_ready(self):
        saved = self.paraview(RUN, "--save", "state.pvsm")
        self.assertEqual(saved.returncode, 0, saved.stderr)
        loaded = subprocess.run(
            ["timeout", "--kill-after=5", "50", "xvfb-run", "--auto-servernum", "--server-args=-screen 0 1280x1024x24 -noreset", "pvbatch",
             pathlib.Path(__file__).with_name("paraview_inside.py"), self.folder / "state.pvsm"], capture_output=True, text=True, timeout=60)
        self.assertEqual(loaded.returncode, 0, loaded.stderr)
        state = ast.literal_eval(loaded.stdout)

        self.assertEqual((list(state["counts"]), state["last"]), ([float(k) for k in range(1, 11)], 10.0))
        for counts in state["counts"].values():  # every element once, in whatever topology
            self.assertEqual((counts["series"], counts["warped"]), (400, 400))
        damaged = [counts["damage above 0.3"] for counts in state["counts"].values()]
        self.assertEqual(damaged[:5], [0] * 5)
        self.assertGreater(damaged[-1], 20)
        self.assertGreater(state["counts"][10.0]["slice"], 0)
        self.assertEqual(state["visible"], ["warped"])
        self.assertGreater(state["warp"], 1)

        pixels = numpy.asarray(Image.open(self.folder / "state.png").convert("RGB")).astype(int)
        red = (pixels[:, :, 0] > 2 * pixels[:, :, 1]) & (pixels[:, :, 0] > 120)  # DGFE: the crack's two sides
        self.assertGreater(red.mean(), 0.03)

    def test_mistakes_are_told(self):
        for arguments, piece in [([self.folder], "no Exodus file"), ([RUN, "--save", "x.png"], "states are .pvsm files"),
                                 ([RUN, "--warp", "much"], "--warp much")]:
            outcome = self.paraview(*arguments)
            self.assertEqual(outcome.returncode, 2)
            self.assertIn(piece, outcome.stderr)


if __name__ == "__main__":
    unittest.main()
