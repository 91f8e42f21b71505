"""The sides of elements: those on the outside of a body, and the order in which they hide each other."""

# The corners of each side, by the number of an element's corners, as Exodus counts them. -1: a triangle has no fourth.
SIDES_2D = {3: [[0, 1], [1, 2], [2, 0]], 4: [[0, 1], [1, 2], [2, 3], [3, 0]]}
SIDES_3D = {8: [[0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [0, 4, 7, 3], [0, 3, 2, 1], [4, 5, 6, 7]],
            6: [[0, 1, 4, 3], [1, 2, 5, 4], [0, 3, 5, 2], [0, 2, 1, -1], [3, 4, 5, -1]],
            5: [[0, 1, 4, -1], [1, 2, 4, -1], [2, 3, 4, -1], [0, 4, 3, -1], [0, 3, 2, 1]],
            4: [[0, 1, 3, -1], [1, 2, 3, -1], [0, 3, 2, -1], [0, 2, 1, -1]]}


def all_sides(blocks, n_dimensions):
    """Of all elements: two corners each, or four, of a triangle -1 as the fourth; and the index of the element of each."""
    import numpy

    sides = SIDES_2D if n_dimensions == 2 else SIDES_3D
    none = [numpy.full((len(block), 1), -1) for block in blocks]  # the node that a triangle has as its fourth
    found = numpy.concatenate([numpy.hstack([block, missing])[:, sides[block.shape[1]]].reshape(-1, 2 * n_dimensions - 2)
                               for block, missing in zip(blocks, none)])
    n_sides = numpy.concatenate([numpy.full(len(block), len(sides[block.shape[1]])) for block in blocks])
    return found, numpy.repeat(numpy.arange(len(n_sides)), n_sides)


def closed(sides):
    """Triangles with their first corner as the fourth."""
    import numpy

    return numpy.where(sides < 0, sides[:, :1], sides)


def outer_sides(blocks, n_dimensions):
    """Those that no two elements share, triangles closed; and the index of the element of each."""
    import numpy

    sides, elements = all_sides(blocks, n_dimensions)
    _, first, count = numpy.unique(numpy.sort(sides, axis=1), axis=0, return_index=True, return_counts=True)
    outer = first[count == 1]
    return closed(sides[outer]), elements[outer]


def plane_of(toward):
    """The axes of a picture, to the right and up, as columns, seen from a direction."""
    import numpy

    toward = numpy.array(toward) / numpy.linalg.norm(toward)
    right = numpy.cross([0, 0, 1], toward) / numpy.linalg.norm(numpy.cross([0, 0, 1], toward))
    return numpy.stack([right, numpy.cross(toward, right)], axis=-1)


def seen(places, faces, toward):
    """Corners of faces in the plane of the picture, those in front last; and their order."""
    import numpy

    order = numpy.argsort((places @ numpy.array(toward))[faces].mean(axis=1))
    return (places @ plane_of(toward))[faces[order]], order
