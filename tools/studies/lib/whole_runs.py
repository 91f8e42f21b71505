"""Whole runs of the program, for tools/studies/benchmark: what their tables are made of."""

import collections
import glob
import os
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from concurrent.futures import ThreadPoolExecutor
from functools import partial

import numpy as np

from cases import ROOT, TOOLS, check, make_mesh, run
from fields import distances_between_paths, last_damage
from messages import need
from squares import POLICIES, cube, side_for, square
from tables import print_table

DOUBLE_NOTCH = os.path.join(ROOT, "inputs", "double_edge_notched_plate", "double_edge_notched_plate.xml")
EXAMPLES_THAT_BREAK = ["brazilian_disk", "notched_plate_hole_h10", "notched_plate_hole_h15", "notched_beam",
                       "double_edge_notched_plate"]
STOPPED_AT_A_LIMIT = 3  # exit status


def ratio(value, other):
    return f"{value / other:.2f}"


def measured(case, folder, ranks, **options):
    """A run, announced as a table comes only when all are done."""
    name = os.path.splitext(os.path.basename(case))[0]
    print(f"{name} on {ranks} rank{'s' if ranks > 1 else ''}", file=sys.stderr)
    return run(case, os.path.join(folder, f"{name}-{ranks}"), ranks, **options)


def two_at_once(case, folder):
    """The slower of two runs on one rank each, started together. Nothing joins them: two ranks cannot be much faster."""
    with ThreadPoolExecutor() as pool:
        return max(pool.map(lambda copy: run(case, os.path.join(folder, f"copy-{copy}")), range(2)),
                   key=lambda one: one.solving)


def fastest(run_of, choices, rounds=3):
    """For each choice the one of some runs that set up and solved fastest. Choices take turns: a machine's pace changes."""
    found = [[run_of(choice) for choice in choices] for _ in range(rounds)]
    return [min(runs, key=lambda one: one.solving) for runs in zip(*found)]


def iterations(last, before):
    """Those of a run's last row, and how many more they are than on the mesh before."""
    count = int(last["cg_iterations"])
    growth = f" ({100 * (count / int(before['cg_iterations']) - 1):+.0f} %)" if before else ""
    return f"{count} in {last['linear_solves']}{growth}"


def print_iterations(folder, scale):
    """Growth of the iterations with the mesh."""
    sizes = [scale * unknowns for unknowns in (50e3, 200e3, 800e3)]
    rows = []
    for model, policy in [("FE only", POLICIES[0])] + [(m, p) for m in ("hybrid", "all peridynamic") for p in POLICIES]:
        runs = [measured(square(folder, side_for(n, model, policy), model, policy), folder, 2).history[-1] for n in sizes]
        cells = [model if model == "FE only" else f"{model}, {policy}"]
        for last, before in zip(runs, [None] + runs):
            cells.append(f"{last['unknowns']}: {iterations(last, before)}")
        rows.append(cells)
    print_table("Unknowns: CG iterations to 1e-6 in so many solves, 2 ranks. Target: at most 15 % more from one mesh to "
                "the next.",
                ["model", "first mesh", "second", "third"], rows)


def print_zone(folder, scale):
    """What a small peridynamic zone costs."""
    n = side_for(1e6 * scale)
    models = ("FE only", "hybrid")
    runs = dict(zip(models, fastest(lambda model: measured(square(folder, n, model), folder, 2), models)))
    finite = runs["FE only"]
    rows = []
    for model, one in runs.items():
        phases = one.phases
        rows.append([model, one.history[-1]["cg_iterations"],
                     *(f"{phases[p]:.2f}" for p in ("search", "assemble", "preconditioner", "CG")),
                     f"{one.solving:.2f}", ratio(one.solving, finite.solving), ratio(one.wall, finite.wall),
                     f"{one.memory:.0f}"])
    print_table(f"{finite.history[-1]['unknowns']} unknowns, 5 % of the area peridynamic, elastic, 2 ranks; wall seconds, "
                "the fastest of three runs. Set-up and solve is all but start, reading and writing. Target: 1.5 times FE only.",
                ["model", "iterations", "search", "assemble", "preconditioner", "CG", "set-up and solve", "/ FE only",
                 "whole run / FE only", "MB per rank"], rows)


