#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A pool drains through the ring of grates of a mill at rest: its discharge compared with that of a wall of orifices.

Below a level pool at y = H, the holes at y let through C f sqrt(2 g (H - y)) of their grates' area, with the open share
f and the discharge coefficient C; behind them is air. Over the ring, whose chord at y is w(y) wide, this is

    Q(H) = C f integral of w(y) sqrt(2 g (H - y)) dy  from the ring's lower end to H

and the hold-up V of a drum of length L falls by dV/dt = -Q(H(V)). C of the plate that a mill's grates are is
1/(f sqrt(K + 1)): K by Idelchik, diagram 8-1, and 1 because the pool in front of them is at rest. Independent of K, the
coefficient that the discharge has must be an orifice's. Exit code 1 if a run misses a limit."""
import shutil
import sys
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

from millfoam.files.constants import GRAVITY
from millfoam.files.mill import read_mill
from millfoam.files.tables import read_columns
from millfoam.readings.models import orifice_coefficients, plate_loss
from millfoam.run import run as run_program
from millfoam.run import case_options, fresh_runs, marked, run_jobs, set_options, stop_mill, write_table

matplotlib.use("Agg")

RADIUS, LENGTH, INNER, OUTER, OPEN = 0.15, 0.06, 0.09, 0.13, 0.1  # of mill.yaml, m
END = 0.4  # s, of mill.yaml
BEGIN = 0.05  # s: the pool begins at rest and has its discharge after 0.03 s
TOLERANCE, HOLD_UP = 0.025, 0.01  # of the discharge, of a pool a few cells deep; of what has left
TEMPLATE = Path(__file__).resolve().parents[3] / "scripts" / "mill_case"


@dataclass(frozen=True)
class Pool:
    """A pool of a level (m) in front of grates of which a share of holes is pegged, on a mesh of cells of a size
    (m)."""
    name: str
    level: float
    pegged: float = 0.0
    cell: float = 0.015

    @property
    def open_share(self):
        return OPEN * (1 - self.pegged)

    @property
    def coefficient(self):
        """Discharge coefficient of the open holes, by the plate's loss."""
        return 1 / (self.open_share * np.sqrt(plate_loss(self.open_share) + 1))

    @property
    def band(self):
        """Least and largest discharge coefficient of an orifice."""
        return orifice_coefficients(self.open_share)

    def discharge(self, level):
        """Discharge (m3/s) of a pool of a level (m) by the closed form."""
        return self.open_share * self.coefficient * ring_orifice(level, INNER, OUTER)


POOLS = [Pool("open", -0.02), Pool("pegged", -0.02, pegged=0.5), Pool("low", -0.08)]
FINE = Pool("open, fine", -0.02, cell=0.01)


def chord(y, radius):
    """Length (m) of a circle's chord at y (m) from its centre; 0 outside."""
    return 2 * np.sqrt(max(radius**2 - y**2, 0))


def ring_orifice(level, inner, outer):
    """Discharge (m3/s) of a ring that is open as a whole and has no loss, below a pool of a level (m): the integral of
    w(y) sqrt(2 g (level - y)) dy. Level, inner and outer radius: m, y from the ring's centre."""
    kinks = [y for y in (-inner, inner) if y < level]
    return quad(lambda y: (chord(y, outer) - chord(y, inner)) * np.sqrt(2 * GRAVITY * max(level - y, 0)), -outer,
                min(level, outer), points=kinks or None, limit=200)[0]


def hold_up(level):
    """Volume (m3) of a pool of a level (m) in the drum."""
    return LENGTH * (RADIUS**2 * np.arccos(-level / RADIUS) + level * np.sqrt(RADIUS**2 - level**2))


def level_of(volume):
    """Level (m) of a pool of a volume (m3) in the drum."""
    return brentq(lambda level: hold_up(level) - volume, -RADIUS, RADIUS)


