"""What the Python tools know about the folder of a run: its history, its case, its log, its Exodus series."""

import collections
import csv
import glob
import math
import os
import re
import xml.etree.ElementTree

from messages import fail, nearest


# --- history.csv ---


class History:
    """The columns of a history.csv as lists of numbers, and a name for the legend."""

    def __init__(self, path):
        self.file = os.path.join(path, "history.csv") if os.path.isdir(path) else path
        self.name = os.path.basename(os.path.dirname(os.path.abspath(self.file)))
        try:
            with open(self.file, newline="") as stream:
                rows = [row for row in csv.reader(stream) if row]
        except OSError as error:
            fail(f"{self.file}: {error.strerror}; expected the directory of a run or its history.csv")
        if len(rows) < 2:
            fail(f"{self.file}: no increments in it yet")
        self.columns = {name: [] for name in rows[0]}
        for number, row in enumerate(rows[1:], start=2):
            if len(row) != len(rows[0]):
                # The last line of a run that is being written, or that ended by force, may be incomplete.
                if number == len(rows):
                    break
                fail(f"{self.file}:{number}: {len(row)} values for {len(rows[0])} columns")
            for name, text in zip(rows[0], row):
                self.columns[name].append(self.number(text, number))
        if not self.columns[rows[0][0]]:
            fail(f"{self.file}: no complete increment in it yet")

    def number(self, text, line):
        try:
            return float(text)
        except ValueError:
            fail(f'{self.file}:{line}: "{text}" is not a number')

    def __getitem__(self, name):
        if name not in self.columns:
            fail(f'{self.file}: no column "{name}"; {nearest(name, list(self.columns))}')
        return self.columns[name]

    def is_nonzero(self, name):
        return any(value != 0.0 for value in self.columns.get(name, []))

    def nonzero(self, prefix):
        """Columns of that prefix that are not rounding errors beside the largest of them."""
        names = [name for name in self.columns if name.startswith(prefix) and self.is_nonzero(name)]
        largest = {name: max((abs(v) for v in self.columns[name] if math.isfinite(v)), default=0.0) for name in names}
        return [name for name in names if largest[name] > 1e-5 * max(largest.values())]


def curves_of(history, x=None, y=None):
    """Pairs of columns (x, y) to draw."""
    if y:
        for name in y:
            history[name]
        return [(x or "load_factor", name) for name in y]
    reactions = history.nonzero("reaction_")
    if x:
        return [(x, name) for name in reactions or ["load_factor"]]
    displacements = {name: "displacement_" + name[len("reaction_"):] for name in reactions}
    pairs = [(displacements[name], name) for name in reactions if history.is_nonzero(displacements[name])]
    return pairs or [("load_factor", name) for name in reactions or ["elastic_energy"]]


def label(column):
    """reaction_top_y -> top, y"""
    for prefix in ("reaction_", "displacement_"):
        if column.startswith(prefix):
            name, _, component = column[len(prefix):].rpartition("_")
            return f"{name}, {component}"
    return column.replace("_", " ")


def magnitudes(history, column):
    """A column; reactions and displacements without their sign, since compression is drawn like tension."""
    signed = column.startswith(("reaction_", "displacement_"))
    return [abs(value) if signed else value for value in history[column]]


def axis_label(columns):
    kinds = {column.split("_")[0] for column in columns if column.startswith(("reaction_", "displacement_"))}
    if len(kinds) == 1 and all(column.startswith(tuple(kinds)) for column in columns):
        where = f" ({label(next(iter(columns)))})" if len(columns) == 1 else ""
        return {"reaction": "|reaction force|", "displacement": "|prescribed displacement|"}[kinds.pop()] + where
    return ", ".join(sorted(column.replace("_", " ") for column in columns))


Event = collections.namedtuple("Event", "row text")


