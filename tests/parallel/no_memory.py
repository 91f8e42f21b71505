"""One rank has no memory left, at many places in turn: the run ends in order and says so, and no rank waits forever.

    no_memory.py PERIMORPH MPIEXEC LIBRARY

PERIMORPH_PLACES=100 in the environment tries so many places with each number of ranks.
"""

import os
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
library = sys.argv.pop(3)
from fixture import Plate

PLACES = int(os.environ.get("PERIMORPH_PLACES", 6))
PATIENCE = 60  # seconds; a rank that has failed waits 5 for the others


class OneRankWithoutMemory(Plate):
    def run_without_memory(self, ranks, rank, **what):
        what = {f"NO_MEMORY_{key.upper()}": str(value) for key, value in what.items()}
        return self.run_case(ranks=ranks, timeout=PATIENCE, env={**os.environ, "LD_PRELOAD": library, "NO_MEMORY_RANK": str(rank), **what})

    def test_ends_the_run_with_a_message_wherever_it_happens(self):
        n_told = 0
        for ranks in [2, 4]:
            count = self.folder / "count"
            self.assertEqual(self.run_without_memory(ranks, 1, count=count).returncode, 0)
            n_allocations = int(count.read_text())
            self.assertGreater(n_allocations, 10 * PLACES)
            for place in range(PLACES):
                at = int(n_allocations * (place + 0.5) / PLACES)
                with self.subTest(ranks=ranks, at=at):
                    run = self.run_without_memory(ranks, place % ranks, at=at)

                    if run.returncode != 0:  # libraries do without some buffers
                        self.assertEqual(run.returncode, 3, run.stderr)
                        self.assertIn("there is no memory left", run.stderr)
                        n_told += 1
        self.assertGreater(n_told, PLACES)


if __name__ == "__main__":
    unittest.main()
