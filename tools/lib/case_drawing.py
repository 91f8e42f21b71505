"""Draws the body of a case with its dimensions, supports, loads, cracks and probes."""

import functools

import matplotlib.colors
import numpy
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.patches import Patch

import case_tables
from case_data import AXES, of_length_one
from case_look import Hull, edges_of
from case_symbols import (ABOVE, BODY_FORCE, COLOURS, FAINT, HEAT, SUPPORT, Labels, across, arrow_ends, draw_arrow, draw_support,
                          draw_turn, evenly)

TINTS = ["#dfe6ee", "#f0dfc4", "#dcead6", "#ead9e8", "#e3e3d3", "#d5e8ea"]  # of materials
CRACK, MEASURED, PROBE, MIXED = "#7a1010", "#0f7f7f", "#c98a1b", "#333333"
SYMBOL = 0.24  # inches
MARGIN = (1.6, 1.4)  # of a drawing with labels around it, inches


def escaped(text):
    """A user's name in a text in which Matplotlib looks for formulas."""
    return text.replace("$", r"\$")


def formula(symbol):
    name, _, index = symbol.partition("_")
    return f"${name}_{{{index}}}$" if index else f"${name}$"


# --- A drawing of the body ---


class Drawing:
    """Axes in which a body is drawn to scale, with room around it."""

    def __init__(self, data, look, scale, margin=MARGIN):
        """@param scale inches per length"""
        self.data, self.look, self.scale, self.margin = data, look, scale, margin
        flat = look.flat(data.places)
        self.low, self.high = flat.min(axis=0), flat.max(axis=0)
        self.symbol = SYMBOL / scale

    @property
    def size(self):
        """In inches, with the line of its title."""
        wide, high = (self.high - self.low) * self.scale + 2 * numpy.array(self.margin)
        return wide, high + 0.3

    def open(self, figure, left, top, title):
        """Makes the axes; left and top in inches from the figure's upper left corner."""
        (wide, high), (whole_wide, whole_high) = self.size, figure.get_size_inches()
        high -= 0.3
        self.axes = figure.add_axes([left / whole_wide, 1 - (top + 0.3 + high) / whole_high, wide / whole_wide, high / whole_high])
        for axis, (low, up, margin) in enumerate(zip(self.low, self.high, self.margin)):
            (self.axes.set_ylim if axis else self.axes.set_xlim)(low - margin / self.scale, up + margin / self.scale)
        self.axes.set_axis_off()
        figure.text((left + 0.1) / whole_wide, 1 - (top + 0.17) / whole_high, escaped(title), fontsize=11, weight="bold", va="center")
        return self.axes

    def outline(self, colour="#333333", width=0.9):
        """The body's edges, those behind it faintly."""
        edges = edges_of(self.data)
        clearly = numpy.ones(len(edges)) if self.look.is_flat else self.as_seen(edges.mean(axis=1))
        colours = [(*matplotlib.colors.to_rgb(colour), share) for share in clearly]
        self.axes.add_collection(LineCollection(self.look.flat(edges), colors=colours, linewidths=width * clearly**0.5, zorder=4,
                                                capstyle="round"))

    @functools.cached_property
    def hull(self):
        return Hull(self.data, self.look)

    def as_seen(self, places):
        """How clearly places on the body are seen: 1, or faintly behind it."""
        if self.look.is_flat:
            return numpy.ones(len(places))
        points, depths, size = self.look.flat(places), self.look.depth(places), numpy.linalg.norm(self.high - self.low)
        return numpy.array([FAINT if self.hull.hides(point, depth, size) else 1.0 for point, depth in zip(points, depths)])

    def elements_drawn(self, **how):
        """Of a body in the plane."""
        places = self.data.places
        collection = PolyCollection([places[nodes] for nodes in self.data.elements()], zorder=2, **how)
        self.axes.add_collection(collection)
        return collection

    def mesh_width(self):
        """Of the mesh's lines: none if they would be all that one sees."""
        pixels = self.data.table["Element Size"] * self.scale * 72
        return 0.0 if pixels < 2.5 else min(0.4, 0.06 * pixels)

    def body(self):
        """In the colours of its materials, with the mesh if there is room for it."""
        colours = numpy.array([matplotlib.colors.to_rgb(tint) for tint in TINTS])[self.data.materials_of_elements() % len(TINTS)]
        width = self.mesh_width()
        lines = {"linewidths": width or 0.2}
        if self.look.is_flat:
            self.elements_drawn(facecolors=colours, edgecolors="#9aa7b4" if width else colours, **lines)
        else:
            hull = self.hull
            shaded = colours[hull.elements] * (0.78 + 0.22 * hull.shade[:, None])
            self.axes.add_collection(PolyCollection(hull.corners[hull.order], facecolors=shaded[hull.order], zorder=2,
                                                    edgecolors="#9aa7b4" if width else shaded[hull.order], **lines))
        self.outline()


