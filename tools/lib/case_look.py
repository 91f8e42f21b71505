"""From where a body is seen: its places in the plane of the picture, its outside, its edges."""

import matplotlib.path
import numpy

from case_data import normals, of_length_one
from runs import VIEW
from sides import plane_of


class Look:
    """From where a body is seen. @param turn about the vertical axis, in degrees (three dimensions)"""

    def __init__(self, n_dimensions, turn=0.0):
        self.is_flat = n_dimensions == 2
        angle = numpy.radians(turn)
        turned = numpy.array([[numpy.cos(angle), -numpy.sin(angle), 0], [numpy.sin(angle), numpy.cos(angle), 0], [0, 0, 1]])
        self.toward = numpy.zeros(2) if self.is_flat else of_length_one(turned @ numpy.array(VIEW))
        self.axes = numpy.eye(2) if self.is_flat else plane_of(self.toward)

    def flat(self, places):
        return numpy.asarray(places) @ self.axes

    def depth(self, places):
        return numpy.asarray(places) @ self.toward


class Hull:
    """The outside of a body in three dimensions as it is seen."""

    def __init__(self, data, look):
        faces = data.boundary[0]
        towards = of_length_one(normals(data.places, faces)) @ look.toward
        self.faces = faces[towards > 0]
        self.shade = towards[towards > 0]
        self.elements = data.boundary[1][towards > 0]
        self.corners = look.flat(data.places)[self.faces]
        self.depths = look.depth(data.places)[self.faces].mean(axis=1)
        self.order = numpy.argsort(self.depths)
        self.low, self.high = self.corners.min(axis=1), self.corners.max(axis=1)

    def hides(self, point, depth, size):
        """Whether a face lies before a point."""
        near = ((self.low <= point) & (self.high >= point)).all(axis=1) & (self.depths > depth + 0.02 * size)
        return any(matplotlib.path.Path(corners).contains_point(point) for corners in self.corners[near])


def edges_of(data):
    """The body's edges, where two of its outer sides meet at an angle, as pairs of places; in the plane its outline."""
    sides = data.boundary[0]
    if data.n_dimensions == 2:
        return data.places[sides]
    of_sides = of_length_one(normals(data.places, sides))
    pairs = numpy.stack([sides, numpy.roll(sides, -1, axis=1)], axis=-1)
    keep = pairs[:, :, 0] != pairs[:, :, 1]
    owners = numpy.repeat(numpy.arange(len(sides)), keep.sum(axis=1))
    edges, place = numpy.unique(numpy.sort(pairs[keep], axis=1), axis=0, return_inverse=True)
    sums = numpy.zeros((len(edges), 3))
    numpy.add.at(sums, place.ravel(), of_sides[owners])
    counts = numpy.bincount(place.ravel(), minlength=len(edges))
    is_bent = numpy.linalg.norm(sums, axis=1) < 1.93 * counts / 2  # by more than 30 degrees
    return data.places[edges[is_bent]]
