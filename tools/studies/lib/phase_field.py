#!/usr/bin/python3
"""phase_field.py CASE.xml FOLDER --length L [--model AT1|AT2] [other options]

A phase field on FEniCSx, the peer of tools/studies/benchmark --runs phase_field; one process, one thread. It reads mesh, material,
supports, prescribed displacements, increments and pre-cracks of a case of ours, and minimizes in each increment

  integral of g(d) psi(u) + G_c / c (w(d) / L + L |grad d|^2),  g = (1 - d)^2 + 1e-6,  d not below that of the increment before,

AT1: w = d, c = 8/3; AT2: w = d^2, c = 2 [Bourdin, Francfort and Marigo 2000; Pham et al. 2011]. u and d take turns (alternate
minimization): u by conjugate gradients with GAMG and the rigid body modes, d by PETSc's SNES for bounds (vinewtonrsls), until the
largest change of d is below --tolerance. The step of d may be over-relaxed [Farrell and Maurini 2017]. G_c is lowered by
1 + h / (c L), as a crack on a mesh takes that much more of it [Bourdin, Francfort and Marigo 2008]; h is the mean edge.
Elements are the mesh's, of first order, with 2 Gauss points per direction.

FOLDER/history.csv gets a row for each increment, FOLDER/damage.npz the last d by node, and
which nodes are on pre-cracks. Exit status 3: stopped by --seconds.
"""

import argparse
import collections
import csv
import os
import resource
import sys
import time

import dolfinx
import numpy as np
import ufl
from dolfinx import fem
from dolfinx.fem import petsc
from mpi4py import MPI
from petsc4py import PETSc

