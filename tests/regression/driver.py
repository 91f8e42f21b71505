"""The program itself, from a case file and a mesh to files, messages and exit status.

    driver.py PERIMORPH MPIEXEC
"""

import os
import pathlib
import pty
import re
import subprocess
import sys
import unittest
import xml.etree.ElementTree

import netCDF4
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from fixture import CASE, N, PERIMORPH, ROOT, Plate, changed, msh, settings, text_of


class Runs(Plate):
    def test_ends_with_status_0_and_everything_on_disk(self):
        for ranks in [1, 2]:
            with self.subTest(ranks=ranks):
                run = self.run_case(ranks=ranks)

                self.assertEqual(run.returncode, 0, run.stderr)
                for name in ["history.csv", "resolved.xml", "run.log", "plate.e"]:
                    self.assertTrue((self.output / name).is_file(), name)
                rows = self.history()
                self.assertEqual([float(row["increment"]) for row in rows], [1, 2, 3])
                self.assertEqual([float(row["load_factor"]) for row in rows], [1, 2, 3])
                self.assertEqual([float(row["broken_bonds"]) for row in rows[:2]], [0, 0])
                self.assertGreater(float(rows[2]["broken_bonds"]), 0)
                self.assertGreater(float(rows[2]["dgfe_elements"]), 0)
                self.assertGreater(float(rows[2]["unknowns"]), float(rows[1]["unknowns"]))
                log = (self.output / "run.log").read_text()
                self.assertIn("first in step 3", log)
                total, most = map(int, re.search(r"memory +(\d+) MB in all, (\d+) MB on the rank with most", log).groups())
                self.assertGreaterEqual(most, 10)  # the libraries alone
                self.assertLessEqual(most, total)
                self.assertLessEqual(total, ranks * (most + 1))  # both are rounded

    def test_reactions_balance_and_are_proportional_until_the_first_break(self):
        self.assertEqual(self.run_case().returncode, 0)
        rows = [{key: float(value) for key, value in row.items()} for row in self.history()]

        reaction = lambda row, group: row[f"reaction_{group}_y"]
        self.assertGreater(reaction(rows[0], "upper"), 0)
        for row in rows:
            forces = [reaction(row, group) for group in ["upper", "lower", "right"]]
            # The solver's tolerance, 1e-8 of the reactions, on some hundred free nodes.
            self.assertLess(abs(sum(forces)), 1e-6 * abs(forces[0]))
        # Seven digits are written.
        self.assertAlmostEqual(reaction(rows[1], "upper") / reaction(rows[0], "upper"), 2, places=5)
        self.assertLess(reaction(rows[2], "upper"), 3 * reaction(rows[0], "upper"))

    def test_forces_and_energies_are_those_of_the_whole_thickness(self):
        def outcome(*options):
            run = self.run_case("--quiet", *options)
            self.assertEqual(run.returncode, 0, run.stderr)
            with netCDF4.Dataset(self.series()[-1]) as file:
                names = text_of(file["name_elem_var"])
                energies = [file[f"vals_elem_var{names.index('energy') + 1}eb{b + 1}"][-1].data for b in range(len(file.dimensions["num_el_blk"]))
                            if f"vals_elem_var{names.index('energy') + 1}eb{b + 1}" in file.variables]
            return [{name: value for name, value in row.items() if name != "wall_seconds"} for row in self.history()], numpy.concatenate(energies)

        rows, energies = outcome()
        of_one, energies_of_one = outcome(*settings("Mesh/Thickness=1"))
        thick, energies_of_thick = outcome(*settings("Mesh/Thickness=2.5"))
        self.assertEqual(rows, of_one)
        numpy.testing.assert_array_equal(energies, energies_of_one)
        numpy.testing.assert_allclose(energies_of_thick, 2.5 * energies, rtol=1e-14)
        for row, thicker in zip(rows, thick, strict=True):
            for name, value in row.items():
                if name.startswith("reaction_") or name in ["elastic_energy", "dissipated_energy", "external_work", "jump_loss"]:
                    # Ten digits are written; what is next to nothing is the difference of others.
                    scale = float(rows[-1]["external_work"])
                    self.assertAlmostEqual(float(thicker[name]), 2.5 * float(value), delta=1e-8 * scale, msg=name)
                else:
                    self.assertEqual(thicker[name], value, name)

    def test_increments_before_the_first_break_cost_no_solve(self):
        rates = [f"Boundary Conditions/Displacements/pull {way}/Rate={rate}" for way, rate in [("up", 0.02), ("down", -0.02)]]
        self.assertEqual(self.run_case(*settings(*rates, "Loading/Increments=20")).returncode, 0)

        rows = self.history()
        self.assertEqual([int(row["broken_bonds"]) for row in rows], [0] * 20)
        solves = [int(row["linear_solves"]) for row in rows]
        self.assertIn(solves[0], [1, 2, 3])
        self.assertEqual(solves[1:], [0] * 19)
        with netCDF4.Dataset(self.output / "plate.e") as file:
            self.assertEqual(len(file["time_whole"]), 20)

    def test_the_exodus_series_reads_back(self):
        self.assertEqual(self.run_case(ranks=2).returncode, 0)
        rows = self.history()

        times = []
        for part in self.series():
            with netCDF4.Dataset(part) as file:
                times += list(file["time_whole"][:])
                elements = sum(len(d) for name, d in file.dimensions.items() if name.startswith("num_el_in_blk"))
                self.assertEqual(elements, N * N)
                self.assertEqual(len(file.dimensions["num_nodes"]) * 2, float(rows[len(times) - 1]["unknowns"]))
                self.assertEqual(text_of(file["name_nod_var"]), ["displacement_x", "displacement_y"])
                for name in ["alpha", "damage", "class", "energy", "stress_xx", "stress_yy", "stress_xy"]:
                    self.assertIn(name, text_of(file["name_elem_var"]))
                for name in ["load_factor", "broken_bonds", "elastic_energy", "reaction_upper_y"]:
                    self.assertIn(name, text_of(file["name_glo_var"]))
        self.assertEqual(times, [1, 2, 3])
        self.assertGreater(len(self.series()), 1)

        with netCDF4.Dataset(self.series()[0]) as first, netCDF4.Dataset(self.series()[-1]) as last:
            self.assertEqual(text_of(first["eb_names"]), ["body_FE", "body_MORPH", "body_PD"])
            self.assertIn("body_DGFE", text_of(last["eb_names"]))
            height = first["coordy"][:]
            self.assertEqual((height.min(), height.max()), (0, N))
            u = first["vals_nod_var2"][1]
            self.assertAlmostEqual(u.max(), 0.4)  # the corners: rate 0.2, second increment
            self.assertAlmostEqual(u.min(), -0.4)

    def test_the_fields_of_a_heated_body_say_by_how_much_it_expands(self):
        self.write_case({"Material/Thermal Expansion": 1e-5, "Boundary Conditions/Temperatures": {
            "cold": {"Rate": -20.0, "Direction": [0.0, 1.0], "Positions": [0.0, 12.0], "Factors": [1.0, 0.0]}}})
        self.assertEqual(self.run_case(ranks=2).returncode, 0)
        with netCDF4.Dataset(self.series()[0]) as file:
            place = text_of(file["name_elem_var"]).index("eigenstrain") + 1
            blocks = range(1, len(text_of(file["eb_names"])) + 1)
            values = numpy.concatenate([file[f"vals_elem_var{place}eb{block}"][0] for block in blocks
                                        if f"vals_elem_var{place}eb{block}" in file.variables])
        self.assertEqual(len(values), N * N)
        self.assertAlmostEqual(values.min(), -2e-4 * 11.5 / 12, places=12)
        self.assertAlmostEqual(values.max(), -2e-4 * 0.5 / 12, places=12)

    def test_the_exodus_files_carry_program_and_case(self):
        self.assertEqual(self.run_case().returncode, 0)
        resolved = xml.etree.ElementTree.parse(self.output / "resolved.xml").getroot()
        values = lambda root: [(p.get("name"), p.get("value")) for p in root.iter("Parameter")]

        self.assertGreater(len(self.series()), 1)
        for part in self.series():
            with netCDF4.Dataset(part) as file:
                program, version, date, time = text_of(file["qa_records"][0])
                # Lines of more than 79 characters are split: joined again they are the resolved case.
                case = xml.etree.ElementTree.fromstring("".join(text_of(file["info_records"])))
            self.assertEqual(program, "perimorph")
            self.assertRegex(f"{version} {date} {time}", r"^\d+\.\d+\.\d+ \d{4}-\d\d-\d\d \d\d:\d\d:\d\d$")
            self.assertEqual(values(case), values(resolved))

            dump = subprocess.run(["ncdump", "-v", "qa_records,time_whole", part], capture_output=True, text=True, timeout=30)
            self.assertEqual(dump.returncode, 0, dump.stderr)
            self.assertIn('"perimorph"', dump.stdout)

    def test_a_blocks_name_has_one_id_in_the_whole_series(self):
        self.assertEqual(self.run_case().returncode, 0)
        found = set()
        for part in self.series():
            with netCDF4.Dataset(part) as file:
                found |= set(zip(text_of(file["eb_names"]), map(int, file["eb_prop1"][:])))
        self.assertEqual(found, {("body_FE", 11), ("body_MORPH", 12), ("body_PD", 13), ("body_DGFE", 14)})

    def test_a_terminal_shows_progress_with_what_is_left(self):
        terminal, end = pty.openpty()
        run = subprocess.Popen([PERIMORPH, "run", self.case, "--output", self.output], stdout=end, stderr=end)
        os.close(end)
        shown = b""
        try:
            while piece := os.read(terminal, 4096):
                shown += piece
        except OSError:  # the other end is closed
            pass
        os.close(terminal)
        self.assertEqual(run.wait(timeout=60), 0)
        self.assertRegex(shown.decode(), r"\r\x1b\[K\[=*> *\] step 3/3: \d+ solves, \d+ broken bonds, at this pace \d+ s left")

    def test_crack_faces_that_overlap_are_told(self):
        pressed = settings("Boundary Conditions/Displacements/pull up/Rate=-0.02", "Boundary Conditions/Displacements/pull down/Rate=0.02")
        for ranks in [1, 2]:
            with self.subTest(ranks=ranks):
                self.assertEqual(self.run_case(ranks=ranks).returncode, 0)
                self.assertEqual([float(row["overlap"]) for row in self.history()], [0, 0, 0])
                self.assertNotIn("overlap", (self.output / "run.log").read_text())

                self.assertEqual(self.run_case(*pressed, ranks=ranks).returncode, 0)
                overlaps = [float(row["overlap"]) for row in self.history()]
                # The corners approach each other by 0.04 an increment; the mouth between them follows.
                for increment, overlap in enumerate(overlaps, 1):
                    self.assertGreater(overlap, increment * 0.02)
                    self.assertLess(overlap, increment * 0.04)
                self.assertEqual((self.output / "run.log").read_text().count("crack faces overlap, by"), 1)

    def test_two_ranks_write_the_history_and_fields_of_one(self):
        self.assertEqual(self.run_case().returncode, 0)
        one, displacement = self.history(), self.displacement_by_place()
        self.assertEqual(self.run_case(ranks=2).returncode, 0)

        for row, other in zip(one, self.history(), strict=True):
            for name in ["broken_bonds", "damaged_elements", "dgfe_elements", "unknowns"]:
                self.assertEqual(row[name], other[name])
            self.assertAlmostEqual(float(row["reaction_upper_y"]) / float(other["reaction_upper_y"]), 1, places=6)
        # 0.4 at the corners; the solver's tolerance, 1e-8, times a condition number of some hundreds.
        numpy.testing.assert_allclose(self.displacement_by_place(), displacement, atol=1e-5)

    def displacement_by_place(self):
        """Displacement in the second increment at all nodes, sorted by place (the slit's faces by displacement)."""
        with netCDF4.Dataset(self.series()[0]) as file:
            columns = [file[name][:] for name in ["coordx", "coordy"]] + [file[f"vals_nod_var{c}"][1] for c in [1, 2]]
        return numpy.array(sorted(zip(*(numpy.round(c, 7) for c in columns))))

    def test_overrides_of_the_command_line_reach_the_run_and_the_resolved_case(self):
        run = self.run_case("--set", "Loading/Increments=1", "--set", "Solver/Tolerance=1e-6", "--quiet")

        self.assertEqual((run.returncode, run.stdout), (0, ""), run.stderr)
        self.assertEqual(len(self.history()), 1)
        parameters = {p.get("name"): p.get("value") for p in xml.etree.ElementTree.parse(self.output / "resolved.xml").iter()}
        self.assertEqual((parameters["Increments"], float(parameters["Tolerance"])), ("1", 1e-6))

    def test_a_resolved_case_runs_to_the_same_history(self):
        self.assertEqual(self.run_case("--set", "Loading/Increments=1").returncode, 0)
        first = self.history()
        (self.folder / "again.xml").write_text((self.output / "resolved.xml").read_text())

        run = self.perimorph("run", self.folder / "again.xml", "--output", self.output)

        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(self.history()[0]["elastic_energy"], first[0]["elastic_energy"])


