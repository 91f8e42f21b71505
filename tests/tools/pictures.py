"""tools/render: stills and films.

    pictures.py PERIMORPH MPIEXEC RUNS
"""

import json
import pathlib
import subprocess
import sys
import unittest

import numpy
from PIL import Image

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from fixture import TOOLS, InFolder

RUNS = pathlib.Path(sys.argv.pop(1))
RUN, BLOCK = (RUNS / name / "out" for name in ["small_plate", "small_block"])


def share_of(colour, file):
    """The share of a picture's pixels that are nearly of a colour."""
    pixels = numpy.asarray(Image.open(file).convert("RGB")).astype(int)
    return float((numpy.abs(pixels - colour).max(axis=2) < 12).mean())


class Render(InFolder):
    def render(self, *options, run=RUN):
        command = [TOOLS / "render", run, *options]
        return subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=100)

    def test_several_steps_and_fields_are_drawn_at_once(self):
        drawn = self.render("--step", "1", "--step", "last", "--field", "damage", "--field", "blocks",
                            "-o", self.folder / "p.png")
        self.assertEqual(drawn.returncode, 0, drawn.stderr)
        names = ["p-0001-damage.png", "p-0001-blocks.png", "p-0010-damage.png", "p-0010-blocks.png"]
        self.assertEqual(drawn.stdout.splitlines(), [str(self.folder / name) for name in names])
        dgfe = numpy.array([194, 51, 56])
        self.assertLess(share_of(dgfe, self.folder / names[1]), 0.02)  # the legend only: nothing is broken yet
        self.assertGreater(share_of(dgfe, self.folder / names[3]), 0.1)

    def picture(self, name, *options):
        """Of the block; its pixels without the legend and the caption."""
        drawn = self.render(*options, "-o", self.folder / name, run=BLOCK)
        self.assertEqual(drawn.returncode, 0, drawn.stderr)
        return numpy.asarray(Image.open(self.folder / name).convert("RGB")).astype(int)[100:, :-300]

    def test_a_slice_cuts_away_what_lies_before_it(self):
        whole, half, rest = (self.picture(f"{place}.png", *options) for place, options in
                             [("whole", []), ("half", ["--slice", "x=8"]), ("rest", ["--slice", "x=0.1"])])
        filled = [(pixels.min(axis=2) < 250).mean() for pixels in (whole, half, rest)]
        self.assertGreater(filled[0], 1.2 * filled[1])
        self.assertGreater(filled[1], 1.2 * filled[2])
        self.assertGreater(filled[2], 0.02)

    def test_the_broken_surface_is_seen_through_the_body(self):
        red = lambda pixels: (pixels[:, :, 0] > 2 * pixels[:, :, 1]) & (pixels[:, :, 0] > 60)
        before, after = (red(self.picture(f"{step}.png", "--step", step, "--field", "broken_surface")) for step in ["1", "last"])
        self.assertEqual(before.sum(), 0)
        self.assertGreater(after.mean(), 0.02)

    def test_a_film_has_a_frame_for_each_step(self):
        for name, codec, steps in [("crack.mp4", "h264", "8"), ("crack.gif", "gif", "2")]:
            with self.subTest(name):
                film = self.folder / name
                drawn = self.render("--warp", "20", "--step", steps, "-o", film)
                self.assertEqual((drawn.returncode, drawn.stdout), (0, f"{film}\n"), drawn.stderr)
                outcome = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_streams", "-of", "json", film],
                                      capture_output=True, text=True, timeout=30)
                stream = json.loads(outcome.stdout)["streams"][0]
                self.assertEqual((stream["codec_name"], stream["nb_read_frames"]), (codec, steps))

    def test_mistakes_are_told_before_anything_is_drawn(self):
        for options, piece in [
            (["-o", self.folder / "p.tiff"], 'found the ending ".tiff"; allowed are .png'),
            (["--field", "damge"], 'did you mean "damage"?'),
            (["--step", "99"], "not written; nearest are 7, 8, 9, 10"),
            (["--slice", "z=1"], "--slice: only for three-dimensional runs"),
            (["--field", "broken_surfac"], 'did you mean "broken_surface"?'),
            (["--warp", "much"], '--warp much: expected a factor, or "auto"'),
        ]:
            drawn = self.render(*options)
            self.assertEqual(drawn.returncode, 2)
            self.assertIn(piece, drawn.stderr)


if __name__ == "__main__":
    unittest.main()
