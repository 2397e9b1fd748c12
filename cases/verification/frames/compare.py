#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A smooth drum that drags viscous slurry along: on a mesh that turns with it, and on one at rest whose wall has its
velocity; without balls and with a bed that turns at half its speed.

Both are the same flow, so surface and velocities must come together as the cells get smaller, and the slurry's volume
must not change. They are compared after every quarter turn of the drum, when the cells of both meshes coincide. Exit
code 1 if a check fails."""
import itertools
import shutil
import sys
from dataclasses import dataclass
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from scipy.interpolate import LinearNDInterpolator
from scipy.spatial import cKDTree

from millfoam.files import foam
from millfoam.run import run as run_program
from millfoam.run import case_options, fresh_runs, run_jobs, write_parameters

matplotlib.use("Agg")


@dataclass(frozen=True)
class Extent:
    """How long and how finely: quarters of a turn, those of them (the last ones) in which the surface has its shape and
    is judged, sizes of the cells (m), largest time-step over the cells' size (s/m)."""
    quarters: int
    late: int
    cells: tuple
    step: float


WHOLE = Extent(quarters=6, late=3, cells=(0.006, 0.004, 0.003), step=0.25)
QUICK = Extent(quarters=2, late=1, cells=(0.006,), step=0.33)
BEDS = {"no balls": False, "bed": True}
BED_SPEED = 0.5  # over the drum's
# Of the velocities' difference in the slurry, rms over their own, for each m of the cells' size: about twice what was
# found. Its order, from the coarsest to the finest cells.
VELOCITY, LEAST_ORDER = {"no balls": 40.0, "bed": 40.0}, 0.5
FRAMES = {"mesh turns": ("dynamicMotionSolverFvMesh", "movingWallVelocity"),
          "wall velocity": ("staticFvMesh", "rotatingWallVelocity")}
CONSERVED = 1e-8


@dataclass
class Drum:
    """One frame's flow after each quarter: centres [cell, 2] (m), slurry shares, velocities [cell, 2] (m/s), slurry
    (m3; at the start as if there were no balls); the drum's radius and cell size, m."""
    time: list
    centre: list
    share: list
    velocity: list
    volume: np.ndarray
    radius: float
    cell: float

    def surface(self, number, x):
        """Height of the surface after a quarter at the places x, m: the first fall of the share below a half above the
        pool's floor."""
        share = LinearNDInterpolator(self.centre[number], self.share[number])
        y = np.linspace(-self.radius, self.radius, 1201)
        result = np.full(len(x), np.nan)
        for i, place in enumerate(x):
            column = np.nan_to_num(share(np.full(len(y), place), y), nan=-1)
            wet = np.flatnonzero(column >= 0.5)
            above = np.flatnonzero((column < 0.5) & (np.arange(len(y)) > wet[0])) if len(wet) else []
            if len(above):
                low = above[0] - 1
                result[i] = y[low] + (y[1] - y[0]) * (column[low] - 0.5) / (column[low] - column[low + 1])
        return result


def perform(frame, bed, cell, extent, case, here):
    motion, wall = FRAMES[frame]
    shutil.copytree(here / "template", case)
    if BEDS[bed]:
        shutil.copytree(here / "bed", case, dirs_exist_ok=True)
    # millMesh wants the case's dictionaries whole; the times follow once it has said how fast the drum turns
    common = dict(meshMotion=motion, wallVelocity=wall, largestStep=extent.step * cell)
    write_parameters(case, **common, endTime=1, writeInterval=1, bedOmega=0)
    run_program(case, "millMesh", here / "drum.yaml", "--case", ".", "--set", f"resolution.cell_size={cell}")
    mill = foam.read_dictionary(case / "constant" / "millProperties")
    omega = float(mill["omega"])
    quarter = np.pi / 2 / abs(omega)
    write_parameters(case, **common, endTime=repr(extent.quarters * quarter), writeInterval=repr(quarter),
                     bedOmega=repr(BED_SPEED * omega))
    run_program(case, "setAlphaField")
    run_program(case, "slurryFoam")
    return measure(case, float(mill["radius"]))


def measure(case, radius):
    drum = Drum([], [], [], [], [], radius, 0)
    for time, folder in foam.times(case):
        mesh = foam.read_mesh(case, folder)
        centre, volume = mesh.centres_and_volumes()
        share = foam.read_field(folder / "alpha.slurry", mesh.cells)
        drum.time.append(time)
        drum.centre.append(centre[:, :2])
        drum.share.append(share)
        balls = folder / "solidity"
        voidage = 1 - foam.read_field(balls, mesh.cells) if balls.is_file() else 1
        drum.velocity.append(foam.read_field(folder / "U", mesh.cells)[:, :2])
        drum.volume.append((share * voidage * volume).sum())
        drum.cell = np.sqrt(np.median(volume) / np.ptp(mesh.points[:, 2]))
    drum.volume = np.array(drum.volume)
    return drum


@dataclass
class Difference:
    """Of a drum whose mesh turns from one at rest, after a quarter: height of the surface (m) at |x| <= 0.8 R, share in
    a cell (mean), velocity in the slurry over its own (rms)."""
    time: float
    height: np.ndarray
    share: float
    velocity: float


