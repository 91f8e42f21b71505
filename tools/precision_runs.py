"""What tools/work-precision runs: bodies on whose outer boundary an exact displacement is prescribed, node by node."""

import csv
import os
import shutil
import subprocess
import sys
import time

import numpy as np

TOOLS = os.path.dirname(os.path.realpath(__file__))
E, NU = 30000.0, 1.0 / 3.0


def write_mesh(file, nodes, quads, boundary):
    """A mesh of quadrilaterals, MSH 2.2, in which each node of the boundary is a group.

    nodes: positions (n, 2); quads: (m, 4), from 0; boundary: numbers of nodes. The groups are n0, n1, ...
    """
    with open(file, "w") as out:
        out.write(f'$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{len(boundary) + 1}\n2 1 "plate"\n')
        out.writelines(f'0 {n + 2} "n{n}"\n' for n in boundary)
        out.write(f"$EndPhysicalNames\n$Nodes\n{len(nodes)}\n")
        out.writelines(f"{n} {float(x)!r} {float(y)!r} 0\n" for n, (x, y) in enumerate(nodes, start=1))
        out.write(f"$EndNodes\n$Elements\n{len(quads) + len(boundary)}\n")
        out.writelines(f"{i} 15 2 {n + 2} {n + 1} {n + 1}\n" for i, n in enumerate(boundary, start=1))
        out.writelines(f"{i} 3 2 1 1 " + " ".join(str(n + 1) for n in quad) + "\n"
                       for i, quad in enumerate(quads, start=len(boundary) + 1))
        out.write("$EndElements\n")


def prescribed(boundary, displacements):
    """The case's list of displacements: those (m, 2) of the boundary's nodes in increment 1."""
    return {f"n{n} {component}": {"Group": f"n{n}", "Component": component, "Rate": float(rate)}
            for n, both in zip(boundary, displacements) for component, rate in zip("xy", both)}


def xml(name, value):
    """A parameter, or a list of them."""
    if isinstance(value, dict):
        return f'<ParameterList name="{name}">\n' + "".join(xml(*item) for item in value.items()) + "</ParameterList>\n"
    kind = {float: "double", int: "int", list: "Array(double)"}.get(type(value), "string")
    if isinstance(value, list):
        value = "{" + ", ".join(repr(float(number)) for number in value) + "}"
    elif isinstance(value, str) and value.startswith("{"):
        kind = "Array(string)"
    return f'<Parameter name="{name}" type="{kind}" value="{value}"/>\n'


def write_case(file, name, case):
    with open(file, "w") as out:
        out.write(xml(name, case))


def rows_of(folder):
    """The complete rows of a history.csv that may still be written."""
    try:
        with open(os.path.join(folder, "history.csv")) as file:
            return [row for row in csv.DictReader(file) if None not in row.values()]
    except FileNotFoundError:
        return []


def run(case, folder, is_enough=None):
    """Runs a case on one rank, until is_enough(rows) says so; returns processor seconds, memory in MB and the rows."""
    shutil.rmtree(folder, ignore_errors=True)  # the rows of an earlier run would be taken for this one's
    command = '. "$0"; exec "$root/build/drivers/perimorph" run "$1" --output "$2" --quiet --no-progress'
    process = subprocess.Popen(["bash", "-c", command, os.path.join(TOOLS, "environment"), case, folder])
    was_enough = False
    while True:
        pid, status, usage = os.wait4(process.pid, os.WNOHANG if is_enough and not was_enough else 0)
        if pid != 0:
            break
        time.sleep(0.1)
        if is_enough(rows_of(folder)):
            was_enough = True
            process.kill()
    if status != 0 and not was_enough:
        sys.exit(1)
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024, rows_of(folder)


def write_rows(file, rows):
    with open(file, "w", newline="") as out:
        writer = csv.DictWriter(out, rows[0])
        writer.writeheader()
        writer.writerows(rows)
