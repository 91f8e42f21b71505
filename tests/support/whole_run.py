"""The plate with a growing crack, with all that a run can write, and comparisons of all of it to the last bit.

PERIMORPH_KILLS is how often tests with SIGKILL kill their run, on each number of ranks; 3 if it is not set.
"""

import contextlib
import csv
import os
import pathlib
import random
import re
import signal
import subprocess
import time

import netCDF4
import numpy

from fixture import EVERY, GrowingCrack, changed, settings, text_of

EXPORTS = {"Crack": True, "Bonds": [2, 13], "Probes": {"ahead": {"Points": [7.25, 6.25, 12, 6.25], "Divisions": 4}}}


def order_in_series(path):
    """Of spread files those of one rank after the other."""
    number, ranks, rank = re.fullmatch(r".*\.e(?:-s(\d+))?(?:\.(\d+)\.(\d+))?", path.name).groups(default="1")
    return int(ranks), int(rank), int(number)


def without_seconds(file):
    with open(file, newline="") as table:
        return [{name: value for name, value in row.items() if name != "wall_seconds"} for row in csv.DictReader(table)]


def steps_in(file):
    """(time, {variable: values}) of each step of an Exodus file, but for the seconds."""
    with netCDF4.Dataset(file) as data:
        data.set_auto_mask(False)
        seconds = text_of(data["name_glo_var"]).index("wall_seconds")
        for index, time in enumerate(data["time_whole"][:]):
            values = {name: data[name][index] for name in data.variables if name.startswith("vals_")}
            values["vals_glo_var"] = numpy.delete(values["vals_glo_var"], seconds)
            values["nodes"] = numpy.array([len(data.dimensions["num_nodes"])])
            yield float(time), values


class WholeRun(GrowingCrack):
    CASE = changed(GrowingCrack.CASE, {"Output": EXPORTS})

    def everything(self, output=None):
        """By name: all that a run leaves of its increments."""
        output = output or self.output
        found = {"steps": [step for file in sorted(output.glob("plate.e*"), key=order_in_series) for step in steps_in(file)],
                 "history.csv": without_seconds(output / "history.csv")}
        for file in [*output.glob("bonds-*.vtp"), *output.glob("[cp]r*.csv")]:
            found[file.name] = file.read_bytes()
        return found

    def whole(self, *options, ranks=1):
        """What comes out of a run that nothing disturbs."""
        output = self.folder / "whole"
        run = subprocess.run(self.command(*EVERY, *options, ranks=ranks, output=output), capture_output=True, text=True, timeout=250)
        self.assertEqual(run.returncode, 0, run.stderr)
        return self.everything(output)

    def difference(self, found, expected):
        """What differs, or ""."""
        if found.keys() != expected.keys():
            return f"files: {sorted(found.keys() ^ expected.keys())}"
        for name in expected.keys() - {"steps"}:
            if found[name] != expected[name]:
                return f"{name}: {len(found[name])} or {len(expected[name])} rows or bytes"
        if [time for time, _ in found["steps"]] != [time for time, _ in expected["steps"]]:
            return f"steps: {[time for time, _ in found['steps']]}, not {[time for time, _ in expected['steps']]}"
        for (time, one), (_, other) in zip(found["steps"], expected["steps"]):
            wrong = [name for name in other if name not in one or one[name].tobytes() != other[name].tobytes()]
            if wrong or one.keys() != other.keys():
                return f"step {time}: {wrong}"
        return ""

    def beginning(self, expected):
        """What a whole run had left when it had come as far as this one."""
        rows = expected["history.csv"][:len(without_seconds(self.output / "history.csv"))]
        last = int(rows[-1]["increment"])

        def until_then(name, content):
            if name.endswith(".vtp"):
                return content
            head, *lines = content.splitlines(keepends=True)
            return b"".join([head, *(line for line in lines if int(line.split(b",")[0]) <= last)])

        to_come = {f"bonds-{bonds:06d}.vtp" for bonds in self.CASE["Output"]["Bonds"] if bonds > last}
        files = {name: until_then(name, expected[name]) for name in expected.keys() - to_come - {"history.csv", "steps"}}
        return files | {"history.csv": rows, "steps": [step for step in expected["steps"] if step[0] <= last]}


def kill(run, ranks, chance):
    """Kills a run that may be over; on more than one rank one of them alone."""
    if ranks > 1 and run.poll() is None:
        of_mpirun = pathlib.Path(f"/proc/{run.pid}/task/{run.pid}/children").read_text().split()
        with contextlib.suppress(ProcessLookupError, IndexError):  # over by now, or not begun
            os.kill(int(chance.choice(of_mpirun)), signal.SIGKILL)
            run.wait(timeout=100)
    run.kill()
    run.wait()


class Killed:
    """With a whole run."""

    RANKS = [1]

    def test_killed_at_any_moment_it_loses_and_doubles_nothing(self):
        end, seed = self.CASE["Loading"]["Increments"], random.randrange(10**6)
        chance = random.Random(seed)
        for ranks in self.RANKS:
            expected = self.whole(ranks=ranks)
            begin = time.monotonic()
            self.assertEqual(self.start(*EVERY, ranks=ranks).wait(timeout=250), 0)
            duration = time.monotonic() - begin
            for n in range(int(os.environ.get("PERIMORPH_KILLS", 3))):
                with self.subTest(seed=seed, ranks=ranks, kill=n):
                    run = self.start(*EVERY, *(["--restart"] if n % 8 else []), ranks=ranks)  # now and then from the beginning
                    time.sleep(chance.uniform(0.2, 1) * duration)
                    kill(run, ranks, chance)
                    resumed = self.start(*EVERY, "--restart", *settings(f"Loading/Increments={chance.randint(end // 2, end)}"), ranks=ranks)
                    self.assertEqual(resumed.wait(timeout=250), 0, resumed.stderr.read())
                    self.assertEqual(self.difference(self.everything(), self.beginning(expected)), "")
            self.run_until(end, *EVERY, "--restart", ranks=ranks)
            self.assertEqual(self.difference(self.everything(), expected), "")
