"""What the studies share that make cases of their own and measure how they run."""

import collections
import csv
import os
import shutil
import subprocess
import sys
import time

from messages import fail
from runs import Log

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..", ".."))
TOOLS = os.path.join(ROOT, "tools")


def make_mesh(stem, geometry, *options, dimension=2):
    """<stem>.msh of gmsh's geometry, which is kept as <stem>.geo."""
    with open(stem + ".geo", "w") as out:
        out.write(geometry)
    command = ["gmsh", f"-{dimension}", "-v", "0", *options, stem + ".geo", "-o", stem + ".msh"]
    if subprocess.run(command, check=False).returncode != 0:
        fail(f"gmsh could not mesh {stem}.geo")


class Run(collections.namedtuple("Run", "status wall processor memory total_memory history phases topologies")):
    """Exit status; wall seconds, and processor seconds of all ranks, start and output included; memory in MiB of the rank
    with most, and of all ranks, None for a run that did not come to its end; the rows of history.csv; wall seconds of rank 0 by
    phase; how often neighbours were searched again."""

    @property
    def solving(self):
        """Wall seconds of set-up and solve: all but start, reading and writing."""
        return self.phases["total"] - self.phases["read"] - self.phases["write"]


def rows_of(output):
    """The complete rows of a history.csv that may still be written."""
    try:
        with open(os.path.join(output, "history.csv"), newline="") as file:
            return [row for row in csv.DictReader(file) if None not in row.values()]
    except FileNotFoundError:
        return []


def wait_until(is_enough, process, output):
    """Ends a run once is_enough(its rows); returns its status and usage, whether it was ended."""
    while True:
        pid, status, usage = os.wait4(process.pid, os.WNOHANG)
        if pid != 0:
            return status, usage, False
        time.sleep(0.1)
        if is_enough(rows_of(output)):
            process.kill()
            _, status, usage = os.wait4(process.pid, 0)
            return status, usage, True


def program(ranks, what, case, settings):
    """The command that runs or checks a case as tools/run would, without building."""
    command = ["bash", "-c", '. "$0"; exec $1 "$perimorph" "${@:2}"', os.path.join(TOOLS, "lib", "environment"),
               f"mpirun --quiet -n {ranks}" if ranks > 1 else "", what, case]
    return command + [part for setting in settings for part in ("--set", setting)]


def check(case, settings=()):
    """What perimorph check says of a case, on one rank."""
    done = subprocess.run(program(1, "check", case, settings), stdout=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{case}: the check ended with status {done.returncode}")
    return done.stdout


def run(case, output, ranks=1, settings=(), ends=(0,), is_enough=None, environment=None):
    """Runs a case as tools/run would, without building.

    settings: texts such as "Loading/Increments=1"; ends: the exit statuses that are no failure; is_enough: a run on one
    rank is ended once it says so of the rows; environment: more of its variables.
    """
    command = program(ranks, "run", case, settings) + ["--output", output, "--quiet", "--no-progress"]
    if is_enough:
        shutil.rmtree(output, ignore_errors=True)  # the rows of an earlier run would be taken for this one's
    # After an exit status other than 0 mpirun would wait a second.
    environment = dict(os.environ, OMPI_MCA_odls_base_sigkill_timeout="0", **(environment or {}))
    begin = time.monotonic()
    process = subprocess.Popen(command, env=environment)
    if is_enough:
        status, usage, was_enough = wait_until(is_enough, process, output)
    else:
        (_, status, usage), was_enough = os.wait4(process.pid, 0), False
    wall = time.monotonic() - begin
    status = os.waitstatus_to_exitcode(status)
    if status not in ends and not was_enough:
        sys.exit(f"{case}: the run ended with status {status}")
    history = rows_of(output)
    log = Log(output)
    phases = {row[0]: float(row[1]) for row in log.profile}
    topologies = next((int(row[3]) for row in log.profile if row[0] == "search"), 0)
    total_memory = next((float(line.split()[1]) * 1e6 / 2**20 for line in log.summary if line.startswith("memory ")), None)
    # Of children that have ended, the system keeps the memory of the largest.
    return Run(status, wall, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024, total_memory,
               history, phases, topologies)
