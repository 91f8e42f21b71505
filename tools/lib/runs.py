"""What the Python tools know about the folder of a run: its history, its case, its log, its Exodus series."""

import collections
import csv
import functools
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

    def largest(self, name):
        """The largest magnitude in a column among those that are finite, or 0."""
        return max((abs(value) for value in self.columns[name] if math.isfinite(value)), default=0.0)

    def not_finite(self):
        """The columns with a value that is none, such as nan, and the first increment that has one."""
        rows = {name: next((row for row, value in enumerate(values) if not math.isfinite(value)), None)
                for name, values in self.columns.items()}
        found = {name: row for name, row in rows.items() if row is not None}
        return [f"{name} is not finite from row {row + 1} of history.csv on" for name, row in found.items()]

    def is_nonzero(self, name):
        return any(value != 0.0 for value in self.columns.get(name, []))

    def nonzero(self, prefix):
        """The columns with this prefix, without those that are only rounding errors beside the largest."""
        names = [name for name in self.columns if name.startswith(prefix) and self.is_nonzero(name)]
        largest = {name: self.largest(name) for name in names}
        return [name for name in names if largest[name] > 1e-5 * max(largest.values())]

    def moved(self):
        """The columns, without their prefix, of the groups and directions that the case moves; None if it is not known."""
        parameters = {path: value for path, value, _ in parameters_of(os.path.dirname(self.file) or ".")}
        section = "/Boundary Conditions/Displacements/"
        names = {path[len(section):].rpartition("/")[0] for path in parameters if path.startswith(section)}
        of = lambda name, what: parameters.get(f"{section}{name}/{what}", "0")
        moves = lambda name: float(of(name, "Rate")) != 0.0 or float(of(name, "Constant")) != 0.0
        # Along a direction they may move along any axis.
        along = lambda name: [of(name, "Component").replace(" ", "_")] if f"{section}{name}/Component" in parameters else "xyz"
        return {f"{of(name, 'Group')}_{c}" for name in names if moves(name) for c in along(name)} if parameters else None


def has_increments(folder):
    """Whether the history of a run has a whole row."""
    try:
        with open(os.path.join(folder, "history.csv"), encoding="utf-8") as stream:
            return stream.readline().endswith("\n") and stream.readline().endswith("\n")
    except OSError:
        return False


def curves_of(history, x=None, y=None):
    """Pairs of columns (x, y) to draw. A group that is not moved itself may share nodes with one that is: what it does
    there is no force-displacement curve."""
    x = x or ("measure" if "measure" in history.columns else None)
    if y:
        for name in y:
            history[name]
        return [(x or "load_factor", name) for name in y]
    reactions = history.nonzero("reaction_")
    if x:
        return [(x, name) for name in reactions or ["load_factor"]]
    displacements = {name: "displacement_" + name[len("reaction_"):] for name in reactions}
    moved = history.moved()
    pairs = [(displacements[name], name) for name in reactions if history.is_nonzero(displacements[name])
             and (moved is None or name[len("reaction_"):] in moved)]
    return pairs or [("load_factor", name) for name in reactions or ["elastic_energy"]]


def label(column):
    """reaction_top_y -> top, y"""
    for prefix in ("reaction_", "displacement_"):
        if column.startswith(prefix):
            name, _, component = column[len(prefix):].replace("_rotation_", "_rotation ").rpartition("_")
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
    """The rows worth a look: first break, largest drops of a reaction, end; in order, each once."""
    broken, forces = history["broken_bonds"], magnitudes(history, reaction)
    found = {}
    first = next((row for row, count in enumerate(broken) if count > 0), None)
    if first is not None:
        found[first] = "first break"
    drops = [(forces[row - 1] - forces[row], row) for row in range(1, len(forces))]
    n_drops, least = 3, 0.1 * history.largest(reaction)  # smaller drops are steps of steady growth
    for fall, row in sorted(drops, reverse=True)[:n_drops]:
        if least < fall < math.inf:
            text = f"drop from {forces[row - 1]:.4g} to {forces[row]:.4g}"
            found[row] = f"{found[row]}, {text}" if row in found else text
    found.setdefault(len(forces) - 1, "last increment")
    return [Event(row, found[row]) for row in sorted(found)]


