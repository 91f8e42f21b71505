"""Whether two runs have written the same, to the last bit: tables, fields, checkpoints. Seconds may differ."""

import collections
import csv
import itertools
import os
import re

import h5py
import netCDF4
import numpy

from runs import texts

SECONDS = "wall_seconds"  # a column of history.csv and a global variable of the Exodus files
RECORDS = ("qa_records", "info_records")  # of the Exodus files: program, date, resolved case
OF_SECONDS = {"results", "tables"}  # in checkpoints: seconds, and checksums of tables that have them


class Difference(collections.namedtuple("Difference", "file place first second")):
    """Where two runs differ first in a file: an increment and a column, a variable and an index, a line; both values."""

    def __str__(self):
        return f"{self.file}: {self.place}: {self.first} and {self.second}"


def first_unequal(one, other):
    """The index of the first entry of two arrays that differs in a bit, or None."""
    if one.dtype.kind == "f":
        one, other = (numpy.ascontiguousarray(array).view(f"u{array.dtype.itemsize}") for array in (one, other))
    unequal = numpy.argwhere(one != other)
    return tuple(int(i) for i in unequal[0]) if len(unequal) else None


def differing_array(name, one, other):
    """(place, value, value) of two arrays."""
    one, other = numpy.asarray(one), numpy.asarray(other)
    if (one.shape, one.dtype) != (other.shape, other.dtype):
        return f"{name}, its shape", (one.shape, str(one.dtype)), (other.shape, str(other.dtype))
    index = first_unequal(one, other)
    return None if index is None else (f"{name}{list(index)}", repr(one[index]), repr(other[index]))


def differing_names(what, one, other):
    """The first name that only one of two listings has."""
    for mine, others in itertools.zip_longest(one, other):
        if mine != others:
            return f"names of {what}", mine, others
    return None


# --- tables and other texts ---


def rows_of(path):
    with open(path, newline="") as file:
        return list(csv.reader(file))


def differing_tables(one, other):
    """By cells, so that the column can be named; the seconds are passed over."""
    rows, others = rows_of(one), rows_of(other)
    names = differing_names("columns", rows[0] if rows else [], others[0] if others else [])
    if names:
        return names
    for row, its in zip(rows[1:], others[1:]):
        if len(row) != len(its):
            return f"row of {row[0]}, its length", len(row), len(its)
        for column, mine, its_own in zip(rows[0], row, its):
            if mine != its_own and column != SECONDS:
                return f"increment {row[0]}, {column}", mine, its_own
    return None if len(rows) == len(others) else ("number of rows", len(rows) - 1, len(others) - 1)


def differing_lines(one, other):
    with open(one, "rb") as first, open(other, "rb") as second:
        for number, (mine, its) in enumerate(itertools.zip_longest(first, second), start=1):
            if mine != its:
                shorten = lambda line: None if line is None else line.decode(errors="replace").strip()[:120]
                return f"line {number}", shorten(mine), shorten(its)
    return None


# --- Exodus ---


def differing_globals(one, other):
    """Global variables by name, as far as they are no seconds."""
    names = [texts(data["name_glo_var"]) for data in (one, other)]
    difference = differing_names("global variables", *names)
    if difference:
        return difference
    values, others = (data["vals_glo_var"][:] for data in (one, other))
    if len(values) != len(others):
        return "number of steps", len(values), len(others)
    columns = [(name, at) for at, name in enumerate(names[0]) if name != SECONDS]
    found = (differing_array(f"global variable {name} at step", values[:, at], others[:, at]) for name, at in columns)
    return next(filter(None, found), None)


def differing_variables(one, other):
    for name in one.variables:
        if name in RECORDS or name == "vals_glo_var":
            continue
        difference = differing_array(name, one[name][:], other[name][:])
        if difference:
            return difference
    return differing_globals(one, other) if "vals_glo_var" in one.variables else None


def differing_fields(one, other):
    with netCDF4.Dataset(one) as first, netCDF4.Dataset(other) as second:
        for data in (first, second):
            data.set_auto_mask(False)
        attributes = lambda data: [f"{name} = {data.getncattr(name)}" for name in data.ncattrs()]
        return (differing_names("variables", sorted(first.variables), sorted(second.variables))
                or differing_names("attributes", attributes(first), attributes(second))
                or differing_variables(first, second))


# --- checkpoints ---


def differing_checkpoints(one, other):
    with h5py.File(one) as first, h5py.File(other) as second:
        names, problem = set(first), differing_names("data sets", sorted(first), sorted(second))
        if list(first["format"]) != list(second["format"]):  # of versions that write other data sets: what both have
            names, problem = (first.keys() & second.keys()) - {"format", "increment"}, None
            names = {name for name in names if len(first[name].shape) == len(second[name].shape)}
        found = (differing_array(name, first[name][()], second[name][()]) for name in sorted(names - OF_SECONDS))
        return problem or next(filter(None, found), None)


# --- folders ---

COMPARISONS = [(r"\.csv$", differing_tables), (r"\.h5$", differing_checkpoints), (r"\.e(-s\d+)?(\.\d+\.\d+)?$", differing_fields),
               (r"\.(vtp|xml)$", differing_lines)]


def comparison_of(name):
    return next((compare for pattern, compare in COMPARISONS if re.search(pattern, name)), None)


def files_of(folder, ignored):
    """What is compared, tables first: all that a run writes but its log, its mesh and what is ignored."""
    names = [name for name in os.listdir(folder) if comparison_of(name) and name not in ignored]
    return sorted(names, key=lambda name: (not name.endswith(".csv"), not name.endswith(".h5"), name))


def first_difference(one, other, ignored=()):
    """The first Difference between the folders of two runs, None if there is none. ignored: names of files."""
    names = differing_names("files", files_of(one, ignored), files_of(other, ignored))
    if names:
        return Difference(os.path.basename(other), *names)
    for name in files_of(one, ignored):
        found = comparison_of(name)(os.path.join(one, name), os.path.join(other, name))
        if found:
            return Difference(name, *found)
    return None
