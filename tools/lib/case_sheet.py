"""All drawings of a case on one sheet, with its tables; or each by itself, for the page."""

import io
import textwrap

import numpy
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Patch
from matplotlib.textpath import TextPath

import case_tables
from case_data import AXES
from case_drawing import CRACK, MARGIN, Drawing, draw_body_and_conditions, draw_cracks, escaped, formula
from case_look import Look
from runs import CLASSES
from sides import SIDES_2D, SIDES_3D, outer_sides, seen

# Of the body in a drawing, inches: in a row with another one, or in one of its own.
LARGEST, LONG = (5.0, 4.2), (8.6, 4.2)
DPI = 130
SYMBOLS = {"u_x", "u_y", "u_z", "u_d", "φ_x", "φ_y", "φ_z", "t", "p", "b", "g", "E", "l", "f_t", "s_crit", "G_c"}


def new_figure(width, height):
    figure = Figure(figsize=(width, height), facecolor="white")
    FigureCanvasAgg(figure)
    return figure


def scale_of(data, look):
    """Inches per length, the same in all drawings of the whole body."""
    largest = LONG if is_long(data, look) else LARGEST
    return float(min(largest / extent for largest, extent in zip(largest, numpy.ptp(look.flat(data.places), axis=0))))


def is_long(data, look):
    """Whether a drawing of the body takes a row of its own."""
    wide, high = numpy.ptp(look.flat(data.places), axis=0)
    return wide > 2 * high


# --- The morphing function ---


def draw_alpha(drawing):
    """Figures 6 (b), 10 (b), ... of WHL19. In three dimensions the zone alone, in the outline of the body, cut open."""
    if drawing.look.is_flat:
        patches = drawing.elements_drawn(array=drawing.data.alpha_of_elements(), cmap="viridis", antialiaseds=False)
    else:
        patches = draw_zone(drawing)
    patches.set_clim(0, 1)
    drawing.outline("#555555", 0.7)
    draw_cracks(drawing)
    bar = drawing.axes.inset_axes([0.3, 0.26 / drawing.size[1], 0.4, 0.1 / drawing.size[1]])
    drawing.axes.figure.colorbar(patches, cax=bar, orientation="horizontal", ticks=[0, 0.5, 1])
    bar.set_title("α", fontsize=9, pad=3)
    bar.tick_params(labelsize=8)


def draw_zone(drawing):
    """The outside of all elements where alpha is more than zero, without those before the plane of the section."""
    data, look, section = drawing.data, drawing.look, Section(drawing.data)
    alpha = data.alpha_of_elements()
    before = (data.middles()[:, section.axis] - section.place) * look.toward[section.axis] > 0
    drawn = (alpha > 0) & ~before
    blocks = numpy.split(drawn, numpy.cumsum([len(block) for block in data.blocks])[:-1])
    inside = [block[chosen] for block, chosen in zip(data.blocks, blocks) if chosen.any()]
    if not inside:
        return drawing.axes.add_collection(PolyCollection([], array=numpy.empty(0), cmap="viridis"))
    faces, owners = outer_sides(inside, 3)
    corners, order = seen(data.places, faces, look.toward)
    return drawing.axes.add_collection(PolyCollection(corners, array=alpha[drawn][owners[order]], cmap="viridis", edgecolors="#ffffff30",
                                                      linewidths=0.2, zorder=3))


# --- Mesh and blocks where cracks start ---


def corners_of(side):
    return [corner for corner in side if corner >= 0]


# The edges of elements in three dimensions by the number of corners; and those of a triangle.
EDGES = {n: sorted({tuple(sorted(pair)) for side in map(corners_of, sides) for pair in zip(side, side[1:] + side[:1])})
         for n, sides in SIDES_3D.items()} | {3: SIDES_2D[3]}


def cut(corners, axis, place):
    """Where a plane across an axis cuts an element or a triangle: corners in order around their middle."""
    beyond = corners[:, axis] - place
    points = numpy.array([(beyond[b] * corners[a] - beyond[a] * corners[b]) / (beyond[b] - beyond[a])
                          for a, b in EDGES[len(corners)] if beyond[a] * beyond[b] < 0]).reshape(-1, 3)
    flat = numpy.delete(points, axis, axis=1)
    around = flat - flat.mean(axis=0) if len(flat) else flat
    return flat[numpy.argsort(numpy.arctan2(around[:, 1], around[:, 0]))]