def draw_materials(drawing):
    """Which colour is which, if there are several."""
    names = list(drawing.data.table["Materials"])
    handles = [Patch(facecolor=TINTS[place % len(TINTS)], edgecolor="#9aa7b4", label=escaped(name)) for place, name in enumerate(names)]
    if len(names) > 1:
        drawing.axes.legend(handles=handles, loc="lower right", fontsize=8, frameon=False, handlelength=1.2)


def draw_axes_of_space(drawing):
    """The directions of space, in a corner."""
    axes, look, length = drawing.axes, drawing.look, 0.42 / drawing.scale
    room = numpy.array([0.5, 0.42] if not look.is_flat else [0.3, 0.25]) / drawing.scale
    corner = numpy.array([axes.get_xlim()[0], axes.get_ylim()[0]]) + room
    for name, axis in zip(AXES, look.axes):
        axes.annotate("", corner + length * axis, corner, annotation_clip=False,
                      arrowprops={"arrowstyle": "-|>,head_length=0.3,head_width=0.13", "color": "#666666", "linewidth": 0.9,
                                  "shrinkA": 0, "shrinkB": 0})
        axes.text(*(corner + 1.3 * length * axis), name, fontsize=8, color="#666666", ha="center", va="center")
    return numpy.array([corner, *(corner + 1.4 * length * axis for axis in look.axes)])


def draw_dimension(drawing, start, end, away, text):
    """A line with arrows beside the body. @param away from the body, a vector of the plane"""
    axes = drawing.axes
    for point in (start, end):
        axes.plot(*numpy.array([point + 0.15 * away, point + 1.12 * away]).T, color="#888888", linewidth=0.5, zorder=3)
    start, end = start + away, end + away
    axes.annotate("", end, start, annotation_clip=False,
                  arrowprops={"arrowstyle": "<|-|>,head_length=0.35,head_width=0.12", "color": "#555555", "linewidth": 0.7,
                              "shrinkA": 0, "shrinkB": 0})
    angle = numpy.degrees(numpy.arctan2(*(end - start)[::-1]))
    axes.text(*(0.5 * (start + end)), text, fontsize=8.5, color="#444444", ha="center", va="center", zorder=5,
              rotation=(angle + 89) % 180 - 89, bbox={"boxstyle": "square,pad=0.15", "facecolor": "white", "edgecolor": "none"})
    return numpy.array([start, end])


def dimension_edges(drawing):
    """For each axis an edge of the body's box (two places) at its outside in the picture, and the way out."""
    (low, high), look = drawing.data.box, drawing.look
    wide, far = (numpy.array(drawing.margin) - 0.2) / drawing.scale
    if look.is_flat:
        return [(low, numpy.array([high[0], low[1]]), numpy.array([0, -far])), (low, numpy.array([low[0], high[1]]), numpy.array([-wide, 0]))]
    found = []
    near = numpy.where(look.toward > 0, high, low)
    for axis in range(3):
        start = near.copy()
        start[2] = low[2]
        if axis == 2:  # the vertical edge at the left
            corners = [numpy.array([x, y, low[2]]) for x in (low[0], high[0]) for y in (low[1], high[1])]
            start = min(corners, key=lambda corner: look.flat(corner)[0]).copy()
        end = start.copy()
        start[axis], end[axis] = low[axis], high[axis]
        out = across(of_length_one(look.flat(end) - look.flat(start)))
        middle = look.flat(0.5 * (low + high))
        if out @ (look.flat(0.5 * (start + end)) - middle) < 0:
            out = -out
        found.append((start, end, 0.6 * far * out))
    return found


