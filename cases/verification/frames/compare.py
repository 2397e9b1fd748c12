#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A smooth drum that drags viscous slurry along: on a mesh that turns with it, and on one at rest whose wall has its
velocity.

Both are the same flow, so the surface must have the same height, within half a cell, and the slurry's volume must not
change. They are compared after every quarter turn of the drum, when the cells of both meshes coincide. Exit code 1 if a
check fails."""
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
    """Duration and resolution: quarters of a turn, number of the last ones, in which the surface has its shape and is
    judged, size of the cells (m), largest time-step (s)."""
    quarters: int
    late: int
    cell: float
    step: float


WHOLE = Extent(quarters=6, late=3, cell=0.004, step=1e-3)
QUICK = Extent(quarters=2, late=1, cell=0.006, step=2e-3)
FRAMES = {"mesh turns": ("dynamicMotionSolverFvMesh", "movingWallVelocity"),
          "wall velocity": ("staticFvMesh", "rotatingWallVelocity")}
CONSERVED = 1e-8


@dataclass
class Drum:
    """One frame's flow after each quarter: centres [cell, 2] (m) and slurry shares; the drum's radius and cell size,
    m."""
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


def perform(frame, extent, case, here):
    motion, wall = FRAMES[frame]
    shutil.copytree(here / "template", case)
    # millMesh needs complete dictionaries; the times follow from the drum's speed, which millMesh computes
    common = dict(meshMotion=motion, wallVelocity=wall, largestStep=extent.step)
    write_parameters(case, **common, endTime=1, writeInterval=1)
    run_program(case, "millMesh", here / "drum.yaml", "--case", ".", "--set", f"resolution.cell_size={extent.cell}")
    mill = foam.read_dictionary(case / "constant" / "millProperties")
    quarter = np.pi / 2 / abs(float(mill["omega"]))
    write_parameters(case, **common, endTime=repr(extent.quarters * quarter), writeInterval=repr(quarter))
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
        drum.velocity.append(foam.read_field(folder / "U", mesh.cells)[:, :2])
        drum.volume.append((share * volume).sum())
        drum.cell = np.sqrt(np.median(volume) / np.ptp(mesh.points[:, 2]))
    drum.volume = np.array(drum.volume)
    return drum


def report(turning, still, extent, out):
    """Writes and prints the table; returns the number of values beyond their limit."""
    x = np.linspace(-0.8, 0.8, 65) * still.radius
    lines = [f"{'time s':>7} {'height: mean mm':>15} {'rms mm':>7} {'largest mm':>10} {'share, mean |diff|':>18} "
             f"{'u in slurry, rms %':>18}"]
    missed = 0
    for number in range(1, extent.quarters + 1):
        height = [drum.surface(number, x) for drum in (turning, still)]
        difference = height[0] - height[1]
        twin = cKDTree(turning.centre[number]).query(still.centre[number])[1]
        share = np.abs(turning.share[number][twin] - still.share[number])
        wet = np.minimum(turning.share[number][twin], still.share[number])
        speed = (wet[:, None] * still.velocity[number] ** 2).sum()
        apart = (wet[:, None] * (turning.velocity[number][twin] - still.velocity[number]) ** 2).sum()
        largest = np.abs(difference).max()
        bad = number > extent.quarters - extent.late and not largest <= still.cell / 2
        missed += bad
        lines.append(f"{still.time[number]:7.3f} {1e3 * difference.mean():15.3f} "
                     f"{1e3 * np.sqrt(np.mean(difference**2)):7.3f} {1e3 * largest:10.3f} {share.mean():18.4f} "
                     f"{100 * np.sqrt(apart / speed):18.2f}" + ("  MISSED" if bad else ""))
    lines.append("height of the surface on the turning mesh minus that on the mesh at rest, at |x| <= 0.8 R; allowed "
                 f"in the last {extent.late} quarters: half a cell, {1e3 * still.cell / 2:.2f} mm")
    for name, drum in (("mesh turns", turning), ("wall velocity", still)):
        change = np.abs(drum.volume / still.volume[0] - 1).max()
        bad = not change <= CONSERVED
        missed += bad
        lines.append(f"{name}: slurry {drum.volume[-1]:.10g} m3, largest relative change {change:.1e}"
                     + ("  MISSED" if bad else ""))
    print("\n".join(lines))
    out.write_text("\n".join(lines) + "\n")
    return missed


def plot(turning, still, extent, out):
    figure, axes = plt.subplots(1, 3, figsize=(15, 5), constrained_layout=True)
    for axis, drum, title in ((axes[0], turning, "mesh turns"), (axes[1], still, "wall has the velocity")):
        axis.tricontourf(*1e3 * drum.centre[-1].T, drum.share[-1], levels=np.linspace(-0.001, 1.001, 11), cmap="Blues")
        axis.quiver(*1e3 * drum.centre[-1].T, *drum.velocity[-1].T, scale=8, width=0.002)
        axis.set(title=f"{title}, {drum.time[-1]:.2f} s", aspect="equal", xlabel="mm", ylabel="mm")
    x = np.linspace(-0.8, 0.8, 65) * still.radius
    for number in sorted({1, (extent.quarters + 1) // 2, extent.quarters}):
        line, = axes[2].plot(1e3 * x, 1e3 * still.surface(number, x), "-",
                             label=f"wall velocity, {still.time[number]:.2f} s")
        axes[2].plot(1e3 * x, 1e3 * turning.surface(number, x), "o", ms=3, mfc="none", color=line.get_color(),
                     label="mesh turns")
    axes[2].set(title="Surface", xlabel="x, mm", ylabel="height, mm")
    axes[2].legend(fontsize=8)
    axes[2].grid(alpha=0.3)
    figure.savefig(out, dpi=110)


def main():
    options = case_options(__doc__, quick=f"{QUICK.quarters} quarters of a turn on cells of {1e3 * QUICK.cell:g} mm")
    extent = QUICK if options.quick else WHOLE
    here = Path(__file__).parent.resolve()
    work = fresh_runs(here)
    drums = run_jobs(lambda frame: perform(frame, extent, work / frame.replace(" ", "_"), here), FRAMES, options.jobs)
    missed = report(*drums, extent, here / "frames.txt")
    plot(*drums, extent, here / "frames.png")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