def print_ranks(folder, scale):
    """Speed-up by ranks, and whether they agree."""
    rows = []
    for model, unknowns in (("FE only", 8e5), ("hybrid", 8e5), ("all peridynamic", 2e5)):
        case = square(folder, side_for(scale * unknowns), model)
        *runs, copies = fastest(lambda choose: choose(case, folder),
                                [partial(measured, ranks=ranks) for ranks in (1, 2, 4)] + [two_at_once])
        energies = [float(one.history[-1]["elastic_energy"]) for one in runs]
        rows.append([f"{model}, {runs[0].history[-1]['unknowns']}", *(f"{one.solving:.2f}" for one in runs),
                     ratio(runs[0].solving, runs[1].solving), ratio(2 * runs[0].solving, copies.solving),
                     ratio(runs[0].wall, runs[1].wall),
                     " ".join(one.history[-1]["cg_iterations"] for one in runs),
                     f"{max(abs(e / energies[0] - 1) for e in energies):.0e}"])
    print_table("Elastic, wall seconds of set-up and solve on 1, 2 and 4 ranks, the fastest of three runs. Target: 2 ranks "
                "1.7 times faster than 1; 4 agree. The machine's own limit: what two runs on one rank, started together, get "
                "done in the time of one.",
                ["model, unknowns", "1", "2", "4", "1 / 2", "machine's limit", "whole run, 1 / 2", "iterations", "energies differ by"], rows)


def double_notch(folder, name, seeds=None):
    """The case, with its mesh made already, so that both runs have the same."""
    case = ElementTree.parse(DOUBLE_NOTCH)
    mesh = os.path.join(folder, "double_notch")
    if not os.path.exists(mesh + ".msh"):
        with open(os.path.splitext(DOUBLE_NOTCH)[0] + ".geo") as geometry:
            make_mesh(mesh, geometry.read())
    case.find("./ParameterList[@name='Mesh']/Parameter[@name='File']").set("value", os.path.abspath(mesh + ".msh"))
    if seeds is not None:
        morphing = case.find("./ParameterList[@name='Morphing']")
        morphing.remove(morphing.find("./ParameterList[@name='Seeds']"))
        morphing.append(ElementTree.fromstring(seeds))
    file = os.path.join(folder, name + ".xml")
    case.write(file)
    return file


COARSE_NOTCH = ["Mesh/File=" + DOUBLE_NOTCH.replace(".xml", "_coarse.geo"), "Mesh/Refinement/Levels=2"]


def print_notch(folder, scale):
    """What the hybrid model saves in a run with fracture, and a mesh that is fine only where its zone is."""
    everywhere = ('<ParameterList name="Seeds"><ParameterList name="body"><Parameter name="Shape" type="string" '
                  'value="Everything"/></ParameterList></ParameterList>')
    iterations = max(1, round(50 * scale))
    models = {"hybrid": (None, []), "all peridynamic": (everywhere, []), "hybrid, refined": (None, COARSE_NOTCH)}

    def run_of(model):
        seeds, settings = models[model]
        return measured(double_notch(folder, "notch-" + re.sub("[, ]+", "-", model), seeds), folder, 2, ends=(STOPPED_AT_A_LIMIT,),
                        settings=[f"Loading/Maximum Damage Iterations={iterations}", *settings])

    runs = dict(zip(models, fastest(run_of, models)))
    hybrid = runs["hybrid"]
    rows = [[model, one.history[-1]["unknowns"], one.history[-1]["increment"], f"{one.wall:.1f}", f"{one.solving:.1f}",
             ratio(one.wall, hybrid.wall), ratio(one.solving, hybrid.solving), f"{one.memory:.0f}",
             ratio(one.memory, hybrid.memory)] for model, one in runs.items()]
    print_table(f"Double notch, up to the first increment with {iterations} damage iterations, 2 ranks; the "
                "fastest of three runs. Targets: all peridynamic takes 10 times longer and 4 times more memory; 20 and 6 times "
                "those of the refined mesh.",
                ["model", "unknowns", "increments done", "wall [s]", "set-up and solve [s]", "wall / hybrid",
                 "set-up and solve / hybrid", "MB per rank", "/ hybrid"], rows)