def main_curve(history):
    """The pair of columns to show if there is room for one: the one with the largest reaction."""
    return max(curves_of(history), key=lambda curve: history.largest(curve[1]))


# --- resolved.xml and run.log ---


def planned_increments(parameters):
    """How many increments a run is to have, by its parameters; 0 if nobody knows, since they may be cut."""
    values = {path: value for path, value, _ in parameters}
    return 0 if "/Loading/Largest Break per Increment" in values else int(values.get("/Loading/Increments", 0))


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
        start = next((n for n, line in enumerate(lines) if line.split()[:2] == ["phase", "seconds"]), len(lines))
        # What ended the run stands between the last empty line and the profile.
        last_empty = max((n for n in range(start) if not lines[n]), default=start)
        self.head = lines[:next((n for n, line in enumerate(lines) if line.split()[:2] == ["step", "load"]), last_empty)]
        self.warnings = [line for line in lines if "warning" in line.lower()]
        ranks = re.search(r" on (\d+) ranks?$", "\n".join(self.head), re.MULTILINE)
        self.ranks = int(ranks.group(1)) if ranks else None
        self.profile = [row[:4] + [""] * (4 - len(row)) for row in map(str.split, lines[start + 1:]) if len(row) >= 3]
        self.is_over = bool(self.profile)
        summary = next((n for n, line in enumerate(lines) if line.startswith("broken bonds ")), None)
        self.summary = lines[summary:start] if summary is not None else []
        # A run that fails says why on the lines before its profile, and has no summary.
        self.error = " ".join(lines[last_empty:start]).strip() if self.is_over and summary is None else ""


# --- The Exodus series ---


def series_of(path, spread_first=False):
    """The files of the series, in order: each a list, of one file or of the spread ones (case.e.N.r) that stand for it.
    If there are both, the one file counts as long as no rank has written since, unless the spread ones are to come first."""
    first = path
    if os.path.isdir(path):
        candidates = sorted({re.sub(r"(\.e)\.\d+\.\d+$", r"\1", name)
                             for pattern in ("*.e", "*.e.[0-9]*.[0-9]*") for name in glob.glob(os.path.join(glob.escape(path), pattern))})
        if not candidates:
            fail(f"{path}: no Exodus file (*.e) in it")
        if len(candidates) > 1:
            fail(f"{path}: several series in it, name one of {', '.join(candidates)}")
        first = candidates[0]
    first = re.sub(r"(\.e)\.\d+\.\d+$", r"\1", first)
    if not files_of(first, spread_first):
        fail(f"{first}: no such file or directory; expected the directory of a run or its first Exodus file")
    later = {re.sub(r"\.\d+\.\d+$", "", name) for name in glob.glob(glob.escape(first) + "-s[0-9]*")}
    return [files_of(name, spread_first) for name in [first, *sorted(later)]]


def files_of(name, spread_first):
    """What stands for a file of the series: itself, or its spread files by rank; none if there is neither."""
    found = sorted(part for part in glob.glob(glob.escape(name) + ".[0-9]*.[0-9]*") if re.search(r"\.\d+\.\d+$", part))
    if os.path.isfile(name) and not (found and (spread_first or os.stat(name).st_mtime_ns < last_change(found))):
        return [name]
    if not found:
        return []
    ranks = int(found[0].split(".")[-2])
    parts = [f"{name}.{ranks}.{rank:0{len(str(ranks))}}" for rank in range(ranks)]
    if sorted(parts) != found:
        fail(f"{name}: the spread files {', '.join(map(os.path.basename, found))} are not those of one run; "
             f"expected {', '.join(map(os.path.basename, parts))}")
    return parts


