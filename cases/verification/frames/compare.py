#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A smooth drum that drags viscous slurry along: on a mesh that turns with it, and on one at rest whose wall has its
velocity; part full, without balls and with a bed that turns at half its speed, and full, with the bed.

Both are the same flow, so surface and velocities must come together as the cells get smaller, and the slurry's volume
must not change. They are compared after every quarter turn of the drum, when the cells of both meshes coincide. Exit
code 1 if a check fails."""
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
class Kind:
    """A drum: part full, or full and with a bed; sizes of the cells (m)."""
    name: str
    full: bool
    cells: tuple


@dataclass(frozen=True)
class Extent:
    """Duration and resolution: drums, quarters of a turn, number of the last ones, in which the flow has its shape and
    is judged, largest time-step over the cells' size (s/m)."""
    kinds: tuple
    quarters: int
    late: int
    step: float


WHOLE = Extent((Kind("pool", False, (0.004,)), Kind("pool with a bed", False, (0.004,)),
                Kind("full with a bed", True, (0.006, 0.004, 0.003))), quarters=6, late=3, step=0.25)
QUICK = Extent((Kind("pool", False, (0.006,)), Kind("full with a bed", True, (0.006, 0.004))), quarters=2, late=1,
               step=0.33)
BED_SPEED = 0.5  # over the drum's
# Largest difference of the surface's height, cells. About twice what was found of the velocities' in the slurry, rms
# over their own: in a pool, and in the full drum for each m of the cells' size
HEIGHT = {"pool": 0.5, "pool with a bed": 1.0}
VELOCITY, FULL_VELOCITY, LEAST_ORDER = {"pool": 0.27, "pool with a bed": 0.27}, 13.0, 1.4
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
    shutil.copytree(here / "template", case)
    if "bed" in kind.name:
        shutil.copytree(here / "bed", case, dirs_exist_ok=True)
    # millMesh needs complete dictionaries; the times follow from the drum's speed, which millMesh computes
    common = dict(meshMotion=motion, wallVelocity=wall, largestStep=extent.step * cell)
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
    """Of a drum whose mesh turns from one at rest, after a quarter: height of the surface (m) at |x| <= 0.8 R, share in
    a cell (mean), velocity in the slurry over its own (rms)."""
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


def report(drums, extent, out):
    """Writes and prints the table; returns the number of values beyond their limit. drums: (turning, still) by kind and cell size."""
    lines = [f"{'drum':<16} {'cell mm':>7} {'time s':>7} {'height: mean mm':>15} {'rms mm':>7} {'largest mm':>10} "
             f"{'allowed':>7} {'share, mean |diff|':>18} {'u in slurry, rms %':>18} {'allowed %':>9}"]
    missed = 0
    for kind in extent.kinds:
        late = []
        for cell in kind.cells:
            turning, still = drums[kind, cell]
            most = FULL_VELOCITY * cell if kind.full else VELOCITY[kind.name]
            for number in range(1, extent.quarters + 1):
                found = difference(turning, still, number, kind.full)
                judged = number > extent.quarters - extent.late
                bad = judged and not found.velocity <= most
                heights = " " * 42
                if not kind.full:
                    largest, allowed = np.abs(found.height).max(), HEIGHT[kind.name] * still.cell
                    bad = bad or judged and not largest <= allowed
                    heights = f"{1e3 * found.height.mean():15.3f} {1e3 * np.sqrt(np.mean(found.height**2)):7.3f} " \
                              f"{1e3 * largest:10.3f} {1e3 * allowed:7.2f}"
                missed += bad
                lines.append(f"{kind.name:<16} {1e3 * cell:7g} {found.time:7.3f} {heights} {found.share:18.4f} "
                             f"{100 * found.velocity:18.2f} {100 * most:9.1f}" + ("  MISSED" if bad else ""))
            late.append(found.velocity)
            for name, drum in (("mesh turns", turning), ("wall velocity", still)):
                change = np.abs(drum.volume[1:] / still.volume[1] - 1).max()
                bad = not change <= CONSERVED
                missed += bad
                lines.append(f"{kind.name}, {1e3 * cell:g} mm, {name}: slurry {drum.volume[-1]:.10g} m3, largest "
                             f"relative change {change:.1e}" + ("  MISSED" if bad else ""))
        if len(kind.cells) > 1:
            order = np.log(late[0] / late[-1]) / np.log(kind.cells[0] / kind.cells[-1])
            bad = not order >= LEAST_ORDER
            missed += bad
            lines.append(f"{kind.name}: at the end velocities differ by {100 * late[0]:.2f} % on the coarsest and "
                         f"{100 * late[-1]:.2f} % on the finest cells, order {order:.2f} (at least {LEAST_ORDER:g})"
                         + ("  MISSED" if bad else ""))
    lines.append("height of the surface where the mesh turns less that where it does not, at |x| <= 0.8 R; judged are "
                 f"the last {extent.late} quarters")
    print("\n".join(lines))
    out.write_text("\n".join(lines) + "\n")
    return missed


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
