#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Slurry carried along by a bed that turns like a solid about an upright axis, between walls that slip.

A full cylinder spins up as u = Omega r (1 - exp(-beta t/(epsilon rho))); in a half-full one the surface settles to the
paraboloid z = z0 + Omega^2 r^2/(2 g). Exit code 1 if a check fails."""
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

GRAVITY = 9.81
SLURRY = dict(slurryDensity=1239, slurryKinematicViscosity=1e-6)
AIR = dict(airDensity=1.2, airKinematicViscosity=1.5e-5)
SOLIDITY = 0.5
# Full: the O-grid of the 30 cm mill's section. Omega in rad/s, drag per mass beta/(epsilon rho) in 1/s, times in s.
FULL = dict(radius=0.15, omega=2.0, drag=5.0, end=0.8, step=1e-3)
# Half full: an upright cylinder, m, with its level at rest at a border between layers
HALF = dict(radius=0.05, height=0.078, layers=52, level=0.0375, omega=10.0, drag=20.0, end=0.72, step=4e-3)
RECORDS = 20
SPIN_TOLERANCE, SHAPE_TOLERANCE = 5e-3, 0.01


def ball_diameter(drag):
    """Diameter, m, of the balls whose drag per mass beta/(epsilon rho) is this, 1/s (Kozeny-Carman, 150)."""
    return np.sqrt(150 * SLURRY["slurryKinematicViscosity"] * SOLIDITY**2 / ((1 - SOLIDITY) ** 2 * drag))


def run(setting, case, here):
    shutil.copytree(here / "template", case)
    half = "level" in setting
    shutil.copytree(here / "half" if half else here.parent / "rest" / "pool" / "ogrid", case, dirs_exist_ok=True)
    write_parameters(
        case, **SLURRY, **AIR, gravity=-GRAVITY, solidity=SOLIDITY, diameter=ball_diameter(setting["drag"]),
        omega=setting["omega"], endTime=setting["end"], writeInterval=setting["end"] / RECORDS,
        largestStep=setting["step"], height=setting.get("height", 0), layers=setting.get("layers", 1),
        level=setting.get("level", 1), share=0 if half else 1)
    run_program(case, "blockMesh")
    if half:
        run_program(case, "setAlphaField")
    run_program(case, "slurryFoam")


@dataclass
class SpinUp:
    """The full cylinder at the written times (s): tangential velocity of its cells (m/s, [time, cell]) at their radii
    (m)."""
    time: np.ndarray
    radius: np.ndarray
    speed: np.ndarray
    volume: np.ndarray

    @property
    def share(self):
        """Angular momentum over that of the bed's rotation."""
        moment = self.volume * self.radius
        return self.speed @ moment / (FULL["omega"] * (moment * self.radius).sum())

    @property
    def exact_share(self):
        return 1 - np.exp(-FULL["drag"] * self.time)

    @property
    def errors(self):
        """Velocity error of every cell at every time, over the bed's speed at the wall."""
        exact = FULL["omega"] * self.radius * self.exact_share[:, None]
        return (self.speed - exact) / (FULL["omega"] * FULL["radius"])

    @property
    def rms_error(self):
        """Rms of the velocity error at every time, weighted by volume, over the bed's speed at the wall."""
        return np.sqrt(self.errors**2 @ self.volume / self.volume.sum())


def spin_up(case):
    mesh = foam.read_mesh(case)
    centre, volume = mesh.centres_and_volumes()
    radius = np.hypot(centre[:, 0], centre[:, 1])
    time, speed = [], []
    for t, folder in foam.times(case):
        u = foam.read_field(folder / "U", mesh.cells)
        time.append(t)
        speed.append((centre[:, 0] * u[:, 1] - centre[:, 1] * u[:, 0]) / radius)
    return SpinUp(np.array(time), radius, np.array(speed), volume)


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


