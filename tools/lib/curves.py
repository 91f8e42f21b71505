"""Force-displacement curves, drawn by Matplotlib; shared by tools/plot-history and tools/report."""

from messages import fail, need
from runs import axis_label, curves_of, label, magnitudes

need("matplotlib")
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

COLOURS = ["#1f5fa8", "#c8442c", "#3a8f4d", "#8a5bb0", "#c98a1b", "#4a4a4a"]


def style(axes):
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    axes.grid(True, color="#e4e4e4", linewidth=0.6)
    axes.set_axisbelow(True)
    axes.ticklabel_format(style="sci", scilimits=(-3, 4), useMathText=True)


def save(figure, output, **options):
    try:
        figure.savefig(output, **options)
    except (OSError, ValueError) as error:
        fail(f"{output}: the picture cannot be written: {error}")


def mark(axes, history, events, curve):
    """A numbered ring at each event on a curve."""
    for number, event in enumerate(events, start=1):
        place = tuple(magnitudes(history, name)[event.row] for name in curve)
        axes.plot(*place, "o", markersize=9, fillstyle="none", color="#222222")
        axes.annotate(str(number), place, xytext=(7, 5), textcoords="offset points", fontsize=10)


def draw(histories, x=None, y=None, events=()):
    """A figure of the curves of all histories; the events are marked on the first curve of the first."""
    with_bonds = any(history.is_nonzero("broken_bonds") for history in histories)
    figure, panels = plt.subplots(
        2 if with_bonds else 1, 1, sharex=True, squeeze=False, figsize=(7.2, 5.6 if with_bonds else 4.4),
        gridspec_kw={"height_ratios": [3, 1] if with_bonds else [1], "hspace": 0.08}, layout="constrained")
    upper, lower = panels[0][0], panels[-1][0]
    xs, ys, n_drawn = set(), set(), 0
    for history in histories:
        curves = curves_of(history, x, y)
        for x_name, y_name in curves:
            colour = COLOURS[n_drawn % len(COLOURS)]
            n_drawn += 1
            xs.add(x_name)
            ys.add(y_name)
            values = magnitudes(history, y_name)
            run, curve = history.name if len(histories) > 1 else "", label(y_name) if len(curves) > 1 else ""
            text = ": ".join(part for part in (run, curve) if part)
            upper.plot(magnitudes(history, x_name), values, color=colour, linewidth=1.6, marker="o", markersize=2.6,
                       label=text or None)
        if with_bonds and "broken_bonds" in history.columns:
            first = COLOURS[(n_drawn - len(curves)) % len(COLOURS)]
            lower.step(magnitudes(history, curves[0][0]), history["broken_bonds"], where="post", linewidth=1.2,
                       color=first if len(histories) > 1 else "#4a4a4a")
    upper.set_ylabel(axis_label(ys))
    lower.set_xlabel(axis_label(xs))
    if with_bonds:
        lower.set_ylabel("broken bonds")
        lower.set_ylim(bottom=0)
        style(lower)
    style(upper)
    if upper.get_legend_handles_labels()[1]:
        upper.legend(frameon=False)
    if len(histories) == 1:
        upper.set_title(histories[0].name, loc="left", fontsize=11)
    mark(upper, histories[0], events, curves_of(histories[0], x, y)[0])
    figure.align_ylabels()
    return figure
