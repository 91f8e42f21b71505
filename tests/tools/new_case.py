"""tools/new-case: every template makes a case that passes perimorph check, and mistakes are reported.

    new_case.py PERIMORPH MPIEXEC RUNS
"""

import csv
import pathlib
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from fixture import PERIMORPH, TOOLS, InFolder

del sys.argv[1:]
TEMPLATES = sorted(folder.name for folder in (TOOLS / "templates").iterdir())
ENERGIES = {"concrete-beam": "G_f = 0.075", "inclusion": "G_c = 0.04"}


class NewCase(InFolder):
    def new_case(self, *arguments):
        return subprocess.run([TOOLS / "new-case", *map(str, arguments)], capture_output=True, text=True, timeout=30)

    def test_every_template_makes_a_case_that_is_in_order(self):
        self.assertLessEqual({"beam", "plate", "disk", "block"}, set(TEMPLATES))
        for template in TEMPLATES:
            with self.subTest(template):
                case = self.folder / "deep" / f"my-{template}"
                made = self.new_case(case, "--from", template)
                self.assertEqual(made.returncode, 0, made.stderr)
                self.assertEqual(sorted(f.name for f in case.iterdir()),
                                 ["README.md", f"my-{template}.geo", f"my-{template}.xml"])
                for file in case.iterdir():
                    self.assertNotIn("@NAME@", file.read_text(), file)

                check = subprocess.run([PERIMORPH, "check", case / f"my-{template}.xml"],
                                       capture_output=True, text=True, timeout=60)

                self.assertEqual(check.returncode, 0, check.stderr)
                self.assertIn(ENERGIES.get(template, "G_c = 0.1") + "\n", check.stdout)
                self.assertIn("peridynamic", check.stdout)
                if template != "block":  # a horizon of four elements is too much in three dimensions
                    self.assertNotIn("advice", check.stdout + check.stderr)

    def test_every_template_makes_a_case_that_runs_to_its_end_as_it_is(self):
        """What its README says of the first break is what happens."""
        for template in TEMPLATES:
            with self.subTest(template):
                case = self.folder / template
                self.new_case(case, "--from", template)
                run = subprocess.run([PERIMORPH, "run", case / f"{template}.xml", "--output", case / "out", "--quiet"],
                                     capture_output=True, text=True, timeout=600)
                self.assertEqual(run.returncode, 0, run.stderr)
                with open(case / "out/history.csv", newline="") as stream:
                    first = next(row["increment"] for row in csv.DictReader(stream) if int(row["broken_bonds"]) > 0)
                self.assertIn(f"the first bonds break in step {first};", (case / "README.md").read_text())

    def assert_refused(self, made, *pieces):
        self.assertEqual(made.returncode, 2, made.stderr)
        for piece in pieces:
            self.assertIn(piece, made.stderr)

    def test_an_unknown_template_is_refused_and_the_nearest_offered(self):
        self.assert_refused(self.new_case(self.folder / "x", "--from", "plat"), "--from plat", 'did you mean "plate"?')
        self.assertFalse((self.folder / "x").exists())

    def test_a_folder_that_already_exists_is_left_alone(self):
        self.assert_refused(self.new_case(self.folder, "--from", "beam"), "already exists")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_a_name_that_cannot_be_a_files_is_refused(self):
        for name in ["my case", "x.y", "-x"]:
            self.assert_refused(self.new_case("--from", "beam", "--", self.folder / name), f'"{name}"', "allowed are")


if __name__ == "__main__":
    unittest.main()
