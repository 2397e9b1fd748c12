#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Steady flow through a duct whose voidage changes along it: velocity and pressure compared with the closed form.

With superficial velocity U along x and voidage e(x), u = U/e and

    p(x) + rho u(x)^2/2 + integral of beta u/e dx = const,

with the drag's gradient beta u/e by Ergun's law, or without drag. Smooth ramps of e show the order of convergence; a
sharp edge has Bernoulli's jump of pressure. Meshes: aligned; wavy, with vertical columns of cells; and slanted, whose
columns the sharp edge cuts. They are at rest or move along the duct, past the bed. Exit code 1 if a run fails."""
import itertools
import sys
from dataclasses import dataclass
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from scipy.integrate import cumulative_trapezoid

from millfoam.files import foam
from millfoam.run import run as run_program
from millfoam.run import case_options, copy_case, fresh_runs, run_jobs, write_parameters, write_table

matplotlib.use("Agg")

RESOURCES = Path(__file__).resolve().parents[1] / "resources"
LENGTH, WIDTH = 0.8, 0.1  # m
# A mesh that moves along the duct, with the flow and against it: a longer part of the duct, m, at this speed, m/s. It
# begins and ends with its bed inside.
MOVING = dict(length=1.2, spare=0.05, speed=0.25, end=1.4, interval=0.2)
SPEED, DENSITY, NU = 0.5, 1000.0, 1e-6  # superficial m/s; kg/m3; m2/s
DIAMETER = 5e-3
MESHES = ("aligned", "wavy", "slanted")
MOVES = {0: "", 1: ", moves with it", -1: ", moves against it"}
CELLS = (16, 32, 64, 128)  # along the duct
EDGE_CELLS = 64
END, DENSE_END, WRITE_INTERVAL = 8.0, 4.0, 0.4  # s; all of a dense bed's drag lets nothing last
# s, with --quick: with all of the drag, and for the sharp edges
QUICK_ENDS = {"all": 4.0, "0.9": 2.0, "edges": 5.2}
# Of both errors' rms. Cells along skewed walls are of first order (0.94 found, the others 1.76) and their share falls
# with their size: that is an order of 1.5 in the limit, 1.48 found.
LEAST_ORDER = 1.45
# Of the pressure on a mesh that moves, with steps as the cells: its inertia is that of the mass that moved in the last
# step, of first order in time
LEAST_ORDER_MOVING = 0.9
VISCOUS = 1e-4  # errors below are those of the slurry's viscosity, which the closed form leaves out
# Of both errors' rms on LIMIT_CELLS, aligned or wavy, where the mesh rests and moves: twice what was found. Of finer
# meshes by the least order. In the dense beds u is 4 and 10 times the U that its error is over.
LIMIT_CELLS = 32
LIMITS = {("ramps", False): (0.005, 0.004), ("ramps", True): (0.04, 0.08),
          ("drag", False): (0.005, 0.004), ("drag", True): (0.03, 0.08),
          ("all", False): (0.035, 0.005), ("all", True): (0.1, 0.005),
          ("0.75", False): (0.14, 0.0065), ("0.75", True): (0.25, 0.006),
          ("0.9", False): (0.8, 0.014), ("0.9", True): (0.75, 0.015)}
JUMP_TOLERANCE = 0.01
# Change of the pressure over WRITE_INTERVAL, over Bernoulli's jump or the bed's loss; behind sharp edges
# JUMP_TOLERANCE: eddies drift
STEADY = 1e-4
# Well away from the sharp edges, m: before the bed, in it, behind it
PLATEAUS = ((0.1, 0.2), (0.4, 0.5), (0.68, 0.75))


@dataclass
class Bed:
    """A bed between two places (m) with cosine ramps of some length (m) inside them; share of Ergun's drag; largest
    solidity."""
    begin: float
    end: float
    edge: float
    drag: float
    most: float = 0.5

    def solidity(self, x):
        depth = np.minimum(x - self.begin, self.end - x)
        if self.edge == 0:
            return self.most * (depth > 0)
        return self.most * (1 - np.cos(np.pi * np.clip(depth / self.edge, 0, 1))) / 2

    def velocity(self, x):
        return SPEED / (1 - self.solidity(x))

    def pressure(self, x):
        """Pa, 0 behind the bed."""
        fine = np.linspace(0, LENGTH, 20001)
        lost = cumulative_trapezoid(self.gradient(fine), fine, initial=0)
        return lost[-1] - np.interp(x, fine, lost) - DENSITY / 2 * (self.velocity(x) ** 2 - SPEED**2)

    def gradient(self, x):
        """Ergun's loss of pressure as he printed it, with the superficial velocity, Pa/m."""
        phi = self.solidity(x)
        return self.drag * (150 * DENSITY * NU * phi**2 / ((1 - phi) ** 3 * DIAMETER**2) * SPEED
                            + 1.75 * DENSITY * phi / ((1 - phi) ** 3 * DIAMETER) * SPEED**2)

    @property
    def dynamic(self):
        """Bernoulli's jump of the pressure into the bed, Pa."""
        return DENSITY * SPEED**2 / 2 * ((1 - self.most) ** -2 - 1)

    @property
    def scale(self):
        """What pressures are compared with, Pa: Bernoulli's jump or the bed's loss."""
        return max(self.dynamic, self.pressure(0))


