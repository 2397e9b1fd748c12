#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A capillary wave on two viscous fluids, compared with Prosperetti's solution.

Amplitude over time of slurryFoam on three meshes, and of interFoam on one of them. Exit code 1 if a check fails."""
import sys
from dataclasses import dataclass
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from scipy.optimize import curve_fit

from millfoam.files import foam
from millfoam.run import run as run_program
from millfoam.run import case_options, copy_case, fresh_runs, marked, run_jobs, write_parameters, write_table
from prosperetti import Wave

matplotlib.use("Agg")

RESOURCES = Path(__file__).resolve().parents[1] / "resources"
LENGTH = 0.02  # m, of the wave
SIGMA = 0.07  # N/m
SLURRY, AIR = 1239, 1.2  # kg/m3
VISCOSITY = 1e-5  # m2/s, of both: the closed form needs the same
AMPLITUDE = 0.03  # over the wave's length
HEIGHT = 1.5  # of the room over the wave's length
LEVEL = 0.3  # of a cell between the surface at rest and the faces below it
RECORDS = 20  # per period


@dataclass(frozen=True)
class Limit:
    """Largest deviation from theory, and errors of frequency and rate of decay."""
    deviation: float
    frequency: float
    decay: float


# By cells per wave
LIMITS = {16: Limit(0.5, 0.13, 0.2), 32: Limit(0.15, 0.04, 0.1), 64: Limit(0.1, 0.03, 0.05)}


@dataclass(frozen=True)
class Run:
    cells: int  # per wave
    solver: str = "slurryFoam"
    periods: float = 2

    @property
    def name(self):
        return f"{self.solver}_{self.cells}"

    @property
    def wave(self):
        return Wave(2 * np.pi / LENGTH, SIGMA, SLURRY, AIR, VISCOSITY)


RUNS = [Run(64), Run(32), Run(16), Run(32, "interFoam")]
PROGRAMS = {"interFoam": "millInterFoam", "slurryFoam": "slurryFoam"}


def shares(columns, rows):
    """Share of slurry of each cell (rows x columns), the edge of a cell being 1, under the cosine."""
    points = 16  # along x in a cell
    x = (np.arange(columns * points) + 0.5) / (columns * points) * 2 * np.pi
    level = int(rows / 2) + LEVEL + AMPLITUDE * columns * np.cos(x)
    return np.clip(level - np.arange(rows)[:, None], 0, 1).reshape(rows, columns, points).mean(axis=2)


def build(run, case, here):
    copy_case(case, RESOURCES / "common", RESOURCES / "closed", RESOURCES / "with_interfoam", here / "template")
    columns, rows = run.cells, int(HEIGHT * run.cells)
    edge = LENGTH / run.cells
    period = run.wave.period
    write_parameters(
        case, solver=PROGRAMS[run.solver], surfaceTension=SIGMA, slurryDensity=SLURRY, airDensity=AIR,
        slurryKinematicViscosity=VISCOSITY, airKinematicViscosity=VISCOSITY, endTime=run.periods * period,
        writeInterval=period / RECORDS, largestStep=np.sqrt(SLURRY * edge**3 / SIGMA) / 8, width=LENGTH,
        height=rows * edge, edge=edge, cellsX=columns, cellsY=rows, correctors=3 if run.solver == "interFoam" else 1)
    run_program(case, "blockMesh")
    path = case / "0" / "alpha.slurry"
    alpha = shares(columns, rows).ravel()
    values = "\n".join(f"{value:.15g}" for value in alpha)
    path.write_text(path.read_text().replace(
        "internalField   uniform 0;", f"internalField   nonuniform List<scalar> {alpha.size}\n(\n{values}\n);"))


@dataclass
class History:
    """The wave's amplitude over that at the start, at the written times (s)."""
    run: Run
    time: np.ndarray
    amplitude: np.ndarray
    volume_change: float  # of the slurry, relative

    @property
    def theory(self):
        return self.run.wave.amplitude(self.time)

    @property
    def deviation(self):
        """Root mean square difference from theory."""
        return np.sqrt(np.mean((self.amplitude - self.theory) ** 2))

    @staticmethod
    def fit(time, amplitude, wave):
        """Frequency (rad/s) and rate of decay (1/s) of a damped cosine."""
        def damped(t, start, rate, omega, phase):
            return start * np.exp(-rate * t) * np.cos(omega * t + phase)
        guess = (1, 2 * wave.kinematic_viscosity * wave.wave_number**2, wave.omega, 0)
        return curve_fit(damped, time, amplitude, guess)[0][[2, 1]]

    @property
    def errors(self):
        """Relative errors of frequency and rate of decay, each found by the same fit to both courses."""
        found = self.fit(self.time, self.amplitude, self.run.wave)
        return found / self.fit(self.time, self.theory, self.run.wave) - 1


