#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Balls displace slurry: the pool's level compared with the volumes of slurry and of the balls below it.

In a closed box a bed moves from the air into the pool, in an open one a bed appears in the pool. With the slurry's
volume V and the balls' volume V_s below the level, level = (V + V_s)/area, at every time: the slurry fills the space
between the balls from below. The slurry rises through the growing bed and above it, so that the pressure at the bottom
has a closed form; it must not depend on the time-step. Exit code 1 if a level, a pressure, the slurry's volume or the
range of the phase fraction is wrong."""
import sys
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from scipy.integrate import trapezoid

from millfoam.files import foam
from millfoam.files.constants import GRAVITY
from millfoam.run import run as run_program
from millfoam.run import case_options, copy_case, fresh_runs, marked, run_jobs, write_parameters, write_table

sys.path.insert(0, str(Path(__file__).parent.parent / "pressure_drop"))
import published_laws  # noqa: E402, in that case's folder

matplotlib.use("Agg")

RESOURCES = Path(__file__).resolve().parents[1] / "resources"
WIDTH, HEIGHT, COLUMNS, LAYERS = 0.016, 0.4, 4, 100
LAYER = HEIGHT / LAYERS
POOL = 0.2018  # m, the level at the start: within a layer
SOLIDITY, THICKNESS = 0.5, 0.0987  # of the bed; m, not a whole number of layers
# Moves down in the closed box, and is there from the start in the open one
BED_BOTTOM = {"closed": 0.2413, "open": 0.0613}
BED_SPEED, UNTIL = -0.2, 0.9
RAMP = (0.1, 0.6)
DENSITY, AIR_DENSITY, VISCOSITY, DIAMETER = 1000, 1.2, 2e-4, 0.005  # kg/m3, kg/m3, m2/s, m
END, WRITE_INTERVAL = 1.0, 0.02
RUNS = {"closed": ("closed", 2e-3), "open": ("open", 2e-3), "open, small steps": ("open", 5e-4)}  # largest step, s
QUICK_SMALL = 1e-3  # s, largest of the small steps with --quick
TOLERANCE = 1e-6  # of the level, relative; of the phase fraction, absolute
CONSERVED = 1e-8  # of the slurry's volume, relative
SLOWEST = 1e-12  # m/s, superficial: the law is not defined at rest
PRESSURE = 10  # of the pressure at the bottom, of the largest one, for each second of the largest step


def grown(time):
    """Share of its solidity that the growing bed has at a time (s), with the share s of the ramp that has passed."""
    share = np.clip((time - RAMP[0]) / (RAMP[1] - RAMP[0]), 0, 1)
    return share**3 * (10 - 15 * share + 6 * share**2)


def bed(kind, time):
    """Height of the bed's lower and upper side (m) and its solidity at a time (s)."""
    bottom = BED_BOTTOM[kind]
    if kind == "closed":
        bottom += BED_SPEED * min(time, UNTIL)
        return bottom, bottom + THICKNESS, SOLIDITY
    return bottom, bottom + THICKNESS, SOLIDITY * grown(time)


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


def bottom_pressure(times):
    """p at the bottom of the open box, Pa, at each time (s), where p_rgh is 0 in the air at the top: of a column of
    slurry that is at rest below the growing bed, rises through it with q = dphi/dt (y - bottom), and above it as a
    whole. Sum of weight, drag (beta q/e^2), inertia and the dynamic pressure at the surface."""
    step = 1e-6
    y = np.linspace(0, THICKNESS, 2001)

    def bed_flow(time):
        phi = SOLIDITY * grown(time)
        rate = SOLIDITY * (grown(time + step) - grown(time - step)) / (2 * step)
        return phi, rate * y

    result = []
    for time in times:
        phi, q = bed_flow(time)
        later_phi, later_q = bed_flow(time + step)
        inertia = (later_q / (1 - later_phi) - q / (1 - phi)) / step
        above = (later_q[-1] - q[-1]) / step
        drag = published_laws.GRADIENTS["Beetstra"](phi, np.maximum(q, SLOWEST), DIAMETER, DENSITY * VISCOSITY, DENSITY)
        level = POOL + phi * THICKNESS
        rest = level - BED_BOTTOM["open"] - THICKNESS
        result.append((DENSITY - AIR_DENSITY) * GRAVITY * level + trapezoid(drag + DENSITY * inertia, y)
                      + DENSITY * above * rest + DENSITY * q[-1]**2 / 2)
    return np.array(result)


def final_level(kind):
    """Closed form, m: the bed lies below the level."""
    lower, upper, solidity = bed(kind, END)
    level = POOL + solidity * (upper - lower)
    assert upper < level
    return level


