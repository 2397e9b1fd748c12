#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A smooth drum that drags viscous slurry along: on a mesh that turns with it, and on one at rest whose wall has its
velocity. The drum is part full, without balls and with a bed that turns at half its speed, or full, with the bed.

Both are the same flow. So surface and velocities must approach each other as the cells get smaller, and the slurry's
volume must not change. They are compared after every quarter turn of the drum, when the cells of both meshes coincide.
Exit code 1 if a check fails."""
import sys
from dataclasses import dataclass
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from scipy.interpolate import LinearNDInterpolator
from scipy.spatial import cKDTree

from millfoam.files import foam
from millfoam.files.constants import GRAVITY
from millfoam.run import run as run_program
from millfoam.run import case_options, copy_case, fresh_runs, marked, run_jobs, write_parameters, write_table

matplotlib.use("Agg")

RESOURCES = Path(__file__).resolve().parents[1] / "resources"


@dataclass(frozen=True)
class Kind:
    """A drum: part full or full; sizes of the cells (m)."""
    name: str
    cells: tuple

    @property
    def full(self):
        return self.name.startswith("full")

    @property
    def bed(self):
        return self.name.endswith("with a bed")


@dataclass(frozen=True)
class Extent:
    """Duration and resolution: drums, quarters of a turn, number of the last ones, in which the flow has its shape and
    is judged, largest time-step over the cells' size (s/m)."""
    kinds: tuple
    quarters: int
    late: int
    step: float


POOL, POOL_BED, FULL_BED = "pool", "pool with a bed", "full with a bed"
CELLS = (0.006, 0.004, 0.003)
# Pools have no cells of 3 mm: these begin to hold the film that the wall drags up out of the pool
WHOLE = Extent((Kind(POOL, CELLS[:2]), Kind(POOL_BED, CELLS[:2]), Kind(FULL_BED, CELLS)), quarters=6, late=3, step=0.25)
QUICK = Extent((Kind(POOL, CELLS[:1]), Kind(FULL_BED, CELLS[:2])), quarters=3, late=1, step=0.33)
BED_SPEED = 0.5  # over the drum's
# Largest difference of the surface's height, cells
HEIGHT = {POOL: 0.5, POOL_BED: 1.0}
# Difference of the slurry's velocities, rms over their own: about twice what was found on the coarsest cells; on finer
# cells it falls at least by the order
VELOCITY = {POOL: 0.27, POOL_BED: 0.42, FULL_BED: 0.055}
LEAST_ORDER = {POOL: 0.7, POOL_BED: 0.9, FULL_BED: 1.6}
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


def perform(frame, kind, cell, extent, case, here):
    motion, wall = FRAMES[frame]
    copy_case(case, *(RESOURCES / name for name in ("common", "closed", "mill_level", "drum")), here / "template",
              *([here / "bed"] if kind.bed else []))
    # millMesh needs complete dictionaries; the times follow from the drum's speed, which millMesh computes
    common = dict(meshMotion=motion, wallVelocity=wall, gravity=f"(0 {-GRAVITY} 0)", skewCorrectors=1,
                  largestStep=extent.step * cell)
    write_parameters(case, **common, endTime=1, writeInterval=1, bedOmega=0)
    run_program(case, "millMesh", here / "drum.yaml", "--case", ".", "--set", f"resolution.cell_size={cell}")
    mill = foam.read_dictionary(case / "constant" / "millProperties")
    omega = float(mill["omega"])
    quarter = np.pi / 2 / abs(omega)
    write_parameters(case, **common, endTime=repr(extent.quarters * quarter), writeInterval=repr(quarter),
                     bedOmega=repr(BED_SPEED * omega))
    if kind.full:
        share = case / "0" / "alpha.slurry"
        share.write_text(share.read_text().replace("uniform 0;", "uniform 1;", 1))
    else:
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
    """Difference of a drum whose mesh turns from one at rest, after a quarter: height of the surface (m) at
    |x| <= 0.8 R, share in a cell (mean), velocity in the slurry over its own (rms)."""
    time: float
    height: np.ndarray
    share: float
    velocity: float


def difference(turning, still, number, full):
    x = np.linspace(-0.8, 0.8, 65) * still.radius
    height = np.zeros((2, len(x))) if full else [drum.surface(number, x) for drum in (turning, still)]
    twin = cKDTree(turning.centre[number]).query(still.centre[number])[1]
    wet = np.minimum(turning.share[number][twin], still.share[number])[:, None]
    apart = (wet * (turning.velocity[number][twin] - still.velocity[number]) ** 2).sum()
    return Difference(still.time[number], height[0] - height[1],
                      np.abs(turning.share[number][twin] - still.share[number]).mean(),
                      np.sqrt(apart / (wet * still.velocity[number] ** 2).sum()))


def quarter_row(kind, cell, found, still, judged):
    """Line of the table, and whether a value is beyond its limit."""
    most = VELOCITY[kind.name] * (cell / CELLS[0]) ** LEAST_ORDER[kind.name]
    bad = judged and not found.velocity <= most
    heights = " " * 42
    if not kind.full:
        largest, allowed = np.abs(found.height).max(), HEIGHT[kind.name] * still.cell
        bad = bad or judged and not largest <= allowed
        heights = f"{1e3 * found.height.mean():15.3f} {1e3 * np.sqrt(np.mean(found.height**2)):7.3f} " \
                  f"{1e3 * largest:10.3f} {1e3 * allowed:7.2f}"
    return (f"{kind.name:<16} {1e3 * cell:7g} {found.time:7.3f} {heights} {found.share:18.4f} "
            f"{100 * found.velocity:18.2f} {100 * most:9.1f}"), bad


