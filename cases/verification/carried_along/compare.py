#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Slurry carried along by a bed that turns like a solid about an upright axis, between walls that slip.

A full cylinder spins up as u = Omega r (1 - exp(-beta t/(epsilon rho))), ring by ring; in a half-full one the surface
settles to the paraboloid z = z0 + Omega^2 r^2/(2 g). On meshes at rest and on meshes that turn through the bed. Exit
code 1 if a check fails."""
import sys
from dataclasses import dataclass
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

from millfoam.files import foam
from millfoam.files.constants import GRAVITY
from millfoam.run import run as run_program
from millfoam.run import case_options, copy_case, fresh_runs, limit_table, run_jobs, write_parameters, write_table

sys.path.insert(0, str(Path(__file__).parent.parent / "pressure_drop"))
import published_laws  # noqa: E402, in that case's folder

matplotlib.use("Agg")

RESOURCES = Path(__file__).resolve().parents[1] / "resources"
SLURRY = dict(slurryDensity=1239, slurryKinematicViscosity=1e-6)
AIR = dict(airDensity=1.2, airKinematicViscosity=1.5e-5)
SOLIDITY = 0.5
# Full: the O-grid of the 30 cm mill's section. Omega in rad/s, drag per mass beta/(epsilon rho) at the axis in 1/s
FULL = dict(radius=0.15, omega=2.0, drag=5.0)
# Half full: an upright cylinder, m, with its level at rest at a border between layers
HALF = dict(radius=0.05, height=0.078, layers=52, level=0.0375, omega=10.0, drag=20.0)
FULL_END, QUICK_END, HALF_END = 0.8, 0.3, 0.72  # s
# The falling solidity goes down to half from the first radius to the second (m), as half a cosine wave in equal steps
FALL, FALL_STEPS = (0.03, 0.13), 100
RECORDS = 20
# Of the angular momentum, of the cells' velocities, of the paraboloid
MOMENT_TOLERANCE, SPIN_TOLERANCE, SHAPE_TOLERANCE = 2e-3, 5e-3, 0.01
CONSERVED = 1e-12  # change of the slurry's volume, relative


@dataclass(frozen=True)
class Run:
    half: bool
    falling: bool  # solidity
    turns: float  # of the mesh, over those of the bed
    step: float  # largest, s
    end: float  # s

    @property
    def name(self):
        bed = "half full" if self.half else "full, falling solidity" if self.falling else "full"
        return bed + {0: "", 1: ", mesh forwards", -1: ", mesh backwards"}[np.sign(self.turns)]

    @property
    def folder(self):
        return self.name.replace(", ", "_").replace(" ", "_")

    @property
    def setting(self):
        return HALF if self.half else FULL


# A mesh that turns passes the bed forwards and backwards. Where a surface passes through its cells, the error is
# largest on a fast mesh with long steps, so that half-full cylinders on such meshes have smaller steps.
def runs(quick):
    """All; quick: the full cylinder alone, until its ring at the axis has 78 % of the bed's speed instead of 98 %, and
    the falling solidity on one mesh that turns."""
    half = [Run(True, False, turns, step, HALF_END) for turns, step in ((1.5, 1e-3), (-0.5, 2e-3), (0, 4e-3))]
    full = [Run(False, falling, turns, 1e-3, QUICK_END if quick else FULL_END)
            for falling in (False, True) for turns in ((-3,) if quick and falling else (0, 3, -3))]
    return full if quick else half + full


def fall_radii():
    """Where the falling solidity steps down, m."""
    share = (np.arange(FALL_STEPS) + 0.5) / FALL_STEPS
    return FALL[0] + (FALL[1] - FALL[0]) * np.arccos(1 - 2 * share) / np.pi


def solidity(radius, falling):
    """At the radii, m."""
    steps = np.searchsorted(fall_radii(), radius) / FALL_STEPS if falling else 0
    return SOLIDITY * (1 - steps / 2)


def write_bed(run, case):
    """One cylinder in another, each with its share of the solidity."""
    shells = [(1.0, SOLIDITY)]
    if run.falling:
        shells = [(1.0, SOLIDITY / 2), *((radius, SOLIDITY / 2 / FALL_STEPS) for radius in fall_radii())]
    (case / "bed").write_text("".join(
        f"shell{i} {{ cylinder {{ centre (0 0 0); axis (0 0 1); radius {radius:.12g}; ends (-1 1); }} "
        f"solidity {share:.12g}; velocity (0 0 0); omega $omega; origin (0 0 0); axis (0 0 1); "
        "diameter $diameter; }\n" for i, (radius, share) in enumerate(shells)))


def perform(run, case, here):
    setting = run.setting
    copy_case(case, *(RESOURCES / name for name in ("common", "closed", "turning", "drum")), here / "template",
              here / "half" if run.half else RESOURCES / "ogrid")
    write_parameters(
        case, **SLURRY, **AIR, gravity=f"(0 0 {-GRAVITY})", skewCorrectors=1,
        diameter=published_laws.darcy_diameter(setting["drag"], SOLIDITY, SLURRY["slurryKinematicViscosity"]),
        omega=setting["omega"], meshMotion="dynamicMotionSolverFvMesh" if run.turns else "staticFvMesh",
        meshOmega=run.turns * setting["omega"], endTime=run.end, writeInterval=run.end / RECORDS,
        largestStep=run.step, height=setting.get("height", 0), layers=setting.get("layers", 1),
        level=setting.get("level", 1), share=0 if run.half else 1)
    write_bed(run, case)
    run_program(case, "blockMesh")
    if run.half:
        run_program(case, "setAlphaField")
    run_program(case, "slurryFoam")
    return surface(case) if run.half else spin_up(case, run.falling)


@dataclass
class SpinUp:
    """The full cylinder at the written times (s): tangential velocity of its cells (m/s, [time, cell]) at their radii
    (m), fluid in them (m3)."""
    time: np.ndarray
    radius: np.ndarray
    speed: np.ndarray
    fluid: np.ndarray
    falling: bool

    @property
    def exact(self):
        """Tangential velocity, m/s [time, cell]."""
        phi = solidity(self.radius, self.falling)
        rate = FULL["drag"] * (phi / (1 - phi) * (1 - SOLIDITY) / SOLIDITY) ** 2
        return FULL["omega"] * self.radius * (1 - np.exp(-rate * self.time[:, None]))

    def share(self, speed):
        """Angular momentum over that of the bed's rotation."""
        moment = self.fluid * self.radius
        return speed @ moment / (FULL["omega"] * (moment * self.radius).sum())

    @property
    def share_error(self):
        return self.share(self.speed) - self.share(self.exact)

    @property
    def errors(self):
        """Velocity error of every cell at every time, over the bed's speed at the wall."""
        return (self.speed - self.exact) / (FULL["omega"] * FULL["radius"])

    @property
    def rms_error(self):
        """Rms of the velocity error at every time, weighted by volume, over the bed's speed at the wall."""
        return np.sqrt(self.errors**2 @ self.fluid / self.fluid.sum())


