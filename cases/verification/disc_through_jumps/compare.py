#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A disc of slurry carried through jumps of the voidage, compared with its closed form.

In a flat duct the superficial velocity relative to the bed is the same everywhere, so u = u_s + C/e with the bed's
velocity u_s. With s = x - u_s t and xi = integral of e ds every point of the fluid moves by C t in xi: there the disc
keeps its shape, and in x it is squeezed and stretched along the flow by the ratios of the voidage. Both fluids are
alike, so that the surface carries no force. Exit code 1 if a run fails."""
import itertools
import sys
from dataclasses import dataclass
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

from millfoam.files import foam
from millfoam.run import run as run_program
from millfoam.run import case_options, copy_case, fresh_runs, marked, run_jobs, write_parameters, write_table

matplotlib.use("Agg")

RESOURCES = Path(__file__).resolve().parents[1] / "resources"
LENGTH, WIDTH = 0.64, 0.1  # m
SPEED, DENSITY, NU = 0.2, 1000.0, 1e-6  # superficial, where there are no balls, m/s; kg/m3; m2/s
RADIUS, PLACE = 0.03, (0.06, 0.05)  # of the disc at the start, m
JUMPS = (0.15, 0.25, 0.30)  # m, at the start
SOLIDITY = (0.5, 0.25)  # between the jumps
LAST = 0.34  # m from the bed's origin: where the disc's centre is at the end
CELLS = (128, 256)  # along the duct
# On CELLS[0]: error of the place over the radius, along and across the duct, and share of the slurry on the wrong side,
# about twice what was found. On finer meshes by the least order.
LIMITS = {"aligned": (0.005, 1e-4, 0.04), "wavy": (0.01, 0.05, 0.04)}
LEAST_ORDER = 0.4
BOUNDED, CONSERVED = 1e-11, 1e-11  # the share beyond [0, 1]; change of the slurry's volume, relative
RECORDS = 12  # the disc's centre is in the dense bed at half of them
SAMPLES = 24  # across a cell, of the closed form
# Speeds of bed and mesh, m/s
MOTIONS = {
    "at rest": (0, 0),
    "bed with the flow": (0.1, 0),
    "bed against it": (-0.1, 0),
    "mesh with the flow": (0, 0.1),
    "mesh against it": (0, -0.1),
    "bed and mesh": (-0.1, 0.1),
}
MESHES = ("aligned", "wavy")
QUICK = {"aligned": ("bed with the flow",), "wavy": ("at rest", "bed and mesh")}


@dataclass(frozen=True)
class Run:
    motion: str
    mesh: str
    cells: int

    @property
    def name(self):
        return f"{self.motion}_{self.mesh}_{self.cells}".replace(" ", "_")

    @property
    def bed_speed(self):
        return MOTIONS[self.motion][0]

    @property
    def flux(self):
        """C: superficial velocity relative to the bed, m/s."""
        return SPEED - self.bed_speed

    @property
    def end(self):
        """s"""
        return (stretched(LAST) - stretched(PLACE[0])) / self.flux


def voidage(s):
    """At the places s in the bed's frame, m."""
    first, second, third = JUMPS
    return 1 - np.select([s < first, s < second, s < third], [0, *SOLIDITY], 0)


def stretched(s):
    """xi, m, of places s in the bed's frame, m."""
    first, second, third = JUMPS
    dense, loose = SOLIDITY
    return s - dense * np.clip(s - first, 0, second - first) - loose * np.clip(s - second, 0, third - second)


@dataclass
class Cells:
    """Of every cell what the closed form knows at a time: fluid (m3), its mean xi and y (m), and the slurry's share."""
    fluid: np.ndarray
    xi: np.ndarray
    y: np.ndarray
    share: np.ndarray


def closed_form(run, mesh, time):
    """Cells of the mesh, by samples: between two vertical sides, as all cells here are."""
    x, low, high, depth = corners(mesh)
    offset = (np.arange(SAMPLES) + 0.5) / SAMPLES
    s = x[:, :1] + (x[:, 1:] - x[:, :1]) * offset - run.bed_speed * time  # [cell, along]
    e, xi = voidage(s), stretched(s)
    bottom = low[:, :1] + (low[:, 1:] - low[:, :1]) * offset
    height = high[:, :1] + (high[:, 1:] - high[:, :1]) * offset - bottom
    y = bottom[:, :, None] + height[:, :, None] * offset  # [cell, along, up]
    weight = e * height
    inside = ((xi - stretched(PLACE[0]) - run.flux * time)[:, :, None] ** 2 + (y - PLACE[1]) ** 2) < RADIUS**2
    total = weight.sum(axis=1)
    # The mean height of the fluid times the exact share of the fluid along the cell
    along = stretched(x[:, 1] - run.bed_speed * time) - stretched(x[:, 0] - run.bed_speed * time)
    return Cells(total / e.sum(axis=1) * along * depth, (weight * xi).sum(axis=1) / total,
                 (weight * y.mean(axis=2)).sum(axis=1) / total, (weight * inside.mean(axis=2)).sum(axis=1) / total)


