"""What the program itself does with bad input, on 1, 2 and 4 ranks: status 2, a message that says where and what, no
hang, no trace of a crash, and little memory.

    program.py PERIMORPH MPIEXEC
"""

import os
import pathlib
import resource
import signal
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from fixture import CASE, PERIMORPH, Plate, changed, launch, settings, until

MEMORY = 8 << 30  # of address space, for each rank: Open MPI and libraries take half a gigabyte of it

# Two unit squares beside each other, and one apart from them; "apart" is its lower edge.
MSH = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
4
0 1 "corner"
1 2 "left"
1 3 "apart"
2 4 "plate"
$EndPhysicalNames
$Nodes
10
1 0 0 0
2 1 0 0
3 2 0 0
4 0 1 0
5 1 1 0
6 2 1 0
7 5 0 0
8 6 0 0
9 6 1 0
10 5 1 0
$EndNodes
$Elements
6
1 15 2 1 1 1
2 1 2 2 1 1 4
3 1 2 3 1 7 8
4 3 2 4 1 1 2 5 4
5 3 2 4 1 2 3 6 5
6 3 2 4 1 7 8 9 10
$EndElements
"""

CDB = """/PREP7
ET,1,182
NBLOCK,6,SOLID,4,4
(3i9,6e21.13e3)
        1        0        0
        2        0        0 1.0000000000000E+000
        3        0        0 1.0000000000000E+000 1.0000000000000E+000
        4        0        0 0.0000000000000E+000 1.0000000000000E+000
N,R5.3,LOC,       -1,
EBLOCK,19,SOLID,1,1
(19i9)
        1        1        1        1        0        0        0        0        4        0        1        1        2        3        4
       -1
CMBLOCK,left,NODE,2
(8i10)
         1         4
