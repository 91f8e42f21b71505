"""tools/render: stills and films.

    pictures.py PERIMORPH RUN
"""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy
from PIL import Image

TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"
RUN = pathlib.Path(sys.argv[2]) / "out"
del sys.argv[1:]


def share_of(colour, file):
    """The share of a picture's pixels that are nearly of a colour."""
    pixels = numpy.asarray(Image.open(file).convert("RGB")).astype(int)
    return float((numpy.abs(pixels - colour).max(axis=2) < 12).mean())


class Render(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def render(self, *options):
        command = [TOOLS / "render", RUN, *options]
        return subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=100)

    @unittest.skipUnless(shutil.which("pvbatch") and shutil.which("xvfb-run"), "needs ParaView")
    def test_several_steps_and_fields_are_drawn_at_once(self):
        drawn = self.render("--step", "1", "--step", "last", "--field", "damage", "--field", "blocks",
                            "-o", self.folder / "p.png")
        self.assertEqual(drawn.returncode, 0, drawn.stderr)
        names = ["p-0001-damage.png", "p-0001-blocks.png", "p-0010-damage.png", "p-0010-blocks.png"]
        self.assertEqual(drawn.stdout.splitlines(), [str(self.folder / name) for name in names])
        dgfe = numpy.array([194, 51, 56])
        self.assertLess(share_of(dgfe, self.folder / names[1]), 0.02)  # the legend only: nothing is broken yet
        self.assertGreater(share_of(dgfe, self.folder / names[3]), 0.1)

    @unittest.skipUnless(shutil.which("pvbatch") and shutil.which("ffprobe"), "needs ParaView and ffmpeg")
    def test_a_film_has_a_frame_for_each_step(self):
        for name, codec, steps in [("crack.mp4", "h264", "8"), ("crack.gif", "gif", "2")]:
            with self.subTest(name):
                film = self.folder / name
                drawn = self.render("--warp", "20", "--step", steps, "-o", film)
                self.assertEqual((drawn.returncode, drawn.stdout), (0, f"{film}\n"), drawn.stderr)
                told = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_streams", "-of", "json", film],
                                      capture_output=True, text=True, timeout=30)
                stream = json.loads(told.stdout)["streams"][0]
                self.assertEqual((stream["codec_name"], stream["nb_read_frames"]), (codec, steps))

    def test_mistakes_are_told_before_anything_is_drawn(self):
        for options, piece in [
            (["-o", self.folder / "p.tiff"], 'found the ending ".tiff"; allowed are .png'),
            (["--field", "damge"], 'did you mean "damage"?'),
            (["--step", "99"], "not written; nearest are 7, 8, 9, 10"),
            (["--slice", "z=1"], "--slice: only for three-dimensional runs"),
            (["--warp", "much"], '--warp much: expected a factor, or "auto"'),
        ]:
            drawn = self.render(*options)
            self.assertEqual(drawn.returncode, 2)
            self.assertIn(piece, drawn.stderr)


if __name__ == "__main__":
    unittest.main()