class Section:
    """The elements around the first zone, as polygons in a plane: in three dimensions as they are cut across the body's
    smallest extent."""

    def __init__(self, data):
        self.data = data
        (low, high), zones, horizon = data.box, list(data.table["Zones"].values()), data.table["Horizon"]
        self.axis = None if data.n_dimensions == 2 else int(numpy.argmin(high - low))
        self.kept = [axis for axis in range(data.n_dimensions) if axis != self.axis]
        center, self.half = 0.5 * (low + high), 3.5 * horizon
        if zones:
            lower, upper = (numpy.clip(zones[0][corner], low, high) for corner in ("Lower Corner", "Upper Corner"))
            center, reach = 0.5 * (lower + upper), 0.5 * (upper - lower)[self.kept].max() + 1.15 * zones[0]["Outer Radius"]
            self.half = min(max(reach, 2.5 * horizon), 3.5 * horizon)
        self.place = 0.0 if self.axis is None else center[self.axis]
        self.center = center[self.kept]

    @property
    def title(self):
        return "" if self.axis is None else f", cut at {AXES[self.axis]} = {case_tables.number(self.place)}"

    def flat(self, corners):
        return corners if self.axis is None else cut(corners, self.axis, self.place + 1e-4 * self.data.table["Element Size"])  # not through nodes

    def elements(self):
        """[(corners in the plane, number of the element)] of those that can be seen."""
        found, first = [], 0
        for block in self.data.blocks:
            corners = self.data.places[block]
            low, high = corners.min(axis=1), corners.max(axis=1)
            is_near = ((low[:, self.kept] < self.center + self.half) & (high[:, self.kept] > self.center - self.half)).all(axis=1)
            found += [(self.flat(corners[place]), first + place) for place in numpy.flatnonzero(is_near)]
            first += len(block)
        return [(corners, number) for corners, number in found if len(corners) > 2]

    def cracks(self):
        """Pre-cracks in the plane, as segments."""
        n = self.data.n_dimensions
        facets = [self.flat(facet) for crack in self.data.table["Pre-Cracks"].values()
                  for facet in crack["Corners"].reshape(-1, n, n)]
        return [line for line in facets if len(line) == 2]


BACKGROUND = {"boxstyle": "round,pad=0.15", "facecolor": "white", "edgecolor": "none", "alpha": 0.85}
MEANINGS = {"FE": "classical", "MORPH": "blended", "PD": "peridynamic", "DGFE": "peridynamic, discontinuous"}


def draw_circle(axes, center, radius, text, style):
    axes.add_patch(Circle(center, radius, fill=False, edgecolor="#111111", linewidth=1.2, linestyle=style, zorder=6))
    if text:
        axes.text(center[0], center[1] + radius, text, fontsize=8.5, ha="center", va="bottom", zorder=7,
                  bbox=BACKGROUND)


def draw_mesh(axes, data, section):
    """Elements in the colours of their classes, with the horizon and the characteristic length to scale."""
    found, colours = section.elements(), list(CLASSES.values())
    classes = data.classes_of_elements()
    width = 0.5 if section.half < 40 * data.table["Element Size"] else 0.2
    axes.add_collection(PolyCollection([corners for corners, _ in found], facecolors=[colours[classes[number]] for _, number in found],
                                       edgecolors="#445566", linewidths=width))
    axes.add_collection(LineCollection(section.cracks(), colors=CRACK, linewidths=2.4, zorder=5))
    length = next(iter(data.table["Materials"].values()))["Characteristic Length"]
    draw_circle(axes, section.center, data.table["Horizon"], f"horizon {case_tables.number(data.table['Horizon'])}", "-")
    draw_circle(axes, section.center, length, "", "-")
    beside = section.center + 0.75 * data.table["Horizon"] * numpy.array([1.0, -1.0])
    axes.annotate(f"l = {case_tables.number(length)}", section.center, beside, fontsize=8.5, ha="left", va="top", zorder=7,
                  arrowprops={"arrowstyle": "-", "linewidth": 0.8, "shrinkB": 0}, bbox=BACKGROUND)
    axes.set(xlim=section.center[0] + section.half * numpy.array([-1, 1]), ylim=section.center[1] + section.half * numpy.array([-1, 1]),
             xticks=[], yticks=[], xlabel=AXES[section.kept[0]], ylabel=AXES[section.kept[1]])
    counts = data.class_counts()
    axes.legend(handles=[Patch(facecolor=colour, edgecolor="#445566", label=f"{name}: {MEANINGS[name]}") for name, colour in CLASSES.items() if counts[name]],
                loc="upper center", bbox_to_anchor=(0.5, -0.07), ncol=2, fontsize=8, frameon=False, handlelength=1.2, columnspacing=1.2)