def order_row(kind, late):
    """The same for the order of convergence of the velocities' difference in the judged quarters."""
    order = np.log(late[0] / late[-1]) / np.log(kind.cells[0] / kind.cells[-1])
    sizes = ", ".join(f"{100 * one:.2f} % at {1e3 * cell:g} mm" for one, cell in zip(late, kind.cells))
    return (f"{kind.name}: velocities differ by {sizes} in the judged quarters; order {order:.2f}, at least "
            f"{LEAST_ORDER[kind.name]:g}"), not order >= LEAST_ORDER[kind.name]


def volume_row(kind, cell, name, drum, still):
    """The same for the slurry's volume."""
    change = np.abs(drum.volume[1:] / still.volume[1] - 1).max()
    return (f"{kind.name}, {1e3 * cell:g} mm, {name}: slurry {drum.volume[-1]:.10g} m3, largest relative change "
            f"{change:.1e}"), not change <= CONSERVED


def report(drums, extent, out):
    """Writes and prints the table; returns the number of values beyond their limit. drums: (turning, still) by kind and
    cell size."""
    first_judged = extent.quarters - extent.late + 1
    rows = []
    for kind in extent.kinds:
        late = []
        for cell in kind.cells:
            turning, still = drums[kind, cell]
            found = {number: difference(turning, still, number, kind.full)
                     for number in range(1, extent.quarters + 1)}
            rows += [quarter_row(kind, cell, found[number], still, number >= first_judged) for number in found]
            rows += [volume_row(kind, cell, name, drum, still) for name, drum in zip(FRAMES, (turning, still))]
            late.append(np.sqrt(np.mean([found[number].velocity**2 for number in found if number >= first_judged])))
        if len(kind.cells) > 1:
            rows.append(order_row(kind, late))
    lines = [f"{'drum':<16} {'cell mm':>7} {'time s':>7} {'height: mean mm':>15} {'rms mm':>7} {'largest mm':>10} "
             f"{'allowed':>7} {'share, mean |diff|':>18} {'u in slurry, rms %':>18} {'allowed %':>9}"]
    lines += [marked(text, bad) for text, bad in rows]
    lines.append("height of the surface on the turning mesh minus that on the mesh at rest, at |x| <= 0.8 R; judged "
                 f"are the last {extent.late} quarters")
    write_table(lines, out)
    return sum(bad for _, bad in rows)


def plot(drums, extent, out):
    figure, axes = plt.subplots(len(extent.kinds), 3, figsize=(15, 5 * len(extent.kinds)), constrained_layout=True)
    for row, kind in zip(axes, extent.kinds):
        turning, still = drums[kind, kind.cells[-1]]
        for axis, drum, title in ((row[0], turning, "mesh turns"), (row[1], still, "wall has the velocity")):
            axis.tricontourf(*1e3 * drum.centre[-1].T, drum.share[-1], levels=np.linspace(-0.001, 1.001, 11),
                             cmap="Blues")
            axis.quiver(*1e3 * drum.centre[-1].T, *drum.velocity[-1].T, scale=8, width=0.002)
            axis.set(title=f"{kind.name}, {title}, {drum.time[-1]:.2f} s", aspect="equal", xlabel="mm", ylabel="mm")
        x = np.linspace(-0.8, 0.8, 65) * still.radius
        for number in sorted({1, (extent.quarters + 1) // 2, extent.quarters}):
            if kind.full:
                break
            line, = row[2].plot(1e3 * x, 1e3 * still.surface(number, x), "-",
                                label=f"wall velocity, {still.time[number]:.2f} s")
            row[2].plot(1e3 * x, 1e3 * turning.surface(number, x), "o", ms=3, mfc="none", color=line.get_color(),
                        label="mesh turns")
        for cell in kind.cells if kind.full else ():
            found = [difference(*drums[kind, cell], number, True) for number in range(1, extent.quarters + 1)]
            row[2].semilogy([one.time for one in found], [100 * one.velocity for one in found], "o-",
                            label=f"{1e3 * cell:g} mm")
        row[2].set(title=f"{kind.name}: " + ("velocities' difference, rms" if kind.full else "surface"),
                   xlabel="time, s" if kind.full else "x, mm", ylabel="%" if kind.full else "height, mm")
        row[2].legend(fontsize=8)
        row[2].grid(alpha=0.3)
    figure.savefig(out, dpi=110)


def main():
    options = case_options(__doc__, quick=f"{QUICK.quarters} quarters of a turn, coarser cells")
    extent = QUICK if options.quick else WHOLE
    here = Path(__file__).parent.resolve()
    work = fresh_runs(here)
    wanted = [(kind, cell, frame) for kind in extent.kinds for cell in kind.cells for frame in FRAMES]
    found = run_jobs(lambda item: perform(
        item[2], item[0], item[1], extent,
        work / f"{item[0].name}_{item[2]}_{1e3 * item[1]:g}mm".replace(" ", "_"), here), wanted, options.jobs)
    drums = {(kind, cell): pair for (kind, cell, _), pair in zip(wanted[::2], zip(found[::2], found[1::2]))}
    missed = report(drums, extent, here / "frames.txt")
    plot(drums, extent, here / "frames.png")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