def print_examples(folder, scale):
    """All of inputs/, from the first increment to the last."""
    rows = []
    for case in sorted(glob.glob(os.path.join(ROOT, "inputs", "*", "*.xml"))):
        one = measured(case, folder, 2, ends=(0, STOPPED_AT_A_LIMIT))
        name, last = os.path.splitext(os.path.basename(case))[0], one.history[-1]
        longest = sorted((s, p) for p, s in one.phases.items() if p != "total")[:-4:-1]
        others = one.solving - one.phases["CG"]
        rows.append([name, last["increment"] + (", then stopped" if one.status else ""), last["broken_bonds"],
                     f"{one.wall:.1f}", f"{one.processor:.1f}", f"{one.memory:.0f}",
                     ", ".join(f"{phase} {seconds:.0f}" for seconds, phase in longest), ratio(others, one.phases["CG"]),
                     ratio(others / one.topologies, float(one.history[0]["wall_seconds"]))])
    print_table("The examples on 2 ranks. Targets: two minutes of wall time for each in two dimensions; all but CG takes less "
                "than CG; a change of topology, even if all of that is its cost, less than two first increments.",
                ["case", "increments", "broken bonds", "wall [s]", "processor [s]", "MB per rank", "longest phases [s]",
                 "all but CG / CG", "for each topology / first increment"], rows)


def print_cubes(folder, scale):
    """A hybrid cube of a hundred thousand and of a million unknowns."""
    for horizon, form in ((2.0, "Matrix-Free"), (3.0, "Matrix-Free"), (3.0, "On-the-Fly")):
        rows, before = [], None
        for unknowns in (1e5, 1e6):
            case = cube(folder, side_for(scale * unknowns, dimension=3), "hybrid", horizon=horizon)
            one = measured(case, folder, 2, settings=[f"Solver/Operator={form}"])
            last, phases = one.history[-1], one.phases
            rows.append([last["unknowns"], iterations(last, before),
                         *(f"{phases[p]:.1f}" for p in ("read", "search", "assemble", "preconditioner", "CG")),
                         f"{one.solving:.1f}", f"{one.wall:.1f}", f"{one.total_memory / 1024:.2f}"])
            before = last
        print_table(f"Hybrid cubes, 5 % of the volume peridynamic, horizon {horizon:g} elements, {form}, elastic, 2 ranks; wall "
                    "seconds. Targets for a million unknowns: 60 s of set-up and solve, 8 GiB, at most 20 % more iterations.",
                    ["unknowns", "CG iterations", "read", "search", "assemble", "preconditioner", "CG", "set-up and solve",
                     "whole run", "GiB, both ranks"], rows)


def print_operators(folder, scale):
    """Memory and time of the operator in its three forms."""
    rows = []
    for policy, size in zip(POLICIES, (1e4, 1.2e4)):
        n = side_for(scale * size, "all peridynamic", policy, dimension=3)
        case = cube(folder, n, "all peridynamic", policy)
        for form in ("CRS", "Matrix-Free", "On-the-Fly"):
            setting = [f"Solver/Operator={form}"]
            printed = check(case, setting)
            unknowns, bonds, memory = (int(re.search(r"(\d+) " + thing, printed).group(1))
                                       for thing in ("unknowns", "MB for bonds", "MB for the operator"))
            of_crs = memory if form == "CRS" else of_crs
            one = run(case, os.path.join(folder, f"operator-{form}"), settings=setting)
            iteration = 1000 * one.phases["CG"] / int(one.history[-1]["cg_iterations"])
            rows.append([policy, f"{n}^3", str(unknowns), form, str(bonds), str(memory), f"1/{of_crs / memory:.1f}",
                         f"{iteration:.1f}"])
    print_table("All-peridynamic cubes, horizon 3 elements, 1 rank. Target for the operator: a tenth of CRS.",
                ["discontinuous elements", "elements", "unknowns", "Operator", "bonds [MB]", "operator [MB]", "/ CRS",
                 "CG iteration [ms]"], rows)


def print_three_dimensions(folder, scale):
    print_operators(folder, scale)
    print_cubes(folder, scale)