def events_of(history, reaction):
    """What to look at: the first break, the largest drops of a reaction, the end. In order, each row once."""
    broken, forces = history["broken_bonds"], magnitudes(history, reaction)
    found = {}
    first = next((row for row, count in enumerate(broken) if count > 0), None)
    if first is not None:
        found[first] = "first break"
    drops = [(forces[row - 1] - forces[row], row) for row in range(1, len(forces))]
    n_drops, least = 3, 0.1 * max(forces)  # smaller drops are stairs
    for fall, row in sorted(drops, reverse=True)[:n_drops]:
        if fall > least:
            text = f"drop from {forces[row - 1]:.4g} to {forces[row]:.4g}"
            found[row] = f"{found[row]}, {text}" if row in found else text
    found.setdefault(len(forces) - 1, "last increment")
    return [Event(row, found[row]) for row in sorted(found)]


def main_curve(history):
    """The pair of columns to show if there is room for one: the one with the largest reaction."""
    return max(curves_of(history), key=lambda curve: max(magnitudes(history, curve[1])))


# --- resolved.xml and run.log ---


def parameters_of(folder):
    """[(path, value, whether it is the default)] of resolved.xml; none if there is no such file yet."""
    file = os.path.join(folder, "resolved.xml")
    try:
        root = xml.etree.ElementTree.parse(file).getroot()
    except (OSError, xml.etree.ElementTree.ParseError):
        return []

    def listing(element, path):
        for child in element:
            here = f"{path}/{child.get('name')}"
            if child.tag == "Parameter":
                yield here, short_numbers(child.get("value")), child.get("isDefault") == "true"
            elif child.tag == "ParameterList":
                yield from listing(child, here)

    return list(listing(root, ""))


def short_numbers(text):
    """Numbers as people write them: 3.33333333333333315e-01 -> 0.333333."""
    return re.sub(r"-?\d\.\d{10,}e[+-]\d+", lambda number: f"{float(number.group()):.6g}", text)


class Log:
    """run.log: what it says before the table of increments, warnings, the profile, and how the run ended."""

    def __init__(self, folder):
        try:
            with open(os.path.join(folder, "run.log"), encoding="utf-8", errors="replace") as stream:
                lines = stream.read().splitlines()
        except OSError:
            lines = []
        table = next((n for n, line in enumerate(lines) if line.split()[:2] == ["step", "load"]), len(lines))
        self.head = lines[:table]
        self.warnings = [line for line in lines if "warning" in line.lower()]
        ranks = re.search(r" on (\d+) ranks?$", "\n".join(self.head), re.MULTILINE)
        self.ranks = int(ranks.group(1)) if ranks else None
        start = next((n for n, line in enumerate(lines) if line.split()[:2] == ["phase", "seconds"]), len(lines))
        self.profile = [row[:4] + [""] * (4 - len(row)) for row in map(str.split, lines[start + 1:]) if len(row) >= 3]
        self.is_over = bool(self.profile)
        summary = next((n for n, line in enumerate(lines) if line.startswith("broken bonds ")), None)
        self.summary = lines[summary:start] if summary is not None else []
        # A run that fails says why on the lines before its profile, and has no summary.
        self.error = " ".join(lines[lines.index(""):start]).strip() if self.is_over and summary is None and "" in lines else ""


# --- The Exodus series ---


def series_of(path):
    """The files of the series, in order."""
    first = path
    if os.path.isdir(path):
        candidates = sorted(glob.glob(os.path.join(glob.escape(path), "*.e")))
        if not candidates:
            fail(f"{path}: no Exodus file (*.e) in it")
        if len(candidates) > 1:
            fail(f"{path}: several series in it, name one of {', '.join(candidates)}")
        first = candidates[0]
    if not os.path.isfile(first):
        fail(f"{first}: no such file or directory; expected the directory of a run or its first Exodus file")
    return [first] + sorted(glob.glob(glob.escape(first) + "-s[0-9]*"))