# As much drag as Bernoulli's pressure, a five-hundredth or so of what these balls have; and all of it. Balls of mixed
# sizes pack as densely as 0.75 and 0.9: there momentum by `Gauss linear` needs more than 16 cells along the duct.
BEDS = {
    "ramps": Bed(0.2, 0.6, 0.15, 0),
    "drag": Bed(0.2, 0.6, 0.15, 0.004),
    "all": Bed(0.2, 0.6, 0.15, 1),
    "0.75": Bed(0.2, 0.6, 0.15, 1, 0.75),
    "0.9": Bed(0.2, 0.6, 0.15, 1, 0.9),
    "edges": Bed(0.3, 0.6, 0, 0),
}
LOOSE, DENSE = ("ramps", "drag", "all"), ("0.75", "0.9")


@dataclass
class Flow:
    """Velocity along x (m/s), the largest across, and pressure (Pa) at the cells' centres x (m), at the end. Errors at
    the end; on a mesh that moves the largest in the second half of the run."""
    mesh: str
    bed: str
    cells: int
    moves: int  # 1: the mesh with the flow, -1: against it
    x: np.ndarray
    u: np.ndarray
    across: float
    p: np.ndarray
    drift: float
    velocity_error: float  # rms over the superficial velocity
    pressure_error: float  # rms over Bernoulli's jump or the bed's loss

    @property
    def exceeded(self):
        """Whether an error is above its limit."""
        limits = [limit * (self.cells / LIMIT_CELLS) ** -order for limit, order in
                  zip(LIMITS[self.bed, self.moves != 0], least_orders(self.moves))]
        return not (self.velocity_error <= limits[0] and self.pressure_error <= limits[1])

    @property
    def jumps(self):
        """Errors of the jumps of pressure into the bed and out of it, relative."""
        dynamic = BEDS[self.bed].dynamic
        before, inside, behind = (self.p[(begin < self.x) & (self.x < end)].mean() for begin, end in PLATEAUS)
        return (before - inside) / dynamic - 1, (behind - inside) / dynamic - 1


def least_orders(moves):
    """Of velocity and pressure."""
    return LEAST_ORDER, LEAST_ORDER_MOVING if moves else LEAST_ORDER


def skew(mesh, points):
    """Moves the points of an aligned mesh; the duct's long walls stay in place."""
    x, y, z = points.T
    if mesh == "wavy":
        y = y + 0.02 * np.sin(2 * np.pi * x / 0.2) * np.sin(np.pi * y / WIDTH)
    elif mesh == "slanted":
        x = x + np.tan(np.radians(30)) * (y - WIDTH / 2)
    return np.column_stack([x, y, z])


