#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Steady flow through a duct whose voidage changes along it: velocity and pressure compared with the closed form.

With superficial velocity U along x and voidage e(x), u = U/e and

    p(x) + rho u(x)^2/2 + integral of beta u/e dx = const,

with the drag's gradient beta u/e by Ergun's law, or without drag. Smooth ramps of e show the order of convergence; a
sharp edge has Bernoulli's jump of pressure. Meshes: aligned; wavy, with vertical columns of cells; and slanted, whose
columns the sharp edge cuts. Exit code 1 if a run fails."""
import itertools
import shutil
import sys
from dataclasses import dataclass
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from scipy.integrate import cumulative_trapezoid

from millfoam.files import foam
from millfoam.run import run as run_program
from millfoam.run import case_options, fresh_runs, run_jobs, write_parameters

matplotlib.use("Agg")

LENGTH, WIDTH = 0.8, 0.1  # m
SPEED, DENSITY, NU = 0.5, 1000.0, 1e-6  # superficial m/s; kg/m3; m2/s
SOLIDITY, DIAMETER = 0.5, 5e-3
DYNAMIC = DENSITY * SPEED**2 / 2 * ((1 - SOLIDITY) ** -2 - 1)  # Bernoulli's jump into the bed, Pa
MESHES = ("aligned", "wavy", "slanted")
CELLS = (16, 32, 64, 128)  # along the duct
EDGE_CELLS = 64
END, WRITE_INTERVAL = 8.0, 0.4  # s
# Of both errors' rms. Cells along skewed walls are of first order (0.94 found, the others 1.76) and their share falls
# with their size: that is an order of 1.5 in the limit, 1.48 found.
LEAST_ORDER = 1.45
VISCOUS = 1e-4  # errors below are those of the slurry's viscosity, which the closed form leaves out
JUMP_TOLERANCE = 0.01
# Change of the pressure over WRITE_INTERVAL, over DYNAMIC; behind sharp edges JUMP_TOLERANCE: eddies drift
STEADY = 1e-4
# Well away from the sharp edges, m: before the bed, in it, behind it
PLATEAUS = ((0.1, 0.2), (0.4, 0.5), (0.68, 0.75))


@dataclass
class Bed:
    """A bed between two places (m) with cosine ramps of some length (m) inside them; share of Ergun's drag."""
    begin: float
    end: float
    edge: float
    drag: float

    def solidity(self, x):
        depth = np.minimum(x - self.begin, self.end - x)
        if self.edge == 0:
            return SOLIDITY * (depth > 0)
        return SOLIDITY * (1 - np.cos(np.pi * np.clip(depth / self.edge, 0, 1))) / 2

    def velocity(self, x):
        return SPEED / (1 - self.solidity(x))

    def pressure(self, x):
        """Pa, 0 behind the bed."""
        fine = np.linspace(0, LENGTH, 20001)
        phi = self.solidity(fine)
        gradient = self.drag * (150 * DENSITY * NU * phi**2 / ((1 - phi) ** 3 * DIAMETER**2) * SPEED
                                + 1.75 * DENSITY * phi / ((1 - phi) ** 3 * DIAMETER) * SPEED**2)
        lost = cumulative_trapezoid(gradient, fine, initial=0)
        return lost[-1] - np.interp(x, fine, lost) - DENSITY / 2 * (self.velocity(x) ** 2 - SPEED**2)


# As much drag as Bernoulli's pressure: a five-hundredth or so of what these balls have
BEDS = {
    "ramps": Bed(0.2, 0.6, 0.15, 0),
    "drag": Bed(0.2, 0.6, 0.15, 0.004),
    "edges": Bed(0.3, 0.6, 0, 0),
}


@dataclass
class Flow:
    """Velocity along x (m/s), the largest across, and pressure (Pa) at the cells' centres x (m) of volumes (m3)."""
    mesh: str
    bed: str
    cells: int
    x: np.ndarray
    volume: np.ndarray
    u: np.ndarray
    across: float
    p: np.ndarray
    drift: float

    def rms(self, values):
        return np.sqrt((self.volume * values**2).sum() / self.volume.sum())

    @property
    def velocity_error(self):
        """Rms over the superficial velocity."""
        return self.rms(self.u - BEDS[self.bed].velocity(self.x)) / SPEED

    @property
    def pressure_error(self):
        """Rms over Bernoulli's jump."""
        return self.rms(self.p - BEDS[self.bed].pressure(self.x)) / DYNAMIC

    @property
    def jumps(self):
        """Errors of the jumps of pressure into the bed and out of it, relative."""
        before, inside, behind = (self.p[(begin < self.x) & (self.x < end)].mean() for begin, end in PLATEAUS)
        return (before - inside) / DYNAMIC - 1, (behind - inside) / DYNAMIC - 1