def last_change(files):
    return max(os.stat(file).st_mtime_ns for file in files)


def texts(variable):
    """The texts that a netCDF variable of characters holds. (As text at once, letters of two bytes would shift all after them.)"""
    import netCDF4

    return [bytes(text).decode(errors="replace") for text in netCDF4.chartostring(variable[:], encoding="bytes").ravel()]


class ExodusFile:
    """One file of a series, or the spread files that stand for it as if they were joined: nodes by their number, blocks
    one after the other, elements in each by their number. Read by netCDF; needs python3-netcdf4."""

    def __init__(self, files):
        import netCDF4

        self.files = files
        self.name = re.sub(r"\.\d+\.\d+$", "", files[0])
        self.parts = []
        for file in files:
            try:
                self.parts.append(netCDF4.Dataset(file))
            except OSError as error:
                fail(f"{file}: not readable as an Exodus file: {error}")
            self.parts[-1].set_auto_mask(False)
        # Of a rank without elements there is nothing to see.
        self.parts = [part for part in self.parts if "num_nodes" in part.dimensions and len(part.dimensions["num_nodes"])]
        self.data = self.parts[0]  # for what is the same in all
        times = [part["time_whole"][:] if "time_whole" in part.variables else [] for part in self.parts]
        self.times = [float(time) for time in min(times, key=len)]  # one rank may be ahead of another

    def close(self):
        for part in self.parts:
            part.close()

    def records(self, variable):
        """A variable of texts: "qa_records" (program, version, date, time), "info_records" (the resolved case), names."""
        if variable not in self.data.variables:
            return []
        return texts(self.data[variable])

    def names(self, variable):
        return [text.strip("\0 ") for text in self.records(variable)]

    def block_ids(self):
        return [int(number) for number in self.data["eb_prop1"][:]]

    # Places in the joined file

    @functools.cached_property
    def nodes(self):
        """The numbers of all nodes, ascending, and for each where it stands first in the parts one after the other."""
        import numpy

        count = lambda part: len(part.dimensions["num_nodes"])
        maps = [part["node_num_map"][:] if "node_num_map" in part.variables else numpy.arange(1, count(part) + 1)
                for part in self.parts]
        return numpy.unique(numpy.concatenate(maps), return_index=True)

    def places_of_nodes(self, part):
        import numpy

        numbers = part["node_num_map"][:] if "node_num_map" in part.variables else self.nodes[0]
        return numpy.searchsorted(self.nodes[0], numbers)

    def nodal(self, variable, *index):
        import numpy

        return numpy.concatenate([part[variable][index or slice(None)] for part in self.parts])[self.nodes[1]]

    def block_sizes(self, part):
        names = [f"num_el_in_blk{block}" for block in range(1, len(self.block_ids()) + 1)]
        return [len(part.dimensions[name]) if name in part.dimensions else 0 for name in names]

    @functools.cached_property
    def ids_by_block(self):
        """For each block the numbers of its elements, part after part, and the order that sorts them."""
        import numpy

        pieces = [numpy.split(part["elem_num_map"][:], numpy.cumsum(self.block_sizes(part))[:-1]) for part in self.parts]
        blocks = [numpy.concatenate(block) for block in zip(*pieces)]
        return [(ids, numpy.argsort(ids, kind="stable") if len(self.parts) > 1 else slice(None)) for ids in blocks]

    def of_blocks(self, variable, *index):
        """A variable of each block's elements, named with {} in place of the block's place."""
        import numpy

        for block, (_, order) in enumerate(self.ids_by_block, start=1):
            parts = [part for part in self.parts if variable.format(block) in part.variables]
            yield numpy.concatenate([part[variable.format(block)][index or slice(None)] for part in parts])[order]

    # What is in the joined file

    def element_numbers(self):
        """Of all elements in the order of the blocks: the numbers of the mesh, from 1."""
        import numpy

        return numpy.concatenate([ids[order] for ids, order in self.ids_by_block])

    def coordinates(self):
        return [self.nodal(axis) for axis in ("coordx", "coordy", "coordz") if axis in self.data.variables]

    def connectivity(self):
        """For each block the nodes of its elements, from 0: an array (elements, corners)."""
        import numpy

        blocks = []
        for block, (_, order) in enumerate(self.ids_by_block, start=1):
            parts = [part for part in self.parts if f"connect{block}" in part.variables]
            blocks.append(numpy.concatenate([self.places_of_nodes(part)[part[f"connect{block}"][:] - 1] for part in parts])[order])
        return blocks

    def node_sets(self):
        """{name: places of its nodes, ascending}"""
        import numpy

        return {name: numpy.unique(numpy.concatenate(
                    [self.places_of_nodes(part)[part[f"node_ns{s}"][:] - 1] for part in self.parts if f"node_ns{s}" in part.variables]
                    or [numpy.empty(0, int)]))
                for s, name in enumerate(self.names("ns_names"), start=1)}

    def side_sets(self):
        """{name: [(place of the element, side from 1)], ascending}"""
        import numpy

        place = {int(number): at for at, number in enumerate(self.element_numbers())}
        return {name: sorted((place[int(part["elem_num_map"][element - 1])], int(side)) for part in self.parts
                             if f"elem_ss{s}" in part.variables
                             for element, side in zip(part[f"elem_ss{s}"][:], part[f"side_ss{s}"][:]))
                for s, name in enumerate(self.names("ss_names"), start=1)}

    def displacement(self, index):
        """One array per coordinate; zeros where there is none."""
        names = self.names("name_nod_var")
        wanted = [f"displacement_{axis}" for axis, _ in zip("xyz", self.coordinates())]
        return [self.nodal(f"vals_nod_var{names.index(name) + 1}", index) if name in names else 0.0 * x
                for name, x in zip(wanted, self.coordinates())]

    def values(self, field, index):
        """A field at one step: of all elements in the order of the blocks, or of all nodes."""
        import numpy

        element, nodal = self.names("name_elem_var"), self.names("name_nod_var")
        if field in element:
            return numpy.concatenate(list(self.of_blocks(f"vals_elem_var{element.index(field) + 1}eb{{}}", index)))
        if field == "displacement":
            return numpy.sqrt(sum(component**2 for component in self.displacement(index)))
        return self.nodal(f"vals_nod_var{nodal.index(field) + 1}", index)

    def global_value(self, name, index):
        names = self.names("name_glo_var")
        return float(self.data["vals_glo_var"][index][names.index(name)]) if name in names else None