class UserErrors(Plate):
    """Status 2 on any number of ranks, with a message that says where and what, printed once."""

    def assert_refused(self, run, *pieces):
        self.assertEqual(run.returncode, 2, run.stderr)
        for piece in pieces:
            self.assertEqual(run.stderr.count(piece), 1, run.stderr)
        self.assertNotIn("bug", run.stderr)

    def test_a_case_file_that_is_not_there(self):
        for ranks in [1, 2]:
            with self.subTest(ranks=ranks):
                self.assert_refused(self.perimorph("run", "nowhere.xml", ranks=ranks), "perimorph: nowhere.xml")

    def test_a_mesh_that_is_not_there(self):
        (self.folder / "plate.msh").unlink()
        for ranks in [1, 2]:
            with self.subTest(ranks=ranks):
                self.assert_refused(self.run_case(ranks=ranks), "plate.msh")

    def test_a_group_that_the_mesh_does_not_have(self):
        self.write_case({"Boundary Conditions/Displacements/hold x/Group": "rihgt"})
        for ranks in [1, 2]:
            with self.subTest(ranks=ranks):
                self.assert_refused(
                    self.run_case("--set", "Output/Reactions={upper}", ranks=ranks),
                    "/Boundary Conditions/Displacements/hold x/Group",
                    'no group of nodes called "rihgt"',
                    'it has "lower", "right", "upper" - did you mean "right"?',
                )

    def test_a_poissons_ratio_that_no_solid_has(self):
        self.write_case({"Material/Poisson's Ratio": 0.7})
        for ranks in [1, 2]:
            with self.subTest(ranks=ranks):
                self.assert_refused(self.run_case(ranks=ranks), "/Material/Poisson's Ratio", "0.7")

    def test_a_command_that_does_not_exist(self):
        self.assertEqual(self.perimorph("rnu", self.case).returncode, 2)


