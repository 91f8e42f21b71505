"""What the Python tools share: the displacement that a run ended with."""

import os

import netCDF4
import numpy as np

from messages import fail

AXES = "xy"


class Displacement:
    """Of a run that wrote one file, at its last step, with the nodes of each element, by the element's number in the mesh."""

    def __init__(self, directory):
        first = next((name for name in os.listdir(directory) if name.endswith(".e")), None)
        if first is None:
            fail(f"{directory}: no Exodus file (*.e) in it")
        with netCDF4.Dataset(os.path.join(directory, first)) as data:
            data.set_auto_mask(False)
            blocks = [data[f"connect{b + 1}"][:] for b in range(len(data.dimensions["num_el_blk"]))]
            if any(block.shape[1] != 4 for block in blocks):
                fail(f"{directory}: only meshes of quadrilaterals can be compared")
            self.corners = np.concatenate(blocks)[np.argsort(data["elem_num_map"][:])] - 1
            self.coordinates = np.column_stack([data["coordx"][:], data["coordy"][:]])
            names = [str(name) for name in netCDF4.chartostring(data["name_nod_var"][:])]
            self.values = np.column_stack(
                [data[f"vals_nod_var{names.index('displacement_' + axis) + 1}"][-1] for axis in AXES])
            sets = [str(name) for name in netCDF4.chartostring(data["ns_names"][:])]
            self.node_sets = {name: data[f"node_ns{s + 1}"][:] - 1 for s, name in enumerate(sets)}
