#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Slurry falls through a bed or a grate in a column: its surface compared with the equations of a rigid column.

With superficial speed U and surface at z, both fluids in the column move as one:

    M dU/dt = G(z) - f(U) - b,   dz/dt = -U/e at the surface

M is the inertia (density times length over voidage), G gravity's and the ends' pressure, f the drag law's or the
grate's, b the difference of rho u^2/2 between the ends. With Darcy's law, a slow column and the drag's gradient K U
this is, above the bed, an exponential of the head with the time K L/((rho - rho_air) g): of the level above the
tailwater's, or, where the bed drains freely at its lower end, of h + L. A grate with the loss coefficient K, much above
1, lets through sqrt(2 g h/K) of the head h: sqrt(h) falls by a straight line to the time sqrt(2 K h/g). Independent of
K, the discharge coefficient that this line has must be one of an orifice. Exit code 1 if a run misses a limit."""
import shutil
import sys
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from scipy.integrate import solve_ivp

from millfoam.files import foam
from millfoam.files.constants import GRAVITY
from millfoam.readings.models import orifice_coefficients, plate_loss
from millfoam.run import run as run_program
from millfoam.run import case_options, copy_case, fresh_runs, marked, run_jobs, write_parameters, write_table

matplotlib.use("Agg")

RESOURCES = Path(__file__).resolve().parents[1] / "resources"
SLURRY, AIR = 1000.0, 1.2  # kg/m3
SLURRY_NU, AIR_NU = 1e-6, 1.5e-5  # m2/s
HEIGHT, LAYERS, START = 0.5, 200, 0.45  # of the column, m; surface at the start, m
TOLERANCE = 0.01  # of the first head; of the exponential's time, relative
SHORT = 1e-6  # s that a run may end early: the digits of its times
HEAD_LEFT = 0.1  # share of the first head down to which a closed form is fitted
GRATES = Path(__file__).resolve().parents[3] / "scripts" / "mill_case" / "constant" / "grateProperties"


@dataclass
class Column:
    """A column with a bed between two heights (m) and, at its lower end, the pressure of a tailwater of a height
    (m)."""
    name: str
    law: str
    solidity: float
    diameter: float  # m
    bottom: float
    top: float
    tailwater: float
    end: float  # s
    largest_step: float  # s
    open_fraction: float = 0.0  # of a grate
    pegged: float = 0.0  # share of its holes

    @property
    def voidage(self):
        return 1 - self.solidity

    @property
    def is_grate(self):
        return self.law == "grate"

    @property
    def open_share(self):
        """Open share of a grate, without its pegged holes."""
        return self.open_fraction * (1 - self.pegged)

    @property
    def loss(self):
        """Loss coefficient K of the grate."""
        return plate_loss(self.open_share)

    @property
    def orifice(self):
        """Least and largest discharge coefficient of an orifice."""
        return orifice_coefficients(self.open_share)

    def gradient(self, speed, density, nu):
        """Pressure gradient (Pa/m) at a superficial speed (m/s), of the bed by Ergun 1952 or its viscous part."""
        viscous = 150 * density * nu * self.solidity**2 / (self.voidage**3 * self.diameter**2) * speed
        inertial = 1.75 * density * self.solidity / (self.voidage**3 * self.diameter) * speed * abs(speed)
        return viscous + (inertial if self.law == "Ergun" else 0)

    @property
    def has_closed_form(self):
        return self.law != "Ergun"

    @property
    def time_constant(self):
        """Time of the exponential, or at which the head above a grate is 0, s."""
        if self.is_grate:
            return np.sqrt(2 * self.loss * self.head / GRAVITY)
        return self.gradient(1.0, SLURRY, SLURRY_NU) * (self.top - self.bottom) / ((SLURRY - AIR) * GRAVITY)

    @property
    def head(self):
        """Head at the start, m."""
        return START - self.tailwater

    def closed_form(self, time):
        """Heads at times (s), m."""
        if self.is_grate:
            return self.head * np.maximum(1 - time / self.time_constant, 0)**2
        return self.head * np.exp(-time / self.time_constant)

    def in_bed(self, z):
        return self.bottom < z < self.top

    def rates(self, _, state):
        """dz/dt and dU/dt at surface z and superficial speed U downwards."""
        z, speed = state
        bed_wet = min(max(z, self.bottom), self.top) - self.bottom
        bed_dry = self.top - self.bottom - bed_wet
        slowness = 1 / self.voidage
        inertia = (SLURRY * (z + bed_wet * (slowness - 1)) + AIR * (HEIGHT - z + bed_dry * (slowness - 1)))
        drive = (SLURRY - AIR) * GRAVITY * (z - self.tailwater)
        if self.is_grate:
            drag = self.loss * SLURRY * speed * abs(speed) / 2
        else:
            drag = bed_wet * self.gradient(speed, SLURRY, SLURRY_NU) + bed_dry * self.gradient(speed, AIR, AIR_NU)
        at_surface, at_end = (speed * (slowness if inside else 1)
                              for inside in (self.in_bed(z), self.bottom <= 0))
        ends = (SLURRY * (at_end**2 - at_surface**2) + AIR * (at_surface**2 - speed**2)) / 2
        return [-at_surface, (drive - drag - ends) / inertia]

    def levels(self, times):
        """Height of the surface, m, by quadrature."""
        solution = solve_ivp(self.rates, (0, times[-1]), [START, 0.0], method="LSODA", t_eval=times, rtol=1e-9,
                             atol=1e-12, max_step=self.end / 500)
        assert solution.success, solution.message
        return solution.y[0]


COLUMNS = [
    Column("tailwater", "Darcy", 0.6, 1e-3, 0.05, 0.15, 0.25, 20.0, 0.02),
    Column("draining", "Darcy", 0.6, 1e-3, 0.0, 0.1, 0.0, 16.0, 0.02),
    Column("Ergun", "Ergun", 0.5, 0.02, 0.05, 0.15, 0.0, 0.75, 1.5e-3),
    Column("grate", "grate", 0.0, 0.02, 0.0, 0.0, 0.0, 4.4, 5e-3, 0.1),
    Column("pegged", "grate", 0.0, 0.02, 0.0, 0.0, 0.0, 9.0, 1e-2, 0.1, 0.5),
]


@dataclass
class Fall:
    """The surface's height z (m) at the written times (s), the start among them."""
    column: Column
    time: np.ndarray
    z: np.ndarray

    @cached_property
    def expected(self):
        return self.column.levels(self.time)

    @property
    def error(self):
        """Largest difference from the quadrature, over the first head."""
        return np.abs(self.z - self.expected).max() / self.column.head

    @property
    def late(self):
        """Times at which the surface is above the bed and more than HEAD_LEFT of the head is left."""
        return (self.z > self.column.top) & (self.z - self.column.tailwater > HEAD_LEFT * self.column.head)

    @property
    def fitted_time(self):
        """Time of the closed form fitted to the heads, s."""
        time, head = self.time[self.late], (self.z - self.column.tailwater)[self.late]
        if self.column.is_grate:
            return -np.sqrt(self.column.head) / np.polyfit(time, np.sqrt(head), 1)[0]
        return -1 / np.polyfit(time, np.log(head), 1)[0]

    @property
    def discharge_coefficient(self):
        """Discharge of the grate over that of a lossless jet through its open holes, by the fitted time."""
        return np.sqrt(2 * self.column.head / GRAVITY) / (self.column.open_share * self.fitted_time)

    @property
    def is_orifice(self):
        """Whether a grate discharges as an orifice does."""
        least, most = self.column.orifice
        return least <= self.discharge_coefficient <= most

    @property
    def closed_error(self):
        """Largest difference from the closed form, over the first head."""
        expected = self.column.closed_form(self.time)
        return np.abs(self.z - self.column.tailwater - expected)[self.late].max() / self.column.head

    @property
    def errors(self):
        found = [self.error]
        if self.column.has_closed_form:
            found += [self.closed_error, abs(self.fitted_time / self.column.time_constant - 1)]
        return found

    @property
    def reached(self):
        """Whether the run was written up to its end."""
        return self.column.end - self.time[-1] <= SHORT

    def misses(self):
        return not (self.reached and all(error <= TOLERANCE for error in self.errors)
                    and (not self.column.is_grate or self.is_orifice))


