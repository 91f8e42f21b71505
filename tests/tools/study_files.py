"""What the studies write and other programs read: case files, and meshes whose cracks are opened.

    study_files.py PERIMORPH MPIEXEC RUNS
"""

import pathlib
import sys
import unittest

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parents[1] / "support")]
import numpy as np

from fixture import InFolder
from case_file import read_case, write_case
from msh import edge_lengths, open_crack, read_mesh
from precision_runs import lattice, write_mesh

del sys.argv[1:]


class Cases(InFolder):
    def test_what_is_written_is_read(self):
        case = {"Dimension": 2, "Loading": {"Increments": 3}, "Pre-Cracks": {"a & b": {"Points": [0.0, 0.0, 1.5, 0.0]}},
                "Output": {"Spread Files": True, "Reactions": ["top", "left edge"], "Bonds": [1, 2]}, "Mesh": {"Scale": 0.1}}
        write_case(self.folder / "case.xml", case)
        self.assertEqual(read_case(self.folder / "case.xml"), case)


class Meshes(InFolder):
    def test_what_is_written_is_read(self):
        nodes, cells = lattice(np.array([0.0, 1.0, 3.0]))
        write_mesh(self.folder / "plate.msh", nodes, cells, {"bottom": [0, 1, 2], "corner": [8]})
        read_nodes, read_cells, groups = read_mesh(self.folder / "plate.msh", 2)
        np.testing.assert_array_equal(read_nodes, nodes)
        np.testing.assert_array_equal(read_cells, cells)
        self.assertEqual({name: list(group) for name, group in groups.items()},
                         {"body": list(range(9)), "bottom": [0, 1, 2], "corner": [8]})
        self.assertEqual(edge_lengths(nodes, cells).mean(), 1.5)

    def test_a_crack_parts_its_faces_and_not_its_tip(self):
        nodes, cells = lattice(np.arange(-2.0, 3.0))
        on_crack, opened, parent = open_crack(nodes, cells, [np.array([[-2.0, 0.0], [0.0, 0.0]])])
        self.assertEqual([tuple(nodes[n]) for n in on_crack], [(-2, 0), (-1, 0), (0, 0)])
        self.assertEqual([tuple(nodes[n]) for n in parent[len(nodes):]], [(-2, 0), (-1, 0)])
        np.testing.assert_array_equal(parent[opened], cells)
        is_above = nodes[cells].mean(axis=1)[:, 1] > 0
        self.assertEqual(np.intersect1d(opened[is_above], opened[~is_above]).tolist(),
                         [n for n in range(len(nodes)) if nodes[n, 1] == 0 and nodes[n, 0] >= 0])


if __name__ == "__main__":
    unittest.main()
