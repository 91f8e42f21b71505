"""One run, one folder: a second one is refused, what an earlier one has left is safe until it is replaced, and a run goes on
only from a checkpoint whose results are there.

    folder.py PERIMORPH MPIEXEC
"""

import pathlib
import re
import shutil
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from fixture import ENDLESS, EVERY, INCREMENTS, settings
from whole_run import WholeRun, order_in_series


class InFolder(WholeRun):
    def contents(self):
        return {path.name: path.read_bytes() for path in self.output.iterdir()}

    def put_back(self, contents):
        for path in self.output.iterdir():
            path.unlink()
        for name, content in contents.items():
            (self.output / name).write_bytes(content)


class OneRun(InFolder):
    def test_a_second_one_is_refused_and_names_the_first(self):
        for ranks, others in [(1, [1, 2]), (2, [1]), (4, [1])]:
            with self.subTest(ranks=ranks):
                first = self.start(*ENDLESS, ranks=ranks)
                self.wait_for(lambda: self.has_rows(3))
                for other in others:
                    for options in [[], ["--restart"]]:
                        second = self.run_case(*ENDLESS, *options, ranks=other)
                        self.assertEqual(second.returncode, 2, second.stderr)
                        named = re.search(r"/out: another run is writing there: process (\d+) on \S+, since ", second.stderr)
                        self.assertTrue(pathlib.Path(f"/proc/{named[1]}").exists(), second.stderr)
                        if ranks == 1:
                            self.assertEqual(int(named[1]), first.pid)
                self.assertIsNone(first.poll())
                first.terminate()
                first.wait()
                numbers = [int(row["increment"]) for row in self.history()]
                self.assertEqual(numbers, list(range(1, len(numbers) + 1)))
                self.run_until(2)  # nobody is there any more

    def test_one_that_was_killed_hinders_nobody(self):
        first = self.start(*ENDLESS, *EVERY)
        self.wait_for(lambda: self.has_rows(3))
        first.kill()
        first.wait()
        self.assertTrue((self.output / "run.lock").exists())
        self.run_until(2)
        self.assertFalse((self.output / "run.lock").exists())

    def test_a_folder_that_is_emptied_meanwhile_is_an_error(self):
        for ranks, what in [(1, "*"), (2, "*"), (1, "history.csv"), (1, "probes.csv"), (1, "crack.csv")]:
            with self.subTest(ranks=ranks, what=what):
                options = ["--set", "Output/Spread Files=true"] if ranks > 1 else []
                run = self.start(*ENDLESS, *options, ranks=ranks)
                self.wait_for(lambda: self.has_rows(3))
                for path in self.output.glob(what):
                    path.unlink(missing_ok=True)  # the run may have ended already, and taken its lock away
                message = run.stderr.read()
                self.assertEqual(run.wait(timeout=60), 3, message)
                self.assertRegex(message, "somebody has emptied the folder|it is missing or was changed by something else")
                shutil.rmtree(self.output)

    def test_a_folder_that_is_removed_meanwhile_is_an_error(self):
        run = self.start(*ENDLESS)
        self.wait_for(lambda: self.has_rows(3))
        self.output.rename(self.folder / "elsewhere")
        message = run.stderr.read()
        self.assertEqual(run.wait(timeout=60), 3, message)

    def test_a_series_that_is_removed_meanwhile_is_an_error(self):
        run = self.start(*settings("Loading/Increments=1000000", "Material/Critical Stretch=1e3"))
        self.wait_for(lambda: self.has_rows(3))
        (self.output / "plate.e").unlink()
        message = run.stderr.read()
        self.assertEqual(run.wait(timeout=60), 3, message)
        self.assertIn("plate.e: it is missing", message)

    def test_a_table_that_somebody_writes_to_is_an_error(self):
        run = self.start(*ENDLESS)
        self.wait_for(lambda: self.has_rows(3))
        with open(self.output / "history.csv", "a") as file:
            file.write("1,2,3\n")
        message = run.stderr.read()
        self.assertEqual(run.wait(timeout=60), 3, message)
        self.assertIn("history.csv: it is missing or was changed by something else", message)


