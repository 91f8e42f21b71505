"""Meshes of gmsh in the format MSH 2.2, as the studies' own programs read them."""

import numpy as np

KINDS = {15: (0, 1), 1: (1, 2), 2: (2, 3), 3: (2, 4), 4: (3, 4), 5: (3, 8)}  # gmsh's number: dimension, nodes


def sections_of(file):
    """{name: lines, as lists of words, without their count}"""
    with open(file, encoding="utf-8") as stream:
        lines = stream.read().split("\n")
    return {name: [line.split() for line in lines[lines.index("$" + name) + 2:lines.index("$End" + name)]]
            for name in ("PhysicalNames", "Nodes", "Elements")}


def read_mesh(file, dimension):
    """Nodes (n, dimension), the cells (m, nodes of one) of the only kind of that dimension, {group: its nodes}."""
    sections = sections_of(file)
    numbers = np.array([int(line[0]) for line in sections["Nodes"]])
    nodes = np.array([line[1:1 + dimension] for line in sections["Nodes"]], dtype=float)
    names = {(int(line[0]), int(line[1])): " ".join(line[2:]).strip('"') for line in sections["PhysicalNames"]}
    number_of = np.zeros(numbers.max() + 1, dtype=int)
    number_of[numbers] = np.arange(len(numbers))
    cells, members = [], {name: [] for name in names.values()}
    for line in sections["Elements"]:
        kind_dimension, count = KINDS[int(line[1])]
        corners = [int(word) for word in line[-count:]]
        members[names[kind_dimension, int(line[3])]] += corners
        if kind_dimension == dimension:
            cells.append(corners)
    used, cells = np.unique(number_of[np.array(cells)], return_inverse=True)  # gmsh keeps centres of arcs
    place = np.full(len(nodes), -1)
    place[used] = np.arange(len(used))
    groups = {name: place[np.unique(number_of[corners])] for name, corners in members.items()}
    return nodes[used], cells.reshape(-1, count_of(sections, dimension)), groups


def count_of(sections, dimension):
    return next(KINDS[int(line[1])][1] for line in sections["Elements"] if KINDS[int(line[1])][0] == dimension)


def edge_lengths(nodes, cells):
    """Of all edges of all cells."""
    ring = cells.shape[1] if nodes.shape[1] == 2 else cells.shape[1] // 2
    around = [(i, (i + 1) % ring) for i in range(ring)]
    upper = [(i + ring, j + ring) for i, j in around] + [(i, i + ring) for i in range(ring)]
    edges = np.array(around if nodes.shape[1] == 2 else around + upper)
    return np.linalg.norm(np.diff(nodes[cells[:, edges]], axis=2), axis=3)


def open_crack(nodes, cells, cracks):
    """Cracks that are flat and run from the surface along y = const. to an end at the largest x.

    Returns the nodes on them, the cells with nodes of their own above the cracks, and for each of all nodes the one it came
    of.
    """
    cells, parent, on_cracks = cells.copy(), list(range(len(nodes))), []
    for corners in cracks:
        level, tip = corners[0][1], corners[:, 0].max()
        small = 1e-6 * np.ptp(nodes, axis=0).max()
        on_crack = np.flatnonzero((np.abs(nodes[:, 1] - level) < small) & (nodes[:, 0] < tip + small)
                                  & (nodes[:, 0] > corners[:, 0].min() - small))
        on_cracks += list(on_crack)
        opened = on_crack[nodes[on_crack, 0] < tip - small]
        copy = np.arange(len(nodes))
        copy[opened] = len(parent) + np.arange(len(opened))
        parent += list(opened)
        above = nodes[cells][:, :, 1].mean(axis=1) > level
        cells[above] = np.where(cells[above] < len(nodes), copy[np.minimum(cells[above], len(nodes) - 1)], cells[above])
    return np.array(on_cracks, dtype=int), cells, np.array(parent)