class ExodusFile:
    """One file of a series, read by netCDF; needs python3-netcdf4."""

    def __init__(self, name):
        import netCDF4

        self.name = name
        try:
            self.data = netCDF4.Dataset(name)
            self.data.set_auto_mask(False)
        except OSError as error:
            fail(f"{name}: not readable as an Exodus file: {error}")
        self.times = [float(time) for time in self.data["time_whole"][:]] if "time_whole" in self.data.variables else []

    def records(self, variable):
        """A variable of texts: "qa_records" (program, version, date, time), "info_records" (the resolved case), names."""
        import netCDF4

        if variable not in self.data.variables:
            return []
        return [str(text) for text in netCDF4.chartostring(self.data[variable][:]).ravel()]

    def names(self, variable):
        return [text.strip("\0 ") for text in self.records(variable)]

    def block_ids(self):
        return [int(number) for number in self.data["eb_prop1"][:]]

    def coordinates(self):
        return [self.data[axis][:] for axis in ("coordx", "coordy", "coordz") if axis in self.data.variables]

    def connectivity(self):
        """For each block the nodes of its elements, from 0: an array (elements, corners)."""
        return [self.data[f"connect{block}"][:] - 1 for block in range(1, len(self.data.dimensions["num_el_blk"]) + 1)]

    def displacement(self, index):
        """One array per coordinate; zeros where there is none."""
        names = self.names("name_nod_var")
        wanted = [f"displacement_{axis}" for axis, _ in zip("xyz", self.coordinates())]
        return [self.data[f"vals_nod_var{names.index(name) + 1}"][index] if name in names else 0.0 * x
                for name, x in zip(wanted, self.coordinates())]

    def values(self, field, index):
        """A field at one step: of all elements in the order of the blocks, or of all nodes."""
        import numpy

        element, nodal = self.names("name_elem_var"), self.names("name_nod_var")
        if field in element:
            number = element.index(field) + 1
            blocks = range(1, len(self.data.dimensions["num_el_blk"]) + 1)
            return numpy.concatenate([self.data[f"vals_elem_var{number}eb{block}"][index] for block in blocks])
        if field == "displacement":
            return numpy.sqrt(sum(component**2 for component in self.displacement(index)))
        return self.data[f"vals_nod_var{nodal.index(field) + 1}"][index]

    def global_value(self, name, index):
        names = self.names("name_glo_var")
        return float(self.data["vals_glo_var"][index][names.index(name)]) if name in names else None


def all_steps(files):
    """(file, index) of every increment, in order. A topology that changed during an increment may have left the same
    increment in two files: the later one counts."""
    return [place for _, place in sorted({file.times[index]: (file, index) for file in files
                                          for index in range(len(file.times))}.items())]


def find_step(files, step):
    """The file and the index in it of an increment. A topology that changed during an increment may have left the same
    increment in two files: the later one counts."""
    known = sorted({time for file in files for time in file.times})
    if not known:
        fail(f"{files[0].name}: no steps in it yet")
    try:
        wanted = known[-1] if step == "last" else float(step)
    except ValueError:
        fail(f'--step {step}: expected the number of an increment, or "last"')
    for file in reversed(files):
        for index in reversed(range(len(file.times))):
            if math.isclose(file.times[index], wanted, rel_tol=1e-9, abs_tol=1e-12):
                return file, index
    near = ", ".join(f"{time:g}" for time in sorted(sorted(known, key=lambda time: abs(time - wanted))[:4]))
    fail(f"--step {step}: not written; nearest are {near} (of {known[0]:g} to {known[-1]:g})")


def warp_factor(text, box, displacement):
    """A number, or for "auto" the one of 1, 2, 5, 10, ... that makes the largest displacement about 5 % of the body."""
    if text != "auto":
        try:
            return float(text)
        except ValueError:
            fail(f'--warp {text}: expected a factor, or "auto"')
    largest = max((float(abs(component).max()) for component in displacement), default=0.0)
    if largest == 0.0:
        return 1.0
    factor = 0.05 * max(high - low for low, high in box) / largest
    power = 10.0 ** math.floor(math.log10(factor))
    return power * max(digit for digit in (1, 2, 5) if digit * power <= factor * (1 + 1e-9))
