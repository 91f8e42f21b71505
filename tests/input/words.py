"""What a case or its mesh says reaches terminal and results as it is meant: names, titles, few elements on many ranks.

    words.py PERIMORPH MPIEXEC
"""

import pathlib
import shutil
import subprocess
import sys
import unittest

import netCDF4

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from fixture import TOOLS, settings, text_of
import runs
from hardly_meant import DISPLACEMENTS, Checked, Grids, held, moved


class Words(Checked):
    def test_a_title_does_not_steer_the_terminal(self):
        title = "\x1b]0;owned\x07\x1b[31mred\u009b1m"
        for run in [self.check(*settings(f"Title={title}")), self.run_case("--no-progress", *settings(f"Title={title}"))]:
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertIn("\\x1b]0;owned\\x07\\x1b[31mred\\u009b1m", run.stdout)
            self.assertNotRegex(run.stdout, "[\x1b\x07\u009b]")
        self.assertNotIn("\x1b", (self.output / "run.log").read_text())

    def test_nor_do_names_in_a_mistake(self):
        run = self.check(*settings("Output/Reactions={\x1b[31m}"))
        self.assertEqual(run.returncode, 2)
        self.assertNotIn("\x1b", run.stderr)

    def test_nor_do_those_of_files_and_groups(self):
        self.case = self.folder / "\x1b]0;owned\x07.xml"
        self.write_case({"Mesh/File": "\x1b[2J.msh"})
        told = self.check().stderr
        (self.folder / "\x1b[2J.msh").write_text(self.MESH.replace('"upper"', '"up\x1b[31mper"'))
        for text in [told, self.check().stderr]:
            self.assertIn("\\x1b]0;owned\\x07.xml", text)
            self.assertNotRegex(text, "[\x1b\x07]")

    def test_groups_with_long_names_that_differ_at_the_end_only(self):
        long = "g" * 180
        (self.folder / "plate.msh").write_text(self.MESH.replace('"lower"', f'"{long}1"').replace('"upper"', f'"{long}2"'))
        self.write_case({f"{DISPLACEMENTS}/pull down/Group": long + "1", f"{DISPLACEMENTS}/pull up/Group": long + "2"})
        self.assertEqual(self.run_case("--quiet").returncode, 0)
        with netCDF4.Dataset(self.series()[0]) as file:
            self.assertTrue({long + "1", long + "2"} <= set(text_of(file["ns_names"])))
            self.assertTrue({f"reaction_{long}{k}_y" for k in "12"} <= set(text_of(file["name_glo_var"])))

    def test_groups_with_names_of_other_lengths_and_letters(self):
        names = ["g" * 65, "Träger über der Öffnung", "g" * 64]
        mesh = self.MESH
        for old, name in zip(["lower", "upper", "right"], names):
            mesh = mesh.replace(f'"{old}"', f'"{name}"')
        (self.folder / "plate.msh").write_text(mesh)
        self.write_case({f"{DISPLACEMENTS}/{condition}/Group": name for condition, name in
                         [("pull down", names[0]), ("pull up", names[1]), ("hold x", names[2]), ("hold y", names[2])]})
        self.assertEqual(self.run_case("--quiet").returncode, 0)
        with netCDF4.Dataset(self.series()[0]) as file:
            self.assertLessEqual(set(names), set(text_of(file["ns_names"])))
        self.assertIn(f"reaction_{names[1]}_y", self.history()[0])
        told = subprocess.run([TOOLS / "compare-runs", self.output, self.output], capture_output=True, text=True, timeout=60)
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assertLess({f"reaction_{name}_y" for name in names}, set(runs.ExodusFile([str(self.series()[0])]).names("name_glo_var")))

    def test_a_group_of_the_mesh_called_as_the_surface_of_cracks(self):
        (self.folder / "plate.msh").write_text(self.MESH.replace('"right"', '"broken_surface"'))
        self.write_case({f"{DISPLACEMENTS}/hold {c}/Group": "broken_surface" for c in "xy"})
        self.assert_warned('/Mesh/File: the sides of the mesh\'s group "broken_surface" are called "broken_surface_of_mesh" in results')
        with netCDF4.Dataset(self.series()[0]) as file:
            sizes = {name: len(file.dimensions[f"num_side_ss{k}"]) if f"num_side_ss{k}" in file.dimensions else 0
                     for k, name in enumerate(text_of(file["ss_names"]), 1)}
        self.assertEqual(sizes, {"broken_surface": 0, "broken_surface_of_mesh": 12})

    def test_the_summary_leaves_out_reactions_that_are_rounding(self):
        self.write_case({DISPLACEMENTS: held("right", "x") | held("lower", "y") | moved("upper", "y", 0.2)})
        run = self.run_case("--no-progress", *settings("Loading/Increments=1"))
        listed = [line.split()[1] for line in run.stdout.splitlines() if line.startswith("reaction ")]
        self.assertEqual(listed, ["lower_y", "upper_y"] if "right_x" not in listed else listed)
        peaks = [abs(float(line.split()[3])) for line in run.stdout.splitlines() if line.startswith("reaction ")]
        self.assertGreater(min(peaks), 1e-5 * max(peaks))

    def steps_of_spread_files(self, n_elements, *options, ranks):
        run = self.run_case("--quiet", *options, ranks=ranks)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(len(self.series()) % ranks, 0)
        joined = subprocess.run([TOOLS / "join", self.output], capture_output=True, text=True, timeout=60)
        self.assertEqual(joined.returncode, 0, joined.stderr)
        times = []
        for part in [file for file in self.series() if file.name in ["plate.e", "plate.e-s0002"]]:
            with netCDF4.Dataset(part) as file:
                self.assertEqual(len(file.dimensions["num_elem"]), n_elements)
                times += list(file["time_whole"][:])
            part.unlink()
        return times

    def test_more_ranks_than_elements_write_spread_files(self):
        self.write_case({"Pre-Cracks": None, "Morphing/Seeds": {"all": {"Shape": "Everything"}}, "Peridynamics/Horizon": 1.0,
                         DISPLACEMENTS: held("left", "x", "y") | moved("right", "x", 0.001), "Output/Spread Files": True})
        for columns, ranks in [(3, 4), (1, 4), (2, 3)]:
            with self.subTest(columns=columns, ranks=ranks):
                (self.folder / "plate.msh").write_text(Grids().add(0, 0, columns, 1).text())
                self.assertEqual(self.steps_of_spread_files(columns, ranks=ranks), [1, 2, 3])
                more = ["--restart", *settings("Loading/Increments=5")]
                self.assertEqual(self.steps_of_spread_files(columns, *more, ranks=ranks), [1, 2, 3, 4, 5])
                shutil.rmtree(self.output)


if __name__ == "__main__":
    unittest.main()
