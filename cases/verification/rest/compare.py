#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Slurry at rest in a mill at rest stays at rest: on the mill's own mesh, first slurry alone, then a pool under air.

Slurry alone must stay at rest to round-off. The pool's free surface, exactly flat at the start, does not stay at rest
with interFoam: gravity's potential is taken at the faces and not at the interface. Its spurious speeds are reported and
must not increase. Exit code 1 if a check fails."""
import math
import sys
from dataclasses import dataclass
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

from millfoam.files import foam
from millfoam.files.constants import GRAVITY
from millfoam.run import run as run_program
from millfoam.run import (case_options, copy_case, fresh_runs, limit_table, run_jobs, set_options, write_parameters,
                          write_table)
from mill_slice import FINE, MILL
from pool_history import largest_speeds

matplotlib.use("Agg")

RESOURCES = Path(__file__).resolve().parents[1] / "resources"
STILL = 1e-14  # m/s, largest speed of the slurry alone
CONSERVED = 3e-8  # relative change of the slurry's volume
FLUID_STEPS, POOL_END = 50, 0.2  # s
SHORT = 1e-6  # s that the pool may end early: the digits of its times
# Twice what this mesh showed (air 1.0, slurry 0.041): a limit against changes for the worse, not a physical bound
MOST_AIR, MOST_SLURRY = 2.0, 0.082  # m/s
STILL_FLUID = dict(slurryShare=1, endTime=FLUID_STEPS * 1e-3, firstStep=1e-3, adjustTimeStep="no",
                   writeInterval=FLUID_STEPS * 1e-3)
# By name: mill (in this folder, or elsewhere) and its settings, the DEM time it is turned to, parameters of the flow
RUNS = {
    "pool": ("mill.yaml", (), 0, dict(slurryShare=0, endTime=POOL_END, firstStep=1e-4, adjustTimeStep="yes",
                                      writeInterval=0.01)),
    "fluid": ("mill.yaml", (), 0, STILL_FLUID),
    "slice": (MILL, FINE, 1.0, STILL_FLUID),
}


@dataclass
class Pool:
    """The pool at the written times: largest speed of air and of slurry, slurry's rms speed (m/s), its volume (m3)."""
    time: np.ndarray
    air: np.ndarray
    slurry: np.ndarray
    slurry_rms: np.ndarray
    volume: np.ndarray

    @property
    def volume_change(self):
        return np.abs(self.volume / self.volume[0] - 1).max()


def run(name, work, here):
    """Runs one of RUNS in its own folder under `work`; a program that fails ends this one."""
    case = work / name
    copy_case(case, RESOURCES / "common", RESOURCES / "closed", RESOURCES / "mill_level", here / "template")
    mill, changes, time, parameters = RUNS[name]
    write_parameters(case, **parameters, gravity=f"(0 {-GRAVITY} 0)", convection="linearUpwind grad(U)")
    run_program(case, "millMesh", here / mill, "--case", ".", "--at-time", time, *set_options(changes))
    if name == "pool":
        run_program(case, "setAlphaField")
    run_program(case, "millInterFoam")
    return case


def measure(case):
    mesh = foam.read_mesh(case)
    _, volume = mesh.centres_and_volumes()
    rows = []
    for time, folder in foam.times(case):
        alpha = foam.read_field(folder / "alpha.slurry", mesh.cells)
        speed = np.linalg.norm(foam.read_field(folder / "U", mesh.cells), axis=1)
        rows.append((time, speed[alpha < 0.5].max(), speed[alpha >= 0.5].max(),
                     math.sqrt((alpha * volume * speed**2).sum() / (alpha * volume).sum()), (alpha * volume).sum()))
    return Pool(*np.array(rows).T)


def report(fluids, pool, out):
    """Writes and prints the table; returns the number of values beyond their limit."""
    rows = []
    for name, fluid in fluids.items():
        rows += [(f"slurry alone ({name}): largest m/s", fluid[:, 1].max(), STILL),
                 (f"slurry alone ({name}): steps more or less than {FLUID_STEPS}", abs(FLUID_STEPS - len(fluid)), 0)]
    lines, missed = limit_table(rows + [
        (f"pool: s that the run ended before or after {POOL_END:g} s", abs(POOL_END - pool.time[-1]), SHORT),
        ("pool: air, largest m/s", pool.air.max(), MOST_AIR),
        ("pool: slurry, largest m/s", pool.slurry.max(), MOST_SLURRY),
        ("pool: relative change of the slurry's volume", pool.volume_change, CONSERVED)])
    lines += ["", "pool, spurious speeds in m/s",
              f"{'time s':>7} {'air max':>9} {'slurry max':>11} {'slurry rms':>11}"]
    lines += [f"{t:7.3f} {air:9.4f} {slurry:11.5f} {rms:11.6f}"
              for t, air, slurry, rms in zip(pool.time, pool.air, pool.slurry, pool.slurry_rms)]
    write_table(lines, out)
    return missed


def plot(fluids, pool, steps, out):
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.5), constrained_layout=True)
    for name, fluid in fluids.items():
        left.semilogy(1e3 * fluid[:, 0], np.maximum(fluid[:, 1], 1e-18), label=f"largest speed ({name})")
    left.axhline(STILL, color="k", ls="--", label="allowed")
    left.set(title="Slurry alone, at rest", xlabel="time, ms", ylabel="m/s")
    right.semilogy(1e3 * steps[:, 0], steps[:, 1], color="0.7", label="largest of every step")
    for values, label in ((pool.air, "air, largest"), (pool.slurry, "slurry, largest"),
                          (pool.slurry_rms, "slurry, rms")):
        right.semilogy(1e3 * pool.time[1:], values[1:], "o-", ms=3, label=label)
    right.set(title="Pool under air: spurious speeds", xlabel="time, ms", ylabel="m/s")
    for axis in (left, right):
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    figure.savefig(out, dpi=110)


def main():
    options = case_options(__doc__)
    here = Path(__file__).parent.resolve()
    work = fresh_runs(here)
    cases = dict(zip(RUNS, run_jobs(lambda name: run(name, work, here), RUNS, options.jobs)))
    steps, pool = largest_speeds(cases["pool"]), measure(cases["pool"])
    fluids = {"plain ends": largest_speeds(cases["fluid"]), "slice": largest_speeds(cases["slice"])}
    missed = report(fluids, pool, here / "rest.txt")
    plot(fluids, pool, steps, here / "rest.png")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
