"""cmake --install: other programs find the packages, and the installed tools run a case and show it, from another folder and
without the repository.

    installed.py PERIMORPH MPIEXEC BUILD CMAKE
"""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from fixture import coarsen, settings

BUILD, CMAKE = sys.argv[1:3]
del sys.argv[1:]
CONSUMER = pathlib.Path(__file__).parent / "consumer"


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        installed = cls.folder / "first"
        cls.command(CMAKE, "--install", BUILD, "--prefix", installed)
        cls.prefix = installed.rename(cls.folder / "moved")  # nothing may name the place where it was installed

    @classmethod
    def command(cls, *words):
        done = subprocess.run(list(map(str, words)), cwd=cls.folder, capture_output=True, text=True, timeout=500)
        if done.returncode != 0:
            raise AssertionError(f"{' '.join(map(str, words))}\n{done.stdout}\n{done.stderr}")
        return done.stdout

    def test_another_program_finds_the_packages_and_links_them(self):
        self.command(CMAKE, "-S", CONSUMER, "-B", "consumer", f"-DCMAKE_PREFIX_PATH={self.prefix}", "-DCMAKE_BUILD_TYPE=Debug")
        self.command(CMAKE, "--build", "consumer")
        stiffness, edge, alignment = map(float, self.command(self.folder / "consumer/consumer").split())
        self.assertAlmostEqual(stiffness, 210e3 / (1 - 1 / 9))
        self.assertEqual(edge, 1.5)
        self.assertGreaterEqual(alignment, 8)

    def test_a_package_that_is_missing_is_told(self):
        (self.folder / "CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.21)\nproject(x CXX C)\nfind_package(Perimorph REQUIRED)\n")
        outcome = subprocess.run([CMAKE, "-S", self.folder, "-B", self.folder / "lacking", f"-DCMAKE_PREFIX_PATH={self.prefix}",
                               "-DCMAKE_DISABLE_FIND_PACKAGE_pugixml=ON"], capture_output=True, text=True, timeout=500)
        self.assertNotEqual(outcome.returncode, 0)
        self.assertIn("pugixml was not found. Install it with: apt-get install libpugixml-dev", " ".join(outcome.stderr.split()))

    def test_the_tools_run_a_case_and_show_it(self):
        tool = lambda name: self.prefix / f"bin/perimorph-{name}"
        self.command(tool("new-case"), "part", "--from", "plate")
        coarsen(self.folder / "part/part.geo", "dx = 1;", "dx = 2;")
        self.command(tool("preview"), "part/part.xml", *settings("Peridynamics/Horizon=6", "Peridynamics/Characteristic Length=0.4"))
        self.assertTrue((self.folder / "part-preview.png").is_file())
        self.command(tool("run"), "part/part.xml", "-n", "2", *settings(
            "Peridynamics/Horizon=6", "Peridynamics/Characteristic Length=0.4", "Loading/Increments=2"))
        self.command(tool("plot-history"), "results/part")
        self.command(tool("render"), "results/part")
        made = {path.name for path in (self.folder / "results/part").iterdir()}
        self.assertLessEqual({"history.csv", "part.e", "history.png", "part-0002-damage.png"}, made)

    def test_the_program_stands_beside_them(self):
        self.assertIn("/Loading/Increments", self.command(self.prefix / "bin/perimorph", "params"))
        self.assertFalse(os.path.exists(self.prefix / "share/perimorph/tools/build"))


if __name__ == "__main__":
    unittest.main()