def skew(mesh, points):
    """Moves the points of an aligned mesh; the duct's long walls stay in place."""
    x, y, z = points.T
    if mesh == "wavy":
        y = y + 0.02 * np.sin(2 * np.pi * x / 0.2) * np.sin(np.pi * y / WIDTH)
    elif mesh == "slanted":
        x = x + np.tan(np.radians(30)) * (y - WIDTH / 2)
    return np.column_stack([x, y, z])


def move_points(case, mesh):
    path = case / "constant" / "polyMesh" / "points"
    text = path.read_text()
    head = text[:text.index("}") + 1]
    rows = "\n".join(f"({x!r} {y!r} {z!r})" for x, y, z in skew(mesh, foam.read_mesh(case).points).tolist())
    path.write_text(f"{head}\n\n{rows.count(chr(10)) + 1}\n(\n{rows}\n)\n")


def run(mesh, bed, cells, work, template):
    case = work / f"{bed}_{mesh}_{cells}"
    shutil.copytree(template, case)
    own = BEDS[bed]
    step = 0.5 * LENGTH / cells / SPEED
    write_parameters(
        case, length=LENGTH, width=WIDTH, cells=cells, across=cells // 8, speed=SPEED, slurryDensity=DENSITY,
        slurryViscosity=NU, airDensity=1.2, bedBegin=own.begin, bedEnd=own.end, edge=own.edge, solidity=SOLIDITY,
        diameter=DIAMETER, drag=own.drag, firstStep=0.01 * step, largestStep=step, endTime=END,
        writeInterval=WRITE_INTERVAL, correctors=0 if mesh == "aligned" else 1)
    run_program(case, "blockMesh")
    move_points(case, mesh)
    run_program(case, "slurryFoam")
    return measure(mesh, bed, cells, case)


def measure(mesh, bed, cells, case):
    centres, volume = foam.read_mesh(case).centres_and_volumes()
    *_, (_, before), (_, last) = foam.times(case)
    velocity, pressure = foam.read_field(last / "U", len(volume)), foam.read_field(last / "p_rgh")
    drift = np.abs(pressure - foam.read_field(before / "p_rgh")).max() / DYNAMIC
    return Flow(mesh, bed, cells, centres[:, 0], volume, velocity[:, 0], np.abs(velocity[:, 1]).max(), pressure, drift)


def orders(flows):
    """Orders of velocity and pressure on smooth ramps, between the two finest meshes: {(mesh, bed): (order, order)},
    where there are two.

    None where the coarser error is already the viscosity's."""
    found = {}
    for mesh, bed in itertools.product(dict.fromkeys(flow.mesh for flow in flows), ("ramps", "drag")):
        own = [flow for flow in flows if (flow.mesh, flow.bed) == (mesh, bed)]
        if len(own) < 2:
            continue
        coarse, fine = own[-2:]
        pairs = ((coarse.velocity_error, fine.velocity_error), (coarse.pressure_error, fine.pressure_error))
        found[mesh, bed] = tuple(np.log2(a / b) if a > VISCOUS else None for a, b in pairs)
    return found


def misses(flows):
    """Missed limits, in words. A sharp edge is a staircase on the slanted mesh; its numbers have no limits."""
    for flow in flows:
        where = f"{flow.bed}, {flow.mesh}, {flow.cells} cells"
        if flow.mesh == "slanted" and flow.bed == "edges":
            continue
        # Orders are those of the two finest; the coarsest is only shown
        sizes = [other.cells for other in flows if (other.mesh, other.bed) == (flow.mesh, flow.bed)]
        coarsest = len(sizes) > 2 and flow.cells == min(sizes)
        if not coarsest and not flow.drift <= (JUMP_TOLERANCE if flow.bed == "edges" else STEADY):
            yield f"{where}: not steady"
        if flow.bed == "edges" and not max(map(abs, flow.jumps)) <= JUMP_TOLERANCE:
            yield f"{where}: jump"
    for (mesh, bed), pair in orders(flows).items():
        if not all(order is None or order >= LEAST_ORDER for order in pair):
            yield f"{bed}, {mesh}: order"


