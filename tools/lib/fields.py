"""Displacement at the end of a run, damage at any step, bonds: for the tools that compare runs."""

import collections
import xml.etree.ElementTree

import numpy as np

from messages import fail
from runs import ExodusFile, all_steps, series_of

AXES = "xyz"


class Displacement:
    """At the last step of a run that wrote one file. Elements are ordered by their number in the mesh."""

    def __init__(self, directory):
        file = ExodusFile(series_of(directory)[0])
        blocks = file.connectivity()
        if len({block.shape[1] for block in blocks}) != 1:
            fail(f"{directory}: only meshes with elements of one kind can be compared")
        self.corners = np.concatenate(blocks)[np.argsort(file.element_numbers())]
        self.coordinates = np.column_stack(file.coordinates())
        self.values = np.column_stack(file.displacement(-1))
        self.node_sets = file.node_sets()
        names = np.repeat(file.names("eb_names"), [len(block) for block in blocks])
        # Blocks are named by the mesh's block and the class of their elements.
        self.blocks = np.array([name.rpartition("_")[0] for name in names])[np.argsort(file.element_numbers())]


Damage = collections.namedtuple("Damage", "values centroids size")  # by ascending id; size of damaged elements


def damage_in(file, step):
    order = np.argsort(file.element_numbers())
    values = file.values("damage", step)[order]
    corners = [np.stack([axis[nodes] for axis in file.coordinates()], axis=-1) for nodes in file.connectivity()]
    edges = np.concatenate([np.linalg.norm(x[:, 0] - x[:, 1], axis=-1) for x in corners])[order]
    is_damaged = values > 0
    return Damage(values, np.concatenate([x.mean(axis=1) for x in corners])[order],
                  edges[is_damaged].mean() if is_damaged.any() else 0.0)


def damage_by_step(directory):
    files = [ExodusFile(names) for names in series_of(directory)]
    return {round(file.times[step]): damage_in(file, step) for file, step in all_steps(files)}


def last_damage(directory):
    file, step = all_steps([ExodusFile(names) for names in series_of(directory)])[-1]
    return damage_in(file, step)


def distances(places, others):
    """Of each place from the nearest of the others, (places); infinite if there are none."""
    if len(others) == 0:
        return np.full(len(places), np.inf)
    parts = np.array_split(places, len(places) * len(others) // 10**7 + 1)
    return np.concatenate([np.linalg.norm(part[:, None] - others, axis=2).min(axis=1) for part in parts])


def distances_between(one, other):
    """Of each place from the nearest of the other set, both ways; none if a set is empty."""
    if len(one) == 0 or len(other) == 0:
        return np.empty(0)
    return np.concatenate([distances(one, other), distances(other, one)])


def distances_between_paths(one, other):
    """Of each damaged element from the nearest one of the other run, in the size of elements; none if a run has none."""
    return distances_between(*(run.centroids[run.values > 0] for run in (one, other))) / max(one.size, other.size)


# --- Bonds ---

VTK_TYPES = {"Int64": "<i8", "Float64": "<f8", "Int8": "i1"}


def read_vtp(file):
    """{name: array} of a VTK file with appended raw data, such as bonds-<increment>.vtp."""
    with open(file, "rb") as stream:
        content = stream.read()
    begin = content.index(b'<AppendedData encoding="raw">\n_') + len(b'<AppendedData encoding="raw">\n_')
    end = content.rindex(b"\n</AppendedData>")
    tree = xml.etree.ElementTree.fromstring(content[:begin] + content[end:])
    arrays = {}
    for tag in tree.iter("DataArray"):
        at = begin + int(tag.get("offset"))
        size = int.from_bytes(content[at:at + 8], "little")
        values = np.frombuffer(content[at + 8:at + 8 + size], VTK_TYPES[tag.get("type")])
        arrays[tag.get("Name")] = values.reshape(-1, int(tag.get("NumberOfComponents")))
    piece = next(tree.iter("Piece"))
    assert len(arrays["points"]) == int(piece.get("NumberOfPoints"))
    assert len(arrays["stretch"]) == int(piece.get("NumberOfLines"))
    return arrays
