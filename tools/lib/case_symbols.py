"""Symbols of supports and loads, and labels beside them. Lengths of symbols are in units of the drawing's plane."""

import matplotlib.patches
import matplotlib.transforms
import numpy

from case_data import of_length_one

SUPPORT, MOVED, FORCE, BODY_FORCE, HEAT = "#2b6e3f", "#1f5fa8", "#c8442c", "#8a5bb0", "#b07a1e"
COLOURS = {"Displacements": MOVED, "Tractions": FORCE, "Pressures": FORCE, "Body Force": BODY_FORCE, "Self-Weight": BODY_FORCE,
           "Temperatures": HEAT}
ABOVE = 6  # zorder of symbols; the body is below
FAINT = 0.3  # what the body hides


def spread(points, spacing, most=14):
    """The places of some points that are about so far from each other: those at the ends first."""
    chosen = [int(numpy.argmax(numpy.linalg.norm(points - points.mean(axis=0), axis=1)))]
    distance = numpy.linalg.norm(points - points[chosen[0]], axis=1)
    while len(chosen) < min(most, len(points)) and distance.max() > 0:
        chosen.append(int(numpy.argmax(distance)))
        distance = numpy.minimum(distance, numpy.linalg.norm(points - points[chosen[-1]], axis=1))
        if distance.max() < spacing:
            break
    return chosen


def evenly(points, spacing, most=14):
    """The same along a line, evenly; of a surface as spread()."""
    middle = points - points.mean(axis=0)
    _, sizes, axes = numpy.linalg.svd(middle, full_matrices=False)
    if len(points) < 3 or sizes[1] > 0.2 * sizes[0]:
        return spread(points, spacing, most)
    along = middle @ axes[0]
    n = min(most, max(2, int(round(numpy.ptp(along) / spacing)) + 1))
    return sorted({int(numpy.argmin(abs(along - place))) for place in numpy.linspace(along.min(), along.max(), n)})


def across(direction):
    return numpy.array([-direction[1], direction[0]])


def draw_support(axes, tip, direction, size, is_fixed, alpha=1.0):
    """A triangle whose tip holds the body; on rollers, or on firm ground. Returns its corners.
    @param direction in which it pushes, of length 1"""
    side = across(direction) * 0.5 * size
    base = tip - direction * 0.85 * size
    axes.add_patch(matplotlib.patches.Polygon([tip, base + side, base - side], facecolor="white", edgecolor=SUPPORT, linewidth=1.1,
                                              zorder=ABOVE, alpha=alpha))
    ground = base if is_fixed else base - direction * 0.22 * size
    line = numpy.array([ground - 1.4 * side, ground + 1.4 * side])
    axes.plot(*line.T, color=SUPPORT, linewidth=1.1, zorder=ABOVE, alpha=alpha)
    if is_fixed:
        for share in numpy.linspace(-1.2, 1.2, 5):
            start = ground + share * side
            hatch = numpy.array([start, start - direction * 0.25 * size - 0.35 * side])
            axes.plot(*hatch.T, color=SUPPORT, linewidth=0.8, zorder=ABOVE, alpha=alpha)
    return numpy.array([tip, *line, ground - direction * 0.25 * size])


def draw_arrow(axes, tail, tip, colour, has_bar, alpha=1.0):
    """A force, or with a bar at its tail a prescribed displacement. Returns its ends."""
    axes.annotate("", tip, tail, zorder=ABOVE, annotation_clip=False,
                  arrowprops={"arrowstyle": "-|>,head_length=0.45,head_width=0.2", "color": colour, "linewidth": 1.3,
                              "shrinkA": 0, "shrinkB": 0, "alpha": alpha})
    if has_bar:
        side = across(of_length_one(tip - tail)) * 0.22 * numpy.linalg.norm(tip - tail)
        axes.plot(*numpy.array([tail - side, tail + side]).T, color=colour, linewidth=1.3, zorder=ABOVE, alpha=alpha)
    return numpy.array([tail, tip])


def draw_turn(axes, middle, size, sense, colour):
    """Three quarters of a circle with an arrow at its end. Returns its points."""
    angles = sense * numpy.linspace(0.25, 1.75, 40) * numpy.pi
    points = middle + size * numpy.column_stack([numpy.cos(angles), numpy.sin(angles)])
    axes.plot(*points.T, color=colour, linewidth=1.3, zorder=ABOVE)
    draw_arrow(axes, points[-3], points[-1], colour, has_bar=False)
    return points


