"""What `perimorph check --preview` says of a case, preview.xml and preview.e, for tools/preview to draw."""

import functools
import os
import xml.etree.ElementTree

import numpy

from runs import CLASSES, ExodusFile
from sides import all_sides, closed, outer_sides

AXES = "xyz"


def values_of(element):
    """A list of parameters as a dictionary, in its order; lists in it as dictionaries too."""
    values = {}
    for child in element:
        if child.tag == "ParameterList":
            values[child.get("name")] = values_of(child)
        elif child.tag == "Parameter":
            values[child.get("name")] = value_of(child.get("type"), child.get("value"))
    return values


def value_of(kind, text):
    if kind == "Array(double)":
        return numpy.array([float(number) for number in text.strip("{}").split(",") if number.strip()])
    return {"int": int, "double": float}.get(kind, str)(text)


class Condition:
    """A prescribed displacement, traction, pressure, temperature or body force. values: before the first increment and at the end
    of each stage, (stages + 1, 1 or dimensions); largest: in each stage; first_stage: with which it
    begins; n_stages: before it is released. Where a measure
    decides on the load, values are those without it and at a load factor of 1."""

    def __init__(self, kind, name, entry, n_dimensions):
        self.kind, self.name, self.group = kind, name, entry.get("Group")
        self.component = entry.get("Component", -1)  # of displacements; 3 to 5 are rotations; -1: along a direction
        self.along = entry.get("Direction") if kind == "Displacements" else None
        self.blocks = entry.get("Blocks", "").strip("{}")
        self.profile = [entry[key] for key in ("Direction", "Positions", "Factors") if key in entry] if kind == "Temperatures" else []
        n_values = 1 if kind in ("Displacements", "Pressures", "Temperatures") else n_dimensions
        self.values, self.largest = (entry[key].reshape(-1, n_values) for key in ("Values", "Largest"))
        self.first_stage, self.n_stages, self.n_dimensions = entry["First Stage"], entry["Stages"], n_dimensions

    @property
    def symbol(self):
        """What its values are called."""
        moved = "u_d" if self.along is not None else ("u_" if self.component < 3 else "φ_") + AXES[self.component % 3]
        return {"Displacements": moved, "Tractions": "t", "Pressures": "p", "Temperatures": "ΔT", "Body Force": "b",
                "Self-Weight": "g"}[self.kind]

    @property
    def place(self):
        """What it acts on, in words."""
        blocks = self.blocks or "all of the body"
        if not self.profile:
            return self.group or blocks
        direction, positions, factors = self.profile
        course = ", ".join(f"{factor:.5g} at {position:.5g}" for position, factor in zip(positions, factors))
        return f"{blocks}, along {numbers_text(direction)} times {course}".replace("-", "−")

    @property
    def axis(self):
        """Along which a displacement is prescribed, of length 1; None for rotations, and other kinds."""
        if self.kind != "Displacements" or self.component >= 3:
            return None
        return self.along if self.along is not None else numpy.eye(self.n_dimensions)[self.component]

    def value(self, stage):
        """That counts in a stage: at its end, or if that is zero the largest in it, or else the one before it."""
        values = [self.values[stage + 1], self.largest[stage], self.values[stage]]
        return next((value for value in values if value.any()), values[0])

    def holds(self, stage):
        """Whether it is a support in a stage: a displacement that stays zero."""
        return self.kind == "Displacements" and not self.value(stage).any()

    def is_idle(self, stage):
        """Whether it does nothing in a stage: it has not begun, is released, or a load that is zero all through it."""
        return not self.first_stage <= stage < self.n_stages or (self.kind != "Displacements" and not self.value(stage).any())

    def direction(self, stage):
        """Where it acts in a stage, of length 1; None for pressures, which follow the normal, rotations and temperatures."""
        value = self.value(stage)
        if self.kind == "Displacements":
            return None if self.axis is None else numpy.sign(value[0]) * self.axis
        return None if self.kind in ("Pressures", "Temperatures") else of_length_one(value)

    def text(self, stage, follows_measure):
        """Its value at the end of a stage, and the largest in it where that lies beyond both ends; and its direction."""
        if stage < self.first_stage:
            return "not yet"
        if stage >= self.n_stages:
            return "released"
        along = "" if self.along is None else f" along {numbers_text(self.along)}"
        return self.value_text(stage, follows_measure) + along

    def value_text(self, stage, follows_measure):
        start, end, largest = self.values[stage], self.values[stage + 1], self.largest[stage]
        if not follows_measure:
            is_beyond = ((largest < numpy.minimum(start, end)) | (largest > numpy.maximum(start, end))).any()
            return numbers_text(end) + (f" (up to {numbers_text(largest)})" if is_beyond else "")
        growth = end - start
        terms = [numbers_text(start)] if start.any() or not growth.any() else []
        return " + ".join(terms + ([f"{numbers_text(growth)} λ"] if growth.any() else []))


def numbers_text(values):
    texts = [f"{value:.5g}".replace("-", "−") for value in values + 0.0]
    return texts[0] if len(texts) == 1 else f"({', '.join(texts)})"