def draw_dimensions(drawing, labels):
    extents = drawing.data.box[1] - drawing.data.box[0]
    for (start, end, away), extent in zip(dimension_edges(drawing), extents):
        line = draw_dimension(drawing, drawing.look.flat(start), drawing.look.flat(end), away, case_tables.number(extent))
        labels.keep_free_along(*line)


# --- Conditions ---


class GroupSymbols:
    """The symbols of all conditions on one group."""

    def __init__(self, drawing, group, held, loads, stage):
        self.drawing, self.group, self.held, self.loads, self.stage = drawing, group, held, loads, stage
        self.places, self.normals = drawing.data.where(group)
        self.drawn = []  # points of the plane that symbols reach

    def draw(self):
        look, spacing = self.drawing.look, 1.5 * self.drawing.symbol
        chosen = evenly(look.flat(self.places), spacing)
        self.clearly = dict(zip(chosen, self.drawing.as_seen(self.places[chosen])))
        axes_held = [condition.axis for condition in self.held if condition.axis is not None]
        if len(axes_held) == self.drawing.data.n_dimensions:
            for at in chosen:
                self.fix(at)
        else:
            for axis in axes_held:
                for at in self.places_along(axis, chosen):
                    self.support(axis, at)
        for condition in self.loads:
            self.turn(condition) if condition.symbol.startswith("φ") else self.arrows(condition, chosen)
        return numpy.concatenate([look.flat(self.places[chosen]), *self.drawn])

    def places_along(self, axis, chosen):
        """Where a body is held along a side rather than across it, its end says all."""
        across_it = [at for at in chosen if abs(self.normals[at] @ axis) > 0.3]
        return across_it or [min(chosen, key=lambda at: self.places[at] @ axis)]

    def turn(self, condition):
        """A rotation that is prescribed: an arc around the middle of the group."""
        sense = numpy.sign(condition.value(self.stage)[0])
        self.drawn.append(draw_turn(self.drawing.axes, self.drawing.look.flat(self.places.mean(axis=0)), self.drawing.symbol, sense,
                                    COLOURS[condition.kind]))

    def fix(self, at):
        """Held in all directions."""
        normal = self.normals[at]
        axis = int(numpy.argmax(numpy.abs(normal))) if normal.any() else 1
        self.support(numpy.eye(self.drawing.data.n_dimensions)[axis], at, is_fixed=True)

    def support(self, axis, at, is_fixed=False):
        toward = 1.0 if self.normals[at] @ axis <= 0.05 else -1.0
        direction = of_length_one(self.drawing.look.flat(toward * axis))
        tip = self.drawing.look.flat(self.places[at])
        self.drawn.append(draw_support(self.drawing.axes, tip, direction, self.drawing.symbol, is_fixed, self.clearly.get(at, 1.0)))

    def arrows(self, condition, chosen):
        """One at each place, but for those that would lie on another."""
        kept = []
        for at in chosen:
            ends = self.arrow_at(condition, at)
            if all(apart(ends, other, self.drawing.symbol) for other in kept):
                kept.append(ends)
                self.drawn.append(draw_arrow(self.drawing.axes, *ends, COLOURS[condition.kind], condition.kind == "Displacements",
                                             self.clearly[at]))

    def arrow_at(self, condition, at):
        """Its ends in the plane."""
        direction = condition.direction(self.stage)
        if direction is None:  # a pressure
            direction = -self.normals[at] * numpy.sign(condition.value(self.stage)[0])
        flat = self.drawing.look.flat
        along = flat(direction) / max(numpy.linalg.norm(flat(direction)), 0.5)
        slope = direction @ self.normals[at]
        normal = of_length_one(flat(self.normals[at])) if abs(slope) < 0.2 else slope * along
        return arrow_ends(flat(self.places[at]), along, normal, 1.7 * self.drawing.symbol)


