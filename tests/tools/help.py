"""Every tool explains itself, called from any folder, and names itself as one calls it.

    help.py PERIMORPH MPIEXEC RUNS
"""

import os
import pathlib
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from fixture import ROOT, InFolder

del sys.argv[1:]


class Help(InFolder):
    def test_every_tool_explains_itself_from_any_folder(self):
        folders = [ROOT / "tools", ROOT / "tools/studies", ROOT / "tools/checks"]
        tools = sorted(file for folder in folders for file in folder.iterdir() if file.is_file() and os.access(file, os.X_OK))
        self.assertGreater(len(tools), 20)
        for tool in tools:
            with self.subTest(tool.name):
                outcome = subprocess.run([tool, "--help"], capture_output=True, text=True, timeout=60, cwd=self.folder)
                self.assertEqual(outcome.returncode, 0, outcome.stderr)
                self.assertIn(f"{tool.relative_to(ROOT)}", outcome.stdout)

    def test_nothing_is_installed_to_explain_a_tool(self):
        """Without the packages of Debian, which this takes away from Python, a tool would install them."""
        (self.folder / "sitecustomize.py").write_text(
            "import sys\nsys.path[:] = [place for place in sys.path if 'dist-packages' not in place]\n")
        for tool in ["report", "plot-history", "compare-runs", "compare-slab", "studies/scaling-study"]:
            with self.subTest(tool):
                outcome = subprocess.run([ROOT / "tools" / tool, "--help"], capture_output=True, text=True, timeout=60,
                                      env={**os.environ, "PYTHONPATH": str(self.folder)})
                self.assertEqual((outcome.returncode, outcome.stderr), (0, ""))
                self.assertIn(f"tools/{tool}", outcome.stdout)


class Mistakes(InFolder):
    def test_an_empty_name_of_a_file_is_refused(self):
        for tool in ["report", "plot-history", "render", "join", "compare-calculix"]:
            outcome = subprocess.run([ROOT / "tools" / tool, self.folder, "--output", ""], capture_output=True, text=True, timeout=60)
            self.assertEqual(outcome.returncode, 2, tool)
            self.assertIn('found ""; allowed is a name', outcome.stderr)

    def test_numbers_of_ranks_that_no_machine_has(self):
        case = self.folder / "case.xml"
        case.write_text("")
        environment = {name: value for name, value in os.environ.items() if not name.endswith("JOB_ID")}
        for ranks in ["999999", "0", "-1", "2.5", "two"]:
            outcome = subprocess.run([ROOT / "tools/run", case, "-n", ranks], capture_output=True, text=True, timeout=60, env=environment)
            self.assertEqual(outcome.returncode, 2, ranks)
            self.assertIn(f"-n {ranks}: ", outcome.stderr)


if __name__ == "__main__":
    unittest.main()