def move_points(case, mesh, begin):
    """Skews the mesh, and moves it to where it begins, m."""
    path = case / "constant" / "polyMesh" / "points"
    text = path.read_text()
    head = text[:text.index("}") + 1]
    points = skew(mesh, foam.read_mesh(case).points) + np.array([begin, 0, 0])
    rows = "\n".join(f"({x!r} {y!r} {z!r})" for x, y, z in points.tolist())
    path.write_text(f"{head}\n\n{rows.count(chr(10)) + 1}\n(\n{rows}\n)\n")


def write_velocity(case, bed):
    """The closed form, as a mesh that moves is not long in its duct."""
    x = foam.read_mesh(case).centres_and_volumes()[0][:, 0]
    rows = "\n".join(f"({u!r} 0 0)" for u in BEDS[bed].velocity(x).tolist())
    path = case / "0" / "U"
    path.write_text(path.read_text().replace(
        "internalField   uniform ($speed 0 0);", f"internalField   nonuniform List<vector> {len(x)}\n(\n{rows}\n);"))


def run(bed, mesh, cells, moves, ends, work, template):
    case = work / f"{bed}_{mesh}_{cells}_{moves}"
    copy_case(case, RESOURCES / "common", RESOURCES / "duct", template)
    own = BEDS[bed]
    # No step differs from the last where the mesh moves: the pressure of the step after shows it. Courant's number in
    # the bed is 0.64 at most.
    step = min(0.16, 0.64 * (1 - own.most)) * LENGTH / cells / SPEED if moves else 0.5 * LENGTH / cells / SPEED
    length, interval, begin = LENGTH, WRITE_INTERVAL, 0
    end = ends.get(bed, DENSE_END if own.most > 0.5 else END)
    if moves:
        length, end, interval = MOVING["length"], MOVING["end"], MOVING["interval"]
        # The bed's end is inside the mesh where that lies farthest upstream, whether this is at the start or at the end
        farthest = own.end + MOVING["spare"] - length
        begin = farthest if moves > 0 else farthest + MOVING["speed"] * end
    write_parameters(
        case, length=length, width=WIDTH, cells=round(cells * length / LENGTH), across=cells // 8, speed=SPEED,
        slurryDensity=DENSITY, slurryKinematicViscosity=NU, convection="linear", bedBegin=own.begin, bedEnd=own.end,
        edge=own.edge, solidity=own.most, diameter=DIAMETER, drag=own.drag, firstStep=step if moves else 0.01 * step,
        largestStep=step, endTime=end, writeInterval=interval, courant=1 if moves else 0.5,
        skewCorrectors=0 if mesh == "aligned" else 1,
        meshMotion="dynamicMotionSolverFvMesh" if moves else "staticFvMesh", meshSpeed=moves * MOVING["speed"])
    run_program(case, "blockMesh")
    move_points(case, mesh, begin)
    if moves:
        write_velocity(case, bed)
    run_program(case, "slurryFoam")
    return measure(mesh, bed, cells, moves, case)