FINISH
"""


def displacement(name, group, component, rate=0.0):
    return {name: {"Group": group, "Component": component, "Rate": rate}}


HELD = displacement("x", "left", "x") | displacement("y", "left", "y")
APART_HELD = displacement("apart x", "apart", "x") | displacement("apart y", "apart", "y")
DISPLACEMENTS = "Boundary Conditions/Displacements"


class Program(Plate):
    """Nothing breaks: there is no peridynamic zone."""

    CASE = changed(CASE, {"Material/Critical Stretch": None, "Morphing": None, "Pre-Cracks": None, DISPLACEMENTS: HELD | APART_HELD,
                          "Loading/Increments": 1})
    MESH = MSH

    def write(self, name, content):
        (self.folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())

    def perimorph(self, *arguments, ranks=1):
        command = [*launch(ranks), PERIMORPH, *map(str, arguments)]
        limit = None if "ASAN_OPTIONS" in os.environ else lambda: resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        return subprocess.run(command, capture_output=True, text=True, timeout=60, preexec_fn=limit, cwd=self.folder)

    def assert_refused(self, *pieces, command="check", options=(), ranks=(2,)):
        for n in ranks:
            with self.subTest(ranks=n):
                run = self.perimorph(command, self.case, *options, ranks=n)
                self.assertEqual(run.returncode, 2, run.stderr)
                for piece in pieces:
                    self.assertEqual(run.stderr.count(piece), 1, run.stderr)
                self.assertNotIn("bug", run.stderr)


class Sound(Program):
    def test_the_case_that_the_others_spoil_is_sound(self):
        for mesh, content in [("plate.msh", MSH), ("square.cdb", CDB)]:
            self.write(mesh, content)
            self.write_case({"Mesh/File": mesh} if mesh == "plate.msh" else {"Mesh/File": mesh, DISPLACEMENTS: HELD})
            run = self.perimorph("check", self.case)
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertIn('group          "left": 2 nodes, 1 side\n', run.stdout)

    def test_the_scale_reaches_the_report(self):
        run = self.perimorph("check", self.case, *settings("Mesh/Scale=1000"))
        self.assertIn("(0, 0) to (6000, 1000)", run.stdout)


class Meshes(Program):
    def test_truncated(self):
        self.write("plate.msh", MSH[: MSH.index("8 6 0 0")])
        self.assert_refused("plate.msh:", "truncated", ranks=[1, 2, 4])

    def test_of_another_version(self):
        self.write("plate.msh", MSH.replace("2.2 0 8", "1.0 0 8"))
        self.assert_refused("plate.msh:2: MSH version 1; allowed are 2.0 to 4.1")

    def test_empty_or_garbage(self):
        for name in ["plate.msh", "plate.e", "plate.exo", "plate.cdb"]:
            self.write_case({"Mesh/File": name})
            self.write(name, "")
            self.assert_refused(f"{name}: the file is empty")
            self.write(name, bytes(range(256)) * 20)
            self.assert_refused(name)

    def test_a_folder_a_missing_file_and_a_device(self):
        (self.folder / "folder.msh").mkdir()
        (self.folder / "zero.msh").symlink_to("/dev/zero")
        for name, what in [("folder.msh", "is a folder"), ("none.msh", "No such file"), ("zero.msh", "no regular file")]:
            self.write_case({"Mesh/File": name})
            self.assert_refused(what.replace("no regular", "is not a regular"))

    def test_a_geometry_that_cannot_be_read(self):
        for name, why in [("absent.geo", "No such file or directory"), ("a" * 300 + ".geo", "File name too long")]:
            self.write_case({"Mesh/File": name})
            self.assert_refused(f"{name}: cannot be read: {why}")

    def test_huge_counts(self):
        self.write("plate.msh", MSH.replace("$Nodes\n10", "$Nodes\n1000000000000"))
        self.assert_refused("a count of 1000000000000, but the rest of the file holds at most")
        self.write_case({"Mesh/File": "square.cdb", DISPLACEMENTS: HELD})
        self.write("square.cdb", CDB.replace("NODE,2", "NODE,1999999999"))
        self.assert_refused("a count of 1999999999, but the rest of the file holds at most")


class Notes(Program):
    REVERSED = MSH.replace("10 5 1 0\n", "10 5 1 0\n77 9 9 0\n").replace("$Nodes\n10", "$Nodes\n11")
    NOTE = "plate.msh: dropped: 1 node in no 2D element (77)\n"

    def test_what_reading_changed_is_told_by_check_and_run(self):
        self.write("plate.msh", self.REVERSED)
        for command in ["check", "run"]:
            run = self.perimorph(command, self.case, *(["--output", "out"] if command == "run" else []), ranks=2)
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertEqual((run.stdout + run.stderr).count(self.NOTE), 1, run.stdout + run.stderr)
        self.assertIn(self.NOTE, (self.folder / "out" / "run.log").read_text())

    def test_a_group_that_was_left_out_and_is_used_is_a_mistake_that_says_why(self):
        self.write("plate.msh", MSH.replace('0 1 "corner"', '0 1 "left"'))
        why = 'the groups called "left" are left out, since their nodes differ: give each its own name'
        mistake = 'has no group of nodes called "left"; it has "apart"'
        self.assert_refused(f"x/Group: the mesh plate.msh {mistake} ({self.folder}/plate.msh: {why})", ranks=[1])


class Geometries(Program):
    PLATE = """SetFactory("OpenCASCADE"); Rectangle(1) = {0, 0, 0, 6, 1}; MeshSize{:} = 1;
        Physical Surface("plate", 1) = {1}; Physical Curve("left", 2) = {4};
        """

    def setUp(self):
        super().setUp()
        self.write_case({"Mesh/File": "plate.geo", DISPLACEMENTS: HELD})
        self.written = self.folder / "written"

    def test_commands_run_only_if_they_are_allowed(self):
        self.write("plate.geo", f'{self.PLATE}SystemCall "touch {self.written}";')
        self.assert_refused("plate.geo:3: SystemCall runs a command; allowed are", "--allow-shell")
        self.assertFalse(self.written.exists())
        run = self.perimorph("check", self.case, "--allow-shell", ranks=2)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("commands and writing files are allowed (--allow-shell)\n", run.stdout)
        self.assertTrue(self.written.exists())

    def test_a_case_cannot_allow_them_itself(self):
        self.write("plate.geo", f'{self.PLATE}SystemCall "touch {self.written}";')
        self.write_case({"Mesh/File": "plate.geo", "Mesh/Shell": True, DISPLACEMENTS: HELD})
        self.assert_refused("Shell", "SystemCall runs a command", ranks=[1])
        self.assertFalse(self.written.exists())

    def test_check_says_that_a_geometry_is_a_program(self):
        self.write("plate.geo", self.PLATE)
        run = self.perimorph("check", self.case)
        refused = "geometry         a program that gmsh runs; commands and writing files are refused (--allow-shell)\n"
        self.assertIn(refused, run.stdout, run.stderr)

    def test_the_ending_may_be_in_capitals(self):
        self.write("plate.GEO", self.PLATE)
        self.write_case({"Mesh/File": "plate.GEO", DISPLACEMENTS: HELD, "Loading/Increments": 1})
        run = self.run_case("--quiet")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertTrue((self.output / "plate.msh").is_file())

    ENDLESS = f"{PLATE}For i In {{1:2000000000}}\n x = i;\nEndFor\n"

    def test_one_that_loops_for_ever_is_ended_and_named(self):
        self.write("plate.geo", self.ENDLESS)
        self.assert_refused("plate.geo: gmsh was still meshing it after 0.02 min, and was ended", "/Mesh/Maximum Meshing Minutes",
                            options=settings("Mesh/Maximum Meshing Minutes=0.02"))

    def test_a_signal_ends_a_run_that_waits_for_gmsh(self):
        self.write("plate.geo", self.ENDLESS)
        command = [*launch(2), PERIMORPH, "run", self.case, "--output", self.output]
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as run:
            meshes = ["pgrep", "-f", f"gmsh .*{self.folder}"]
            self.assertTrue(until(lambda: subprocess.run(meshes, capture_output=True).returncode == 0))
            for rank in pathlib.Path(f"/proc/{run.pid}/task/{run.pid}/children").read_text().split():
                os.kill(int(rank), signal.SIGTERM)
            self.assertIn("a signal asked the run to stop while gmsh meshed it", run.communicate(timeout=30)[1])
        self.assertEqual(run.returncode, 3)

    def test_gmsh_does_not_outlive_the_program(self):
        self.write("plate.geo", self.ENDLESS)
        gmsh = ["pgrep", "-f", f"gmsh .*{self.folder}"]
        meshes = lambda: subprocess.run(gmsh, capture_output=True).returncode == 0
        with subprocess.Popen([PERIMORPH, "check", self.case], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as run:
            self.assertTrue(until(meshes))
            run.kill()
        self.assertTrue(until(lambda: not meshes()))

    def test_a_geometry_without_a_body_is_named_itself(self):
        self.write("plate.geo", self.PLATE.replace('Physical Surface("plate", 1) = {1};', ""))
        self.assert_refused("plate.geo: the mesh has no elements of dimension 2, its highest is 1: put what", ranks=[1])


class Conditions(Program):
    def test_a_part_of_the_body_that_nothing_holds(self):
        self.write_case({DISPLACEMENTS: HELD})
        line = self.case.read_text().splitlines().index('<ParameterList name="Displacements">') + 1
        self.assert_refused(
            f"plate.xml:{line}: /Boundary Conditions/Displacements: part 2 of 2 of the body (1 element, from (5, 0) to (6, 1)) can "
            "move as a whole: translation in x, translation in y, rotation; prescribe displacements against it",
            ranks=[1, 2, 4],
        )

    def test_motions_that_the_supports_leave_free(self):
        for held, free in [
            (displacement("x", "left", "x"), "translation in y"),
            (displacement("y", "left", "y"), "translation in x, rotation"),
            (displacement("x", "corner", "x") | displacement("y", "corner", "y"), "rotation"),
            ({}, "translation in x, translation in y, rotation"),
        ]:
            self.write_case({DISPLACEMENTS: held | APART_HELD})
            self.assert_refused(f"part 1 of 2 of the body (2 elements, from (0, 0) to (2, 1)) can move as a whole: {free};", ranks=[1])

    def test_contradictory_displacements(self):
        self.write_case({f"{DISPLACEMENTS}/pull": {"Group": "corner", "Component": "x", "Rate": 0.1}})
        self.assert_refused(
            "/Boundary Conditions/Displacements/pull: prescribes another x displacement than "
            "/Boundary Conditions/Displacements/x on 1 node that both groups have, the first at (0, 0)",
            ranks=[1, 4],
        )

    def test_all_that_does_not_fit_the_mesh_is_told_at_once(self):
        self.write_case({DISPLACEMENTS: HELD | displacement("pull", "corner", "x", 0.1) | displacement("push", "lefft", "y")})
        self.assert_refused(
            'no group of nodes called "lefft"; it has "apart", "corner", "left" - did you mean "left"?',
            "/Boundary Conditions/Displacements/pull: prescribes another x displacement than",
            "/Output/Probes/one/Points: (3, 0.5) is outside the body",
            options=settings("Output/Probes/one/Points={3, 0.5}"),
            ranks=[1, 4],
        )

    def test_groups_of_another_dimension(self):
        self.write_case({DISPLACEMENTS: HELD | displacement("all", "plate", "x"),
                         "Boundary Conditions/Tractions/t/Group": "corner"})
        self.assert_refused(
            'no group of nodes called "plate"; it has "apart", "corner", "left" ("plate" is a group of elements)',
            'no group of sides called "corner"; it has "apart", "left" ("corner" has nodes only)',
        )


class Horizons(Program):
    def test_one_that_ends_inside_the_elements(self):
        self.write_case({"Morphing/Seeds/tip/Shape": "Everything"})
        self.assertEqual(self.perimorph("check", self.case, *settings("Peridynamics/Horizon=0.71")).returncode, 0)
        self.assert_refused(
            '/Peridynamics/Horizon: found 0.4, but in the seed "tip" the element at (0.5, 0.5) reaches 0.707107 from its '
            "centre to its corners; allowed is no less than that",
            options=settings("Peridynamics/Horizon=0.4"),
            ranks=[1, 4],
        )


class Folders(Program):
    """Where results may not go."""

    def refused_output(self, output, *pieces):
        self.assert_refused(*pieces, command="run", options=["--output", output], ranks=[1, 4])

    def test_a_file_in_the_way(self):
        self.refused_output("plate.msh", "plate.msh: the output folder cannot be made")
        self.assertEqual((self.folder / "plate.msh").read_text(), MSH)

    def test_names_that_netcdf_reads_otherwise(self):
        for name in [" blank", "http://host/out", "[mode]file", "out#mode=zarr", " "]:
            run = self.perimorph("run", self.case, "--output", name, "--quiet")
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertTrue((self.folder / name / "plate.e").is_file(), name)

    def test_where_nothing_can_be_written(self):
        self.refused_output("/proc/perimorph", "/proc/perimorph: the output folder cannot be made")
        self.refused_output("/proc", "cannot be written")

    def test_results_never_replace_the_input(self):
        self.write_case({"Mesh/File": "plate.e", DISPLACEMENTS: HELD})
        self.write("plate.e", b"precious")
        self.refused_output(".", "plate.e: the results would replace the mesh")
        self.assertEqual((self.folder / "plate.e").read_bytes(), b"precious")
        (self.folder / "unfinished").mkdir()
        (self.folder / "plate.e").rename(self.folder / "unfinished/plate.e")
        self.write_case({"Mesh/File": "unfinished/plate.e", DISPLACEMENTS: HELD})
        self.refused_output(".", "plate.e: the results would replace the mesh")
        self.assertEqual((self.folder / "unfinished/plate.e").read_bytes(), b"precious")
        self.case = self.folder / "resolved.xml"
        self.write_case()
        before = self.case.read_text()
        self.refused_output(".", "resolved.xml: the results would replace the case")
        self.assertEqual(self.case.read_text(), before)

    def test_results_stay_in_their_folder(self):
        for name in ["..xml", "...xml"]:
            self.case = self.folder / name
            self.write_case()
            self.assert_refused(f"{name}: its name without .xml names the results", command="run")
        self.assertFalse((self.folder / "results").exists())


if __name__ == "__main__":
    unittest.main()
