#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Balls displace slurry: the pool's level compared with the volumes of slurry and of the balls below it.

In a closed box a bed moves from the air into the pool, in an open one a bed appears in the pool. With the slurry's
volume V and the balls' volume V_s below the level, level = (V + V_s)/area, at every time: the slurry fills the space
between the balls from below. Exit code 1 if a level, the slurry's volume or the
range of the phase fraction is wrong."""
import shutil
import sys
from dataclasses import dataclass
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

from millfoam.files import foam
from millfoam.run import run as run_program
from millfoam.run import case_options, fresh_runs, run_jobs, write_parameters

matplotlib.use("Agg")

WIDTH, HEIGHT, COLUMNS, LAYERS = 0.016, 0.4, 4, 100
LAYER = HEIGHT / LAYERS
POOL = 0.2018  # m, the level at the start: within a layer
SOLIDITY, THICKNESS = 0.5, 0.0987  # of the bed; m, not a whole number of layers
# Moves down in the closed box, and is there from the start in the open one
BED_BOTTOM = {"closed": 0.2413, "open": 0.0613}
BED_SPEED, UNTIL = -0.2, 0.9
RAMP = (0.1, 0.6)
END, WRITE_INTERVAL = 1.0, 0.02
TOLERANCE = 1e-6  # of the level, relative; of the phase fraction, absolute
CONSERVED = 1e-8  # of the slurry's volume, relative


def bed(kind, time):
    """Height of the bed's lower and upper side (m) and its solidity at a time (s)."""
    bottom = BED_BOTTOM[kind]
    if kind == "closed":
        bottom += BED_SPEED * min(time, UNTIL)
        return bottom, bottom + THICKNESS, SOLIDITY
    return bottom, bottom + THICKNESS, SOLIDITY * np.clip((time - RAMP[0]) / (RAMP[1] - RAMP[0]), 0, 1)


def voidages(kind, time):
    """Mean voidage of every layer, from below."""
    lower, upper, solidity = bed(kind, time)
    faces = LAYER * np.arange(LAYERS + 1)
    covered = np.clip(np.minimum(faces[1:], upper) - np.maximum(faces[:-1], lower), 0, None)
    return 1 - solidity * covered / LAYER


def expected_level(kind, time):
    """Height (m) up to which the slurry of POOL fills the layers' voids."""
    filled = np.concatenate([[0], LAYER * np.cumsum(voidages(kind, time))])
    return np.interp(POOL, filled, LAYER * np.arange(LAYERS + 1))


def final_level(kind):
    """Closed form, m: the bed lies below the level."""
    lower, upper, solidity = bed(kind, END)
    level = POOL + solidity * (upper - lower)
    assert upper < level
    return level


@dataclass
class Displacement:
    """Phase fractions [time, layer, column] at the written times (s), and largest speed at the end (m/s)."""
    kind: str
    time: np.ndarray
    share: np.ndarray
    last_speed: float

    @property
    def level(self):
        """Level of every column, m [time, column]; exact where all layers below it are full and all above are empty."""
        return LAYER * self.share.sum(axis=1)

    @property
    def expected(self):
        return np.array([expected_level(self.kind, time) for time in self.time])

    @property
    def error(self):
        """Relative error of the columns' mean at every time; single columns have small waves while the bed moves."""
        return np.abs(self.level.mean(axis=1) / self.expected - 1)

    @property
    def final_error(self):
        return np.abs(self.level[-1] / final_level(self.kind) - 1).max()

    @property
    def volume_change(self):
        voids = np.array([voidages(self.kind, time) for time in self.time])
        return np.abs(LAYER * (self.share * voids[:, :, None]).sum(axis=1).mean(axis=1) / POOL - 1).max()

    @property
    def beyond(self):
        """Largest distance of the phase fraction from [0, 1]."""
        return max(self.share.max() - 1, -self.share.min(), 0)

    @property
    def not_settled(self):
        """Slurry above and air below the layer of the surface, at the end: phase fraction, largest of all cells."""
        at = int(final_level(self.kind) / LAYER)
        return max(np.abs(1 - self.share[-1, :at]).max(), np.abs(self.share[-1, at + 1:]).max())

    def misses(self):
        return not (max(self.error.max(), self.final_error, self.beyond, self.not_settled) <= TOLERANCE
                    and self.volume_change <= CONSERVED)