def spin_up(case, falling):
    time, speed = [], []
    for t, folder in foam.times(case):
        mesh = foam.read_mesh(case, folder)
        centre, volume = mesh.centres_and_volumes()
        radius = np.hypot(centre[:, 0], centre[:, 1])
        u = foam.read_field(folder / "U", mesh.cells)
        time.append(t)
        speed.append((centre[:, 0] * u[:, 1] - centre[:, 1] * u[:, 0]) / radius)
    return SpinUp(np.array(time), radius, np.array(speed), volume * (1 - solidity(radius, falling)), falling)


@dataclass
class Surface:
    """Columns of the half-full cylinder: means of r^2 over their cross-sections (m2), heights of the surface (m, [time,
    column])."""
    time: np.ndarray
    r2: np.ndarray
    area: np.ndarray
    height: np.ndarray

    @property
    def exact(self):
        """Heights of the paraboloid that holds the same volume, m."""
        curve = HALF["omega"] ** 2 / (2 * GRAVITY)
        return HALF["level"] + curve * (self.r2 - self.mean(self.r2))

    @property
    def rise(self):
        """Rise of the paraboloid from the axis to the wall, m."""
        return (HALF["omega"] * HALF["radius"]) ** 2 / (2 * GRAVITY)

    def mean(self, values):
        return (self.area * values).sum(axis=-1) / self.area.sum()

    @property
    def curvature_error(self):
        """Relative error at every time of the factor of r^2 that is fitted to the heights."""
        spread = self.r2 - self.mean(self.r2)
        slope = self.mean(self.height * spread) / self.mean(spread**2)
        return slope / (HALF["omega"] ** 2 / (2 * GRAVITY)) - 1

    @property
    def rms_error(self):
        """Rms error of the heights at every time, over the rise."""
        return np.sqrt(self.mean((self.height - self.exact) ** 2)) / self.rise

    @property
    def volume_change(self):
        volume = self.mean(self.height)
        return np.abs(volume / volume[0] - 1).max()


def surface(case):
    mesh = foam.read_mesh(case)
    centre, volume = mesh.centres_and_volumes()
    # The bottom's faces are the columns' projections
    bottom = mesh.patches["bottom"]
    faces = [mesh.points[mesh.faces[face]][:, :2] for face in range(bottom.start, bottom.start + bottom.size)]
    area, r2 = np.array([polygon(face) for face in faces]).T
    owners = centre[mesh.owner[bottom.start:bottom.start + bottom.size], :2]
    column = np.argmin(((centre[:, None, :2] - owners) ** 2).sum(axis=-1), axis=1)
    time, height = [], []
    for t, folder in foam.times(case):
        wet = foam.read_field(folder / "alpha.slurry", mesh.cells) * volume
        time.append(t)
        height.append(np.bincount(column, wet, len(area)) / area)
    return Surface(np.array(time), r2, area, np.array(height))