def apart(ends, other, size):
    """Whether an arrow does not lie on another one that points in its direction."""
    shaft, other_shaft = ends[1] - ends[0], other[1] - other[0]
    length, along, way = numpy.linalg.norm(shaft), of_length_one(shaft), other[1] - ends[1]
    return along @ of_length_one(other_shaft) < 0.9 or abs(way @ along) > length + 0.2 * size or abs(way @ across(along)) > 0.5 * size


def value_lines(data, conditions, stage):
    """A line each: what is prescribed, and its value at the end of a stage."""
    return [f"{formula(c.symbol)} = {c.text(stage, data.follows_measure)}" for c in conditions]


def group_text(data, group):
    """Its name, what its nodes share, and whether the body goes on beyond it."""
    if group in data.mirrors:
        return f"{escaped(group)}, a plane of symmetry"
    shared = data.rigid.get(group)
    if shared is None:
        return escaped(group)
    return f"{escaped(group)}, {'a rigid body' if shared == 'Rigid Motion' else 'one ' + formula(f'u_{shared}')}"


def draw_group(drawing, labels, group, conditions, stage):
    """Symbols of a group; returns what its label needs: text, place, way out, colour."""
    held = [c for c in conditions if c.holds(stage)]
    loads = [c for c in conditions if not c.holds(stage)]
    symbols = GroupSymbols(drawing, group, held, loads, stage)
    if not len(symbols.places):
        return None
    reached = symbols.draw()
    for points in symbols.drawn:
        labels.keep_free(points)
    out = drawing.look.flat(symbols.normals.sum(axis=0))
    text = "\n".join([group_text(drawing.data, group), *value_lines(drawing.data, conditions, stage)])
    colours = {COLOURS[load.kind] for load in loads} or {SUPPORT}
    colour = colours.pop() if len(colours) == 1 else MIXED
    anchor = drawing.look.flat(symbols.places.mean(axis=0))
    out = of_length_one(out)
    farthest = max(0.0, ((reached - anchor) @ out).max()) if out.any() else 0.0
    near = numpy.linalg.norm(reached - anchor - farthest * out, axis=1)
    return text, reached[numpy.argmin(near)], out, colour


def draw_everywhere(drawing, labels, conditions, stage):
    """A body force: one arrow in the middle; a temperature: words alone."""
    middle = drawing.look.flat(0.5 * (drawing.data.box[0] + drawing.data.box[1]))
    for place, condition in enumerate(conditions):
        if condition.kind == "Temperatures":
            text = "\n".join([escaped(condition.name), *value_lines(drawing.data, [condition], stage), escaped(condition.place)])
            labels.put(text, middle, numpy.zeros(2), HEAT)
            continue
        along = drawing.look.flat(condition.direction(stage))
        tail = middle + place * across(along) * 3 * drawing.symbol
        ends = draw_arrow(drawing.axes, tail, tail + 2.6 * drawing.symbol * along, BODY_FORCE, False)
        labels.keep_free(ends)
        labels.put("\n".join([condition.name, *value_lines(drawing.data, [condition], stage)]), tail, -along, BODY_FORCE)


def draw_conditions(drawing, labels, stage, without):
    """All that act in a stage, by groups."""
    acting = [c for place, c in enumerate(drawing.data.conditions) if place not in without and not c.is_idle(stage)]
    groups = {}
    for condition in acting:
        groups.setdefault(condition.group, []).append(condition)
    everywhere = groups.pop(None, [])
    # All symbols first: labels keep clear of them.
    for label in [draw_group(drawing, labels, group, conditions, stage) for group, conditions in groups.items()]:
        if label:
            labels.put(*label)
    draw_everywhere(drawing, labels, everywhere, stage)


# --- Cracks, probes, what is measured ---