def report(spin, shape, out):
    """Writes and prints the table; returns the number of values beyond their limit."""
    rows = [
        ("full: angular momentum, largest over time, %", 100 * np.abs(spin.share - spin.exact_share).max(),
         100 * SPIN_TOLERANCE),
        ("full: cells' velocities over the wall's, rms, %", 100 * spin.rms_error.max(), 100 * SPIN_TOLERANCE),
    ]
    if shape:
        rows += [
            ("half full, settled: factor of r^2, %", 100 * abs(shape.curvature_error[-1]), 100 * SHAPE_TOLERANCE),
            ("half full, settled: heights, rms over the rise, %", 100 * shape.rms_error[-1], 100 * SHAPE_TOLERANCE),
            ("half full: change of the slurry's volume", shape.volume_change, 1e-8),
        ]
    lines = [f"{'':<50} {'error':>10} {'allowed':>10}"]
    missed = 0
    for text, error, allowed in rows:
        bad = not error <= allowed
        missed += bad
        lines.append(f"{text:<50} {error:10.3g} {allowed:10.3g}" + ("  MISSED" if bad else ""))
    lines.append(f"full: largest error of any cell {100 * np.abs(spin.errors).max():.2g} % of the wall's velocity")
    if shape:
        settling = np.ptp(shape.curvature_error[-4:])
        lines.append(f"the surface rises by {1e3 * shape.rise:.2f} mm from axis to wall; its factor still changed by "
                     f"{100 * settling:.2g} % in the last {shape.time[-1] - shape.time[-4]:.2g} s; largest deviation "
                     f"of a column {1e3 * np.abs(shape.height[-1] - shape.exact).max():.3f} mm")
    print("\n".join(lines))
    out.write_text("\n".join(lines) + "\n")
    return missed


def plot(spin, shape, out):
    figure, axes = plt.subplots(1, 3, figsize=(15, 4.6), constrained_layout=True)
    time = np.linspace(0, spin.time[-1], 200)
    axes[0].plot(time, 1 - np.exp(-FULL["drag"] * time), "k-", lw=0.8, label="1 − exp(−βt/(ερ))")
    axes[0].plot(spin.time, spin.share, "o", ms=4, mfc="none", label="angular momentum over the bed's")
    axes[0].set(title="Full cylinder", xlabel="time, s")
    order = np.argsort(shape.r2)
    radius = 1e3 * np.sqrt(shape.r2)
    axes[1].plot(radius, 1e3 * shape.height[-1], "o", ms=3, mfc="none", label="columns of cells")
    axes[1].plot(radius[order], 1e3 * shape.exact[order], "k-", lw=0.8, label="z₀ + Ω²r²/(2g)")
    axes[1].set(title="Half full, settled", xlabel="radius, mm", ylabel="surface, mm")
    axes[2].semilogy(shape.time, 100 * shape.rms_error, "o-", ms=3, label="heights, rms over the rise")
    axes[2].semilogy(shape.time, 100 * np.abs(shape.curvature_error), "s-", ms=3, label="factor of r²")
    axes[2].semilogy(spin.time[1:], 100 * spin.rms_error[1:], "^-", ms=3, label="full: velocities over the wall's, rms")
    axes[2].axhline(100 * SHAPE_TOLERANCE, color="k", ls="--", lw=0.8, label="allowed, half full settled")
    axes[2].axhline(100 * SPIN_TOLERANCE, color="k", ls=":", lw=0.8, label="allowed, full")
    axes[2].set(title="Errors, %", xlabel="time, s")
    for axis in axes:
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    figure.savefig(out, dpi=110)


def main():
    options = case_options(__doc__, quick="the full cylinder alone")
    here = Path(__file__).parent.resolve()
    work = fresh_runs(here)
    settings = {"full": FULL} if options.quick else {"half": HALF, "full": FULL}
    run_jobs(lambda item: run(item[1], work / item[0], here), settings.items(), options.jobs)
    spin = spin_up(work / "full")
    shape = None if options.quick else surface(work / "half")
    missed = report(spin, shape, here / "carried_along.txt")
    if shape:
        plot(spin, shape, here / "carried_along.png")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
