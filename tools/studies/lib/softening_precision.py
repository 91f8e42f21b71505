"""The softening part of tools/studies/work-precision: force over crack-mouth opening of the beam in inputs/concrete_beam."""

import csv
import os
import pathlib

import matplotlib.pyplot as plt
import numpy as np

from cases import ROOT, run
from curves import COLOURS
from precision_runs import write_rows

CASE = pathlib.Path(ROOT) / "inputs" / "concrete_beam"
THICKNESS = 50.0  # of the beam that was measured; the case's is 1
OPENINGS = [0.02, 0.04, 0.06, 0.08, 0.12, 0.16, 0.20]  # at which forces are told
COMPARED = np.linspace(0.005, 0.12, 200)  # openings over which curves differ by so much

# What is run: elements, characteristic length, horizon, fracture energy, law. The first is the reference of those that
# share its lengths and material.
AS_THE_CASE = {"dx": 2.5, "l": 1.25, "horizon": 15.0, "energy": 0.075, "law": "Bilinear"}
SETTINGS = {
    "mesh": [{"dx": 1.25}, {}, {"dx": 5.0}],
    "length": [{"l": 1.667, "horizon": 20.0}, {"l": 1.667, "horizon": 20.0, "dx": 5.0}, {"l": 0.8333, "horizon": 10.0}],
    "horizon": [{"horizon": 11.25}],
    "material": [{"energy": 0.143}, {"law": "Exponential"}, {"law": "Brittle"}],
}


def write_case_of(folder, setting):
    """The case with other elements, in a folder of its own; of brittle bonds without what only soft ones have."""
    geometry = (CASE / "concrete_beam.geo").read_text()
    assert "dx = 2.5;" in geometry
    (folder / "concrete_beam.geo").write_text(geometry.replace("dx = 2.5;", f"dx = {setting['dx']:g};"))
    lines = (CASE / "concrete_beam.xml").read_text().splitlines(keepends=True)
    of_soft_bonds = ('"Bond Law"', '"Tensile Strength"') if setting["law"] == "Brittle" else ()
    (folder / "concrete_beam.xml").write_text("".join(
        line for line in lines if not any(name in line for name in of_soft_bonds)))


def curve_of(output, rows):
    """Openings of the mouth, and forces on the whole beam."""
    with open(os.path.join(output, "probes.csv"), newline="") as file:
        probes = list(csv.DictReader(file))
    side = lambda name: {p["increment"]: float(p["displacement_x"]) for p in probes if p["probe"].startswith(name)}
    left, right = side("left"), side("right")
    opening = np.array([right[row["increment"]] - left[row["increment"]] for row in rows])
    return opening, -THICKNESS * np.array([float(row["reaction_platen_y"]) for row in rows])


def settings_of(setting):
    return [f"Peridynamics/Characteristic Length={setting['l']}", f"Peridynamics/Horizon={setting['horizon']}",
            f"Material/Fracture Energy={setting['energy']}", f"Material/Bond Law={setting['law']}"]


def difference(curve, reference):
    """Mean difference of forces over the mean force, up to the last opening that is compared."""
    forces, others = (np.interp(COMPARED, *one) for one in (curve, reference))
    return np.abs(forces - others).mean() / others.mean()


def measured():
    return np.loadtxt(CASE / "measured.csv", delimiter=",", skiprows=1).T


def measure(folder):
    rows, curves, references = [], [], {}
    folder = pathlib.Path(folder)
    opening, lowest, highest = measured()
    print("measured  largest force " + f"{lowest.max():.0f} to {highest.max():.0f}; at openings of "
          + ", ".join(f"{at:g}: {np.interp(at, opening, lowest):.0f} to {np.interp(at, opening, highest):.0f}" for at in OPENINGS))
    for study, changes in SETTINGS.items():
        for change in changes:
            setting = {**AS_THE_CASE, **change}
            write_case_of(folder, setting)
            output = str(folder / "concrete_beam")
            one = run(str(folder / "concrete_beam.xml"), output, settings=settings_of(setting))
            curve = curve_of(output, one.history)
            key = tuple(value for name, value in setting.items() if name != "dx")
            reference = references.setdefault(key, curve)
            solves = [int(row["linear_solves"]) for row in one.history]
            rows.append({
                "study": study, **setting, "largest": f"{curve[1].max():.0f}",
                **{f"at_{at:g}": f"{np.interp(at, *curve):.0f}" for at in OPENINGS},
                "difference": f"{difference(curve, reference):.4f}",
                "imbalance": f"{float(one.history[-1]['jump_loss']) / float(one.history[-1]['dissipated_energy']):.4f}",
                "most_solves": max(solves), "mean_solves": f"{np.mean(solves):.1f}",
                "unknowns": one.history[-1]["unknowns"], "seconds": f"{one.processor:.3g}", "memory_mb": f"{one.memory:.0f}"})
            curves.append(curve)
            print("  ".join(f"{key} {value}" for key, value in rows[-1].items()), flush=True)
            write_rows(folder / "softening.csv", rows)
    draw(rows, curves, folder / "softening.png")


def draw(rows, curves, file):
    figure, panels = plt.subplots(1, 4, figsize=(13, 5.4), gridspec_kw={"width_ratios": [2, 1, 1, 1]})
    forces, *costs = panels
    forces.fill_between(*measured(), color="#e4e4e4", label="measured")
    styles = iter(COLOURS * 2)
    for row, curve in zip(rows, curves):
        if row["law"] == "Brittle":
            continue
        text = f"dx {row['dx']:g}, l {row['l']:g}, horizon {row['horizon']:g}, G_f {row['energy']:g}, {row['law']}"
        colour = next(styles)
        forces.plot(*curve, color=colour, linewidth=1.2, linestyle="-" if row["dx"] == 2.5 else "--", label=text)
        if float(row["difference"]) > 0:
            for panel, column in zip(costs, ("seconds", "unknowns", "memory_mb")):
                panel.plot(float(row[column]), 100 * float(row["difference"]), "o", color=colour)
    forces.set(xlim=(0, 0.2), ylim=(0, None), xlabel="opening of the mouth [mm]", ylabel="force [N]")
    for panel, label in zip(costs, ("processor time [s]", "unknowns", "memory [MB]")):
        panel.set(xlabel=label, ylim=(0, 3), xlim=(0, 1.1 * panel.get_xlim()[1]))
    costs[0].set_ylabel("difference from the finer mesh [%]")
    for panel in panels:
        panel.grid(True, color="#e4e4e4", linewidth=0.6)
    figure.legend(*forces.get_legend_handles_labels(), loc="lower center", ncol=3, frameon=False, fontsize=8)
    figure.subplots_adjust(left=0.06, right=0.99, top=0.97, bottom=0.3, wspace=0.3)
    figure.savefig(file, dpi=120)