def corners(mesh):
    """Of every cell, m: x of its vertical sides, y of the lower and the upper corners on them [cell, 2]; depth along
    z."""
    # blockMesh numbers x fastest, then y
    across = mesh.patches["inlet"].size
    x, y = mesh.points[:len(mesh.points) // 2, :2].reshape(across + 1, -1, 2).transpose(2, 0, 1)
    sides, low, high = (np.stack([line[:, :-1].ravel(), line[:, 1:].ravel()], axis=1)
                        for line in (x[:-1], y[:-1], y[1:]))
    return sides, low, high, np.ptp(mesh.points[:, 2])


@dataclass
class Disc:
    """What a run has at a written time; lengths over the disc's radius, volumes over the disc's."""
    time: float
    x: np.ndarray  # of the cells' sides [across, along, 2], m
    share: np.ndarray  # [across, along]
    exact: np.ndarray
    place: float  # error of the mean of xi
    height: float  # error of the mean of y
    shape: float  # slurry on the wrong side of the closed form's surface
    beyond: float  # of the share, over [0, 1]
    volume: float  # change


def perform(run, work, template):
    case = work / run.name
    copy_case(case, RESOURCES / "common", RESOURCES / "duct", template)
    bed, mesh = MOTIONS[run.motion]
    step = 0.25 * LENGTH / run.cells / (SPEED / (1 - SOLIDITY[0]) + abs(mesh))
    across = round(run.cells * WIDTH / LENGTH)
    write_parameters(
        case, length=LENGTH, width=WIDTH, cells=run.cells, across=across, speed=SPEED, slurryDensity=DENSITY,
        slurryKinematicViscosity=NU, airDensity=DENSITY, airKinematicViscosity=NU, convection="linear",
        firstJump=JUMPS[0], secondJump=JUMPS[1], thirdJump=JUMPS[2], denseSolidity=SOLIDITY[0],
        looseSolidity=SOLIDITY[1], bedSpeed=bed, meshSpeed=mesh,
        meshMotion="dynamicMotionSolverFvMesh" if mesh else "staticFvMesh", firstStep=step, largestStep=step,
        courant=0.5, endTime=repr(run.end), writeInterval=repr(run.end / RECORDS),
        skewCorrectors=0 if run.mesh == "aligned" else 1)
    run_program(case, "blockMesh")
    if run.mesh == "wavy":
        bend(case)
    write_disc(run, case)
    run_program(case, "slurryFoam")
    return measure(run, case, across)


def bend(case):
    """Moves the points between the walls; columns of cells stay vertical."""
    path = case / "constant" / "polyMesh" / "points"
    text = path.read_text()
    head = text[:text.index("}") + 1]
    x, y, z = foam.read_mesh(case).points.T
    y = y + 0.01 * np.sin(2 * np.pi * x / 0.2) * np.sin(np.pi * y / WIDTH)
    rows = "\n".join(f"({a!r} {b!r} {c!r})" for a, b, c in np.column_stack([x, y, z]).tolist())
    path.write_text(f"{head}\n\n{len(x)}\n(\n{rows}\n)\n")


def write_disc(run, case):
    share = closed_form(run, foam.read_mesh(case), 0).share
    path = case / "0" / "alpha.slurry"
    rows = "\n".join(map(repr, share.tolist()))
    path.write_text(path.read_text().replace(
        "internalField   uniform 0;", f"internalField   nonuniform List<scalar> {len(share)}\n(\n{rows}\n);"))


def measure(run, case, across):
    """The Disc at every written time."""
    found = []
    for time, folder in foam.times(case):
        mesh = foam.read_mesh(case, folder)
        exact = closed_form(run, mesh, time)
        share = foam.read_field(folder / "alpha.slurry", mesh.cells)
        slurry, reference = share * exact.fluid, exact.share * exact.fluid
        if time > 0:
            # Between the solver's own balls: those of the closed form are sampled where the sides of cells are slanted
            fluid = (1 - foam.read_field(folder / "solidity", mesh.cells)) * mesh.centres_and_volumes()[1]
            kept = share @ fluid
        else:
            start = kept = slurry.sum()
        found.append(Disc(
            time, corners(mesh)[0].reshape(across, -1, 2), share.reshape(across, -1), exact.share.reshape(across, -1),
            abs(slurry @ exact.xi / slurry.sum() - reference @ exact.xi / reference.sum()) / RADIUS,
            abs(slurry @ exact.y / slurry.sum() - PLACE[1]) / RADIUS,
            np.abs(slurry - reference).sum() / 2 / reference.sum(), max(share.max() - 1, -share.min(), 0),
            abs(kept / start - 1)))
    return found


def worst(discs):
    """Largest errors over time: place along and across the duct, shape, share beyond [0, 1], volume."""
    return np.max([(disc.place, disc.height, disc.shape, disc.beyond, disc.volume) for disc in discs], axis=0)


def missed(run, discs):
    finer = (run.cells / CELLS[0]) ** -LEAST_ORDER
    limits = [*(finer * limit for limit in LIMITS[run.mesh]), BOUNDED, CONSERVED]
    # A time that was not written has no error
    return len(discs) <= RECORDS or not np.all(worst(discs) <= limits)


def print_table(results, out):
    lines = [f"{'motion':<20} {'mesh':<8} {'cells':>5} {'place/R':>9} {'across/R':>9} {'shape':>9} {'in the bed':>10} "
             f"{'at the end':>10} {'beyond 0, 1':>11} {'volume':>8}"]
    for run, discs in results.items():
        place, height, shape, beyond, volume = worst(discs)
        lines.append(marked(
            f"{run.motion:<20} {run.mesh:<8} {run.cells:5d} {place:9.1e} {height:9.1e} {shape:9.1e} "
            f"{discs[RECORDS // 2].shape:10.1e} {discs[-1].shape:10.1e} {beyond:11.1e} {volume:8.1e}",
            missed(run, discs)))
    lines += [f"{mesh}, {CELLS[0]} cells: allowed place {limits[0]:g}, across {limits[1]:g}, shape {limits[2]:g}"
              for mesh, limits in LIMITS.items()]
    lines.append(f"finer meshes by the order {LEAST_ORDER}; share beyond [0, 1] {BOUNDED:g}, volume {CONSERVED:g}")
    write_table(lines, out)


def outline(run, time, at):
    """x and y of the closed form's surface, m, at a time (s), of the angles `at`."""
    fine = np.linspace(-LENGTH, 2 * LENGTH, 20001)
    xi = stretched(PLACE[0]) + run.flux * time + RADIUS * np.cos(at)
    return np.interp(xi, stretched(fine), fine) + run.bed_speed * time, PLACE[1] + RADIUS * np.sin(at)


def plot(results, out):
    shown = {run.motion: run for run in results if run.mesh == "aligned"}  # the finest
    figure, axes = plt.subplots(len(shown), 1, figsize=(11, 2.1 * len(shown)), squeeze=False, constrained_layout=True)
    angle = np.linspace(0, 2 * np.pi, 400)
    for axis, (motion, run) in zip(axes.flat, shown.items()):
        for number in (0, RECORDS // 2, RECORDS):
            disc = results[run][number]
            height = WIDTH / len(disc.share)
            x, y = np.meshgrid(disc.x[0].mean(axis=1), (np.arange(len(disc.share)) + 0.5) * height)
            axis.contourf(x, y, disc.share, levels=[0.1, 0.3, 0.5, 0.7, 0.9, 1.1], cmap="Blues", vmin=0, vmax=1.4)
            axis.plot(*outline(run, disc.time, angle), "r-", lw=0.8)
        for jump in JUMPS:
            axis.axvline(jump, color="0.7", lw=0.8)
            axis.axvline(jump + run.bed_speed * run.end, color="0.7", lw=0.8, ls="--")
        axis.set(title=f"{motion}, {run.cells} cells along: start, half way and end (red: closed form; bed at the "
                       "start and, dashed, at the end)", xlim=(0, LENGTH), ylim=(0, WIDTH), aspect="equal")
        axis.title.set_fontsize(8)
    figure.savefig(out, dpi=110)


def main():
    options = case_options(__doc__, quick=f"{CELLS[0]} cells, three motions")
    here = Path(__file__).parent.resolve()
    work = fresh_runs(here)
    runs = [Run(motion, mesh, cells) for cells, mesh, motion in itertools.product(CELLS, MESHES, MOTIONS)]
    if options.quick:
        runs = [run for run in runs if run.cells == CELLS[0] and run.motion in QUICK[run.mesh]]
    results = dict(zip(runs, run_jobs(lambda run: perform(run, work, here / "template"), runs, options.jobs)))
    short = [f"{run.motion}, {run.mesh}, {run.cells} cells: {len(discs) - 1} of {RECORDS} times were written"
             for run, discs in results.items() if len(discs) <= RECORDS]
    if short:
        sys.exit("disc_through_jumps: MISSED: a flow ended early: " + "; ".join(short))
    print_table(results, here / "disc_through_jumps.txt")
    plot(results, here / "disc_through_jumps.png")
    return 1 if any(missed(run, discs) for run, discs in results.items()) else 0


if __name__ == "__main__":
    sys.exit(main())