def bar_mesh():
    """12 by 4 squares of 1 between the edges "left" and "right"."""
    node = lambda i, j: j * 13 + i + 1
    nodes = [(node(i, j), i, j, 0) for j in range(5) for i in range(13)]
    elements = [(1, group, [node(i, j), node(i, j + 1)]) for group, i in [(1, 0), (2, 12)] for j in range(4)]
    elements += [(3, 3, [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)]) for j in range(4) for i in range(12)]
    return msh(['1 1 "left"', '1 2 "right"', '2 3 "body"'], nodes, elements)


class ComputationErrors(Plate):
    """Status 3, and everything up to the last accepted increment on disk, and the next one as it was before it failed."""

    def test_a_solver_that_does_not_converge(self):
        for ranks in [1, 2]:
            with self.subTest(ranks=ranks):
                run = self.run_case(
                    "--set", "Solver/Maximum Iterations=1", "--set", "Solver/Tolerance=1e-15", ranks=ranks
                )

                self.assertEqual(run.returncode, 3, run.stderr)
                self.assertIn("the forces do not balance", run.stderr)
                self.assertIn("the forces do not balance", (self.output / "run.log").read_text())
                self.assertEqual(self.history(), [])
                self.assertTrue((self.output / "resolved.xml").is_file())

    def test_a_limit_in_the_third_increment_leaves_the_first_two(self):
        for ranks in [1, 2]:
            with self.subTest(ranks=ranks):
                run = self.run_case("--set", "Loading/Maximum Damage Iterations=1", ranks=ranks)

                self.assertEqual(run.returncode, 3, run.stderr)
                self.assertIn("increment 3: more than 1 solves; /Loading/Maximum Damage Iterations", run.stderr)
                self.assertEqual([float(row["increment"]) for row in self.history()], [1, 2])
                with netCDF4.Dataset(self.output / "plate.e") as file:
                    self.assertEqual(list(file["time_whole"][:]), [1, 2])
                with netCDF4.Dataset(self.unfinished) as file:
                    self.assertEqual(list(file["time_whole"][:]), [3])
                    self.assertAlmostEqual(file["vals_nod_var2"][0].max(), 0.6)

                notes = self.unfinished.parent / "notes"
                notes.write_text("of somebody else")
                run = self.run_case("--restart", ranks=ranks)
                self.assertEqual(run.returncode, 0, run.stderr)
                self.assertEqual(len(self.history()), 3)
                self.assertFalse(self.unfinished.exists())
                self.assertTrue(notes.exists())