def arrow_ends(place, direction, normal, length):
    """Outside the body: it points at its place if it presses there, and away if it pulls; along a side it lies beside it."""
    slope = float(direction @ normal)
    if abs(slope) < 0.2 and normal.any():
        middle = place + 0.35 * length * normal
        return middle - 0.5 * length * direction, middle + 0.5 * length * direction
    return (place - length * direction, place) if slope < 0 else (place, place + length * direction)


# --- Labels ---


def overlap(box, other):
    """The area that two boxes share, in pixels²."""
    wide = min(box.x1, other.x1) - max(box.x0, other.x0)
    high = min(box.y1, other.y1) - max(box.y0, other.y0)
    return max(0.0, wide) * max(0.0, high)


class Labels:
    """Puts labels where they hide nothing: neither the body nor symbols nor each other."""

    def __init__(self, axes, body):
        """@param body points of it, (n, 2), close to each other"""
        self.axes = axes
        self.taken = []
        self.body = axes.transData.transform(body)
        self.renderer = axes.figure.canvas.get_renderer()

    def keep_free(self, points, margin=4.0):
        """The box around some points of the plane."""
        pixels = self.axes.transData.transform(points)
        self.taken.append(matplotlib.transforms.Bbox([pixels.min(axis=0) - margin, pixels.max(axis=0) + margin]))

    def keep_free_along(self, start, end):
        """A line, in short pieces: the box around a slanting one would be large."""
        pieces = numpy.linspace(start, end, 25)
        for piece in zip(pieces, pieces[1:]):
            self.keep_free(numpy.array(piece), margin=12.0)

    def cost(self, box, distance):
        """Of a place: what it hides, and how far it is."""
        inside = ((self.body > [box.x0, box.y0]) & (self.body < [box.x1, box.y1])).all(axis=1).any()
        frame = self.axes.bbox
        outside = box.width * box.height - overlap(box, frame)
        hidden = [overlap(box, other) for other in self.taken]
        return sum(8.0 * area + 300.0 * (area > 0) for area in hidden) + 5.0 * outside + 1500.0 * inside + 4.0 * distance

    def put(self, text, anchor, direction, colour="#222222", near=6.0):
        """A label at a point, preferably in a direction of the plane. Returns it."""
        label = self.axes.text(*anchor, text, fontsize=8.5, color=colour, zorder=ABOVE + 3, ha="center", va="center", linespacing=1.25,
                               bbox={"boxstyle": "round,pad=0.2", "facecolor": "white", "edgecolor": "none", "alpha": 0.8})
        own = label.get_window_extent(self.renderer)
        start, best = self.axes.transData.transform(anchor), None
        angle = numpy.arctan2(direction[1], direction[0]) if numpy.any(direction) else 0.0
        for distance in near + numpy.array([0.0, 8.0, 20.0, 40.0, 65.0, 95.0, 130.0]):
            for turn in numpy.radians([0, 25, -25, 50, -50, 80, -80, 120, -120, 180]):
                toward = numpy.array([numpy.cos(angle + turn), numpy.sin(angle + turn)])
                # The box's nearest corner or side is so far away.
                middle = start + toward * distance + 0.5 * numpy.array([own.width, own.height]) * toward / max(abs(toward))
                box = matplotlib.transforms.Bbox.from_bounds(*(middle - [0.5 * own.width, 0.5 * own.height]), own.width, own.height)
                cost = self.cost(box, distance + 12.0 * abs(turn))
                if best is None or cost < best[0]:
                    best = (cost, middle, box, distance)
        _, middle, box, distance = best
        label.set_position(self.axes.transData.inverted().transform(middle))
        self.taken.append(box.padded(3.0))
        if distance > near + 10.0:
            self.lead(start, box, colour)
        return label

    def lead(self, start, box, colour):
        """A thin line from a label to what it is about."""
        end = numpy.clip(start, [box.x0, box.y0], [box.x1, box.y1])
        line = self.axes.transData.inverted().transform([start, end])
        self.axes.plot(*line.T, color=colour, linewidth=0.6, zorder=ABOVE + 2)