def measure(run, case):
    k = run.wave.wave_number
    mesh, rows = None, []
    for time, folder in foam.times(case):
        if mesh is None:
            mesh = foam.read_mesh(case, folder)
            centre, volume = mesh.centres_and_volumes()
        slurry = foam.read_field(folder / "alpha.slurry", mesh.cells) * volume
        rows.append((time, (slurry * np.cos(k * centre[:, 0])).sum(), slurry.sum()))
    time, amplitude, slurry = np.array(rows).T
    return History(run, time, amplitude / amplitude[0], np.abs(slurry / slurry[0] - 1).max())


def perform(run, work, here):
    case = work / run.name
    build(run, case, here)
    run_program(case, PROGRAMS[run.solver])
    return measure(run, case)


def report(histories, out):
    """Writes and prints the table; returns the number of values beyond their limit."""
    lines = [f"{'run':<16} {'cells':>6} {'deviation %':>12} {'frequency %':>12} {'decay %':>8} {'volume change':>14}"]
    missed = 0
    for history in histories:
        frequency, decay = np.abs(history.errors)
        limit = LIMITS[history.run.cells]
        bad = not (history.deviation <= limit.deviation and frequency <= limit.frequency and decay <= limit.decay
                   and history.volume_change <= 1e-8)
        bad = bad and history.run.solver == "slurryFoam"
        missed += bad
        lines.append(marked(f"{history.run.solver:<16} {history.run.cells:6d} {100 * history.deviation:12.1f} " +
                            "{:12.1f} {:8.1f}".format(*(100 * history.errors)) + f" {history.volume_change:14.1e}",
                            bad))
    lines.append("Cells per wave; deviation from theory, root mean square over two periods, relative to the start; "
                 "errors of frequency and rate of decay")
    write_table(lines, out)
    return missed


def plot(histories, out):
    figure, axis = plt.subplots(figsize=(9, 4.5), constrained_layout=True)
    wave = histories[0].run.wave
    for history in histories:
        axis.plot(history.time / wave.period, history.amplitude, "o-", ms=3, lw=0.8, mfc="none",
                  label=f"{history.run.solver}, {history.run.cells} cells")
    time = np.linspace(0, histories[0].run.periods, 400)
    axis.plot(time, wave.amplitude(time * wave.period), "k-", lw=0.8, label="Prosperetti")
    axis.set(xlabel="time over the period without viscosity", ylabel="amplitude over its start")
    axis.grid(alpha=0.3)
    axis.legend(fontsize=8, ncol=2)
    figure.savefig(out, dpi=110)


def main():
    options = case_options(__doc__, quick="32 cells per wave, slurryFoam only")
    here = Path(__file__).parent.resolve()
    work = fresh_runs(here)
    runs = [Run(32)] if options.quick else RUNS
    histories = run_jobs(lambda run: perform(run, work, here), runs, options.jobs)
    missed = report(histories, here / "capillary_wave.txt")
    if not options.quick:
        plot(histories, here / "capillary_wave.png")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
