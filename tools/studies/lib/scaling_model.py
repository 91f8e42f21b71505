"""What an iteration takes on many ranks: a model of few terms, fitted to what was counted on few (message_counts.py).

A part of an iteration (vectors, operator, a level of multigrid) takes, on the rank with most of it,
  work        bytes read / rate of a core with it; a core reads what does not fit in its cache no faster than its memory
  messages    exchanges x latency + messages x overhead + bytes sent / bandwidth
  reductions  each log2(ranks) x (latency + overhead)
one after the other. An exchange sends a message to each neighbour. A rank's rows are a square: what it sends grows with
the square root of them, and what it reads beyond its share likewise, but for a fixed imbalance.
"""

import collections
import math

import numpy as np

BLOCK = 3  # rows of an aggregate: rigid motions of the plane
SMALLEST = 100  # of so few rows no coarser level is made
MOST_LEVELS = 10  # MueLu's default
SWEEPS_ON_COARSEST = 20
FEWEST_UNKNOWNS = 20000  # of fewer, iterations say little about more
VECTOR_BYTES = 18 * 8  # of an unknown: vectors that Belos' conjugate gradients read and write

# seconds, seconds, bytes a second, bytes a second, bytes; all of one rank or core
Machine = collections.namedtuple("Machine", "latency overhead bandwidth memory cache")

# How coarse levels are made and visited; by default as the program does it. aggregates: after a level has been gathered, among
# the rows of those that hold it ("across" the ranks of before); "within" ranks, also where they have but one each, so that levels
# get no coarser; the same, but the levels end there ("stop"). doubled: levels down to this one are visited twice for each visit
# to the one above, those below once.
Variant = collections.namedtuple("Variant", "aggregates doubled rows_per_rank", defaults=("across", 99, 500))

# Of one counted run. parts: {number of message_counts: {column: number}}
Counted = collections.namedtuple("Counted", "model ranks unknowns iterations parts")

# One level: rows of all ranks and of the fullest; how often an iteration visits it; whether it is no coarser than the last
Level = collections.namedtuple("Level", "rows holders fullest visits stalled")

# Seconds of an iteration, by part; messages and bytes read of the rank with most; whether not all ranks hold any
Cost = collections.namedtuple("Cost", "part work messages reductions n_messages n_read is_gathered")


