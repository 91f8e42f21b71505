"""Our solver, CHOLMOD, and PETSc's conjugate gradients with GAMG, on the same matrices and right-hand sides.

Square bodies with a peridynamic zone of a twentieth of their area, horizon 3 elements: intact, with a crack of 20 elements,
and while this crack advances by one element three times. From the crack on our solver and PETSc keep their preconditioner
and begin at the last solution, CHOLMOD keeps its symbolic analysis. All reduce the residual to 1e-8 of the load, on one
core; seconds of set-up and solution, without reading and assembling. Our operator is matrix-free, with multigrid from the
short-range matrix; the others get the coupled matrix.
"""

import json
import os
import subprocess
import sys
import tempfile

from tables import print_table

TARGETS = ["perimorph_systems", "perimorph_peer_cholmod", "perimorph_peer_petsc"]
STATES = ["intact", "cracked", "advanced"]


def costs(program, *arguments):
    """For each state the mean of what a program reports."""
    environment = dict(os.environ, OPENBLAS_NUM_THREADS="1")
    result = subprocess.run([program, *arguments], env=environment, check=False, stdout=subprocess.PIPE, text=True)
    if result.returncode != 0:
        sys.exit(f"benchmark: {os.path.basename(program)} ended with status {result.returncode}")
    reports = [json.loads(line) for line in result.stdout.splitlines()]
    worst = max(report["residual"] for report in reports)
    if worst > 1.1e-8:  # iterations update a residual that drifts from the true one by rounding
        sys.exit(f"benchmark: {os.path.basename(program)} left a residual of {worst:.1e}")

    def mean(state):
        these = [report for report in reports if report["state"] == state]
        return {key: sum(report[key] for report in these) / len(these) for key in ("set_up", "solve", "iterations", "work")}

    return {state: mean(state) for state in STATES}


def unknowns_in(folder):
    with open(os.path.join(folder, "load.mtx")) as file:
        file.readline()
        return int(file.readline().split()[0])


def check_that_all_agree(solutions):
    """Within what the tolerance leaves open."""
    for state in STATES:
        works = [solution[state]["work"] for solution in solutions]
        if max(works) - min(works) > 1e-5 * max(works):
            sys.exit(f"benchmark: the solutions differ: {', '.join(TARGETS)} find the loads' work to be {works}")


def cells(cost, ours):
    total = cost["set_up"] + cost["solve"]
    texts = [f"{cost['set_up']:.2f} + {cost['solve']:.2f}"]
    if cost["iterations"]:
        texts[0] += f", {cost['iterations']:.0f} its"
    if cost is not ours:
        texts.append(f"{total / (ours['set_up'] + ours['solve']):.1f}")
    return texts


def print_peers(programs, sides):
    """programs: the folder of the three programs."""
    rows = []
    for side in sides:
        with tempfile.TemporaryDirectory() as system:
            ours, *theirs = [costs(os.path.join(programs, name), system, *more)
                             for name, more in zip(TARGETS, ([str(side)], [], []))]
            unknowns = unknowns_in(system)
        check_that_all_agree([ours, *theirs])
        for state, text in zip(STATES, ("intact", "cracked", "a damage iteration")):
            rows.append([f"{unknowns}, {text}", *cells(ours[state], ours[state])]
                        + [text for peer in theirs for text in cells(peer[state], ours[state])])
    print_table(__doc__.strip(),
                ["unknowns, body", "ours [s]", "CHOLMOD [s]", "/ ours", "PETSc [s]", "/ ours"], rows)
