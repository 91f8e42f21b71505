"""The runs that a prediction of scaling starts from, and what this machine can do."""

import json
import math
import os
import subprocess
import sys
import time

import numpy as np
from cases import ROOT
from message_counts import count
from scaling_model import Counted, Machine
from squares import MODELS, side_for, square

PING_PONG = "perimorph_ping_pong"  # its target; tests/benchmarks/ping_pong.cpp
CACHE = 2e6  # bytes of a core, here
COLUMNS = ("visits_max", "messages_max", "bytes_max", "reductions_max", "bytes_read_max", "bytes_read_sum", "rows_max", "rows_sum",
           "holders_sum", "processor_seconds_max")
TIMED = [25000, 100000, 200000]  # unknowns on one rank and two
FEW_EACH, MORE_EACH = 2000, 8000  # unknowns of a rank; of more up to a quarter of the ranks
REPEATS = 3


def count_all(folder, most_ranks):
    """Runs on one to many ranks; of those on one and two, whose processor seconds count, the fastest of several."""
    runs = []
    powers = [2**n for n in range(1, most_ranks.bit_length())]
    for model in MODELS:
        for ranks in (1, 2):
            for unknowns in TIMED:
                several = [one(folder, model, unknowns, ranks) for _ in range(REPEATS)]
                runs.append(min(several, key=seconds))
        for each, largest in ((FEW_EACH, most_ranks), (MORE_EACH, most_ranks // 4)):
            runs += [one(folder, model, each * ranks, ranks) for ranks in powers if 4 <= ranks <= largest]
    return runs


def seconds(run):
    """Of the processor, on the rank with most in each part; all of its iterations."""
    return sum(part["processor_seconds_max"] for part in run.parts.values())


def one(folder, model, unknowns, ranks):
    counts, last = count(square(folder, side_for(unknowns), model), folder, ranks)
    print(f"{model}, {last['unknowns']} unknowns on {ranks}", file=sys.stderr, flush=True)
    parts = {part: {column: counts.value(part, column) for column in COLUMNS} for part in counts.parts}
    return Counted(model, ranks, int(last["unknowns"]), int(last["cg_iterations"]), parts)


def machine_here():
    """Between two ranks, and of one core that copies a long vector (processor time); the fastest of many."""
    program = os.path.join(ROOT, "build", "tests", "benchmarks", PING_PONG)
    environment = '. "$0"; exec mpirun --quiet -n 2 "$1"'
    latency, overhead, bandwidth = subprocess.run(
        ["bash", "-c", environment, os.path.join(ROOT, "tools", "lib", "environment"), program],
        check=True, stdout=subprocess.PIPE, text=True).stdout.split()
    return Machine(float(latency), float(overhead), float(bandwidth), memory_bandwidth(), CACHE)


def memory_bandwidth():
    source, target = np.ones(16_000_000), np.empty(16_000_000)
    fastest = math.inf
    for _ in range(20):
        begin = time.process_time()
        np.copyto(target, source)
        fastest = min(fastest, time.process_time() - begin)
    return 2 * source.nbytes / fastest


def write(file, here, runs):
    """One run a line."""
    lines = ",\n  ".join(json.dumps(run._asdict()) for run in runs)
    with open(file, "w") as out:
        out.write(f'{{"machine": {json.dumps(here._asdict())},\n "runs": [\n  {lines}\n ]}}\n')


def read(file):
    """(machine, runs)"""
    with open(file) as stream:
        data = json.load(stream)
    return Machine(**data["machine"]), [
        Counted(**{**run, "parts": {int(part): counts for part, counts in run["parts"].items()}}) for run in data["runs"]]