def print_table(flows, out):
    lines = [f"{'bed':<6} {'mesh':<8} {'cells':>5} {'u rms error':>11} {'order':>6} {'p rms error':>11} {'order':>6} "
             f"{'across/U':>9} {'jump in %':>10} {'jump out %':>10} {'drift':>8}"]
    found = orders(flows)
    for flow in flows:
        finest = flow.cells == max(other.cells for other in flows if (other.bed, other.mesh) == (flow.bed, flow.mesh))
        pair = found.get((flow.mesh, flow.bed), (None, None)) if finest else (None, None)
        words = ["" if order is None else f"{order:.2f}" for order in pair]
        jumps = [f"{100 * jump:10.4f}" if flow.bed == "edges" else " " * 10 for jump in flow.jumps]
        lines.append(f"{flow.bed:<6} {flow.mesh:<8} {flow.cells:5d} {flow.velocity_error:11.2e} {words[0]:>6} "
                     f"{flow.pressure_error:11.2e} {words[1]:>6} {flow.across / SPEED:9.1e} {jumps[0]} {jumps[1]} "
                     f"{flow.drift:8.1e}")
    lines.append(f"u over U, p over Bernoulli's jump of {DYNAMIC:g} Pa; least order {LEAST_ORDER}, tolerance of jumps "
                 f"{100 * JUMP_TOLERANCE:g} %")
    lines += [f"MISSED: {miss}" for miss in misses(flows)] or ["nothing missed"]
    print("\n".join(lines))
    out.write_text("\n".join(lines) + "\n")


def plot(flows, out):
    meshes = list(dict.fromkeys(flow.mesh for flow in flows))
    figure, axes = plt.subplots(2, 3, figsize=(15, 8), constrained_layout=True)
    x = np.linspace(0, LENGTH, 1000)
    for column, bed in zip(axes.T[:2], ("drag", "edges")):
        column[0].plot(x, BEDS[bed].velocity(x), "k-", label="closed form")
        column[1].plot(x, BEDS[bed].pressure(x), "k-", label="closed form")
        for mesh, marker in zip(meshes, "osx"):
            flow = [flow for flow in flows if (flow.mesh, flow.bed) == (mesh, bed)][-1]
            column[0].plot(flow.x, flow.u, marker, ms=3, mfc="none", label=f"{mesh}, {flow.cells} cells")
            column[1].plot(flow.x, flow.p, marker, ms=3, mfc="none", label=mesh)
        title = "smooth ramps with drag" if bed == "drag" else "sharp edges, no drag"
        column[0].set(title=title, ylabel="velocity, m/s")
        column[1].set(xlabel="along the duct, m", ylabel="pressure, Pa")
        column[0].legend(fontsize=8)
    for axis, name, error in ((axes[0, 2], "velocity", "velocity_error"), (axes[1, 2], "pressure", "pressure_error")):
        for (mesh, marker), (bed, line) in itertools.product(zip(meshes, "osx"), (("ramps", "-"), ("drag", "--"))):
            own = [flow for flow in flows if (flow.mesh, flow.bed) == (mesh, bed)]
            axis.loglog([flow.cells for flow in own], [max(getattr(flow, error), 1e-16) for flow in own], marker + line,
                        mfc="none", label=f"{mesh}, {'no drag' if bed == 'ramps' else 'drag'}")
        own = np.array(CELLS[:3])
        axis.loglog(own, 0.1 * (own / own[0]) ** -2.0, "k:", label="order 2")
        axis.set(xlabel="cells along the duct", ylabel=f"rms error of the {name}, smooth ramps")
        axis.legend(fontsize=7)
    for axis in axes.flat:
        axis.grid(alpha=0.3)
    figure.savefig(out, dpi=110)


def main():
    options = case_options(__doc__, quick="one mesh of the smooth ramps, and the sharp edges; aligned and wavy")
    here = Path(__file__).parent.resolve()
    work = fresh_runs(here)
    cells = CELLS[1:2] if options.quick else CELLS
    meshes = ("aligned", "wavy") if options.quick else MESHES
    wanted = [*itertools.product(("ramps", "drag"), meshes, cells),
              *itertools.product(("edges",), meshes, (EDGE_CELLS,))]
    flows = run_jobs(lambda item: run(item[1], item[0], item[2], work, here / "template"), wanted, options.jobs)
    print_table(flows, here / "through_flow.txt")
    plot(flows, here / "through_flow.png")
    return 1 if any(misses(flows)) else 0


if __name__ == "__main__":
    sys.exit(main())