HERE = os.path.dirname(os.path.realpath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..", "..", "lib")]
from case_file import read_case
from msh import edge_lengths, open_crack, read_mesh

STOPPED_AT_A_LIMIT = 3  # exit status
RESIDUAL_STIFFNESS = 1e-6
MODELS = {"AT1": (8 / 3, lambda d: d), "AT2": (2.0, lambda d: d**2)}  # c, w(d)
CRACKS = {"AT1": "both", "AT2": "split"}  # by which loads are nearest to fracture mechanics
CELLS = {3: "triangle", 4: "quadrilateral", 8: "hexahedron"}
TENSOR_ORDER = {3: [0, 1, 2], 4: [0, 1, 3, 2], 8: [0, 1, 3, 2, 4, 5, 7, 6]}  # of a cell's nodes, from gmsh's order


# --- Body ---


class Body:
    """The case's mesh in dolfinx, and where its nodes went."""

    def __init__(self, case, folder, is_split):
        self.dimension = case["Dimension"]
        nodes, cells, self.groups = read_mesh(os.path.join(folder, case["Mesh"]["File"]), self.dimension)
        cracks = [np.reshape(crack["Points"], (-1, self.dimension)) for crack in case.get("Pre-Cracks", {}).values()]
        self.size = np.mean(edge_lengths(nodes, cells))
        self.crack_nodes, opened, parent = open_crack(nodes, cells, cracks)
        if not is_split:
            opened, parent = cells, np.arange(len(nodes))
        self.nodes, self.parent = nodes[parent], parent
        kind = ufl.Cell(CELLS[cells.shape[1]], geometric_dimension=self.dimension)
        opened = np.ascontiguousarray(opened[:, TENSOR_ORDER[cells.shape[1]]], dtype=np.int64)
        self.mesh = dolfinx.mesh.create_mesh(MPI.COMM_SELF, opened, self.nodes, ufl.Mesh(ufl.VectorElement("Lagrange", kind, 1)))

    def places(self, space):
        """For each node of the file its block of unknowns in a space of first order."""
        geometry = self.mesh.geometry
        place = np.empty(len(self.nodes), dtype=np.int32)
        place[np.array(geometry.input_global_indices)[geometry.dofmap.array]] = space.dofmap.list.array
        return place

    def with_copies(self, nodes):
        """Nodes before the crack was opened, and those that came of them."""
        return np.flatnonzero(np.isin(self.parent, nodes))


def rigid_modes(space):
    """The near-null space of elasticity."""
    x = space.tabulate_dof_coordinates()[:, :space.dofmap.index_map_bs]
    dimension = x.shape[1]
    modes = [np.tile(np.eye(dimension)[i], (len(x), 1)) for i in range(dimension)]
    for i in range(dimension):
        for j in range(i):
            turned = np.zeros_like(x)
            turned[:, i], turned[:, j] = -x[:, j], x[:, i]
            modes.append(turned)
    basis = np.linalg.qr(np.column_stack([mode.ravel() for mode in modes]))[0].T
    one = fem.Function(space)
    vectors = [one.vector.duplicate() for _ in basis]
    for vector, values in zip(vectors, basis):
        vector.array[:] = values
    return PETSc.NullSpace().create(vectors=vectors)


# --- Energies ---


class Material:
    """Elastic constants, and the densities of energy."""

    def __init__(self, parameters, size, options):
        e, nu = parameters["Young's Modulus"], parameters["Poisson's Ratio"]
        self.mu, self.lam = e / (2 * (1 + nu)), e * nu / ((1 + nu) * (1 - 2 * nu))
        self.is_plane_stress = parameters["Elastic Model"] == "Plane Stress"
        self.across = nu / (1 - nu)  # strain across the thickness over that in the plane, in plane stress
        self.constant, self.w = MODELS[options.model]
        self.length, self.split = options.length, options.split
        self.toughness = parameters["Fracture Energy"] / (1 + size / (self.constant * self.length))

    def stress(self, u):
        strain, lam = ufl.sym(ufl.grad(u)), self.lam
        if self.is_plane_stress:
            lam *= 2 * self.mu / (self.lam + 2 * self.mu)
        return lam * ufl.tr(strain) * ufl.Identity(len(u)) + 2 * self.mu * strain

    def driving(self, u):
        """The density of energy that makes cracks: all of it or, split, that of shear and of growing volume."""
        strain = ufl.sym(ufl.grad(u))
        if self.split == "none":
            return ufl.inner(self.stress(u), strain) / 2
        trace, square = ufl.tr(strain), ufl.inner(strain, strain)
        if self.is_plane_stress:
            square += (self.across * trace) ** 2
            trace *= 1 - self.across
        bulk = self.lam + 2 * self.mu / 3
        return bulk / 2 * ufl.max_value(trace, 0) ** 2 + self.mu * (square - trace**2 / 3)

    def crack(self, d):
        return self.toughness / self.constant * (self.w(d) / self.length + self.length * ufl.inner(ufl.grad(d), ufl.grad(d)))


def degradation(d):
    return (1 - d) ** 2 + RESIDUAL_STIFFNESS


# --- Solvers ---


def set_options(solver, prefix, **options):
    for name, value in options.items():
        PETSc.Options()[prefix + name] = value
    solver.setOptionsPrefix(prefix)
    solver.setFromOptions()


class Displacement:
    """u for given d."""

    def __init__(self, body, material, d, conditions, dx):
        self.space = fem.VectorFunctionSpace(body.mesh, ("Lagrange", 1))
        self.u = fem.Function(self.space)
        trial, test = ufl.TrialFunction(self.space), ufl.TestFunction(self.space)
        self.stiffness = fem.form(degradation(d) * ufl.inner(material.stress(trial), ufl.sym(ufl.grad(test))) * dx)
        self.forces = fem.form(degradation(d) * ufl.inner(material.stress(self.u), ufl.sym(ufl.grad(test))) * dx)
        place, n = body.places(self.space), body.dimension
        dofs_of = lambda group, component: np.sort(n * place[body.with_copies(body.groups[group])] + component).astype(np.int32)
        self.conditions = [(rate, constant, dofs_of(group, component)) for group, component, rate, constant in conditions]
        self.held = [fem.dirichletbc(PETSc.ScalarType(0), dofs_of(group, component), self.space.sub(component))
                     for group, component, _, _ in conditions]
        self.fixed = np.unique(np.concatenate([dofs for _, _, dofs in self.conditions]))
        self.matrix = petsc.create_matrix(self.stiffness)
        self.matrix.setNearNullSpace(rigid_modes(self.space))
        self.residual, self.step = self.u.vector.duplicate(), self.u.vector.duplicate()
        self.krylov = self.conjugate_gradients()
        self.solves = self.iterations = 0
        self.needed = None  # iterations with a new preconditioner

    def conjugate_gradients(self):
        krylov = PETSc.KSP().create(MPI.COMM_SELF)
        krylov.setOperators(self.matrix)
        set_options(krylov, "u_", ksp_type="cg", pc_type="gamg", pc_gamg_threshold=0.02, pc_gamg_reuse_interpolation=True)
        krylov.setNormType(PETSc.KSP.NormType.UNPRECONDITIONED)
        return krylov

    def prescribe(self, load):
        """Displacements of this load; the others grow with them, from where the solution then starts."""
        before = np.linalg.norm(self.u.x.array[self.fixed])
        values = self.u.x.array.copy()
        for rate, constant, dofs in self.conditions:
            values[dofs] = rate * load + constant
        if before > 0:
            self.u.x.array[:] *= np.linalg.norm(values[self.fixed]) / before
        self.u.x.array[self.fixed] = values[self.fixed]

    def solve(self, tolerance):
        """A step from the last u, which has the prescribed values, to a residual of so much of the reactions."""
        self.matrix.zeroEntries()
        petsc.assemble_matrix(self.matrix, self.stiffness, bcs=self.held)
        self.matrix.assemble()
        forces = self.internal_forces()
        reactions = np.linalg.norm(forces[self.fixed])
        forces[self.fixed] = 0.0
        self.residual.array[:] = -forces
        self.krylov.setTolerances(rtol=1e-14, atol=tolerance * reactions, max_it=1000)
        self.krylov.getPC().setReusePreconditioner(self.needed is not None)
        self.krylov.solve(self.residual, self.step)
        done = self.krylov.getIterationNumber()
        self.solves, self.iterations = self.solves + 1, self.iterations + done
        if self.needed is None:
            self.needed = done
        elif done > self.needed + 12:  # more than a set-up costs
            self.needed = None
        self.u.vector.axpy(1.0, self.step)

    def internal_forces(self):
        with self.residual.localForm() as local:
            local.set(0.0)
        petsc.assemble_vector(self.residual, self.forces)
        return self.residual.array.copy()

    def reactions(self):
        """The force on each condition's nodes along its component."""
        forces = self.internal_forces()
        return [np.sum(forces[dofs]) for _, _, dofs in self.conditions]


class Damage:
    """d for given u, between that of the increment before and 1."""

    def __init__(self, body, material, dx):
        self.space = fem.FunctionSpace(body.mesh, ("Lagrange", 1))
        self.d, self.material, self.dx = fem.Function(self.space), material, dx

    def prepare(self, u):
        energy = (degradation(self.d) * self.material.driving(u) + self.material.crack(self.d)) * self.dx
        gradient = ufl.derivative(energy, self.d)
        self.gradient, self.hessian = fem.form(gradient), fem.form(ufl.derivative(gradient, self.d))
        self.matrix, self.constant = petsc.create_matrix(self.hessian), self.d.vector.duplicate()
        self.lower, self.upper = self.d.vector.duplicate(), self.d.vector.duplicate()
        self.lower.array[:], self.upper.array[:] = self.d.x.array, 1.0
        self.iterate, self.residual = self.d.vector.duplicate(), self.d.vector.duplicate()
        self.snes = PETSc.SNES().create(MPI.COMM_SELF)
        self.snes.setFunction(self.evaluate, self.residual)
        self.snes.setJacobian(lambda *_: None, self.matrix)  # the energy is quadratic in d
        self.snes.setVariableBounds(self.lower, self.upper)
        set_options(self.snes, "d_", snes_type="vinewtonrsls", snes_linesearch_type="basic", ksp_type="cg", pc_type="jacobi",
                    ksp_rtol=1e-5)

    def evaluate(self, _, x, f):
        self.matrix.multAdd(x, self.constant, f)

    def solve(self):
        """The new d, as an array."""
        self.matrix.zeroEntries()
        petsc.assemble_matrix(self.matrix, self.hessian)
        self.matrix.assemble()
        self.constant.set(0.0)
        petsc.assemble_vector(self.constant, self.gradient)
        self.iterate.array[:] = self.d.x.array
        self.matrix.mult(self.iterate, self.residual)
        self.constant.axpy(-1.0, self.residual)
        self.snes.setTolerances(rtol=1e-5, atol=1e-9 * self.constant.norm(), stol=0.0, max_it=50)
        self.snes.solve(None, self.iterate)
        if self.snes.getConvergedReason() < 0:
            sys.exit(f"phase_field.py: SNES did not converge, reason {self.snes.getConvergedReason()}")
        return np.clip(self.iterate.array, self.lower.array, 1.0)


# --- The run ---


class TimeIsUp(Exception):
    pass


class Run:
    def __init__(self, case, folder, options):
        body = Body(case, folder, options.crack != "damage")
        material = Material(case["Material"], body.size, options)
        dx = ufl.dx(metadata={"quadrature_degree": 2})
        self.damage = Damage(body, material, dx)
        self.names, conditions = zip(*conditions_of(case, body.dimension))
        self.displacement = Displacement(body, material, self.damage.d, conditions, dx)
        self.places, self.body, self.options = body.places(self.damage.space), body, options
        if options.crack != "split":
            self.damage.d.x.array[self.places[body.with_copies(body.crack_nodes)]] = 1.0
        self.damage.prepare(self.displacement.u)
        d, u = self.damage.d, self.displacement.u
        self.energies = [fem.form(degradation(d) * ufl.inner(material.stress(u), ufl.sym(ufl.grad(u))) / 2 * dx),
                         fem.form(material.crack(d) * dx)]
        self.iterations = 0
        self.begin = time.monotonic()

    def alternate(self, deadline):
        """u and d in turn until d changes no more."""
        d, options = self.damage.d.x.array, self.options
        while True:
            self.displacement.solve(options.residual)
            new = self.damage.solve()
            change = np.abs(new - d).max()
            self.iterations += 1
            if change < options.tolerance:
                d[:] = new
                return
            d[:] = np.clip(d + options.relaxation * (new - d), self.damage.lower.array, 1.0)
            if time.monotonic() > deadline:
                raise TimeIsUp

    def increments(self, count, seconds):
        """A row for each increment, until the time is up: the last one is then not through."""
        for load in range(1, count + 1):
            self.displacement.prescribe(load)
            try:
                self.alternate(self.begin + seconds)
                is_through = 1
            except TimeIsUp:
                is_through = 0
            self.damage.lower.array[:] = self.damage.d.x.array
            yield self.row(load, is_through)
            if not is_through:
                return

    def row(self, load, is_through):
        u = self.displacement
        elastic, crack = (fem.assemble_scalar(form) for form in self.energies)
        usage = resource.getrusage(resource.RUSAGE_SELF)
        row = collections.OrderedDict(
            increment=load, is_through=is_through, iterations=self.iterations, linear_solves=u.solves, cg_iterations=u.iterations,
            wall_seconds=time.monotonic() - self.begin, processor_seconds=usage.ru_utime + usage.ru_stime,
            memory_mb=usage.ru_maxrss / 1024, elastic_energy=elastic, crack_energy=crack, largest_damage=self.damage.d.x.array.max())
        for name, reaction, (rate, constant, _) in zip(self.names, u.reactions(), u.conditions):
            row["displacement_" + name], row["reaction_" + name] = rate * load + constant, reaction
        return row

    def save_damage(self, file):
        np.savez(file, nodes=self.body.nodes, damage=self.damage.d.x.array[self.places],
                 is_pre_crack=np.isin(self.body.parent, self.body.crack_nodes))


def conditions_of(case, dimension):
    """(name, (group, component, rate, constant)) of each prescribed displacement."""
    for one in case["Boundary Conditions"]["Displacements"].values():
        for component in one["Component"].split():
            if component in "xyz"[:dimension]:
                yield f"{one['Group']}_{component}", (one["Group"], "xyz".index(component), one.get("Rate", 0.0), one.get("Constant", 0.0))


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case")
    parser.add_argument("folder")
    parser.add_argument("--model", choices=MODELS, default="AT1")
    parser.add_argument("--length", type=float, required=True, metavar="L")
    parser.add_argument("--split", choices=["none", "volumetric-deviatoric"], default="none",
                        help="of the energy that makes cracks; u always sees g(d) times all of it [Ambati et al. 2015]")
    parser.add_argument("--crack", choices=["split", "damage", "both"],
                        help="pre-cracks: nodes in two, d = 1 along them, or both; default: both for AT1, split for AT2")
    parser.add_argument("--relaxation", type=float, default=1.0, help="factor on the step of d (default 1)")
    parser.add_argument("--tolerance", type=float, default=1e-3, help="of d (default 1e-3)")
    parser.add_argument("--residual", type=float, default=1e-5, help="of u, over the reactions (default 1e-5)")
    parser.add_argument("--seconds", type=float, default=1e9, help="limit on the wall time")
    parser.add_argument("--drop", type=float, default=0.0, metavar="SHARE",
                        help="end once the elastic energy is below this share of its largest")
    options = parser.parse_args()
    options.crack = options.crack or CRACKS[options.model]
    return options


def main():
    options = arguments()
    case = read_case(options.case)
    run = Run(case, os.path.dirname(options.case), options)
    os.makedirs(options.folder, exist_ok=True)
    with open(os.path.join(options.folder, "history.csv"), "w", newline="") as file:
        writer, largest = None, 0.0
        for row in run.increments(case["Loading"]["Increments"], options.seconds):
            writer = writer or csv.DictWriter(file, row)
            if row["increment"] == 1:
                writer.writeheader()
            writer.writerow(row)
            file.flush()
            largest = max(largest, row["elastic_energy"])
            if row["elastic_energy"] < options.drop * largest:
                break
    run.save_damage(os.path.join(options.folder, "damage.npz"))
    sys.exit(0 if row["is_through"] else STOPPED_AT_A_LIMIT)


if __name__ == "__main__":
    main()
