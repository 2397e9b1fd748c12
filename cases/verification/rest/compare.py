#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is at rest in a mill at rest stays at rest: on the mill's own mesh, first slurry alone, then a pool under air.

Slurry alone must stay below 1e-6 m/s. The pool's free surface, exactly flat at the start, does not stay at rest with
interFoam: gravity's potential is taken at the faces and not at the interface. Its spurious speeds are reported, and
must stay within what that error can drive. Exit code 1 when something misses."""
import argparse
import math
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from millfoam import foam

GRAVITY = 9.81
STILL = 1e-6  # m/s, largest speed of the slurry alone
CONSERVED = 1e-6  # relative change of the slurry's volume
FLUID_STEPS, POOL_END = 50, 0.2
RUNS = {
    "fluid": dict(slurryShare=1, endTime=FLUID_STEPS * 1e-3, firstStep=1e-3, adjustTimeStep="no", writeInterval=FLUID_STEPS * 1e-3),
    "pool": dict(slurryShare=0, endTime=POOL_END, firstStep=1e-4, adjustTimeStep="yes", writeInterval=0.01),
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
    shutil.copytree(here / "template", case)
    (case / "parameters").write_text("".join(f"{key} {value};\n" for key, value in RUNS[name].items()))
    commands = [["millMesh", str(here / "mill.yaml"), "--case", str(case)]]
    if name == "pool":
        commands.append(["setAlphaField", "-case", str(case)])
    commands.append(["millInterFoam", "-case", str(case)])
    for command in commands:
        with open(case / f"log.{command[0]}", "w") as log:
            done = subprocess.run(command, stdout=log, stderr=subprocess.STDOUT)
        if done.returncode:
            sys.exit(f"{command[0]} failed; see {case}/log.{command[0]}")
    return case


def largest_speeds(case):
    """Time (s) and largest speed (m/s) of every step, as the function object wrote them."""
    lines = (case / "postProcessing" / "speeds" / "0" / "fieldMinMax.dat").read_text().splitlines()
    # time, field, smallest, where, largest, where
    columns = [line.split("\t") for line in lines if not line.startswith("#")]
    return np.array([[float(column[0]), float(column[4])] for column in columns])


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


def bounds(case):
    """Speeds (m/s) that the air and the slurry of the pool may not exceed.

    Air: what the weight of slurry over an error in height of one cell drives, sqrt(2 (rho_s - rho_a) g cell/rho_a).
    Slurry: free fall through the mill."""
    mill = {key: float(value) for key, value in foam.read_dictionary(case / "constant" / "millProperties").items()
            if key in ("radius", "slurryDensity", "airDensity")}
    mesh = foam.read_mesh(case)
    cell = max(np.ptp(mesh.points[face][:, :2], axis=0).max() for face in mesh.faces)
    excess = mill["slurryDensity"] / mill["airDensity"] - 1
    return math.sqrt(2 * excess * GRAVITY * cell), math.sqrt(2 * GRAVITY * 2 * mill["radius"])


def report(fluid, pool, most, out):
    """Writes and prints the table; the number of lines that missed."""
    lines = [f"{'':<44} {'found':>11} {'allowed':>9}"]
    missed = 0

    def row(text, found, allowed):
        nonlocal missed
        hit = math.isfinite(found) and found <= allowed
        missed += not hit
        lines.append(f"{text:<44} {found:11.3e} {allowed:9.2e}" + ("" if hit else "  MISSED"))

    row(f"slurry alone, {len(fluid)} steps: largest m/s", fluid[:, 1].max(), STILL)
    row(f"pool, {pool.time[-1]:g} s: air, largest m/s", pool.air.max(), most[0])
    row("pool: slurry, largest m/s", pool.slurry.max(), most[1])
    row("pool: relative change of the slurry's volume", pool.volume_change, CONSERVED)
    lines += ["", "pool, spurious speeds in m/s",
              f"{'time s':>7} {'air max':>9} {'slurry max':>11} {'slurry rms':>11}"]
    lines += [f"{t:7.3f} {air:9.4f} {slurry:11.5f} {rms:11.6f}"
              for t, air, slurry, rms in zip(pool.time, pool.air, pool.slurry, pool.slurry_rms)]
    print("\n".join(lines))
    out.write_text("\n".join(lines) + "\n")
    return missed


def plot(fluid, pool, steps, out):
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.5), constrained_layout=True)
    left.semilogy(1e3 * fluid[:, 0], np.maximum(fluid[:, 1], 1e-18), label="largest speed")
    left.axhline(STILL, color="k", ls="--", label="allowed")
    left.set(title="Slurry alone, at rest", xlabel="time, ms", ylabel="m/s")
    right.semilogy(1e3 * steps[:, 0], steps[:, 1], color="0.7", label="largest of every step")
    for values, label in ((pool.air, "air, largest"), (pool.slurry, "slurry, largest"), (pool.slurry_rms, "slurry, rms")):
        right.semilogy(1e3 * pool.time[1:], values[1:], "o-", ms=3, label=label)
    right.set(title="Pool under air: spurious speeds", xlabel="time, ms", ylabel="m/s")
    for axis in (left, right):
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    figure.savefig(out, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    here = Path(__file__).parent.resolve()
    work = here / "runs"
    shutil.rmtree(work, ignore_errors=True)
    with ThreadPoolExecutor(options.jobs) as threads:
        fluid_case, pool_case = threads.map(lambda name: run(name, work, here), RUNS)
    fluid, steps, pool = largest_speeds(fluid_case), largest_speeds(pool_case), measure(pool_case)
    missed = report(fluid, pool, bounds(pool_case), here / "rest.txt")
    if len(fluid) != FLUID_STEPS or abs(pool.time[-1] - POOL_END) > 1e-6:
        print(f"the runs ended early: {len(fluid)} steps of {FLUID_STEPS}, {pool.time[-1]} s of {POOL_END}")
        missed += 1
    plot(fluid, pool, steps, here / "rest.png")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