class CaseData:
    """A case before its first increment."""

    def __init__(self, folder):
        self.table = values_of(xml.etree.ElementTree.parse(os.path.join(folder, "preview.xml")).getroot())
        self.file = ExodusFile([os.path.join(folder, "preview.e")])
        self.places = numpy.stack(self.file.coordinates(), axis=-1)
        self.n_dimensions = self.places.shape[1]
        self.stages = list(self.table["Stages"])
        self.conditions = [Condition(kind, name, entry, self.n_dimensions)
                           for kind, entries in self.table["Conditions"].items() for name, entry in entries.items()]
        self.follows_measure = bool(self.table["Measure"])
        self.mirrors = {entry["Group"] for entry in self.table["Symmetry Planes"].values()}
        self.rigid = {entry["Group"]: entry["Shared"] for entry in self.table["Rigid Groups"].values()}

    @property
    def title(self):
        return self.table["Title"] or self.table["Name"]

    # The mesh

    @functools.cached_property
    def first_here(self):
        """For each node the first at its place: where elements have parted, there are several."""
        box = numpy.ptp(self.places, axis=0).max()
        _, same = numpy.unique(numpy.round(self.places / (1e-9 * box)).astype(numpy.int64), axis=0, return_inverse=True)
        first = numpy.full(same.max() + 1, len(same))
        numpy.minimum.at(first, same.ravel(), numpy.arange(len(same)))
        return first[same.ravel()]

    @functools.cached_property
    def blocks(self):
        """For each block the nodes of its elements, as if none had parted."""
        return [self.first_here[block] for block in self.file.connectivity()]

    def elements(self):
        """The nodes of each element."""
        return [nodes for block in self.blocks for nodes in block]

    def middles(self):
        """Of the elements."""
        return numpy.concatenate([self.places[block].mean(axis=1) for block in self.blocks])

    def of_elements(self, values_of_block):
        """A value of each block, repeated for its elements."""
        return numpy.concatenate([numpy.full(len(block), value) for block, value in zip(self.blocks, values_of_block)])

    def materials_of_elements(self):
        """The place of each element's material in the table."""
        materials = [entry["Material"] for entry in self.table["Blocks"].values()]
        # A block's number is 10 * (its place in the mesh + 1) + class + 1; other types of elements follow all these.
        return self.of_elements([materials[(number // 10 - 1) % len(materials)] for number in self.file.block_ids()])

    def classes_of_elements(self):
        """FE, MORPH, PD, DGFE by their numbers in runs.CLASSES."""
        return self.file.values("class", 0).astype(int)

    def class_counts(self):
        counts = numpy.bincount(self.classes_of_elements(), minlength=len(CLASSES))
        return {name: int(count) for name, count in zip(CLASSES, counts)}

    def alpha_of_elements(self):
        return self.file.values("alpha", 0)

    @functools.cached_property
    def boundary(self):
        """The sides on the outside, and the element of each."""
        return outer_sides(self.blocks, self.n_dimensions)

    @functools.cached_property
    def box(self):
        return self.places.min(axis=0), self.places.max(axis=0)

    # Groups

    @functools.cached_property
    def node_sets(self):
        return self.file.node_sets()

    @functools.cached_property
    def side_sets(self):
        return self.file.side_sets()

    @functools.cached_property
    def normals_of_nodes(self):
        """The sum over the sides of the boundary around each node, outward, each as long as its side is or its area."""
        sides, sums = self.boundary[0], numpy.zeros_like(self.places)
        for corner in range(sides.shape[1]):
            numpy.add.at(sums, sides[:, corner], normals(self.places, sides))
        return sums

    def nodes_of(self, group):
        """Of a group, each place once."""
        return numpy.unique(self.first_here[self.node_sets.get(group, numpy.empty(0, int))])

    @functools.cached_property
    def _sides(self):
        """Of all elements, in order; and where each element's begin."""
        sides, elements = all_sides(self.blocks, self.n_dimensions)
        return closed(sides), numpy.searchsorted(elements, numpy.arange(elements[-1] + 1))

    def sides_of(self, group):
        """The nodes of each side of a group; none if it has nodes only."""
        sides, begin = self._sides
        return numpy.array([sides[begin[element] + side - 1] for element, side in self.side_sets.get(group, [])], int)

    def where(self, group):
        """(places, outward normals of length 1) at which symbols of a group can be drawn: the middles of its sides, or its nodes."""
        sides = self.sides_of(group)
        if len(sides):
            return self.places[sides].mean(axis=1), of_length_one(normals(self.places, sides))
        nodes = self.nodes_of(group)
        return self.places[nodes], of_length_one(self.normals_of_nodes[nodes])


def normals(places, sides):
    """Outward normals of sides in Exodus' order of corners, times their lengths or areas."""
    if places.shape[1] == 2:
        along = places[sides[:, 1]] - places[sides[:, 0]]
        return numpy.stack([along[:, 1], -along[:, 0]], axis=-1)
    corners = places[sides]
    # Of a triangle, whose fourth corner is its first, one diagonal is a side: twice its area all the same.
    return 0.5 * numpy.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])


def of_length_one(vectors):
    lengths = numpy.linalg.norm(vectors, axis=-1, keepdims=True)
    return numpy.divide(vectors, lengths, out=numpy.zeros_like(vectors), where=lengths > 0)
