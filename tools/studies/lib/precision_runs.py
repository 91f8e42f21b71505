"""What tools/studies/work-precision runs: plates in plane stress and slabs in plane strain, on whose outer boundary an exact
displacement is prescribed, node by node."""

import csv

import numpy as np

E, NU = 30000.0, (1.0 / 3.0, 1.0 / 4.0)  # in two and in three dimensions


def lattice(x):
    """The quadrilaterals between the lines x = const. and y = const."""
    nodes = np.column_stack([axis.ravel() for axis in np.meshgrid(x, x)])
    n = len(x)
    first = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).ravel()
    return nodes, np.column_stack([first, first + 1, first + n + 1, first + n])


def write_mesh(file, nodes, elements, groups):
    """A mesh of triangles, quadrilaterals or hexahedra, MSH 2.2, with groups of nodes.

    nodes: positions (n, 2 or 3); elements: (m, 3, 4 or 8), from 0; groups: {name: numbers of nodes, from 0}.
    """
    dimension, kind = {3: (2, 2), 4: (2, 3), 8: (3, 5)}[len(elements[0])]
    members = [(tag, n + 1) for tag, group in enumerate(groups.values(), start=2) for n in group]
    with open(file, "w") as out:
        out.write(f'$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{len(groups) + 1}\n{dimension} 1 "body"\n')
        out.writelines(f'0 {tag} "{name}"\n' for tag, name in enumerate(groups, start=2))
        out.write(f"$EndPhysicalNames\n$Nodes\n{len(nodes)}\n")
        out.writelines(f"{n} " + " ".join(repr(float(x)) for x in node) + " 0" * (3 - dimension) + "\n"
                       for n, node in enumerate(nodes, start=1))
        out.write(f"$EndNodes\n$Elements\n{len(elements) + len(members)}\n")
        out.writelines(f"{i} 15 2 {tag} {n} {n}\n" for i, (tag, n) in enumerate(members, start=1))
        out.writelines(f"{i} {kind} 2 1 1 " + " ".join(str(n + 1) for n in element) + "\n"
                       for i, element in enumerate(elements, start=len(members) + 1))
        out.write("$EndElements\n")


def write_body(file, nodes, elements, boundary, layers=0, size=1.0):
    """The mesh of a plane body, or of the slab that it becomes when drawn out into layers of that size, which cannot strain
    across its thickness. Each node of the boundary is a group n0, n1, ..., with those above it."""
    groups = {f"n{n}": [n + k * len(nodes) for k in range(layers + 1)] for n in boundary}
    if layers > 0:
        bottom = np.arange(len(nodes))
        groups["faces"] = np.concatenate([bottom, bottom + layers * len(nodes)])
        elements = np.concatenate([np.hstack([elements + k * len(nodes), elements + (k + 1) * len(nodes)])
                                   for k in range(layers)])
        heights = size * np.repeat(np.arange(layers + 1), len(nodes))
        nodes = np.column_stack([np.tile(nodes, (layers + 1, 1)), heights])
    write_mesh(file, nodes, elements, groups)


def prescribed(boundary, displacements, layers=0):
    """The case's list of displacements: those (m, 2) of the boundary's nodes in increment 1."""
    held = {"faces": {"Group": "faces", "Component": "z"}} if layers > 0 else {}
    return held | {f"n{n} {component}": {"Group": f"n{n}", "Component": component, "Rate": float(rate)}
                   for n, both in zip(boundary, displacements) for component, rate in zip("xy", both)}


def material(layers, ratio=None):
    """Of a plate in plane stress or of a slab in plane strain. @param ratio Poisson's, or that of bonds alone"""
    return {"Young's Modulus": E, "Poisson's Ratio": ratio or NU[bool(layers)],
            "Elastic Model": "Three-Dimensional" if layers else "Plane Stress"}


def plane_constants(layers, ratio=None):
    """Of the same: shear modulus, Kolosov's constant, K^2 / G."""
    nu = ratio or NU[bool(layers)]
    mu = E / (2 * (1 + nu))
    return (mu, 3 - 4 * nu, E / (1 - nu**2)) if layers else (mu, (3 - nu) / (1 + nu), E)


def write_rows(file, rows):
    with open(file, "w", newline="") as out:
        writer = csv.DictWriter(out, rows[0])
        writer.writeheader()
        writer.writerows(rows)
