"""A case in tables, for the sheet and the page of tools/preview."""

import numpy

from case_data import numbers_text


def number(value):
    return numbers_text(numpy.array([value]))


def point(values):
    return numbers_text(numpy.asarray(values))


def extents(data):
    return " x ".join(number(extent) for extent in data.box[1] - data.box[0])


def materials(data):
    """A row each; columns that no material has are left out."""
    columns = {"Young's Modulus": "E", "Poisson's Ratio": "ν", "Density": "ρ", "Thermal Expansion": "α_T", "Tensile Strength": "f_t",
               "Compressive Strength": "f_c", "Characteristic Length": "l", "Critical Stretch": "s_crit", "Fracture Energy": "G_c"}
    entries = data.table["Materials"]
    used = [name for name in columns if any(name in entry for entry in entries.values())]
    blocks = {place: ", ".join(name for name, block in data.table["Blocks"].items() if block["Material"] == place)
              for place in range(len(entries))}
    rows = [[name, *(number(entry[column]) if column in entry else "–" for column in used), blocks[place]]
            for place, (name, entry) in enumerate(entries.items())]
    return [["", *(columns[name] for name in used), "blocks"], *rows]


def interfaces(data):
    rows = [[name, number(entry["Critical Stretch"]), number(entry["Fracture Energy"])]
            for name, entry in data.table["Interfaces"].items() if entry]
    return [["", "s_crit", "G_c"], *rows] if rows else []


def zone_text(zone):
    lower, upper = zone["Lower Corner"], zone["Upper Corner"]
    if zone["Inner Radius"] == 0:
        return f"from {point(lower)} to {point(upper)}, rim {number(zone['Outer Radius'])}"
    place = f"around {point(lower)}" if (lower == upper).all() else f"around the line from {point(lower)} to {point(upper)}"
    return f"{place}, r₁\u00a0=\u00a0{number(zone['Inner Radius'])}, r₂\u00a0=\u00a0{number(zone['Outer Radius'])}"


def crack_text(data, crack):
    """Length of a line, area of a surface."""
    corners = crack["Corners"].reshape(-1, data.n_dimensions, data.n_dimensions)
    sides = corners[:, 1:] - corners[:, :1]
    if data.n_dimensions == 2:
        return f"{number(numpy.linalg.norm(sides, axis=-1).sum())} long"
    return f"area {number(0.5 * numpy.linalg.norm(numpy.cross(sides[:, 0], sides[:, 1]), axis=-1).sum())}"


def sizes(data):
    size, horizon = data.table["Element Size"], data.table["Horizon"]
    counts = ", ".join(f"{count} {name}" for name, count in data.class_counts().items() if count)
    thickness = data.table["Thickness"]
    thick = f", {number(thickness)} thick" if thickness != 1 else ""
    rows = [["body", f"{extents(data)}{thick}, {data.table['Elastic Model'].lower()}"], ["elements", f"{data.table['Elements']}: {counts}"],
            ["element size", f"{size:.3g} where cracks start"], ["horizon", f"{number(horizon)} = {horizon / size:.2g} elements"]]
    rows += [["zone" if place == 0 else "", zone_text(zone)] for place, zone in enumerate(data.table["Zones"].values())]
    rows += [[f"crack {name}", crack_text(data, crack)] for name, crack in data.table["Pre-Cracks"].items()]
    return rows


def place_text(place):
    return f"group {place['Group']}" if "Group" in place else point(place["Point"])


def measure(data):
    entry = data.table["Measure"]
    if not entry:
        return []
    last = list(data.table["Stages"].values())[-1]["Last Increment"]
    where = place_text(entry["Place"]) + (f" less {place_text(entry['Other Place'])}" if entry["Other Place"] else "")
    return [["measure", f"displacement of {where}, along {point(entry['Direction'])}"],
            ["", f"{number(entry['Value'])} in increment {last}; the load factor λ follows"]]


def stage_names(data):
    """The heads of the columns of values."""
    if data.follows_measure:
        return ["at load factor λ"]
    return [f"{name}, to {stage['Last Increment']}" if len(data.stages) > 1 else f"in increment {stage['Last Increment']}"
            for name, stage in data.table["Stages"].items()]


def condition_row(data, condition):
    """Name, group, symbol, and the values in each stage."""
    values = [condition.text(stage, data.follows_measure) for stage in range(len(stage_names(data)))]
    return [condition.name, condition.place, condition.symbol, *values]


def conditions(data):
    return [["", "on", "", *stage_names(data)], *(condition_row(data, condition) for condition in data.conditions)]


def in_stage(rows, stage):
    """Of the rows of conditions, without the columns of other stages."""
    return [row[:3] + row[3 + stage:4 + stage] for row in rows]


def other_groups(data):
    """Names that no condition has."""
    used = {condition.group for condition in data.conditions}
    return [name for name in data.node_sets if name not in used]


def points_text(data, numbers):
    points = numbers.reshape(-1, data.n_dimensions)
    return point(points[0]) + (f" to {point(points[-1])}" if len(points) > 1 else "")


def others(data):
    rows = [[f"probe {name}", points_text(data, probe["Points"])] for name, probe in data.table["Probes"].items()]
    groups = other_groups(data)
    return rows + ([["other groups", ", ".join(groups)]] if groups else [])


def tables(data):
    """{title: rows}"""
    found = {"Material": materials(data), "Interfaces": interfaces(data), "Sizes": sizes(data), "Conditions": conditions(data),
             "Control": measure(data), "Others": others(data)}
    return {title: rows for title, rows in found.items() if rows}