def write_surface(case):
    share = np.clip(START / (HEIGHT / LAYERS) - np.arange(LAYERS), 0, 1)
    values = "\n".join(repr(float(value)) for value in share)
    (case / "initialShare").write_text(f"internalField nonuniform List<scalar> {LAYERS}\n(\n{values}\n);\n")


def run(column, case, template):
    copy_case(case, RESOURCES / "common", template)
    write_parameters(
        case, height=HEIGHT, layers=LAYERS, slurryDensity=SLURRY, slurryKinematicViscosity=SLURRY_NU,
        airDensity=AIR, gravity=f"(0 0 {-GRAVITY})",
        law=column.law, solidity=column.solidity, diameter=column.diameter, bedBottom=column.bottom, bedTop=column.top,
        # p_rgh: slurry at the outlet, air at the top; both for a surface at rest at the tailwater's level
        outletPressure=SLURRY * GRAVITY * column.tailwater, topPressure=AIR * GRAVITY * column.tailwater,
        firstStep=column.largest_step / 10, largestStep=column.largest_step, endTime=column.end,
        writeInterval=column.end / 40)
    write_surface(case)
    run_program(case, "blockMesh")
    if column.is_grate:
        # The dictionary of a mill's case, with what it reads of the mill
        (case / "constant" / "bedProperties").unlink()
        shutil.copy(GRATES, case / "constant")
        (case / "constant" / "millProperties").write_text(
            "FoamFile { version 2; format ascii; class dictionary; object millProperties; }\n"
            f"grates yes; grateOpenFraction {column.open_fraction * (1 - column.pegged)!r};"
            " slurryStart {} slurryVoxels {}\n")
        run_program(case, "topoSet")
    run_program(case, "slurryFoam")
    rows = [(0.0, START)]
    for time, folder in foam.times(case)[1:]:
        rows.append((time, foam.read_field(folder / "alpha.slurry", LAYERS).sum() * HEIGHT / LAYERS))
    return Fall(column, *np.array(rows).T)


