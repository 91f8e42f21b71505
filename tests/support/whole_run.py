"""The plate with a growing crack, with all that a run can write, and comparisons of all of it to the last bit."""

import csv
import re
import subprocess

import netCDF4
import numpy

from fixture import EVERY, GrowingCrack, changed, text_of

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
        run = subprocess.run(self.command(*EVERY, *options, ranks=ranks, output=output), capture_output=True, text=True, timeout=100)
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
