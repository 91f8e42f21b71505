"""The displacement at the end of a run, for the tools that compare runs."""

import numpy as np

from messages import fail
from runs import ExodusFile, series_of

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
