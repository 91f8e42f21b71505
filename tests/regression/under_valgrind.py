"""The program under valgrind, on small cases: no report and no memory lost but by libraries, as valgrind.supp says.
tools/checks/valgrind runs it.

    under_valgrind.py PERIMORPH MPIEXEC
"""

import pathlib
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import fixture
import in_3d
from fixture import settings

SUPPRESSIONS = ["/usr/share/openmpi/openmpi-valgrind.supp", pathlib.Path(__file__).with_name("valgrind.supp")]
FOUND = 99  # exit status
EVERYTHING = settings("Output/Crack=true", "Output/Bonds={3}", "Output/Probes/ahead/Points={8, 6}", "Output/Checkpoint Every=1")


class UnderValgrind:
    def perimorph(self, *arguments, ranks=1):
        valgrind = ["valgrind", "--quiet", f"--error-exitcode={FOUND}", "--child-silent-after-fork=yes", "--num-callers=40",
                    "--leak-check=full", "--show-leak-kinds=definite", "--errors-for-leak-kinds=definite",
                    *(f"--suppressions={file}" for file in SUPPRESSIONS)]
        command = [fixture.MPIEXEC, "-n", str(ranks), *valgrind, fixture.PERIMORPH, *map(str, arguments)]
        return subprocess.run(command, capture_output=True, text=True, timeout=3600)

    def assert_clean(self, run, status=0):
        self.assertNotRegex(run.stderr, r"(?m)^==\d+== ")
        self.assertEqual(run.returncode, status, run.stderr)


class Plate(UnderValgrind, fixture.Plate):
    def test_a_run_that_breaks_bonds_and_writes_everything_and_goes_on(self):
        for ranks in [1, 2]:
            with self.subTest(ranks=ranks):
                self.assert_clean(self.run_case(*EVERYTHING, ranks=ranks))
                self.assertGreater(float(self.history()[-1]["broken_bonds"]), 0)
                self.assert_clean(self.run_case(*EVERYTHING, "--set", "Loading/Increments=4", "--restart", ranks=ranks))
                self.assertEqual(len(self.history()), 4)

    def test_the_other_operator_and_files_for_each_rank(self):
        self.assert_clean(self.run_case(*settings("Solver/Operator=CRS", "Solver/Preconditioner Matrix=Coupled",
                                                   "Output/Spread Files=true"), ranks=2))

    def test_check(self):
        self.assert_clean(self.perimorph("check", self.case))

    def test_a_mistake(self):
        self.write_case({"Boundary Conditions/Displacements/hold x/Group": "rihgt"})
        self.assert_clean(self.run_case(ranks=2), status=2)

    def test_a_computation_that_cannot_go_on(self):
        self.assert_clean(self.run_case("--set", "Solver/Maximum Iterations=1"), status=3)


class Block(UnderValgrind, in_3d.InThreeDimensions):
    def test_a_run_that_breaks_bonds(self):
        faster = [f"Boundary Conditions/Displacements/pull {way}/Rate={rate}" for way, rate in [("up", 0.2), ("down", -0.2)]]
        self.assert_clean(self.run_case(*settings(*faster, "Loading/Increments=4", "Output/Crack=true")))
        self.assertGreater(float(self.history()[-1]["broken_bonds"]), 0)


if __name__ == "__main__":
    unittest.main()