def print_tolerance(folder, scale):
    """Whether looser solutions break other bonds, up to the unstable jump."""
    rows = []
    for name in EXAMPLES_THAT_BREAK:
        case = glob.glob(os.path.join(ROOT, "inputs", "*", name + ".xml"))[0]
        for tolerance in ("1e-6", "1e-4", "1e-3"):
            print(f"{name}, {tolerance}", file=sys.stderr)
            output = os.path.join(folder, f"{name}-{tolerance}")
            one = run(case, output, 2, ends=(0, STOPPED_AT_A_LIMIT), settings=[
                "Loading/Maximum Damage Iterations=100", f"Solver/Damage Tolerance={tolerance}"])
            compared = subprocess.run([os.path.join(TOOLS, "compare-runs"), os.path.join(folder, f"{name}-1e-6"), output],
                                      check=False, stdout=subprocess.DEVNULL)
            rows.append([name, tolerance, one.history[-1]["increment"], one.history[-1]["broken_bonds"],
                         "the same" if compared.returncode == 0 else "OTHER",
                         str(sum(int(row["cg_iterations"]) for row in one.history))])
    print_table("Bonds broken with the default Damage Tolerance, 1e-4, a tighter and a looser one, up to the first increment that "
                "takes more than 100 solves, 2 ranks; in every increment and element compared with 1e-6.",
                ["case", "Damage Tolerance", "last increment", "broken bonds", "as with 1e-6", "CG iterations"], rows)


def print_windows(folder, scale):
    """What windows save where a body is large beside them."""
    case = os.path.join(ROOT, "inputs", "single_edge_block", "single_edge_block_fine.xml")
    solves = max(1, round(200 * scale))
    choices = ("Off", "On")
    runs = fastest(lambda choice: measured(case, os.path.join(folder, choice), 2, ends=(STOPPED_AT_A_LIMIT,), settings=[
        f"Loading/Maximum Damage Iterations={solves}", f"Solver/Windows={choice}"]), choices)
    whole = runs[0]
    rows = []
    for choice, one in zip(choices, runs):
        last = one.history[-1]
        rows.append([choice, last["unknowns"], last["increment"], last["broken_bonds"],
                     str(sum(int(row["cg_iterations"]) for row in one.history)),
                     *(text for phase in ("CG", "preconditioner")
                       for text in (f"{one.phases[phase]:.1f}", ratio(one.phases[phase], whole.phases[phase]))),
                     f"{one.wall:.1f}", ratio(one.wall, whole.wall)])
    print_table(f"Fine block, up to the first increment with {solves} damage iterations, 2 ranks; the fastest of three runs. "
                "Iterations are those of the whole body, in the increments that were done. Targets: 0.35 of CG's seconds, and of the whole run.",
                ["Windows", "unknowns", "increments done", "broken bonds", "iterations", "CG [s]", "/ Off", "preconditioner [s]",
                 "/ Off", "wall [s]", "/ Off"], rows)


FromCoarse = collections.namedtuple("FromCoarse", "case settings force")  # force: a column of history.csv


def coarse(name, levels, force, *settings, stem=None):
    """An example from its coarse mesh."""
    case = glob.glob(os.path.join(ROOT, "inputs", "*", name + ".xml"))[0]
    return FromCoarse(case, [f"Mesh/File={stem or name}_coarse.geo", f"Mesh/Refinement/Levels={levels}", *settings], force)


COARSE_DOUBLE_NOTCH = coarse("double_edge_notched_plate", 2, "reaction_top_y", "Loading/Increments=24")
MARGINS = {"fine everywhere": "Mesh/Refinement/Margin=100000", "refined": "Mesh/Refinement/Margin=3"}
COARSE_ROOTS = [coarse("notched_beam", 2, "reaction_top_left_y",
                       "Mesh/Refinement/Groups={bottom_left, bottom_right, top_left, top_right}"),
                *(coarse(f"notched_plate_hole_h{h}", 1, "reaction_top_y") for h in (10, 15)),
                coarse("brazilian_disk", 2, "reaction_top_y", "Mesh/Refinement/Groups={top, bottom}")]


def forces_before_the_break(one, example):
    return np.array([float(row[example.force]) for row in one.history if row["broken_bonds"] == "0"])


