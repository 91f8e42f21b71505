"""The model behind tools/studies/predict-scaling, with counts made up by known laws.

    scaling_prediction.py PERIMORPH MPIEXEC RUNS
"""

import argparse
import contextlib
import io
import math
import pathlib
import sys
import unittest

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parents[1] / "support")]
from fixture import InFolder
from prediction import print_prediction, print_times_check
from scaling_model import Counted, Machine, Model, Variant, efficiency, exchange, levels
from scaling_runs import read, write

del sys.argv[1:]

FREE = Machine(latency=0.0, overhead=0.0, bandwidth=math.inf, memory=math.inf, cache=0.0)
CLUSTER = Machine(latency=2e-6, overhead=5e-7, bandwidth=1e9, memory=4e9, cache=1e6)
ITERATIONS = 10


def part(visits, rows, ranks, read_each, messages=0.0, sent=0.0, reductions=0.0, seconds=1e-3, beyond=0.0):
    """Columns of one part: each unknown reads so many bytes in a visit, on the fullest rank by a share `beyond` more."""
    n = visits * ITERATIONS
    return {"visits_max": n, "messages_max": n * messages, "bytes_max": n * sent, "reductions_max": ITERATIONS * reductions,
            "bytes_read_max": n * read_each * rows / ranks * (1 + beyond), "bytes_read_sum": n * read_each * rows,
            "rows_max": rows / ranks, "rows_sum": rows, "holders_sum": ranks, "processor_seconds_max": seconds}


def run(unknowns, ranks, growth=0.0, fixed=0.0, surface=0.0):
    """Sends 8 messages and 4 sqrt(n) bytes, of n unknowns on a rank, and reads fixed + surface / sqrt(n) beyond its share."""
    n = unknowns / ranks
    beyond = fixed + surface / math.sqrt(n) if ranks > 1 else 0.0
    many = {"messages": 8.0, "sent": 4 * math.sqrt(n), "beyond": beyond} if ranks > 1 else {}
    parts = {0: part(0.1, unknowns, ranks, 0.0, reductions=2.0), 1: part(1, unknowns, ranks, 100.0, **many),
             2: part(1, unknowns, ranks, 200.0, **many), 3: part(2, unknowns / 6, ranks, 400.0, sent=4 * math.sqrt(n / 6)),
             4: part(2, unknowns / 54, 1, 3000.0)}
    return Counted("made up", ranks, unknowns, ITERATIONS + growth * math.log10(unknowns), parts)


def model(**laws):
    return Model([run(unknowns, ranks, **laws) for unknowns, ranks in
                  ((30000, 1), (120000, 1), (480000, 1), (32000, 16), (128000, 16), (128000, 64), (512000, 64))])


class Levels(unittest.TestCase):
    def test_ranks_of_18_x_18_nodes(self):
        unknowns = 4 * 2 * 18 * 18
        across = levels(unknowns, 4, 3.0, Variant("across", 99, 500))
        self.assertEqual([level.rows for level in across], [unknowns, 4 * 3 * 6 * 6, 3 * 4 * 4])
        self.assertEqual([level.holders for level in across], [4, 1, 1])
        self.assertEqual([level.fullest for level in across], [unknowns / 4, 4 * 3 * 6 * 6, 3 * 4 * 4])
        self.assertEqual([level.visits for level in across], [1, 2, 2], "the coarsest is solved once for each visit above")

    def test_aggregates_of_a_rank_each_get_no_coarser(self):
        unknowns = 64 * 2 * 9 * 9
        within, stop, across = (levels(unknowns, 64, 3.0, Variant(kind, 99)) for kind in ("within", "stop", "across"))
        self.assertEqual([level.rows for level in within], [unknowns, 64 * 3 * 9, *[64 * 3] * 8])
        self.assertEqual(within[-1].visits, 2**8)
        self.assertEqual(len(stop), 3)
        self.assertLess(across[-1].rows, 100)

    def test_a_v_cycle_below_a_level(self):
        visits = [level.visits for level in levels(10**9, 1000, 3.0, Variant("across", 3))]
        self.assertEqual(visits, [1, 2, 4, 8] + [8] * (len(visits) - 4))
        self.assertGreater(len(visits), 6)