@dataclass
class Displacement:
    """Phase fractions [time, layer, column] at the written times (s), largest speed at the end (m/s), and pressure (Pa)
    at the bottom at the end of every step (s), of which the largest has a length (s)."""
    name: str
    kind: str
    time: np.ndarray
    share: np.ndarray
    last_speed: float
    steps: np.ndarray
    pressure: np.ndarray
    largest_step: float

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

    @cached_property
    def pressure_error(self):
        """Largest error of the pressure at the bottom over the largest pressure; none is known of the closed box."""
        if self.kind == "closed":
            return np.nan
        expected = bottom_pressure(self.steps)
        return np.abs(self.pressure - expected).max() / expected.max()

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
        # Of the closed box no pressure is known. A reading that is not a number misses its limit
        right_pressure = self.kind == "closed" or self.pressure_error <= PRESSURE * self.largest_step
        largest = np.max([self.error.max(), self.final_error, self.beyond, self.not_settled])
        return not (right_pressure and largest <= TOLERANCE and self.volume_change <= CONSERVED)


def write_pool(case):
    """The initial phase fraction, exactly flat at POOL."""
    share = np.clip(POOL / LAYER - np.arange(LAYERS), 0, 1).repeat(COLUMNS)
    values = "\n".join(repr(float(value)) for value in share)
    (case / "initialShare").write_text(f"internalField nonuniform List<scalar> {len(share)}\n(\n{values}\n);\n")


def run(name, kind, largest_step, case, template):
    copy_case(case, RESOURCES / "common", template / "common", template / kind)
    write_parameters(
        case, width=WIDTH, height=HEIGHT, columns=COLUMNS, layers=LAYERS, slurryDensity=DENSITY,
        slurryKinematicViscosity=VISCOSITY, gravity=f"(0 0 {-GRAVITY})", airDensity=AIR_DENSITY,
        bedBottom=BED_BOTTOM[kind], bedTop=BED_BOTTOM[kind] + THICKNESS, solidity=SOLIDITY, bedSpeed=BED_SPEED,
        until=UNTIL, rampBegin=RAMP[0], rampEnd=RAMP[1], firstStep=1e-4, largestStep=largest_step, endTime=END,
        writeInterval=WRITE_INTERVAL)
    write_pool(case)
    run_program(case, "blockMesh")
    run_program(case, "slurryFoam")
    written = foam.times(case)[1:]
    shares = [foam.read_field(folder / "alpha.slurry").reshape(LAYERS, COLUMNS) for _, folder in written]
    speeds = np.linalg.norm(foam.read_field(written[-1][1] / "U", LAYERS * COLUMNS), axis=1)
    probe = np.loadtxt(case / "postProcessing" / "bottom" / "0" / "p")
    return Displacement(
        name, kind, np.array([time for time, _ in written]), np.array(shares), speeds.max(), probe[:, 0],
        probe[:, 1] + DENSITY * GRAVITY * LAYER / 2, largest_step)


def print_table(results, out):
    lines = [f"{'box':<18} {'level mm':>10} {'expected mm':>12} {'error':>8} {'at any time':>12} "
             f"{'phase beyond 0, 1':>18} {'not settled':>12} {'volume':>8} {'pressure':>9} {'speed at end m/s':>17}"]
    for result in results:
        lines.append(marked(
            f"{result.name:<18} {1e3 * result.level[-1].mean():10.5f} {1e3 * final_level(result.kind):12.5f} "
            f"{result.final_error:8.1e} {result.error.max():12.1e} {result.beyond:18.1e} {result.not_settled:12.1e} "
            f"{result.volume_change:8.1e} {result.pressure_error:9.1e} {result.last_speed:17.1e}",
            result.misses()))
    lines.append(f"tolerance of levels (relative) and phase fraction {TOLERANCE:g}, of the slurry's volume "
                 f"{CONSERVED:g}, of the pressure at the bottom {PRESSURE:g} times the largest step in s; "
                 f"level at the start {1e3 * POOL:g} mm")
    write_table(lines, out)


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
        picture.set(title=f"{result.name}: slurry's share of the fluid", ylabel="height, m", ylim=(0, HEIGHT))
        picture.legend(loc="upper right", fontsize=8)
        errors.semilogy(result.time, np.maximum(result.error, 1e-16), "k.-")
        errors.axhline(TOLERANCE, color="r", ls="--", lw=1)
        errors.set(xlabel="time, s", ylabel="relative error of the level")
        errors.grid(alpha=0.3)
    figure.colorbar(shades, ax=axes[0, -1])
    figure.savefig(out, dpi=110)


def main():
    options = case_options(__doc__, quick=f"small steps of {1e3 * QUICK_SMALL:g} ms")
    here = Path(__file__).parent.resolve()
    work = fresh_runs(here)
    runs = {**RUNS, "open, small steps": ("open", QUICK_SMALL)} if options.quick else RUNS
    results = run_jobs(lambda name: run(name, *runs[name], work / name.replace(", ", "_").replace(" ", "_"),
                                        here / "template"), runs, options.jobs)
    print_table(results, here / "displacement.txt")
    plot(results, here / "displacement.png")
    return 1 if any(result.misses() for result in results) else 0


if __name__ == "__main__":
    sys.exit(main())