def print_table(falls, out):
    lines = [f"{'column':<10} {'law':<6} {'first head m':>12} {'off quadrature %':>16} {'off closed form %':>17} "
             f"{'time found s':>12} {'expected s':>10} {'error %':>8}"]
    for fall in falls:
        column = fall.column
        line = f"{column.name:<10} {column.law:<6} {column.head:12.3f} {100 * fall.error:16.4f}"
        if column.has_closed_form:
            line += (f" {100 * fall.closed_error:17.4f} {fall.fitted_time:12.5f} {column.time_constant:10.5f} "
                     f"{100 * (fall.fitted_time / column.time_constant - 1):8.4f}")
        line += "" if fall.reached else f"  ended at {fall.time[-1]:g} of {column.end:g} s"
        lines.append(marked(line, fall.misses()))
    lines.append(f"tolerance {100 * TOLERANCE:g} %: of the first head, and of the closed form's time, fitted down to "
                 f"{100 * HEAD_LEFT:g} % of the first head above the bed")
    for fall in falls:
        if fall.column.is_grate:
            least, most = fall.column.orifice
            lines.append(marked(f"{fall.column.name}: K = {fall.column.loss:.1f}, discharge coefficient of the open "
                                f"holes {fall.discharge_coefficient:.3f}, of an orifice {least:.3f} to {most:.3f}",
                                not fall.is_orifice))
    write_table(lines, out)


def plot(falls, out):
    figure, axes = plt.subplots(2, len(falls), figsize=(4.4 * len(falls), 7), sharex="col", height_ratios=(2, 1),
                                constrained_layout=True)
    for fall, (levels, errors) in zip(falls, axes.T):
        column = fall.column
        time = np.linspace(0, column.end, 400)
        if not column.is_grate:
            levels.axhspan(column.bottom, column.top, color="tan", alpha=0.6, label="bed")
        levels.plot(time, column.levels(time), "k-", label="quadrature")
        if column.has_closed_form:
            levels.plot(time, column.tailwater + column.closed_form(time), "r--", label="closed form")
            levels.axhline(column.tailwater, color="b", ls=":", lw=1, label="tailwater")
        levels.plot(fall.time, fall.z, "o", ms=3, mfc="none", label="slurryFoam")
        levels.set(title=f"{column.name}, K = {column.loss:.0f}" if column.is_grate
                   else f"{column.name}: {column.law}'s law", ylabel="surface, m")
        levels.legend(fontsize=8)
        errors.plot(fall.time, 100 * (fall.z - fall.expected) / column.head, "k.-")
        errors.axhspan(-100 * TOLERANCE, 100 * TOLERANCE, color="0.9")
        errors.set(xlabel="time, s", ylabel="off quadrature, % of first head")
        for axis in (levels, errors):
            axis.grid(alpha=0.3)
    figure.savefig(out, dpi=110)


def main():
    options = case_options(__doc__)
    here = Path(__file__).parent.resolve()
    work = fresh_runs(here)
    falls = run_jobs(lambda column: run(column, work / column.name, here / "template"), COLUMNS, options.jobs)
    print_table(falls, here / "falling_head.txt")
    plot(falls, here / "falling_head.png")
    return 1 if any(fall.misses() for fall in falls) else 0


if __name__ == "__main__":
    sys.exit(main())
