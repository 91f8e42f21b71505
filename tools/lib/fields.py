"""Displacement at the end of a run, and damage at any step, for the tools that compare runs."""

import collections

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


def distances_between_paths(one, other):
    """Of each damaged element from the nearest one of the other run, in the size of elements; none if a run has none."""
    paths = [run.centroids[run.values > 0] for run in (one, other)]
    if not all(map(len, paths)):
        return np.empty(0)
    gaps = [np.min(np.linalg.norm(paths[1 - k] - place, axis=-1)) for k in (0, 1) for place in paths[k]]
    return np.array(gaps) / max(one.size, other.size)
