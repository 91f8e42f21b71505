"""tools/studies/published-cases: its cases are in order, and its figures are those of the runs.

    published_cases.py PERIMORPH MPIEXEC RUNS
"""

import pathlib
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from fixture import PERIMORPH, ROOT, TOOLS, InFolder, settings

from published import CASES, SOURCES, Figure, Results, at, at_largest, crack_end, crack_height, first_break, largest, largest_drop

del sys.argv[1:]


class PublishedCases(InFolder):
    def test_every_case_is_in_order_with_its_settings_and_sources(self):
        self.assertGreater(len(CASES), 8)
        for name, case in CASES.items():
            with self.subTest(name):
                checked = subprocess.run([PERIMORPH, "check", ROOT / "inputs" / case.file, *settings(*case.settings)],
                                         capture_output=True, text=True, timeout=60)
                self.assertEqual(checked.returncode, 0, checked.stderr)
                self.assertLessEqual({figure.source for figure in case.figures}, set(SOURCES))

    def test_figures_are_those_of_the_run(self):
        (self.folder / "history.csv").write_text("increment,broken_bonds,displacement_top_y,reaction_top_y\n1,0,-1,-10\n2,3,-2,-16\n3,9,-3,-4\n")
        (self.folder / "crack_path.csv").write_text("increment,element_1,element_2,x_1,y_1,x_2,y_2\n2,1,2,0,1,1,1\n3,3,4,1,1,2,3\n")
        results = Results("case.xml", str(self.folder))
        for figure, value in [(largest("reaction_top_y"), 16), (at_largest("displacement_top_y", "reaction_top_y"), 2), (at(1.5, "top_y"), 13),
                              (first_break, 2), (largest_drop("reaction_top_y"), 3), (crack_height(1.5), 2), (crack_end, 2)]:
            self.assertEqual(figure(results), value)

    def test_of_several_measured_ones_both_ratios_are_told(self):
        row = Figure("largest force", (8, 20), "Winkler", lambda results: 16.0, "").row("panel", None)
        self.assertEqual(row[2:6], ["8 to 20", "Winkler", "16", "0.80 to 2.00"])

    def test_an_unknown_case_is_refused(self):
        outcome = subprocess.run([TOOLS / "studies/published-cases", "L-shaped pane"], capture_output=True, text=True, timeout=60)
        self.assertEqual(outcome.returncode, 2)
        self.assertIn('did you mean "L-shaped panel"', outcome.stderr)


if __name__ == "__main__":
    unittest.main()