@dataclass
class Drain:
    """Hold-up (m3) and discharge (m3/s) of a pool at times (s); filled: volume of the mesh over the drum's."""
    pool: Pool
    time: np.ndarray
    volume: np.ndarray
    flow: np.ndarray
    filled: float = 1.0

    @property
    def late(self):
        return self.time >= BEGIN

    @cached_property
    def levels(self):
        return np.array([level_of(volume / self.filled) for volume in self.volume])

    @cached_property
    def expected(self):
        return np.array([self.pool.discharge(level) for level in self.levels])

    @property
    def off(self):
        """Discharge from BEGIN on over the closed form's, minus 1."""
        return (self.flow / self.expected - 1)[self.late]

    @property
    def coefficient(self):
        """Discharge coefficient that the discharge has, mean from BEGIN on."""
        return np.mean((self.flow / self.expected)[self.late]) * self.pool.coefficient

    @property
    def left_off(self):
        """What has left from BEGIN to the end, over that of the closed form, minus 1."""
        time, volume = self.time[self.late], self.volume[self.late]
        end = solve_ivp(lambda _, v: [-self.pool.discharge(level_of(v[0] / self.filled))], (time[0], time[-1]),
                        [volume[0]], rtol=1e-8, atol=1e-12).y[0, -1]
        return (volume[0] - volume[-1]) / (volume[0] - end) - 1

    def misses(self):
        """Names of the limits that are missed; a number that is not one misses."""
        least, most = self.pool.band
        return [name for name, held in (("discharge", np.abs(self.off).max() <= TOLERANCE),
                                        ("what has left", abs(self.left_off) <= HOLD_UP),
                                        ("orifice", least <= self.coefficient <= most),
                                        ("ended early", END - self.time[-1] <= 1e-6)) if not held]


def require_sizes(case):
    """RuntimeError unless the resolved mill of a case has the sizes of the closed form, which are those here."""
    mill = read_mill(case)
    grates = mill.asked("geometry", "grates")
    found = (mill.radius, mill.length, grates["inner_radius"], grates["outer_radius"], grates["open_fraction"],
             mill.asked("flow", "duration"))
    if not np.allclose(found, (RADIUS, LENGTH, INNER, OUTER, OPEN, END), rtol=1e-12):
        raise RuntimeError(f"mill.yaml has other sizes than compare.py: {found}")


def run(pool, case, here):
    case.mkdir()
    for part in ("constant", "system"):
        shutil.copytree(TEMPLATE / part, case / part)
    shutil.copytree(TEMPLATE / "0.orig", case / "0")
    shutil.copytree(here / "template", case, dirs_exist_ok=True)
    (case / "constant" / "bedProperties").unlink()
    run_program(case, "millMesh", here / "mill.yaml", "--case", ".", *set_options(
        [f"flow.start.level={pool.level}", f"geometry.grates.pegged={pool.pegged}",
         f"resolution.cell_size={pool.cell}"]))
    require_sizes(case)
    stop_mill(case)
    run_program(case, "slurryStart")
    run_program(case, "slurryFoam")
    table = read_columns(case, "slurryBalance")
    start = table["holdUp"][0] + table["discharged"][0]
    return Drain(pool, table["Time"], table["holdUp"], table["discharge"], start / hold_up(pool.level))


def print_table(drains, out):
    lines = [f"{'pool':<12}{'open %':>8}{'level mm, first':>17}{'last':>7}{'off mean %':>12}{'largest %':>11}"
             f"{'left off %':>12}{'C':>8}{'of the plate':>14}{'of an orifice':>17}"]
    for one in drains:
        levels = 1e3 * one.levels[one.late]
        least, most = one.pool.band
        largest = one.off[np.argmax(np.abs(one.off))]
        lines.append(marked(
            f"{one.pool.name:<12}{100 * one.pool.open_share:8.1f}{levels[0]:17.1f}{levels[-1]:7.1f}"
            f"{100 * one.off.mean():12.2f}{100 * largest:11.2f}{100 * one.left_off:12.2f}{one.coefficient:8.3f}"
            f"{one.pool.coefficient:14.3f}{f'{least:.3f} to {most:.3f}':>17}", one.misses()))
    lines.append(f"from {BEGIN:g} s on; tolerance {100 * TOLERANCE:g} % of the discharge, {100 * HOLD_UP:g} % of what "
                 "has left")
    write_table(lines, out)


def plot(drains, out):
    figure, axes = plt.subplots(1, len(drains), figsize=(4.2 * len(drains), 3.8), constrained_layout=True,
                                squeeze=False)
    for one, axis in zip(drains, axes[0]):
        axis.plot(one.time, 1e6 * one.expected, "k-", label="closed form")
        axis.plot(one.time, 1e6 * one.flow, "o", ms=3, mfc="none", label="slurryFoam")
        axis.axvline(BEGIN, color="0.7", lw=1)
        axis.set(title=one.pool.name, xlabel="time, s", ylabel="discharge, ml/s", ylim=(0, None))
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    figure.savefig(out, dpi=110)


def main():
    options = case_options(__doc__, "without the finer mesh")
    here = Path(__file__).parent.resolve()
    work = fresh_runs(here)
    pools = POOLS if options.quick else [*POOLS, FINE]
    drains = run_jobs(lambda pool: run(pool, work / pool.name.replace(", ", "_"), here), pools, options.jobs)
    print_table(drains, here / "grate_ring.txt")
    plot(drains, here / "grate_ring.png")
    return 1 if any(one.misses() for one in drains) else 0


if __name__ == "__main__":
    sys.exit(main())
