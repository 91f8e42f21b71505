"""What tools/work-precision runs: bodies on whose outer boundary an exact displacement is prescribed, node by node."""

import csv

E, NU = 30000.0, 1.0 / 3.0


def write_mesh(file, nodes, elements, boundary):
    """A mesh of quadrilaterals or triangles, MSH 2.2, in which each node of the boundary is a group.

    nodes: positions (n, 2); elements: (m, 4 or 3), from 0; boundary: numbers of nodes. The groups are n0, n1, ...
    """
    with open(file, "w") as out:
        out.write(f'$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{len(boundary) + 1}\n2 1 "plate"\n')
        out.writelines(f'0 {n + 2} "n{n}"\n' for n in boundary)
        out.write(f"$EndPhysicalNames\n$Nodes\n{len(nodes)}\n")
        out.writelines(f"{n} {float(x)!r} {float(y)!r} 0\n" for n, (x, y) in enumerate(nodes, start=1))
        out.write(f"$EndNodes\n$Elements\n{len(elements) + len(boundary)}\n")
        out.writelines(f"{i} 15 2 {n + 2} {n + 1} {n + 1}\n" for i, n in enumerate(boundary, start=1))
        kind = {3: 2, 4: 3}[len(elements[0])]
        out.writelines(f"{i} {kind} 2 1 1 " + " ".join(str(n + 1) for n in element) + "\n"
                       for i, element in enumerate(elements, start=len(boundary) + 1))
        out.write("$EndElements\n")


def prescribed(boundary, displacements):
    """The case's list of displacements: those (m, 2) of the boundary's nodes in increment 1."""
    return {f"n{n} {component}": {"Group": f"n{n}", "Component": component, "Rate": float(rate)}
            for n, both in zip(boundary, displacements) for component, rate in zip("xy", both)}


def write_rows(file, rows):
    with open(file, "w", newline="") as out:
        writer = csv.DictWriter(out, rows[0])
        writer.writeheader()
        writer.writerows(rows)
