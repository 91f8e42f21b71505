"""The cases of tools/studies/published-cases: what others published of each, and how the same is taken from a run."""

import collections
import csv
import functools
import os

import numpy as np

from cases import run
from runs import History

SOURCES = {
    "Miehe": "C. Miehe, M. Hofacker, F. Welschinger, Computer Methods in Applied Mechanics and Engineering 199, 2010, 2765-2778: phase fields; their "
             "curves as GitHub's CastillonMiguel/phasefieldx has digitised them (examples/PhaseFieldFracture/reference_solutions)",
    "phasefieldx": "the same repository's own runs (examples/PhaseFieldFracture, the reactions of 1711, 1712, 1714), whose supports are taken here",
    "Winkler": "B. Winkler, thesis, Innsbruck 2001: the envelope of his tests in GitHub's fpled/MYCODE "
               "(examples/phasefield/dataLshapedPanelWinkler); a single curve in PSAAPGroupLinder/lShapedPanelBenchmark (experimental) bears 7219 N at 0.208",
    "Garcia-Alvarez": "V. O. Garcia-Alvarez, R. Gettu, I. Carol, Sadhana 37(1), 2012, 187-205: the envelope and the material in GitHub's "
                      "mark-hobbs/pypd (examples/mixed_mode_fracture.py and its data)",
    "Gregoire": "D. Gregoire, L. Rojas-Solano, G. Pijaudier-Cabot, International Journal for Numerical and Analytical Methods in Geomechanics 37(10), "
                "2013, 1434-1452: measured.csv of the case",
    "Wagner": "D. Wagner, thesis, University of Texas at San Antonio 2018, figures 5.10, 5.12a and 5.11: cracks measured in fatigue, as GitHub's CastillonMiguel/A-Phase-Field-Approach-"
              "to-Fracture-and-Fatigue-Analysis-Bridging-Theory-and-Simulation has digitised them (examples/Papers_Data)",
    "WHL19": "WHL19, section 5.1, text",
    "mechanics": "fracture mechanics by finite elements, this command",
}


# --- What is taken from a run ---


class Results:
    """A run: its case file and folder."""

    def __init__(self, file, output):
        self.file, self.output = file, output

    @functools.cached_property
    def history(self):
        return History(self.output)

    def column(self, name):
        return np.array(self.history[name])

    @functools.cached_property
    def sides(self):
        """The ends of all sides of elements that have opened: an array (sides, ends, x and y)."""
        with open(os.path.join(self.output, "crack_path.csv"), newline="") as file:
            ends = [[float(row[name]) for name in ("x_1", "y_1", "x_2", "y_2")] for row in csv.DictReader(file)]
        return np.reshape(ends, (-1, 2, 2))


def largest(column):
    return lambda results: np.abs(results.column(column)).max()


def at_largest(other, column):
    """Of another column, where this one is largest."""
    return lambda results: abs(results.column(other)[np.argmax(np.abs(results.column(column)))])


def at(displacement, column):
    """The force of a column "<group>_<component>" at a displacement."""
    return lambda results: np.interp(displacement, np.abs(results.column("displacement_" + column)), np.abs(results.column("reaction_" + column)))


def first_break(results):
    return results.column("increment")[np.argmax(results.column("broken_bonds") > 0)]


def largest_drop(column):
    """The increment in which it falls most."""
    return lambda results: results.column("increment")[np.argmin(np.diff(np.abs(results.column(column)))) + 1]


def crack_height(x, near=0.5):
    """The mean height of the crack's sides near x, if it came there."""
    def height(results):
        middles = results.sides.mean(axis=1)
        there = middles[np.abs(middles[:, 0] - x) < near, 1]
        return there.mean() if len(there) else np.nan

    return height


def crack_end(results):
    """How far along x it came."""
    return results.sides[:, :, 0].max()


@functools.lru_cache
def notch_runs(results):
    """The displacement and the force at which the edge notch runs under tension, by the energy that a longer one releases. The zone is taken
    aside, and elements are finest everywhere."""
    step, energy, seed = 0.00625, 2.7, "Morphing/Seeds/tip of the notch/"
    elastic = []
    for tip in (-step, step):
        output = f"{results.output}-elastic"
        run(results.file, output, settings=[
            "Loading/Increments=1", "Mesh/Perturbation=0", "Mesh/Refinement/Margin=100000", f"{seed}Center={{0.45, 0.45}}", f"{seed}Inner Radius=0.04",
            f"{seed}Outer Radius=0.08", f"Pre-Cracks/notch/Points={{-0.51, 0, {tip}, 0}}"])
        elastic.append(History(output))
    stored = [history["elastic_energy"][0] for history in elastic]
    factor = np.sqrt(energy * 2 * step / (stored[0] - stored[1]))
    return factor * elastic[0]["displacement_top_y"][0], factor * np.mean([history["reaction_top_y"][0] for history in elastic])


# --- The table ---


class Figure(collections.namedtuple("Figure", "name published source perimorph why")):
    """One figure. published: a number, the lowest and the highest of several, or a function of the run's results."""

    def row(self, case, results):
        published = self.published(results) if callable(self.published) else self.published
        bounds = np.atleast_1d(published)
        value = self.perimorph(results)
        ratios = sorted({f"{value / bound:.2f}" for bound in bounds})
        found = ["none", "none"] if np.isnan(value) else [f"{value:.4g}", " to ".join(ratios)]
        return [case, self.name, " to ".join(f"{bound:.4g}" for bound in bounds), self.source, *found, self.why]