class MeshDrawing:
    """The square around the first zone."""

    size = (4.5, 5.0)

    def __init__(self, data):
        self.data = data

    def open(self, figure, left, top, title):
        whole_wide, whole_high = figure.get_size_inches()
        self.axes = figure.add_axes([(left + 0.4) / whole_wide, 1 - (top + 4.3) / whole_high, 3.9 / whole_wide, 3.9 / whole_high])
        write_title(figure, left, top, title)
        draw_mesh(self.axes, self.data, Section(self.data))


# --- Tables ---

ROW, FONT = 0.185, 8.5  # inches, points
MOST_STAGES = 5  # whose values stand beside each other


def shown(cell):
    """A cell's text for Matplotlib; symbols as formulas, long ones in lines."""
    return formula(cell) if cell in SYMBOLS else textwrap.fill(escaped(cell), 64)


def width_of(text):
    """In inches."""
    lines = [TextPath((0, 0), line, size=FONT).get_extents().width for line in text.split("\n") if line.strip()]
    return max(lines, default=0.0) / 72


class Tables:
    """The tables of a case, one below the other."""

    def __init__(self, data, stage):
        tables = case_tables.tables(data)
        if len(data.stages) > MOST_STAGES:
            tables["Conditions"] = case_tables.in_stage(tables["Conditions"], stage)
        self.tables = {title: [[shown(cell) for cell in row] for row in rows] for title, rows in tables.items()}

    def widths(self, rows):
        """Of each column, in inches, with the space between two."""
        n = max(map(len, rows))
        return [0.22 + max(width_of(row[column]) for row in rows if column < len(row)) for column in range(n)]

    @property
    def size(self):
        wide = max(sum(self.widths(rows)) for rows in self.tables.values())
        return 0.2 + wide, sum(0.34 + ROW * sum(map(lines_in, rows)) for rows in self.tables.values())

    def open(self, figure, left, top, _):
        whole_wide, whole_high = figure.get_size_inches()
        for title, rows in self.tables.items():
            write_title(figure, left, top, title)
            top += 0.34
            widths = self.widths(rows)
            for row in rows:
                for column, cell in enumerate(row):
                    figure.text((left + 0.1 + sum(widths[:column])) / whole_wide, 1 - top / whole_high, cell, fontsize=FONT, va="top",
                                color="#555555" if column == 0 else "#222222")
                top += ROW * lines_in(row)


def lines_in(row):
    return max(cell.count("\n") + 1 for cell in row)


# --- The sheet ---


def write_title(figure, left, top, title):
    wide, high = figure.get_size_inches()
    figure.text((left + 0.1) / wide, 1 - (top + 0.17) / high, escaped(title), fontsize=11, weight="bold", va="center")


def height(row):
    return max(part.size[1] for part, _ in row)


def sheet(data, stage, without=(), turn=0.0):
    """All on one figure."""
    look = Look(data.n_dimensions, turn)
    scale, cut_at = scale_of(data, look), Section(data).title
    body = Drawing(data, look, scale)
    alpha = Drawing(data, look, scale, (MARGIN[0], 0.6) if is_long(data, look) else (0.4, MARGIN[1]))  # below, or beside
    above = [(body, "Body and conditions" + stage_title(data, stage)), (alpha, "Morphing function at the start" + cut_at)]
    below = [(MeshDrawing(data), "Mesh and blocks" + cut_at), (Tables(data, stage), "")]
    rows = [[above[0]], [above[1]], below] if is_long(data, look) else [above, below]
    figure = new_figure(0.2 + max(sum(part.size[0] for part, _ in row) for row in rows), 0.55 + sum(map(height, rows)))
    figure.text(0.5, 1 - 0.28 / figure.get_size_inches()[1], escaped(data.title), fontsize=14, ha="center", va="center")
    top = 0.5
    for row in rows:
        left = 0.1
        for part, title in row:
            part.open(figure, left, top, title)
            left += part.size[0]
        top += height(row)
    draw_body_and_conditions(body, stage, without)
    draw_alpha(alpha)
    return figure


def stage_title(data, stage):
    return f": {data.stages[stage]}" if len(data.stages) > 1 else ""


def picture(data, kind, stage=0, without=(), turn=0.0):
    """One of them by itself: "conditions", "alpha" or "mesh"."""
    look = Look(data.n_dimensions, turn)
    part = MeshDrawing(data) if kind == "mesh" else Drawing(data, look, scale_of(data, look), MARGIN if kind == "conditions" else (0.4, 0.55))
    figure = new_figure(*part.size)
    part.open(figure, 0.0, 0.0, "")
    if kind == "conditions":
        draw_body_and_conditions(part, stage, without)
    elif kind == "alpha":
        draw_alpha(part)
    stream = io.BytesIO()
    figure.savefig(stream, format="png", dpi=DPI)
    return stream.getvalue()