def all_steps(files):
    """(file, index) of every increment, in order. A topology that changed during an increment may have left the same
    increment in two files: the later one counts."""
    return [place for _, place in sorted({file.times[index]: (file, index) for file in files
                                          for index in range(len(file.times))}.items())]


def find_step(files, step):
    """The file that has an increment, and its index there; of two files the later one, as in all_steps."""
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


# The element variable "class" from 0 on: name and colour.
CLASSES = {"FE": (0.78, 0.83, 0.88), "MORPH": (0.96, 0.72, 0.32), "PD": (0.42, 0.62, 0.80), "DGFE": (0.76, 0.20, 0.22)}
VIEW = (0.5, -0.75, 0.43)  # direction from the middle of a three-dimensional body to the viewer


def warp_factor(text, box, displacement):
    """A number, or for "auto" the one of 1, 2, 5, 10, ... that makes the largest displacement about 5 % of the body."""
    if text != "auto":
        try:
            return float(text)
        except ValueError:
            fail(f'--warp {text}: expected a factor, or "auto"')
    largest = max((float(abs(component).max()) for component in displacement), default=0.0)
    if largest == 0.0 or not math.isfinite(largest):
        return 1.0
    factor = 0.05 * max(high - low for low, high in box) / largest
    power = 10.0 ** math.floor(math.log10(factor))
    return power * max(digit for digit in (1, 2, 5) if digit * power <= factor * (1 + 1e-9))