def facets_of(drawing, crack):
    n = drawing.data.n_dimensions
    return drawing.look.flat(crack["Corners"].reshape(-1, n, n))


def draw_cracks(drawing):
    for crack in drawing.data.table["Pre-Cracks"].values():
        facets = facets_of(drawing, crack)
        if drawing.look.is_flat:
            drawing.axes.add_collection(LineCollection(facets, colors=CRACK, linewidths=2.2, zorder=5, capstyle="round"))
        else:
            drawing.axes.add_collection(PolyCollection(facets, facecolors=CRACK, edgecolors="none", alpha=0.35, zorder=5))


def label_cracks(drawing, labels):
    for name, crack in drawing.data.table["Pre-Cracks"].items():
        facets = facets_of(drawing, crack)
        along = of_length_one(facets[0][1] - facets[0][0])
        labels.put(f"{escaped(name)}: {case_tables.crack_text(drawing.data, crack)}", facets.reshape(-1, 2).mean(axis=0), across(along), CRACK)


def draw_probes(drawing, labels):
    lines = {name: drawing.look.flat(probe["Points"].reshape(-1, drawing.data.n_dimensions))
             for name, probe in drawing.data.table["Probes"].items()}
    for name, points in lines.items():
        drawing.axes.plot(*points.T, "-x", color=PROBE, markersize=5, markeredgewidth=1.4, linewidth=0.9, zorder=ABOVE + 1)
        middle = points.mean(axis=0)
        away = of_length_one(middle - numpy.concatenate(list(lines.values())).mean(axis=0))  # so that two have their names beside them
        labels.put(escaped(name), middle, away if away.any() else numpy.array([0.0, 1.0]), PROBE)


def place_of(data, place):
    """Of one that is measured at: a point, or the middle of a group."""
    return place["Point"] if "Point" in place else data.places[data.nodes_of(place["Group"])].mean(axis=0)


def draw_measure(drawing, labels):
    """Arrows apart, or one along the direction."""
    data, entry = drawing.data, drawing.data.table["Measure"]
    if not entry:
        return
    flat, along = drawing.look.flat, of_length_one(drawing.look.flat(entry["Direction"]))
    for place, sign in [("Place", 1.0), ("Other Place", -1.0)]:
        if not entry[place]:
            continue
        point = flat(place_of(data, entry[place]))
        drawing.axes.plot(*point, "o", color=MEASURED, markersize=4, zorder=ABOVE + 1)
        labels.keep_free(draw_arrow(drawing.axes, point, point + sign * 1.3 * drawing.symbol * along, MEASURED, False))
    text = f"measure, up to {case_tables.number(entry['Value'])}"
    labels.put(text, flat(place_of(data, entry["Place"])), -across(along), MEASURED)


def draw_other_groups(drawing, labels):
    """Groups without conditions: a thin line of dots, and their names."""
    for group in case_tables.other_groups(drawing.data):
        places, group_normals = drawing.data.where(group)
        if not len(places):
            continue
        points = drawing.look.flat(places)
        drawing.axes.plot(*points.T, ".", color="#999999", markersize=2, zorder=ABOVE - 1)
        out = drawing.look.flat(group_normals.sum(axis=0))
        labels.put(group_text(drawing.data, group), points.mean(axis=0), out, "#777777")


def points_of_body(drawing):
    """Some that are dense in the picture, for labels to stay off: nodes, and middles of elements."""
    return drawing.look.flat(numpy.concatenate([drawing.data.places, drawing.data.middles()]))


def draw_body_and_conditions(drawing, stage, without):
    """Figures 6 (a), 10 (a), ... of WHL19."""
    drawing.body()
    labels = Labels(drawing.axes, points_of_body(drawing))
    draw_materials(drawing)
    draw_cracks(drawing)
    draw_dimensions(drawing, labels)
    labels.keep_free(draw_axes_of_space(drawing))
    draw_conditions(drawing, labels, stage, without)
    draw_measure(drawing, labels)
    label_cracks(drawing, labels)
    draw_probes(drawing, labels)
    draw_other_groups(drawing, labels)