def write_pool(case):
    """The initial phase fraction, exactly flat at POOL."""
    share = np.clip(POOL / LAYER - np.arange(LAYERS), 0, 1).repeat(COLUMNS)
    values = "\n".join(repr(float(value)) for value in share)
    (case / "initialShare").write_text(f"internalField nonuniform List<scalar> {len(share)}\n(\n{values}\n);\n")


def run(kind, case, template):
    shutil.copytree(template / "common", case)
    shutil.copytree(template / kind, case, dirs_exist_ok=True)
    write_parameters(
        case, width=WIDTH, height=HEIGHT, columns=COLUMNS, layers=LAYERS, slurryDensity=1000, slurryViscosity=2e-4,
        airDensity=1.2, bedBottom=BED_BOTTOM[kind], bedTop=BED_BOTTOM[kind] + THICKNESS, solidity=SOLIDITY,
        bedSpeed=BED_SPEED, until=UNTIL, rampBegin=RAMP[0], rampEnd=RAMP[1], firstStep=1e-4, largestStep=2e-3,
        endTime=END, writeInterval=WRITE_INTERVAL)
    write_pool(case)
    run_program(case, "blockMesh")
    run_program(case, "slurryFoam")
    written = foam.times(case)[1:]
    shares = [foam.read_field(folder / "alpha.slurry").reshape(LAYERS, COLUMNS) for _, folder in written]
    speeds = np.linalg.norm(foam.read_field(written[-1][1] / "U", LAYERS * COLUMNS), axis=1)
    return Displacement(kind, np.array([time for time, _ in written]), np.array(shares), speeds.max())


def print_table(results, out):
    lines = [f"{'box':<7} {'level mm':>10} {'expected mm':>12} {'error':>8} {'at any time':>12} "
             f"{'phase beyond 0, 1':>18} {'not settled':>12} {'volume':>8} {'speed at end m/s':>17}"]
    for result in results:
        lines.append(
            f"{result.kind:<7} {1e3 * result.level[-1].mean():10.5f} {1e3 * final_level(result.kind):12.5f} "
            f"{result.final_error:8.1e} {result.error.max():12.1e} {result.beyond:18.1e} {result.not_settled:12.1e} "
            f"{result.volume_change:8.1e} {result.last_speed:17.1e}" + ("  MISSED" if result.misses() else ""))
    lines.append(f"tolerance of levels (relative) and phase fraction {TOLERANCE:g}, of the slurry's volume "
                 f"{CONSERVED:g}; level at the start {1e3 * POOL:g} mm")
    print("\n".join(lines))
    out.write_text("\n".join(lines) + "\n")


def plot(results, out):
    figure, axes = plt.subplots(2, len(results), figsize=(13, 7.5), height_ratios=(2, 1), sharex=True,
                                constrained_layout=True)
    for result, (picture, errors) in zip(results, axes.T):
        edges = np.concatenate([result.time, [2 * result.time[-1] - result.time[-2]]]) - WRITE_INTERVAL / 2
        shades = picture.pcolormesh(edges, LAYER * np.arange(LAYERS + 1), result.share.mean(axis=2).T, cmap="Blues",
                                    vmin=0, vmax=1.4)
        sides = np.array([bed(result.kind, time) for time in result.time])
        picture.fill_between(result.time, sides[:, 0], sides[:, 1], where=sides[:, 2] > 0, facecolor="none",
                             edgecolor="saddlebrown", hatch="..", label="bed")
        picture.plot(result.time, result.expected, "r-", lw=1, label="expected level")
        picture.set(title=f"{result.kind} box: slurry's share of the fluid", ylabel="height, m", ylim=(0, HEIGHT))
        picture.legend(loc="upper right", fontsize=8)
        errors.semilogy(result.time, np.maximum(result.error, 1e-16), "k.-")
        errors.axhline(TOLERANCE, color="r", ls="--", lw=1)
        errors.set(xlabel="time, s", ylabel="relative error of the level")
        errors.grid(alpha=0.3)
    figure.colorbar(shades, ax=axes[0, -1])
    figure.savefig(out, dpi=110)


def main():
    options = case_options(__doc__)
    here = Path(__file__).parent.resolve()
    work = fresh_runs(here)
    results = run_jobs(lambda kind: run(kind, work / kind, here / "template"), BED_BOTTOM, options.jobs)
    print_table(results, here / "displacement.txt")
    plot(results, here / "displacement.png")
    return 1 if any(result.misses() for result in results) else 0


if __name__ == "__main__":
    sys.exit(main())