def damage_at_the_end(output, one):
    """At the last increment, or where the run was stopped within one."""
    return last_damage(os.path.join(output, "unfinished") if one.status else output)


def beside_fine(one, fine, what):
    return f"{what(one):.1f}", ratio(what(one), what(fine))


def refined_rows(folder, example, solves, ranks, rounds):
    """An example on both meshes, fine everywhere and refined, up to an increment with so many damage iterations."""
    name = os.path.splitext(os.path.basename(example.case))[0]
    folders = {mesh: os.path.join(folder, mesh.replace(" ", "-")) for mesh in MARGINS}
    runs = fastest(lambda mesh: measured(example.case, folders[mesh], ranks, ends=(0, STOPPED_AT_A_LIMIT), settings=[
        *example.settings, MARGINS[mesh], f"Loading/Maximum Damage Iterations={solves}"]), MARGINS, rounds)
    paths = [damage_at_the_end(os.path.join(folders[mesh], f"{name}-{ranks}"), one) for mesh, one in zip(MARGINS, runs)]
    fine, fine_forces, fine_path = runs[0], forces_before_the_break(runs[0], example), paths[0]
    for mesh, one, path in zip(MARGINS, runs, paths):
        forces = forces_before_the_break(one, example)
        common = min(len(forces), len(fine_forces))
        differ = np.abs(forces[:common] - fine_forces[:common]).max() / np.abs(fine_forces).max()
        gaps = distances_between_paths(path, fine_path)
        yield [name, mesh, one.history[0]["unknowns"], one.history[-1]["unknowns"], str(len(forces) + 1), f"{forces[-1]:.6g}",
               f"{100 * differ:.3f} %", one.history[-1]["increment"] + (", then stopped" if one.status else ""),
               str(np.count_nonzero(path.values)), f"{gaps.mean():.2f}, {gaps.max():.1f}" if gaps.size else "",
               *beside_fine(one, fine, lambda run: run.wall), *beside_fine(one, fine, lambda run: run.processor),
               *beside_fine(one, fine, lambda run: run.memory)]


def print_refined(title, rows):
    print_table(title, ["case", "mesh", "unknowns, first", "last", "first break in", "force before it", "forces differ by", "increments done",
                        "damaged elements", "apart in the mean, at most [elements]", "wall [s]", "/ fine", "processor [s]", "/ fine",
                        "MB per rank", "/ fine"], rows)


def print_refinement(folder, scale):
    """What it saves that only the zone is fine, against meshes that are as fine everywhere."""
    cases = [(COARSE_DOUBLE_NOTCH, 1000),
             (coarse("single_edge_block_fine", 2, "reaction_top_y", stem="single_edge_block"), 200)]
    print_refined("From elements four times as large, refined where the zone is and as fine everywhere, 2 ranks; the fastest of three runs. Targets: "
                  "0.5 (double notch) and 0.4 (block) of the time, 0.35 of the block's memory; forces within 0.1 % before the jump.",
                  [row for example, solves in cases
                   for row in refined_rows(folder, example, max(1, round(scale * solves)), ranks=2, rounds=3)])


def print_coarse_roots(folder, scale):
    """The other examples from coarse meshes: whether refined ones break as those that are as fine everywhere."""
    print_refined("From elements four times (beam, disk) and twice (plates) as large, refined where the zone is and as fine everywhere, 1 rank, "
                  "one run each. Targets: the same step of the first break, forces within 0.1 % before it, damaged elements within one "
                  "of the other run's in the mean.",
                  [row for example in COARSE_ROOTS
                   for row in refined_rows(folder, example, max(1, round(scale * 20000)), ranks=1, rounds=1)])


def print_phase_field(folder, scale):
    """The program beside a phase field."""
    need("matplotlib")  # no other table needs it
    import phase_field_runs

    phase_field_runs.print_table_of_bodies(folder, scale)


TABLES = {"iterations": print_iterations, "zone": print_zone, "ranks": print_ranks, "notch": print_notch,
          "examples": print_examples, "tolerance": print_tolerance,
          "three_dimensions": print_three_dimensions, "windows": print_windows, "refinement": print_refinement,
          "coarse_roots": print_coarse_roots, "phase_field": print_phase_field}
