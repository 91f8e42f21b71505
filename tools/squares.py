"""What the Python tools share that measure how cost grows: a square of n x n elements of size 1, held at the bottom, with
a traction on the top, in three models: finite elements only, hybrid with a peridynamic zone of a twentieth of the area
(as around a crack from the left edge to the middle), all peridynamic. Horizon 3, l = 1/5. Nothing breaks."""

import os

from cases import make_mesh, write_case

GEOMETRY = """
n = {n};
Point(1) = {{0, 0, 0}};
Point(2) = {{n, 0, 0}};
Point(3) = {{n, n, 0}};
Point(4) = {{0, n, 0}};
For i In {{1:4}}
  Line(i) = {{i, i % 4 + 1}};
EndFor
Curve Loop(1) = {{1:4}};
Plane Surface(1) = {{1}};
Transfinite Curve{{1:4}} = n + 1;
Transfinite Surface{{1}};
Recombine Surface{{1}};
Physical Surface("body") = {{1}};
Physical Curve("bottom") = {{1}};
Physical Curve("top") = {{3}};
"""

MODELS = ("FE only", "hybrid", "all peridynamic")
POLICIES = ("On Damage", "Whole Zone")


def zone(model, n):
    """Its seeds."""
    if model == "FE only":
        return {}
    if model == "all peridynamic":
        return {"zone": {"Shape": "Everything"}}
    return {"zone": {"Shape": "Box", "Lower Corner": f"{{-1, {0.45 * n}}}", "Upper Corner": f"{{{0.5 * n}, {0.55 * n}}}",
                     "Rim": 6.0}}


def side_for(unknowns, model="FE only", policy="On Damage"):
    """How many elements along a side give about so many unknowns."""
    discontinuous = model == "all peridynamic" and policy == "Whole Zone"
    return round((unknowns / 8) ** 0.5 if discontinuous else (unknowns / 2) ** 0.5 - 1)


def square(folder, n, model, policy="On Damage"):
    """The case file; its mesh is made if it is not there."""
    os.makedirs(folder, exist_ok=True)
    mesh = os.path.join(folder, f"square-{n}")
    if not os.path.exists(mesh + ".msh"):
        make_mesh(mesh, GEOMETRY.format(n=n), "-bin")
    file = os.path.join(folder, f"{model}, {policy}, {n}.xml".replace(" ", "-").replace(",", ""))
    held = {component: {"Group": "bottom", "Component": component} for component in "xy"}
    write_case(file, {
        "Title": f"Square, {model}",
        "Mesh": {"File": os.path.abspath(mesh + ".msh")},
        "Material": {"Young's Modulus": 30000.0, "Poisson's Ratio": 1 / 3, "Elastic Model": "Plane Stress"},
        "Peridynamics": {"Horizon": 3.0, "Characteristic Length": 0.2},
        "Morphing": {"Discontinuous Elements": policy, "Seeds": zone(model, n)},
        "Boundary Conditions": {"Displacements": held, "Tractions": {"pull": {"Group": "top", "Rate": "{0, 1}"}}},
        "Loading": {"Increments": 1},
        "Solver": {"Tolerance": 1e-6, "Damage Tolerance": 1e-6},  # equal: one solve, unless its residual falls short
        "Output": {"Reactions": "{bottom}"},
    })
    return file
