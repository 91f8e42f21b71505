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
                told = subprocess.run([tool, "--help"], capture_output=True, text=True, timeout=60, cwd=self.folder)
                self.assertEqual(told.returncode, 0, told.stderr)
                self.assertIn(f"{tool.relative_to(ROOT)}", told.stdout)


if __name__ == "__main__":
    unittest.main()