def polygon(corners):
    """Area (m2) of a polygon in the plane, and the mean of r^2 over it (m2)."""
    a, b = corners, np.roll(corners, -1, axis=0)
    twice = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    moment = (twice * ((a * a).sum(1) + (a * b).sum(1) + (b * b).sum(1))).sum() / 12
    return abs(twice.sum()) / 2, moment / (twice.sum() / 2)


def report(results, out):
    """Writes and prints the table; returns the number of values beyond their limit."""
    rows, notes = [], []
    for run, found in results.items():
        # A time that was not written has no error
        rows.append((f"{run.name}: s that the run ended too early", run.end - found.time[-1], 1e-6))
        if run.half:
            rows += [
                (f"{run.name}, settled: factor of r^2, %", 100 * abs(found.curvature_error[-1]),
                 100 * SHAPE_TOLERANCE),
                (f"{run.name}, settled: heights, rms over the rise, %", 100 * found.rms_error[-1],
                 100 * SHAPE_TOLERANCE),
                (f"{run.name}: change of the slurry's volume", found.volume_change, CONSERVED),
            ]
            notes.append(
                f"{run.name}: the surface rises by {1e3 * found.rise:.2f} mm from axis to wall; its factor still moved "
                f"by {100 * np.ptp(found.curvature_error[-4:]):.2g} % in the last {found.time[-1] - found.time[-4]:.2g}"
                f" s; largest deviation of a column {1e3 * np.abs(found.height[-1] - found.exact).max():.3f} mm")
        else:
            rows += [
                (f"{run.name}: angular momentum, largest over time, %", 100 * np.abs(found.share_error).max(),
                 100 * MOMENT_TOLERANCE),
                (f"{run.name}: cells' velocities over the wall's, rms, %", 100 * found.rms_error.max(),
                 100 * SPIN_TOLERANCE),
            ]
            notes.append(f"{run.name}: largest error of any cell {100 * np.abs(found.errors).max():.2g} % of the "
                         "wall's velocity")
    lines, missed = limit_table(rows)
    write_table(lines + notes, out)
    return missed


def plot(results, out):
    figure, axes = plt.subplots(1, 4, figsize=(20, 4.8), constrained_layout=True)
    for run, found in results.items():
        marker = {0: "o", 1: ">", -1: "<"}[np.sign(run.turns)]
        if run.half:
            order = np.argsort(found.r2)
            radius = 1e3 * np.sqrt(found.r2)
            axes[1].plot(radius, 1e3 * found.height[-1], marker, ms=3, mfc="none", label=run.name)
            axes[1].plot(radius[order], 1e3 * found.exact[order], "k-", lw=0.8)
            axes[3].semilogy(found.time, 100 * found.rms_error, marker + "-", ms=3, mfc="none", label=run.name)
        else:
            line, = axes[0].plot(found.time, found.share(found.speed), marker, ms=4, mfc="none", label=run.name)
            axes[0].plot(found.time, found.share(found.exact), "k-", lw=0.8)
            axes[2].semilogy(found.time[1:], 100 * found.rms_error[1:], marker + "-", ms=3, mfc="none",
                             color=line.get_color(), label=run.name)
    axes[0].set(title="Full: angular momentum over the bed's (line: closed form)", xlabel="time, s")
    axes[1].set(title="Half full, settled (line: z₀ + Ω²r²/(2g))", xlabel="radius, mm", ylabel="surface, mm")
    axes[2].set(title="Full: velocities over the wall's, rms error, %", xlabel="time, s")
    axes[2].axhline(100 * SPIN_TOLERANCE, color="k", ls="--", lw=0.8, label="allowed")
    axes[3].set(title="Half full: heights over the rise, rms error, %", xlabel="time, s")
    axes[3].axhline(100 * SHAPE_TOLERANCE, color="k", ls="--", lw=0.8, label="allowed when settled")
    for axis in axes:
        axis.grid(alpha=0.3)
        if axis.get_legend_handles_labels()[0]:
            axis.legend(fontsize=8)
    figure.savefig(out, dpi=110)


def main():
    options = case_options(__doc__, quick="the full cylinder alone, shorter, its falling solidity on one mesh")
    here = Path(__file__).parent.resolve()
    work = fresh_runs(here)
    asked = runs(options.quick)
    results = dict(zip(asked, run_jobs(lambda run: perform(run, work / run.folder, here), asked, options.jobs)))
    missed = report(results, here / "carried_along.txt")
    plot(results, here / "carried_along.png")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