class Case(collections.namedtuple("Case", "file figures settings force", defaults=((), None))):
    """A case file in inputs/ and what is compared. force: the column whose peak is, so that the run is ended well past it."""

    @property
    def is_enough(self):
        return self.has_fallen if self.force else None

    def has_fallen(self, rows):
        forces = [abs(float(row[self.force])) for row in rows]
        return bool(forces) and forces[-1] < 0.7 * max(forces)


def compact_tension(height, mesh, figures):
    """The specimen with its crack at another height."""
    return Case("compact_tension_holes/compact_tension_holes.xml", figures, (
        f"Mesh/File={mesh}.geo", f"Morphing/Seeds/tip of the crack/Center={{8, {height}}}",
        f"Pre-Cracks/crack/Points={{-11, {height}, 8, {height}}}", f"Loading/Measure/Point={{-10, {height + 0.01}}}",
        f"Loading/Measure/Other Point={{-10, {height - 0.01}}}"))


def heights(measured, why):
    """Of a crack at some x, and how far it comes: to the edge of a hole."""
    *places, end = measured
    return [*(Figure(f"height of the crack at x = {x:g} [mm]", y, "Wagner", crack_height(x), why) for x, y in places),
            Figure("how far it comes, x [mm]", end, "Wagner", crack_end, why)]


CASES = {
    "edge notch, tension": Case("edge_notch/edge_notch_tension.xml", [
        Figure("largest force [N]", 701.2, "Miehe", largest("reaction_top_y"), "their crack runs later than fracture mechanics says, see below"),
        Figure("largest force [N]", 691.5, "phasefieldx", largest("reaction_top_y"), "the same"),
        Figure("largest force [N]", lambda results: notch_runs(results)[1], "mechanics", largest("reaction_top_y"),
               "held up where it steps between perturbed elements"),
        Figure("displacement there [mm]", 0.00555, "Miehe", at_largest("displacement_top_y", "reaction_top_y"), "as the force"),
        Figure("displacement there [mm]", lambda results: notch_runs(results)[0], "mechanics",
               at_largest("displacement_top_y", "reaction_top_y"), "the same; it creeps meanwhile"),
    ], force="reaction_top_y"),
    "edge notch, shear": Case("edge_notch/edge_notch_shear.xml", [
        Figure("largest force [N]", 531.2, "Miehe", largest("reaction_top_x"), "their crack feels tension only; our bonds break by stretch"),
        Figure("largest force [N]", 494.7, "phasefieldx", largest("reaction_top_x"), "a phase field four times as long there"),
        Figure("displacement there [mm]", 0.0096, "Miehe", at_largest("displacement_top_x", "reaction_top_x"), "a flat peak"),
    ], force="reaction_top_x"),
    "L-shaped panel": Case("l_panel/l_panel.xml", [
        Figure("force at 0.06 mm [N]", (2203, 2798), "Winkler", at(0.06, "lift_y"), "missed: with the E that is given; the tests were softer"),
        Figure("largest force [N]", (6700, 7600), "Winkler", largest("reaction_lift_y"), "within what was measured"),
        Figure("displacement there [mm]", 0.2, "Winkler", at_largest("displacement_lift_y", "reaction_lift_y"), "stiffer, as above"),
        Figure("force at 0.3 mm [N]", (4000, 6000), "Winkler", at(0.3, "lift_y"), "missed: G_f is 0.065 here, others take up to 0.16"),
    ], ("Loading/Increments=15",)),
    "V-notched beam": Case("v_notched_beam/v_notched_beam.xml", [
        Figure("largest force [N]", 34.75, "Miehe", largest("reaction_platen_y"), "no crack at first: a length decides, of the phase field or of elements"),
        Figure("largest force [N]", 35.16, "phasefieldx", largest("reaction_platen_y"), "the same"),
        Figure("displacement there [mm]", 0.039, "Miehe", at_largest("displacement_platen_y", "reaction_platen_y"), "the same"),
    ], force="reaction_platen_y"),
    "offset notch": Case("offset_notch_beam/offset_notch_beam.xml", [
        Figure("largest force [N]", (4894, 5405), "Garcia-Alvarez", largest("reaction_platen_y"), "missed: too tough by this G_f, see the case"),
    ], force="reaction_platen_y"),
    "half-notched beam": Case("concrete_beam/concrete_beam.xml", [
        Figure("largest force [N]", (926, 1113), "Gregoire", largest("reaction_platen_y"), "within what was measured"),
    ], ("Mesh/Thickness=50",), "reaction_platen_y"),
    "compact tension, crack at 1.6": compact_tension(1.6, "compact_tension_holes", heights(
        [(12.2, 1.83), (15.1, 2.26), (18.0, 3.32), 20.3], "at most 0.6 off, two and a half elements")),
    "compact tension, crack at 0.8": compact_tension(0.8, "compact_tension_holes_low", heights(
        [(14.9, 1.33), (20.2, 2.56), (25.0, 3.40), 29.6], "missed: caught by the first hole; half a mm decides")),
    "compact tension, crack at -1.6": compact_tension(-1.6, "compact_tension_holes_below", heights(
        [(15.1, -1.85), (20.6, -2.45), (24.2, -3.53), 27.8], "missed: the right hole, but up to 1.3 off the way there")),
    "Brazilian disk with a slit": Case("brazilian_disk/brazilian_disk.xml", [
        Figure("step of the first crack", 84, "WHL19", first_break, "diameter and contacts are assumed, see the case"),
        Figure("step of the collapse", 92, "WHL19", largest_drop("reaction_top_y"), "missed: slit without width, l a fifth of an element, see the case"),
    ]),
}
