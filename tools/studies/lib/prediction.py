"""Tables and a chart of what scaling_model.py predicts."""

import matplotlib.pyplot as plt
from scaling_model import Machine, Variant, blamed, efficiency, levels, per_iteration
from scaling_runs import seconds
from tables import print_table

CLUSTER = Machine(latency=1.5e-6, overhead=0.4e-6, bandwidth=1e9, memory=4e9, cache=1e6)
GOAL = 0.8
COLOURS = ("#4a4a4a", "#1f5fa8", "#c8442c")
AS_IT_IS = Variant()
AS_IT_WAS = Variant("within", 99)  # before this prediction was made
VARIANTS = {
    "as they are": AS_IT_IS,
    "as they were: aggregates within ranks": AS_IT_WAS,
    "as they were, but for those that are no coarser": Variant("stop", 99),
    **{f"a V-cycle below level {level}": Variant("across", level) for level in (1, 3, 5)},
    **{f"Rows per Rank = {rows}": Variant("across", 99, rows) for rows in (50, 100, 200, 1000)}}


def print_counts_check(models):
    """Fitted to the runs on few ranks alone, what does the model say of those on many?"""
    rows = []
    for name, model in models.items():
        most = max(run.ranks for run in model.runs)
        few = type(model)([run for run in model.runs if run.ranks <= most // 4])
        for run in model.runs:
            if run.ranks <= most // 4:
                continue
            costs = few.costs(CLUSTER, run.unknowns, run.ranks, AS_IT_IS)
            counted = [sum(per_iteration(run, part, column) for part in run.parts) for column in ("messages_max", "bytes_read_max")]
            said = sum(cost.n_messages for cost in costs), sum(cost.n_read for cost in costs)
            rows.append([name, str(run.unknowns), str(run.ranks), str(len(run.parts) - 2),
                         str(len(levels(run.unknowns, run.ranks, few.width, AS_IT_IS))), f"{counted[0]:.0f}", f"{said[0]:.0f}",
                         f"{counted[1] / 1e6:.1f}", f"{said[1] / 1e6:.1f}"])
    print_table(f"Counted on more than {most // 4} ranks, and what the model says that was fitted to the runs on fewer.",
                ["model", "unknowns", "ranks", "levels", "model's", "messages", "model's", "MB read", "model's"], rows)


def print_times_check(models, here):
    print(f"Here: {text(here)}.")
    rows = []
    for name, model in models.items():
        for run in model.runs:
            if run.ranks > 2:
                continue
            measured = seconds(run) / run.parts[1]["visits_max"]
            said = model.seconds(here, run.unknowns, run.ranks, AS_IT_IS)
            rows.append([name, str(run.unknowns), str(run.ranks), f"{1e3 * measured:.2f}", f"{1e3 * said:.2f}",
                         f"{said / measured:.2f}" + (" (fitted)" if run is model.alone else "")])
    print_table("One iteration here, processor time [ms] of the rank with most in each part, in the fastest run of several.",
                ["model", "unknowns", "ranks", "measured", "predicted", "ratio"], rows)


def text(machine):
    return (f"latency {1e6 * machine.latency:.2f} us, {1e6 * machine.overhead:.2f} us for each message, "
            f"{machine.bandwidth / 1e9:.3g} GB/s of network and {machine.memory / 1e9:.3g} GB/s of memory for a core, "
            f"cache of {machine.cache / 1e6:.3g} MB")


def cases(options):
    """[(kind, unknowns of one rank alone, [(unknowns, ranks)])]"""
    return [("weak", options.each, [(options.each * ranks, ranks) for ranks in options.ranks]),
            ("strong", options.all, [(options.all, ranks) for ranks in options.ranks])]


def print_prediction(models, options):
    print(f"Predicted for {text(options.machine)}.")
    for kind, alone, points in cases(options):
        rows = []
        for name, model in models.items():
            for unknowns, ranks in points:
                costs = model.costs(options.machine, unknowns, ranks, AS_IT_IS)
                share = efficiency(model, options.machine, unknowns, ranks, AS_IT_IS, alone)
                terms = (sum(cost.work for cost in costs if not cost.is_gathered),
                         sum(cost.work for cost in costs if cost.is_gathered),
                         sum(cost.messages for cost in costs), sum(cost.reductions for cost in costs))
                rows.append([name, str(ranks), str(len(costs) - 2), f"{model.iterations(unknowns):.1f}",
                             *(milliseconds(term) for term in (*terms, sum(terms))), f"{100 * share:.3g} %",
                             blamed(model, options.machine, unknowns, ranks, AS_IT_IS, alone) if ranks > 1 else ""])
        what = f"{options.each} unknowns for each rank" if kind == "weak" else f"{options.all} unknowns in all"
        print_table(f"{kind.capitalize()} scaling, {what}; an iteration [ms].",
                    ["model", "ranks", "levels", "iterations", "work of all", "of holders", "messages", "reductions", "sum",
                     "efficiency", "most of the loss"], rows)


def milliseconds(value):
    return f"{1e3 * value:.3g}" if value < 1 else f"{1e3 * value:.0f}"


def print_variants(models, options):
    many = [ranks for ranks in options.ranks if ranks > 10] or options.ranks[-1:]
    rows = [[name, *(f"{100 * efficiency(model, options.machine, options.each * ranks, ranks, variant, options.each):.3g}"
                     for ranks in many for model in models.values())] for name, variant in VARIANTS.items()]
    print_table(f"Weak efficiency [%] with {options.each} unknowns for each rank, iterations as they are (goal: {100 * GOAL:.0f} "
                "on 1000).",
                ["coarse levels", *(f"{name}, {ranks}" for ranks in many for name in models)], rows)


def draw(models, options, file):
    figure, panels = plt.subplots(1, 2, figsize=(10, 4.4), sharey=True)
    titles = (f"weak: {options.each:,} unknowns for each rank", f"strong: {options.all:,} unknowns")
    for panel, (_, alone, points), title in zip(panels, cases(options), titles):
        for colour, (name, model) in zip(COLOURS, models.items()):
            for variant, style in ((AS_IT_IS, "-"), (AS_IT_WAS, "--")):
                panel.semilogx([ranks for _, ranks in points],
                               [efficiency(model, options.machine, unknowns, ranks, variant, alone) for unknowns, ranks in points],
                               color=colour, linestyle=style, marker="o", markersize=4,
                               label=name if variant is AS_IT_IS else f"{name}, as it was")
        panel.set_title(title, fontsize=10, loc="left")
        panel.set_xlabel("ranks")
        panel.grid(True, color="#e4e4e4", linewidth=0.6)
        for side in ("top", "right"):
            panel.spines[side].set_visible(False)
    panels[0].axhline(GOAL, color="#b0b0b0", linestyle=":")
    panels[0].set_ylabel("predicted efficiency")
    panels[0].set_ylim(0, 1.05)
    panels[0].legend(frameon=False, fontsize=8)
    figure.tight_layout()
    figure.savefig(file, dpi=150)