class PartedBar(Plate):
    """A notched bar that breaks in two under a traction."""

    MESH = bar_mesh()
    CASE = changed(CASE, {
        "Morphing/Seeds": {"middle": {"Center": [6, 2], "Inner Radius": 4.0, "Outer Radius": 4.5}},
        "Pre-Cracks": {"notch": {"Points": [6, 3, 6, 4]}},
        "Boundary Conditions": {
            "Displacements": {f"hold {c}": {"Group": "left", "Component": c} for c in "xy"},
            "Tractions": {"pull": {"Group": "right", "Rate": [10.0, 0.0]}},
        },
        "Loading/Increments": 10,
    })

    def test_it_ends_with_the_free_part_and_leaves_the_crack(self):
        for ranks, spread in [(1, False), (2, False), (2, True)]:
            with self.subTest(ranks=ranks, spread=spread):
                run = self.run_case("--set", f"Output/Spread Files={str(spread).lower()}", ranks=ranks)

                self.assertEqual(run.returncode, 3, run.stderr)
                found = re.search(r"no equilibrium was found: only bonds beyond the critical stretch hold the part of "
                                  r"\d+ of \d+ nodes around \((.*), .*\) against a load of \((.*), .*\)\n", run.stderr)
                self.assertTrue(found, run.stderr)
                self.assertGreater(float(found[1]), 6)
                increment = len(self.history()) + 1
                self.assertAlmostEqual(float(found[2]), increment * 10 * 4, places=3)
                self.assertIn(f"unfinished       increment {increment}, as it was before it failed: {self.unfinished}",
                              (self.output / "run.log").read_text())
                self.assertTrue(any(self.output.glob("checkpoint*")))
                files = [f"{self.unfinished}.2.{rank}" for rank in range(2)] if spread else [self.unfinished]
                sides = 0
                for name in files:
                    with netCDF4.Dataset(name) as file:
                        self.assertEqual(list(file["time_whole"][:]), [increment])
                        place = text_of(file["ss_names"]).index("broken_surface") + 1
                        sides += len(file.dimensions.get(f"num_side_ss{place}", []))
                self.assertGreaterEqual(sides, 6)  # two faces of a crack through three elements at least


class OtherCommands(Plate):
    def test_check_says_what_the_case_would_cost_and_leaves_nothing(self):
        run = self.perimorph("check", self.case)

        self.assertEqual(run.returncode, 0, run.stderr)
        # 13 x 13 nodes and 5 more along the slit: its mouth and four inside; the tip is closed.
        for piece in ["144 elements, 174 nodes", "348 unknowns", "bonds", "memory"]:
            self.assertIn(piece, run.stdout)
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["plate.msh", "plate.xml"])

    def test_params_prints_every_parameter(self):
        run = self.perimorph("params")

        self.assertEqual(run.returncode, 0)
        for path in ["/Material/Young's Modulus", "/Loading/Increments", "/Morphing/Seeds/*/Center", "/Output/Every"]:
            self.assertIn(f"\n{path}\n", run.stdout)

    def test_the_page_of_parameters_is_current(self):
        run = self.perimorph("params", "--markdown")

        self.assertEqual(run.returncode, 0, run.stderr)
        page = ROOT / "packages/PARAMETERS.md"
        self.assertEqual(page.read_text(), run.stdout, f"renew it: perimorph params --markdown > {page}")


if __name__ == "__main__":
    unittest.main()
