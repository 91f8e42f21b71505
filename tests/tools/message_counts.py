"""What tools/studies/scaling-study --count counts: a small hybrid square on two ranks."""

import contextlib
import io
import os
import re
import subprocess
import sys
import tempfile

program, mpiexec, _ = sys.argv[1:]
ROOT = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..")
sys.path[:0] = [os.path.join(ROOT, "tools", "studies", "lib"), os.path.join(ROOT, "tools", "lib")]
from message_counts import PROFILER, Counts, print_counts, print_sums
from squares import square

library = os.path.join(os.path.dirname(program), "..", "tests", "benchmarks", f"lib{PROFILER}.so")


def counted(folder, case, rows_per_rank, *settings):
    table = os.path.join(folder, f"{rows_per_rank}.csv")
    subprocess.run([mpiexec, "-n", "2", program, "run", case, "--output", os.path.join(folder, "out"), "--quiet", "--no-progress",
                    "--set", f"Solver/Rows per Rank={rows_per_rank}", *settings],
                   env=dict(os.environ, LD_PRELOAD=library, PERIMORPH_MPI_COUNTS=table), check=True, timeout=100)
    return Counts(table)


with tempfile.TemporaryDirectory() as folder:
    case = square(folder, 60, "hybrid")
    everywhere, gathered = (counted(folder, case, rows) for rows in (1, 10000))
    tiny_everywhere, tiny_gathered = (counted(folder, case, rows, "--set", "Solver/MueLu/coarse: max size=3") for rows in (1, 10000))

coarsest = max(everywhere.parts)
assert coarsest >= 4, sorted(everywhere.parts)  # three levels
for counts in (everywhere, gathered):
    assert counts.value(0, "visits_max") == 1 and counts.iterations >= 5
    assert counts.each(2, "visits_max") == 1, "the finest level is visited once"
    assert counts.each(3, "visits_max") == 2, "a W-cycle visits the next one twice"
    assert 1 <= counts.total("reductions_max") <= 3
    assert counts.value(1, "messages_sum") == 2 * counts.iterations, "each rank has one neighbour"
    assert counts.value(1, "bytes_read_sum") > counts.value(1, "bytes_read_max") > 0
assert everywhere.each(coarsest, "messages_max") >= 20
assert gathered.value(coarsest, "messages_sum") == 0
assert gathered.value(coarsest, "bytes_read_sum") == gathered.value(coarsest, "bytes_read_max") > 0
assert abs(gathered.iterations - everywhere.iterations) <= 1

# Aggregates do not reach beyond their rank: of one on each MueLu makes no fewer; where all are on one rank there are.
finest, one_aggregate = 2, 3
for number in range(finest + 1, max(tiny_gathered.parts) + 1):
    assert tiny_gathered.value(number, "holders_sum") == 1
    assert tiny_gathered.value(number, "rows_sum") < 0.8 * tiny_gathered.value(number - 1, "rows_sum")
assert tiny_gathered.value(max(tiny_gathered.parts), "rows_sum") == one_aggregate
assert tiny_everywhere.value(max(tiny_everywhere.parts), "rows_sum") == 2 * one_aggregate
assert len(tiny_everywhere.parts) > len(tiny_gathered.parts)

printed = io.StringIO()
last = {"unknowns": "7442", "cg_iterations": f"{gathered.iterations:.0f}"}
with contextlib.redirect_stdout(printed):
    print_counts("hybrid", gathered, last, 2)
    print_sums(["hybrid"], [2], {("hybrid", 2): (gathered, last)})
assert f"| level {coarsest - 2} " in printed.getvalue()
assert re.search(rf"\| +hybrid \|.* {gathered.total('messages_max'):.0f} \|", printed.getvalue()), printed.getvalue()