def levels(unknowns, ranks, width, variant):
    """All levels. width: nodes along a side of an aggregate of the finest; it is 3 on the others."""
    rows, holders, visits = float(unknowns), ranks, 1
    result = [Level(rows, ranks, rows / ranks, 1, False)]
    while rows > SMALLEST and len(result) < MOST_LEVELS:
        coarsening = holders if variant.aggregates == "across" else ranks
        nodes = rows / coarsening / (2 if len(result) == 1 else BLOCK)
        along = math.sqrt(nodes) / (width if len(result) == 1 else 3)
        coarse = BLOCK * coarsening * max(1, math.ceil(along - 0.05)) ** 2
        stalled = coarse > 0.8 * rows
        if stalled and variant.aggregates == "stop":
            break
        rows = min(float(coarse), rows)
        holders = min(max(int(rows // variant.rows_per_rank), 1), holders)
        if len(result) <= variant.doubled:
            visits *= 2
        result.append(Level(rows, holders, rows / ranks * math.ceil(ranks / holders), visits, stalled))
    if 2 <= len(result) <= variant.doubled + 1:  # a second visit to the coarsest would find it solved
        result[-1] = result[-1]._replace(visits=result[-1].visits // 2)
    return result


def at(table, ranks):
    """A table's value for this many ranks, on a straight line over the logarithm; beyond its ends the last."""
    known = sorted(table)
    return float(np.interp(math.log(ranks), np.log(known), [table[n] for n in known]))


class Model:
    """What one model (FE only, ...) reads, sends and needs; fitted to counted runs. Of those on one rank the middle one says
    what an unknown reads, and how fast a core is with it."""

    def __init__(self, runs):
        self.runs = runs
        alone = sorted((run for run in runs if run.ranks == 1), key=lambda run: run.unknowns)
        self.alone = alone = alone[len(alone) // 2]
        many = [run for run in runs if run.ranks >= 4]
        first = alone.parts[3]["rows_sum"] / BLOCK
        self.width = math.sqrt(alone.unknowns / 2 / first)
        self.read = {"vectors": VECTOR_BYTES, "operator": per_row(alone, 1), "finest": per_row(alone, 2)}
        self.read.update(self.of_coarse_levels())
        self.rate = rates(alone)
        self.neighbours = {run.ranks: max(per_visit(other, 1, "messages_max") for other in runs if other.ranks == run.ranks)
                           for run in runs}
        largest = max(runs, key=lambda run: run.ranks)
        self.reductions = per_iteration(largest, 0, "reductions_max")
        self.sent = {name: max((per_visit(run, part, "bytes_max") / math.sqrt(run.parts[part]["rows_max"])
                                for run in many for part in numbers if held(run, part) > 1), default=0.0)
                     for name, numbers in (("operator", [1]), ("finest", [2]), ("coarse", [3]))}
        self.imbalance = {name: self.imbalance_of(part, many) for name, part in (("operator", 1), ("finest", 2))}
        large = [run for run in runs if run.unknowns >= FEWEST_UNKNOWNS]
        self.growth = fitted([[1.0, math.log10(run.unknowns)] for run in large], [run.iterations for run in large])

    def of_coarse_levels(self):
        found = {"coarse": [], "stalled": [], "coarsest": []}
        for run in self.runs:
            last = max(run.parts)
            for part in range(3, last + 1):
                stalled = run.parts[part]["rows_sum"] > 0.8 * run.parts[part - 1]["rows_sum"]
                kind = "stalled" if stalled and part < last else "coarsest" if part == last else "coarse"
                if not (stalled and part == last):
                    found[kind].append(per_row(run, part))
        mean = {kind: float(np.median(values)) for kind, values in found.items() if values}
        return {"stalled": mean["coarse"]} | mean

    def imbalance_of(self, part, runs):
        """(fixed, times the square root of a rank's unknowns): what the fullest rank reads beyond its share."""
        name = {1: "operator", 2: "finest"}[part]
        share = [run.unknowns / run.ranks for run in runs]
        beyond = [per_visit(run, part, "bytes_read_max") / (self.read[name] * n) - 1 for run, n in zip(runs, share)]
        return fitted([[1.0, 1 / math.sqrt(n)] for n in share], beyond)

    def iterations(self, unknowns):
        constant, slope = self.growth
        return constant + slope * math.log10(unknowns)

    def beyond_share(self, name, unknowns, ranks):
        fixed, surface = self.imbalance[name]
        return 0.0 if ranks == 1 else fixed + surface / math.sqrt(unknowns / ranks)

    def costs(self, machine, unknowns, ranks, variant=Variant()):
        """[Cost] of an iteration."""
        share = unknowns / ranks
        stages = math.log2(ranks) * (machine.latency + machine.overhead)
        vectors = self.read["vectors"] * share
        operator = self.read["operator"] * share * (1 + self.beyond_share("operator", unknowns, ranks))
        k = at(self.neighbours, ranks)
        sending = exchange(machine, 1, k, self.sent["operator"] * math.sqrt(share)) if ranks > 1 else 0.0
        result = [Cost("vectors", self.work(machine, "vectors", vectors), 0.0, self.reductions * stages, 0.0, 0.0, False),
                  Cost("operator", self.work(machine, "operator", operator), sending, 0.0, k, operator, False)]
        all_levels = levels(unknowns, ranks, self.width, variant)
        for number, (level, below) in enumerate(zip(all_levels, [*all_levels[1:], None])):
            result.append(self.of_level(machine, number, level, below, unknowns, ranks))
        return result

    def of_level(self, machine, number, level, below, unknowns, ranks):
        kind = "finest" if number == 0 else "coarsest" if below is None else "stalled" if level.stalled else "coarse"
        n_read = self.read[kind] * level.fullest
        if level.holders == ranks:
            n_read *= 1 + self.beyond_share("finest", unknowns, ranks)
        n_messages = seconds = 0.0
        if level.holders > 1:
            neighbours = at(self.neighbours, level.holders)
            # After sweeps; on coarse levels in the mean of two visits.
            exchanges = SWEEPS_ON_COARSEST if below is None else 2 if number == 0 else 2.5
            members = math.ceil(level.holders / below.holders) - 1 if below else 0  # that give their rows to a holder
            if below and below.holders > 1:  # there are neighbours in transfers, too
                exchanges += 2
            n_messages = exchanges * neighbours + 2 * members
            sent = self.sent["finest" if number == 0 else "coarse"] * math.sqrt(level.fullest)
            seconds = exchange(machine, exchanges + (2 if members else 0), n_messages, sent)
        return Cost(f"level {number}", level.visits * self.work(machine, kind, n_read), level.visits * seconds, 0.0,
                    level.visits * n_messages, level.visits * n_read, level.holders < ranks)

    def work(self, machine, kind, n_read):
        """Seconds of one visit."""
        passes = {"vectors": 3, "operator": 1, "coarsest": SWEEPS_ON_COARSEST}.get(kind, 3)  # over what there is
        rate = self.rate["coarse" if kind in ("stalled", "coarsest") else kind]
        return n_read / (min(rate, machine.memory) if n_read / passes > machine.cache else rate)

    def seconds(self, *arguments):
        return sum(cost.work + cost.messages + cost.reductions for cost in self.costs(*arguments))


def exchange(machine, exchanges, n_messages, sent):
    return exchanges * machine.latency + n_messages * machine.overhead + sent / machine.bandwidth


def efficiency(model, machine, unknowns, ranks, variant, alone):
    """Of as many ranks, against one rank with `alone` unknowns; iterations that grow count."""
    one, many = (model.iterations(n) * model.seconds(machine, n, p, variant) for n, p in ((alone, 1), (unknowns, ranks)))
    return one / many * (unknowns / ranks) / alone


def blamed(model, machine, unknowns, ranks, variant, alone):
    """The part that has most seconds more than on one rank, for an unknown of its own."""
    scale = unknowns / ranks / alone
    before = {cost.part: cost for cost in model.costs(machine, alone, 1, variant)}
    excess = {}
    for cost in model.costs(machine, unknowns, ranks, variant):
        was = before[cost.part].work if cost.part in before else 0.0
        excess[f"{cost.part}: work"] = cost.work - scale * was
        excess[f"{cost.part}: messages"] = cost.messages
        excess["reductions"] = excess.get("reductions", 0.0) + cost.reductions
    return max(excess, key=excess.get)


# --- Counted runs ---


def per_iteration(run, part, column):
    return run.parts[part][column] / run.parts[1]["visits_max"]


def per_visit(run, part, column):
    return run.parts[part][column] / run.parts[part]["visits_max"]


def per_row(run, part):
    return per_visit(run, part, "bytes_read_sum") / run.parts[part]["rows_sum"]


def held(run, part):
    return run.parts[part]["holders_sum"] if part in run.parts else 0


def rates(run):
    """Bytes a second of one core, by kind of part."""
    coarse = range(3, max(run.parts) + 1)
    total = lambda column: sum(run.parts[part][column] for part in coarse)
    vectors = VECTOR_BYTES * run.unknowns * run.parts[1]["visits_max"]
    return {"vectors": vectors / run.parts[0]["processor_seconds_max"],
            "operator": run.parts[1]["bytes_read_max"] / run.parts[1]["processor_seconds_max"],
            "finest": run.parts[2]["bytes_read_max"] / run.parts[2]["processor_seconds_max"],
            "coarse": total("bytes_read_max") / total("processor_seconds_max")}


def fitted(rows, values):
    """Least squares of two terms, neither of them negative."""
    rows, values = np.array(rows), np.array(values)
    best = np.linalg.lstsq(rows, values, rcond=None)[0]
    if min(best) >= 0.0:
        return [float(c) for c in best]
    single = [max(0.0, float(column @ values / (column @ column))) for column in rows.T]
    left = [np.linalg.norm(values - c * column) for c, column in zip(single, rows.T)]
    return [single[0], 0.0] if left[0] <= left[1] else [0.0, single[1]]