class Fit(unittest.TestCase):
    def test_finds_the_laws(self):
        made_up = model(growth=0.5, fixed=0.1, surface=3.0)
        self.assertAlmostEqual(made_up.read["operator"], 100.0)
        self.assertAlmostEqual(made_up.read["coarse"], 400.0)
        self.assertAlmostEqual(made_up.rate["operator"], ITERATIONS * 100.0 * 120000 / 1e-3)
        self.assertAlmostEqual(made_up.sent["finest"], 4.0)
        self.assertAlmostEqual(made_up.beyond_share("operator", 1000 * 10000, 1000), 0.1 + 3.0 / 100)
        self.assertAlmostEqual(made_up.iterations(10**8), ITERATIONS + 0.5 * 8)
        self.assertEqual(made_up.reductions, 2.0)

    def test_does_not_let_iterations_fall(self):
        self.assertAlmostEqual(model(growth=-0.5).growth[1], 0.0)


class Prediction(unittest.TestCase):
    def test_one_rank_has_efficiency_one(self):
        self.assertEqual(efficiency(model(), CLUSTER, 100000, 1, Variant(), 100000), 1.0)

    def test_where_sending_is_free_and_coarse_levels_are_only_iterations_are_left(self):
        made_up = model(growth=0.5)
        made_up.rate["coarse"] = math.inf
        expected = made_up.iterations(10**5) / made_up.iterations(10**8)
        self.assertLess(expected, 0.95)
        self.assertAlmostEqual(efficiency(made_up, FREE, 10**8, 1000, Variant(), 10**5), expected)
        self.assertAlmostEqual(efficiency(made_up, FREE, 10**8, 1000, Variant(), 10**8), 1.0)

    def test_reductions_grow_with_the_logarithm_of_ranks(self):
        some, more = (model().costs(CLUSTER, 10**5 * ranks, ranks)[0].reductions for ranks in (32, 1024))
        self.assertAlmostEqual(some, 2 * 5 * 2.5e-6)
        self.assertAlmostEqual(more, 2 * some)

    def test_operator_by_hand(self):
        n = 40000
        cost = model(fixed=0.1).costs(CLUSTER, 64 * n, 64)[1]
        self.assertAlmostEqual(cost.work, 1.1 * 100.0 * n / 4e9)  # does not fit in the cache
        self.assertAlmostEqual(cost.messages, 2e-6 + 8 * 5e-7 + 4 * 200 / 1e9)
        self.assertAlmostEqual(exchange(CLUSTER, 3, 24, 1e6), 3 * 2e-6 + 24 * 5e-7 + 1e-3)

    def test_a_slower_network_costs_more_on_many_ranks_and_nothing_on_one(self):
        slow = CLUSTER._replace(latency=1e-4)
        made_up = model()
        self.assertEqual(made_up.seconds(slow, 10**5, 1), made_up.seconds(CLUSTER, 10**5, 1))
        self.assertGreater(made_up.seconds(slow, 10**7, 100), 1.1 * made_up.seconds(CLUSTER, 10**7, 100))


class Tables(InFolder):
    def test_of_runs_that_were_kept(self):
        write(self.folder / "counts.json", CLUSTER, model(growth=0.5).runs)
        here, runs = read(self.folder / "counts.json")
        self.assertEqual((here, runs), (CLUSTER, model(growth=0.5).runs))

        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            print_times_check({"made up": Model(runs)}, here)
            print_prediction({"made up": Model(runs)},
                             argparse.Namespace(machine=CLUSTER, each=100000, all=10**7, ranks=[1, 1000]))
        self.assertRegex(printed.getvalue(), r"\| made up \| +120000 \| +1 \|.*\(fitted\)")
        self.assertEqual(printed.getvalue().count("100 %"), 2)
        self.assertRegex(printed.getvalue(), r"\| made up \| +1000 \|.* \| +level \d: (work|messages) \|")


if __name__ == "__main__":
    unittest.main()