def difference(turning, still, number):
    x = np.linspace(-0.8, 0.8, 65) * still.radius
    height = [drum.surface(number, x) for drum in (turning, still)]
    twin = cKDTree(turning.centre[number]).query(still.centre[number])[1]
    wet = np.minimum(turning.share[number][twin], still.share[number])[:, None]
    apart = (wet * (turning.velocity[number][twin] - still.velocity[number]) ** 2).sum()
    return Difference(still.time[number], height[0] - height[1],
                      np.abs(turning.share[number][twin] - still.share[number]).mean(),
                      np.sqrt(apart / (wet * still.velocity[number] ** 2).sum()))


def report(drums, extent, out):
    """Writes and prints the table; the number of lines that missed. drums: (turning, still) by bed and cell size."""
    lines = [f"{'bed':<10} {'cell mm':>7} {'time s':>7} {'height: mean mm':>15} {'rms mm':>7} {'largest mm':>10} "
             f"{'share, mean |diff|':>18} {'u in slurry, rms %':>18} {'allowed %':>9}"]
    missed = 0
    late = {}
    for (bed, cell), (turning, still) in drums.items():
        for number in range(1, extent.quarters + 1):
            found = difference(turning, still, number)
            judged = number > extent.quarters - extent.late
            largest = np.abs(found.height).max()
            bad = judged and not (largest <= still.cell / 2 and found.velocity <= VELOCITY[bed] * cell)
            missed += bad
            if judged:
                late.setdefault((bed, cell), []).append(found.velocity)
            lines.append(f"{bed:<10} {1e3 * cell:7g} {found.time:7.3f} {1e3 * found.height.mean():15.3f} "
                         f"{1e3 * np.sqrt(np.mean(found.height**2)):7.3f} {1e3 * largest:10.3f} {found.share:18.4f} "
                         f"{100 * found.velocity:18.2f} {100 * VELOCITY[bed] * cell:9.1f}"
                         + ("  MISSED" if bad else ""))
        for name, drum in (("mesh turns", turning), ("wall velocity", still)):
            change = np.abs(drum.volume[1:] / still.volume[1] - 1).max()
            bad = not change <= CONSERVED
            missed += bad
            lines.append(f"{bed}, {1e3 * cell:g} mm, {name}: slurry {drum.volume[-1]:.10g} m3, largest relative "
                         f"change {change:.1e}" + ("  MISSED" if bad else ""))
    for bed in BEDS:
        coarse, fine = (np.sqrt(np.mean(np.square(late[bed, cell]))) for cell in (extent.cells[0], extent.cells[-1]))
        if len(extent.cells) > 1:
            order = np.log(coarse / fine) / np.log(extent.cells[0] / extent.cells[-1])
            bad = not order >= LEAST_ORDER
            missed += bad
            lines.append(f"{bed}: velocities differ by {100 * coarse:.2f} % on the coarsest and {100 * fine:.2f} % on "
                         f"the finest cells, order {order:.2f} (at least {LEAST_ORDER})" + ("  MISSED" if bad else ""))
    lines.append("height of the surface where the mesh turns less that where it does not, at |x| <= 0.8 R; judged are "
                 f"the last {extent.late} quarters; allowed is half a cell, and the velocities' difference")
    print("\n".join(lines))
    out.write_text("\n".join(lines) + "\n")
    return missed


def plot(drums, extent, out):
    figure, axes = plt.subplots(len(BEDS), 3, figsize=(15, 5 * len(BEDS)), constrained_layout=True)
    for row, bed in zip(axes, BEDS):
        turning, still = drums[bed, extent.cells[-1]]
        for axis, drum, title in ((row[0], turning, "mesh turns"), (row[1], still, "wall has the velocity")):
            axis.tricontourf(*1e3 * drum.centre[-1].T, drum.share[-1], levels=np.linspace(-0.001, 1.001, 11),
                             cmap="Blues")
            axis.quiver(*1e3 * drum.centre[-1].T, *drum.velocity[-1].T, scale=8, width=0.002)
            axis.set(title=f"{bed}, {title}, {drum.time[-1]:.2f} s", aspect="equal", xlabel="mm", ylabel="mm")
        x = np.linspace(-0.8, 0.8, 65) * still.radius
        for number in sorted({1, (extent.quarters + 1) // 2, extent.quarters}):
            line, = row[2].plot(1e3 * x, 1e3 * still.surface(number, x), "-",
                                label=f"wall velocity, {still.time[number]:.2f} s")
            row[2].plot(1e3 * x, 1e3 * turning.surface(number, x), "o", ms=3, mfc="none", color=line.get_color(),
                        label="mesh turns")
        row[2].set(title=f"{bed}: surface", xlabel="x, mm", ylabel="height, mm")
        row[2].legend(fontsize=8)
        row[2].grid(alpha=0.3)
    figure.savefig(out, dpi=110)


def main():
    options = case_options(
        __doc__, quick=f"{QUICK.quarters} quarters of a turn on cells of {1e3 * QUICK.cells[0]:g} mm")
    extent = QUICK if options.quick else WHOLE
    here = Path(__file__).parent.resolve()
    work = fresh_runs(here)
    wanted = list(itertools.product(BEDS, extent.cells, FRAMES))
    found = run_jobs(lambda item: perform(
        item[2], item[0], item[1], extent,
        work / f"{item[0]}_{item[2]}_{1e3 * item[1]:g}mm".replace(" ", "_"), here), wanted, options.jobs)
    drums = {(bed, cell): (turning, still) for (bed, cell, _), turning, still
             in zip(wanted[::2], found[::2], found[1::2])}
    missed = report(drums, extent, here / "frames.txt")
    plot(drums, extent, here / "frames.png")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