class NewOverOld(InFolder):
    def setUp(self):
        super().setUp()
        self.run_until(INCREMENTS, *EVERY)

    def test_a_new_run_that_is_refused_changes_nothing(self):
        before = self.contents()
        mesh = (self.folder / "plate.msh").read_text()
        for mistake, options in [("group", ["--set", "Boundary Conditions/Displacements/hold x/Group=nowhere"]),
                                 ("mesh", []),
                                 ("probe", ["--set", "Output/Probes/ahead/Points={50, 50}"]),
                                 ("crack", settings("Pre-Cracks/slit/Points={0, 2, 11, 4.5}"))]:
            for ranks in [1, 2]:
                with self.subTest(mistake=mistake, ranks=ranks):
                    (self.folder / "plate.msh").write_text(mesh[:1000] if mistake == "mesh" else mesh)
                    run = self.run_case(*options, ranks=ranks)
                    self.assertEqual(run.returncode, 2, run.stderr)
                    self.assertEqual(self.contents(), before)

    def test_a_geometry_of_another_size_leaves_the_mesh_of_the_run(self):
        (self.folder / "square.geo").write_text("""SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 12, 12};
MeshSize{:} = size;
Physical Surface("body") = {1};
Physical Curve("right") = {2};
Physical Point("lower") = {1};
Physical Point("upper") = {4};
""".replace("= size", "= 1"))
        self.write_case({"Mesh/File": "square.geo", "Material/Critical Stretch": 1e3, "Output/Probes": {}, "Pre-Cracks": {}})
        self.run_until(2)
        self.assertIn("square.msh", self.contents())
        before = self.contents()
        (self.folder / "square.geo").write_text((self.folder / "square.geo").read_text().replace("{:} = 1;", "{:} = 0.9;"))
        run = self.run_case("--restart")
        self.assertEqual(run.returncode, 2, run.stderr)
        self.assertIn("belongs to another mesh", run.stderr)
        self.assertEqual(self.contents(), before)

    def test_automatic_seeds_stay_where_they_were_when_there_are_more_increments(self):
        """Under a constant load and a growing one, where the body is stretched most depends on how far it goes."""
        self.write_case({"Morphing/Seeds": {"tip": {"Shape": "Automatic"}}, "Pre-Cracks": {},
                         "Boundary Conditions/Displacements/pull up/Constant": 0.5,
                         "Boundary Conditions/Displacements/hold upper right": {"Group": "upper", "Component": "x", "Rate": 0.3}})
        self.run_until(4, *EVERY)
        before = self.everything()
        self.run_until(2, *EVERY, "--set", "Loading/Increments=4")
        self.run_until(4, *EVERY, "--restart")
        self.assertEqual(self.difference(self.everything(), before), "")


class Support(InFolder):
    """What a checkpoint counts on."""

    def setUp(self):
        super().setUp()
        self.expected = self.whole()
        self.run_until(14, *EVERY)
        self.assertEqual(self.checkpoints(), ["checkpoint-000013.h5", "checkpoint-000014.h5"])

    def cut_rows(self, name, increments):
        file = self.output / name
        rows = file.read_bytes().splitlines(keepends=True)
        file.write_bytes(b"".join(row for row in rows if not row[0:1].isdigit() or int(row.split(b",")[0]) <= increments))

    def test_the_newest_is_taken_that_all_results_support(self):
        history = self.output / "history.csv"
        series = max(self.output.glob("plate.e*"), key=order_in_series)
        harms = {
            "history without its last row": lambda: self.cut_rows("history.csv", 13),
            "half of its last row": lambda: history.write_bytes(history.read_bytes()[:-20]),
            "its last row of zeros": lambda: history.write_bytes(history.read_bytes()[:-20] + bytes(20)),
            "probes without their last rows": lambda: self.cut_rows("probes.csv", 13),
            "crack without its last row": lambda: self.cut_rows("crack.csv", 13),
            "series without the last bytes": lambda: series.write_bytes(series.read_bytes()[:-8]),
        }
        before = self.contents()
        for harm, do in harms.items():
            with self.subTest(harm):
                self.put_back(before)
                do()
                run = self.run_case(*EVERY, "--restart", "--no-progress")
                self.assertEqual(run.returncode, 0, run.stderr)
                self.assertRegex(run.stdout, r"warning: .*: it cannot be continued: it is (missing|shorter than it was|not what it was)")
                self.assertIn("restart          after increment 13", run.stdout)
                self.assertEqual(self.difference(self.everything(), self.expected), "")

    def test_if_none_is_supported_it_is_refused_and_nothing_changes(self):
        first_file, bonds = self.output / "plate.e", self.output / "bonds-000013.vtp"
        harms = {
            "history.csv": lambda: self.cut_rows("history.csv", 12),
            "probes.csv": lambda: self.cut_rows("probes.csv", 5),
            "crack_path.csv": lambda: (self.output / "crack_path.csv").unlink(),
            "plate.e": lambda: first_file.write_bytes(first_file.read_bytes()[:-1]),
            "plate.e-s0002": lambda: (self.output / "plate.e-s0002").unlink(),
            "bonds-000013.vtp": lambda: bonds.write_bytes(bonds.read_bytes()[:-1]),
        }
        before = self.contents()
        for name, do in harms.items():
            with self.subTest(name):
                self.put_back(before)
                do()
                harmed = self.contents()
                for ranks in [1, 2]:
                    run = self.run_case(*EVERY, "--restart", ranks=ranks)
                    self.assertEqual(run.returncode, 2, run.stderr)
                    self.assertIn(f"/{name}: it cannot be continued: it is ", run.stderr)
                    self.assertEqual(self.contents(), harmed)

    def test_rows_behind_it_are_cut_off_whatever_they_are(self):
        for name in ["history.csv", "probes.csv", "crack.csv", "crack_path.csv"]:
            with open(self.output / name, "ab") as file:
                file.write(b"14,x,half\n" + bytes(50))
        self.run_until(INCREMENTS, *EVERY, "--restart")
        self.assertEqual(self.difference(self.everything(), self.expected), "")


if __name__ == "__main__":
    unittest.main()