def measure(mesh, bed, cells, moves, case):
    errors, before = [], None
    written = foam.times(case)[1:]
    for _, folder in written[len(written) // 2 if moves else -2:]:
        centre, volume = foam.read_mesh(case, folder).centres_and_volumes()
        x, u, p = centre[:, 0], foam.read_field(folder / "U", len(volume)), foam.read_field(folder / "p_rgh")
        errors.append([np.sqrt((volume * values**2).sum() / volume.sum()) for values in
                       ((u[:, 0] - BEDS[bed].velocity(x)) / SPEED, (p - BEDS[bed].pressure(x)) / BEDS[bed].scale)])
        drift = np.nan if before is None else np.abs(p - before).max() / BEDS[bed].scale
        before = p
    worst = np.max(errors, axis=0) if moves else errors[-1]
    if moves:
        drift = np.nan
    return Flow(mesh, bed, cells, moves, x, u[:, 0], np.abs(u[:, 1]).max(), p, drift, *worst)


def same_bed(flows, flow):
    """Those of other numbers of cells."""
    return [other for other in flows
            if (other.mesh, other.bed, other.moves) == (flow.mesh, flow.bed, flow.moves)]


def orders(flows, flow):
    """Of velocity and pressure, between this mesh and the next coarser one.

    None where there is no such mesh, and where the coarser error is already the viscosity's."""
    coarser = [other for other in same_bed(flows, flow) if other.cells < flow.cells]
    if not coarser or flow.bed == "edges":
        return None, None
    coarse = max(coarser, key=lambda other: other.cells)
    pairs = ((coarse.velocity_error, flow.velocity_error), (coarse.pressure_error, flow.pressure_error))
    return tuple(None if a <= VISCOUS else np.log2(a / b) for a, b in pairs)


def misses(flows):
    """Missed limits, in words. A sharp edge is a staircase on the slanted mesh; its numbers have no limits."""
    for flow in flows:
        where = f"{flow.bed}, {flow.mesh}{MOVES[flow.moves]}, {flow.cells} cells"
        if flow.mesh == "slanted" and flow.bed == "edges":
            continue
        # Orders are those of the two finest: the coarsest is shown, and judges nothing
        sizes = [other.cells for other in same_bed(flows, flow)]
        if len(sizes) > 2 and flow.cells == min(sizes):
            continue
        if not flow.moves and not flow.drift <= (JUMP_TOLERANCE if flow.bed == "edges" else STEADY):
            yield f"{where}: not steady"
        if flow.bed == "edges" and not all(abs(jump) <= JUMP_TOLERANCE for jump in flow.jumps):
            yield f"{where}: jump"
        if flow.bed != "edges" and flow.mesh != "slanted" and flow.exceeded:
            yield f"{where}: error"
        if flow.cells == max(sizes):
            for name, order, least in zip(("velocity", "pressure"), orders(flows, flow), least_orders(flow.moves)):
                if order is not None and not order >= least:
                    yield f"{where}: order of the {name}"


def print_table(flows, out):
    lines = [f"{'bed':<6} {'mesh':<24} {'cells':>5} {'u rms error':>11} {'order':>6} {'p rms error':>11} {'order':>6} "
             f"{'across/U':>9} {'jump in %':>10} {'jump out %':>10} {'drift':>8}"]
    for flow in flows:
        words = ["" if order is None else f"{order:.2f}" for order in orders(flows, flow)]
        jumps = [f"{100 * jump:10.4f}" for jump in flow.jumps] if flow.bed == "edges" else [" " * 10] * 2
        lines.append(f"{flow.bed:<6} {flow.mesh + MOVES[flow.moves]:<24} {flow.cells:5d} {flow.velocity_error:11.2e} "
                     f"{words[0]:>6} {flow.pressure_error:11.2e} {words[1]:>6} {flow.across / SPEED:9.1e} {jumps[0]} "
                     f"{jumps[1]} {flow.drift:8.1e}")
    scales = ", ".join(f"{name} {BEDS[name].scale:.4g}" for name in dict.fromkeys(flow.bed for flow in flows))
    lines.append(f"u over U, p over Bernoulli's jump or the bed's loss, Pa: {scales}")
    lines.append(f"least order {LEAST_ORDER}, of the pressure on moving meshes {LEAST_ORDER_MOVING}; jumps "
                 f"{100 * JUMP_TOLERANCE:g} %")
    lines += [f"MISSED: {miss}" for miss in misses(flows)] or ["nothing missed"]
    write_table(lines, out)


def plot(flows, out):
    figure, axes = plt.subplots(2, 4, figsize=(19, 8), constrained_layout=True)
    x = np.linspace(0, LENGTH, 1000)
    markers = {("aligned", 0): "o", ("wavy", 0): "s", ("slanted", 0): "x", ("aligned", 1): ">", ("aligned", -1): "<",
               ("wavy", 1): "^", ("wavy", -1): "v"}
    titles = {"drag": "smooth ramps, some drag", "all": "smooth ramps, all drag", "edges": "sharp edges, no drag"}
    for column, (bed, title) in zip(axes.T[:3], titles.items()):
        column[0].plot(x, BEDS[bed].velocity(x), "k-", label="closed form")
        column[1].plot(x, BEDS[bed].pressure(x), "k-", label="closed form")
        for (mesh, moves), marker in markers.items():
            own = [flow for flow in flows if (flow.mesh, flow.moves, flow.bed) == (mesh, moves, bed)]
            for flow in own[-1:]:
                name = f"{mesh}{MOVES[moves]}, {flow.cells} cells"
                column[0].plot(flow.x, flow.u, marker, ms=3, mfc="none", label=name)
                column[1].plot(flow.x, flow.p, marker, ms=3, mfc="none", label=name)
        column[0].set(title=title, ylabel="velocity, m/s", xlim=(0, LENGTH))
        column[1].set(xlabel="along the duct, m", ylabel="pressure, Pa", xlim=(0, LENGTH))
        column[0].legend(fontsize=7)
    for axis, name, error in ((axes[0, 3], "velocity", "velocity_error"), (axes[1, 3], "pressure", "pressure_error")):
        for ((mesh, moves), marker), (bed, line) in itertools.product(
                markers.items(), (("ramps", "-"), ("drag", "--"), ("all", ":"), ("0.75", "-."), ("0.9", (0, (6, 2))))):
            own = [flow for flow in flows if (flow.mesh, flow.moves, flow.bed) == (mesh, moves, bed)]
            if own:
                axis.loglog([flow.cells for flow in own], [max(getattr(flow, error), 1e-16) for flow in own],
                            marker=marker, ls=line, mfc="none", lw=0.8, ms=4, label=f"{mesh}{MOVES[moves]}, {bed}")
        own = np.array(CELLS)
        axis.loglog(own, 0.1 * (own / own[0]) ** -2.0, "k-", lw=0.6, label="order 2")
        axis.set(xlabel="cells along 0.8 m of the duct", ylabel=f"rms error of the {name}, smooth ramps")
        axis.legend(fontsize=5, ncol=2)
    for axis in axes.flat:
        axis.grid(alpha=0.3)
    figure.savefig(out, dpi=110)


def main():
    options = case_options(__doc__, quick="32 cells (sharp edges: 64), shorter, without the bed 0.75")
    here = Path(__file__).parent.resolve()
    work = fresh_runs(here)
    if options.quick:
        # All on the wavy mesh; without drag, with all of it at rest, and with sharp edges on the aligned one too
        wanted = [*itertools.product(("ramps", "all"), ("aligned", "wavy"), CELLS[1:2], (0,)),
                  *itertools.product(("drag", "0.9"), ("wavy",), CELLS[1:2], (0,)),
                  *itertools.product(("ramps",), ("aligned", "wavy"), CELLS[1:2], (1, -1)),
                  *itertools.product(("all", "0.9"), ("wavy",), CELLS[1:2], (1, -1)),
                  *itertools.product(("edges",), ("aligned", "wavy"), (EDGE_CELLS,), (0,))]
    else:
        wanted = [*itertools.product(LOOSE, MESHES, CELLS, (0,)),
                  *itertools.product(DENSE, MESHES, CELLS[1:], (0,)),
                  *itertools.product(LOOSE + DENSE, ("aligned", "wavy"), CELLS[1:], (1, -1)),
                  *itertools.product(("edges",), MESHES, (EDGE_CELLS,), (0,))]
    ends = QUICK_ENDS if options.quick else {}
    flows = run_jobs(lambda item: run(*item, ends, work, here / "template"), wanted, options.jobs)
    print_table(flows, here / "through_flow.txt")
    plot(flows, here / "through_flow.png")
    return 1 if any(misses(flows)) else 0


if __name__ == "__main__":
    sys.exit(main())
