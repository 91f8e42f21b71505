"""What the studies share that measure how cost grows: a square of n x n elements of size 1, or a cube of n x n x n, held
at the bottom, with a traction on the top, in three models: finite elements only, hybrid with a peridynamic zone of a
twentieth of the area or volume (as around a crack from the left edge or face to the middle), all peridynamic; and "small zone":
finite elements with a zone of three horizons in the middle. Horizon 3 unless the caller says otherwise, l = 1/5. Nothing
breaks."""

import os

from case_file import write_case
from cases import make_mesh

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
"""
GROUPS = {2: """
Physical Surface("body") = {1};
Physical Curve("bottom") = {1};
Physical Curve("top") = {3};
""", 3: """
drawn() = Extrude {0, 0, n} { Surface{1}; Layers{n}; Recombine; };
Physical Volume("body") = {drawn(1)};
Physical Surface("bottom") = {drawn(2)};
Physical Surface("top") = {drawn(4)};
"""}
MATERIAL = {2: {"Poisson's Ratio": 1 / 3, "Elastic Model": "Plane Stress"},
            3: {"Poisson's Ratio": 1 / 4, "Elastic Model": "Three-Dimensional"}}

MODELS = ("FE only", "hybrid", "all peridynamic")
POLICIES = ("On Damage", "Whole Zone")


def zone(model, n, dimension, horizon):
    """Its seeds."""
    if model == "FE only":
        return {}
    if model == "small zone":
        return {"zone": {"Shape": {2: "Circle", 3: "Sphere"}[dimension], "Center": [0.5 * n] * dimension,
                         "Inner Radius": 2.0 * horizon, "Outer Radius": 3.0 * horizon}}
    if model == "all peridynamic":
        return {"zone": {"Shape": "Everything"}}
    return {"zone": {"Shape": "Box", "Lower Corner": [-1, 0.45 * n, -1][:dimension],
                     "Upper Corner": [0.5 * n, 0.55 * n, n + 1][:dimension], "Rim": 2.0 * horizon}}


def side_for(unknowns, model="FE only", policy="On Damage", dimension=2):
    """How many elements along a side give about so many unknowns."""
    discontinuous = model == "all peridynamic" and policy == "Whole Zone"
    nodes = unknowns / dimension
    return round((nodes / 2**dimension) ** (1 / dimension) if discontinuous else nodes ** (1 / dimension) - 1)


def square(folder, n, model, policy="On Damage"):
    """The case file; its mesh is made if it is not there."""
    return body(folder, n, model, policy, 2, 3.0)


def cube(folder, n, model, policy="On Damage", horizon=3.0):
    """The same in three dimensions."""
    return body(folder, n, model, policy, 3, horizon)


def body(folder, n, model, policy, dimension, horizon):
    os.makedirs(folder, exist_ok=True)
    shape = {2: "square", 3: "cube"}[dimension]
    mesh = os.path.join(folder, f"{shape}-{n}")
    if not os.path.exists(mesh + ".msh"):
        make_mesh(mesh, GEOMETRY.format(n=n) + GROUPS[dimension], "-bin", dimension=dimension)
    name = f"{model}, {policy}, {n}" if dimension == 2 else f"cube, {model}, {policy}, {horizon:g}, {n}"
    file = os.path.join(folder, f"{name}.xml".replace(" ", "-").replace(",", ""))
    held = {component: {"Group": "bottom", "Component": component} for component in "xyz"[:dimension]}
    write_case(file, {
        "Title": f"{shape.capitalize()}, {model}",
        "Dimension": dimension,
        "Mesh": {"File": os.path.abspath(mesh + ".msh")},
        "Material": {"Young's Modulus": 30000.0, **MATERIAL[dimension]},
        "Peridynamics": {"Horizon": horizon, "Characteristic Length": 0.2},
        "Morphing": {"Discontinuous Elements": policy, "Seeds": zone(model, n, dimension, horizon)},
        "Boundary Conditions": {"Displacements": held, "Tractions": {"pull": {"Group": "top", "Rate": [0, 1, 0][:dimension]}}},
        "Loading": {"Increments": 1},
        "Solver": {"Tolerance": 1e-6, "Damage Tolerance": 1e-6},  # equal: one solve, unless its residual falls short
        "Output": {"Reactions": ["bottom"]},
    })
    return file
