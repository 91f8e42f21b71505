"""What the Python tools share: the displacement that a run ended with."""

import numpy as np

from messages import fail
from runs import ExodusFile, series_of

AXES = "xy"


class Displacement:
    """Of a run that wrote one file, at its last step, with the nodes of each element, by the element's number in the mesh."""

    def __init__(self, directory):
        file = ExodusFile(series_of(directory)[0])
        blocks = file.connectivity()
        if len({block.shape[1] for block in blocks}) != 1:
            fail(f"{directory}: only meshes with elements of one kind can be compared")
        self.corners = np.concatenate(blocks)[np.argsort(file.element_numbers())]
        self.coordinates = np.column_stack(file.coordinates())
        self.values = np.column_stack(file.displacement(-1))
        self.node_sets = file.node_sets()
