"""What a solve sends and reads in each of its parts: counted by a library that is loaded before MPI's."""

import csv
import os

from cases import ROOT, run
from tables import print_table

PROFILER = "perimorph_mpi_counts"  # its target; tests/benchmarks/mpi_counts.cpp
LIBRARY = os.path.join(ROOT, "build", "tests", "benchmarks", f"lib{PROFILER}.so")
OTHER_PARTS = {0: "conjugate gradients", 1: "operator"}


class Counts:
    """Those of one run, by part; `part` is a number as the library writes it, `count` the name of a column."""

    def __init__(self, file):
        with open(file, newline="") as stream:
            self.parts = {int(row["part"]): row for row in csv.DictReader(stream)}
        self.iterations = self.value(1, "visits_max")  # each applies the operator once

    def value(self, part, count):
        return float(self.parts[part][count])

    def each(self, part, count):
        """In one iteration."""
        return self.value(part, count) / self.iterations

    def total(self, count):
        """Of all parts, in one iteration."""
        return sum(self.each(part, count) for part in self.parts)


def name(part):
    return OTHER_PARTS.get(part, f"level {part - len(OTHER_PARTS)}")


def count(case, folder, ranks, settings=()):
    """The counts of a run, and the row of its last increment."""
    stem = os.path.join(folder, f"{os.path.splitext(os.path.basename(case))[0]}-{ranks}")
    done = run(case, stem, ranks, settings,
               environment={"LD_PRELOAD": LIBRARY, "PERIMORPH_MPI_COUNTS": stem + ".csv"})
    return Counts(stem + ".csv"), done.history[-1]


def print_counts(title, counts, last, ranks):
    """One table of one run."""
    def row(label, value):
        mean = value("bytes_read_sum") / ranks
        return [label, f"{value('visits_max'):.0f}" if label != "all" else "",
                *(f"{value(column):.0f}" for column in ("messages_max", "messages_sum")),
                f"{value('bytes_max') / 1e3:.1f}", f"{value('reductions_max'):.0f}",
                f"{value('bytes_read_max') / 1e6:.3f}", f"{value('bytes_read_max') / mean:.2f}" if mean else ""]

    rows = [row(name(part), lambda column, part=part: counts.each(part, column)) for part in sorted(counts.parts)]
    rows.append(row("all", counts.total))
    print_table(f"{title}, {last['unknowns']} unknowns on {ranks} ranks: one of {last['cg_iterations']} iterations; of the "
                "rank with most, unless it says all.",
                ["part", "visits", "messages", "of all ranks", "kB sent", "reductions", "MB read", "over the mean"], rows)


def print_sums(models, ranks, sums):
    """One table of all runs. @param sums {(model, ranks): (counts, last row)}"""
    rows = []
    for model in models:
        for n in ranks:
            counts, last = sums[model, n]
            rows.append([model, last["unknowns"], str(n), last["cg_iterations"],
                         *(f"{counts.total(column):.0f}" for column in ("messages_max", "messages_sum", "reductions_max")),
                         f"{counts.total('bytes_max') / 1e3:.1f}",
                         f"{counts.total('bytes_read_max') * n / counts.total('bytes_read_sum'):.2f}"])
    print_table("Of one iteration, all parts together.",
                ["model", "unknowns", "ranks", "iterations", "messages of a rank", "of all ranks", "reductions", "kB of a rank",
                 "work over the mean"], rows)
