"""Every tool explains itself, called from any folder, and names itself as one calls it.

    help.py PERIMORPH RUNS
"""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
del sys.argv[1:]


class Help(unittest.TestCase):
    def test_every_tool_explains_itself_from_any_folder(self):
        folders = [ROOT / "tools", ROOT / "tools/studies", ROOT / "tools/checks"]
        tools = sorted(file for folder in folders for file in folder.iterdir() if file.is_file() and os.access(file, os.X_OK))
        self.assertGreater(len(tools), 20)
        with tempfile.TemporaryDirectory() as elsewhere:
            for tool in tools:
                with self.subTest(tool.name):
                    told = subprocess.run([tool, "--help"], capture_output=True, text=True, timeout=60, cwd=elsewhere)
                    self.assertEqual(told.returncode, 0, told.stderr)
                    self.assertIn(f"{tool.relative_to(ROOT)}", told.stdout)


if __name__ == "__main__":
    unittest.main()
