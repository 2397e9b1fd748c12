#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A rotating drum of glass beads, compared with the velocities of a tracer that was tracked in it.

Judged are the velocity below 60 mm, the angle of the surface and the depth of zero velocity. The surface layer is
reported, with the same profile as a tracer of inexact position would show it. Complete runs are kept. Exit code 1 if
the first run misses a limit."""
import argparse
import csv
import sys
from dataclasses import dataclass
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from scipy.ndimage import gaussian_filter1d

from millfoam.files.mill import read_mill
from millfoam.files.solids_file import SolidsMap, mean_map, open_hdf5, read_windows
from millfoam.readings.charge import shell_following
from millfoam.readings.free_surface import at_points
from millfoam.readings.means import with_error
from millfoam.run import run as run_program
from millfoam.run import run_jobs, set_options, write_table

matplotlib.use("Agg")

HERE = Path(__file__).parent.resolve()
DEEP = 0.060  # m below the axis, from which on the velocity is judged
ANGLE, ZERO = 27.0, 0.059  # measured: of the surface, degrees; depth of zero velocity, m
MEASURED_SURFACE = 0.030  # m below the axis
MOST_VELOCITY, MOST_ANGLE, MOST_ZERO = 0.01, 1.0, 0.001  # m/s (Found.excess), degrees, m
EDGE = 0.3  # solidity at the surface
WIDTH = 0.006  # m to each side of the normal, over which the profile is averaged
FAINT = 0.02  # solidity up to which a profile has no velocity
TRACER = (0.003, 0.005)  # m, standard deviations of a tracer's position
STEP = 0.0005  # m between a profile's points
WIDTHS = (14, 14, 14, 17, 16, 16)  # of the table's columns
THIN = ("geometry.slice=0.009", "dem.duration=5")
# Friction and rolling friction of two beads, and of a bead and the wall
SCAN = {"r03w2": (0.3, 0.03, 0.35, 0.2), "r05w2": (0.3, 0.05, 0.35, 0.2), "base": (0.3, 0.1, 0.35, 0.1),
        "r05": (0.3, 0.05, 0.35, 0.05), "r02": (0.3, 0.02, 0.35, 0.02), "f15": (0.15, 0.1, 0.35, 0.1),
        "f5r02": (0.5, 0.02, 0.5, 0.02), "f5r03w2": (0.5, 0.03, 0.5, 0.2), "f5r02w2": (0.5, 0.02, 0.5, 0.2)}
VARIANTS = {"fit": {"slice": ()},
            "scan": {name: (*THIN, f"materials.ball_ball.friction={f}", f"materials.ball_ball.rolling_friction={r}",
                            f"materials.ball_wall.friction={fw}", f"materials.ball_wall.rolling_friction={rw}")
                     for name, (f, r, fw, rw) in SCAN.items()},
            # Its dumps would take some 15 GB
            "full": {"full": ("geometry.slice=~", "resolution.layers=2", "averages.live=yes", "dem.dumps=no"),
                     "slice": ()},
            "ends": {"with_ends": ("geometry.slice=~", "geometry.length=0.024", "charge.start_length=0.023",
                                   "charge.classes=[{diameter: 0.003, mass: 0.532673}]", "resolution.layers=2",
                                   "dem.duration=4.5"),
                     "slice": ()},
            "quick": {"thin": THIN}}


@dataclass
class Profile:
    """Charge on the surface's normal through the axis.

    angle: of the surface, degrees; surface: its depth below the axis, m; depth [n] (m); solidity [n]; flux [n]: balls'
    volume flux parallel to the surface, positive down the slope, m/s."""
    angle: float
    surface: float
    depth: np.ndarray
    solidity: np.ndarray
    flux: np.ndarray

    def velocity(self, blur=0.0):
        """Velocity [n] (m/s), NaN where balls are rare; that of a tracer whose positions have the standard deviation
        `blur` (m): it counts a ball at another depth, and more often where there are more balls."""
        solidity, flux = (gaussian_filter1d(values, blur / STEP, mode="nearest") if blur else values
                          for values in (self.solidity, self.flux))
        return np.where(solidity > FAINT, flux / np.maximum(solidity, FAINT), np.nan)

    def at(self, depth, blur=0.0):
        """The same at other depths (m), NaN above the balls."""
        return np.interp(depth, self.depth, self.velocity(blur))

    @property
    def zero(self):
        """Depth at which the velocity changes its sign, m; NaN if it does not. The deepest one: balls may bounce."""
        speed = self.velocity()
        turns = np.flatnonzero((speed[:-1] > 0) & (speed[1:] <= 0))
        if not len(turns):
            return np.nan
        last = turns[-1]
        return self.depth[last] + STEP * speed[last] / (speed[last] - speed[last + 1])


def directions(angle):
    """Unit vectors down the slope and into the charge, of a mill that turns clockwise: the surface falls to the right.
    """
    angle = np.radians(angle)
    return np.array([np.cos(angle), -np.sin(angle)]), np.array([-np.sin(angle), -np.cos(angle)])


def on_lines(charge, values, points):
    return at_points(charge, values, points.reshape(-1, 2)).reshape(points.shape[:-1])


def read_profile(charge: SolidsMap, radius: float) -> Profile:
    """Profile of a map. The surface is the straight line through the first places with the solidity EDGE, over the
    middle half of the chord; its normal is found by iteration."""
    angle, surface = ANGLE, MEASURED_SURFACE
    balls, flux = charge.balls(), charge.flux()
    depth = np.arange(0, 0.8 * radius, STEP)
    for _ in range(8):
        slope, inward = directions(angle)
        along = np.linspace(-0.5, 0.5, 61) * np.sqrt(radius**2 - surface**2)
        phi = on_lines(charge, balls, along[:, None, None] * slope + depth[:, None] * inward)
        first = np.argmax(phi >= EDGE, axis=1)
        if not np.all(first > 0):
            raise RuntimeError(f"no surface of solidity {EDGE} on every normal")
        rows = np.arange(len(along))
        below, above = phi[rows, first], phi[rows, first - 1]
        place = depth[first] - STEP * (below - EDGE) / (below - above)
        tilt, surface = np.polyfit(along, place, 1)
        angle += np.degrees(np.arctan(tilt))
    slope, inward = directions(angle)
    depth = np.arange(0.01, radius, STEP)
    points = np.linspace(-WIDTH, WIDTH, 9)[:, None, None] * slope + depth[:, None] * inward
    downhill = flux[..., :2] @ slope
    return Profile(angle, surface, depth, on_lines(charge, balls, points).mean(axis=0),
                   on_lines(charge, downhill, points).mean(axis=0))


def read_measured():
    """Depth (m) and velocity (m/s) [n], from the surface down."""
    with open(HERE / "measured.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return (1e-3 * np.array([float(row["depth_mm"]) for row in rows]),
            np.array([float(row["velocity_m_s"]) for row in rows]))


def rms_deep(profile, measured):
    """Root mean square of the difference below DEEP, m/s."""
    depth, speed = (values[measured[0] > DEEP] for values in measured)
    return np.sqrt(np.mean((profile.at(depth) - speed) ** 2))


def least_rms(measured, omega):
    """The same of the best charge that is nowhere faster than the drum: equal to the measurement where that is slower
    than the drum, as fast as the drum elsewhere."""
    depth, speed = (values[measured[0] > DEEP] for values in measured)
    return np.sqrt(np.mean(np.maximum(-speed - abs(omega) * depth, 0) ** 2))


def transport(depth, speed, solidity, zero):
    """Balls' volume per length and time down the slope above `zero` and up below it, m2/s; points [n] every STEP."""
    flux = speed * solidity
    parts = [(depth <= zero) & (flux > 0), (depth > zero) & (flux < 0)]
    return [STEP * abs(flux[part].sum()) for part in parts]


def measured_transport(measured, profile, radius):
    """`transport` of the measured velocities with the solidity of a run, which begins at its own surface."""
    depth = np.arange(MEASURED_SURFACE, radius, STEP)
    speed = np.interp(depth, *measured)
    solidity = np.interp(depth - MEASURED_SURFACE + profile.surface, profile.depth, profile.solidity)
    return transport(depth, speed, solidity, ZERO)


def windows_of_middle(path):
    """Windows of the middle third of a drum's length as SolidsMap; of a slice, read_windows."""
    maps = read_windows(path)
    with open_hdf5(path) as file:
        if file["grid"].attrs["periodic"][2]:
            return maps
        layers = file["solidity"].shape[1]
        middle = slice(layers // 3, layers - layers // 3)
        for number, one in enumerate(maps):
            room = file["grid/insideFraction"][number, middle]
            balls = room * file["solidity"][number, middle]
            flux = (balls[..., None] * file["velocity"][number, middle]).mean(axis=0)
            one.inside, balls = room.mean(axis=0), balls.mean(axis=0)
            one.solidity = np.divide(balls, one.inside, out=np.zeros_like(balls), where=one.inside > 0)
            one.velocity = np.divide(flux, balls[..., None], out=np.full_like(flux, np.nan),
                                     where=balls[..., None] > 0)
    return maps


@dataclass
class Found:
    """A run's readings: friction [4] as in SCAN; value and error of angle (degrees), surface (m), zero (m), rms below
    DEEP (m/s), speed at the surface (m/s), speed at the shell over its own; least: least_rms, m/s; profile and map of
    the mean."""
    name: str
    friction: tuple
    value: np.ndarray
    error: np.ndarray
    least: float
    profile: Profile
    charge: SolidsMap
    radius: float
    omega: float

    @property
    def excess(self):
        """rms beyond `least`, m/s: the root of the difference of their squares.

        The measured tracer is faster than the drum. So a charge that the shell drags cannot have a smaller rms than
        `least`, and its excess is at least its rms difference from the best such charge."""
        return float(np.sqrt(max(self.value[3]**2 - self.least**2, 0.0)))

    @property
    def missed(self):
        """Names of the limits that the run misses."""
        angle, _, zero = self.value[:3]
        return [name for name, hit in (("velocity", self.excess <= MOST_VELOCITY),
                                       ("angle", abs(angle - ANGLE) <= MOST_ANGLE),
                                       ("zero", abs(zero - ZERO) <= MOST_ZERO)) if not hit]


def read_run(name, folder, measured, maps=None):
    mill = read_mill(folder)
    maps = windows_of_middle(folder / "solids.h5") if maps is None else maps
    contact = [mill.asked("materials", pair, key) for pair in ("ball_ball", "ball_wall")
               for key in ("friction", "rolling_friction")]

    def reading(charge):
        profile = read_profile(charge, mill.radius)
        return [profile.angle, profile.surface, profile.zero, rms_deep(profile, measured), profile.at(profile.surface),
                shell_following(charge, mill.radius, mill.omega)]

    found = with_error(reading, maps)
    charge = mean_map(maps)
    return Found(name, tuple(contact), found.value, found.error, least_rms(measured, mill.omega),
                 read_profile(charge, mill.radius), charge, mill.radius, mill.omega)


def perform(name, changes, runs):
    """Folder of a run of mill.yaml with changes; a complete run is kept, an interrupted one is resumed."""
    case = runs / name
    case.mkdir(parents=True, exist_ok=True)
    settings = (HERE / "mill.yaml", "--case", ".", *set_options(changes))
    run_program(case, "millMesh", *settings, "--walls")
    run_program(case, "millDem", *settings, "--resume", "--or-anew")
    if "averages.live=yes" not in changes:
        run_program(case, "millAverage", *settings)
    return case


def report(runs, measured, out):
    """Writes and prints the tables."""
    heads = ("angle", "surface mm", "zero mm", "rms m/s", "u surface m/s", "shell")
    lines = [f"{'run':<12}{'friction: bead-bead, rolling; wall, rolling':>44}" +
             "".join(f"{head:>{width}}" for head, width in zip(heads, WIDTHS)) + "  missed"]
    scales, forms = (1, 1e3, 1e3, 1, 1, 1), (".2f", ".1f", ".2f", ".4f", ".3f", ".3f")
    for one in runs:
        friction = "{:g}, {:g}; {:g}, {:g}".format(*one.friction)
        cells = [f"{scale * value:{form}} ± {scale * error:{form}}"
                 for value, error, scale, form in zip(one.value, one.error, scales, forms)]
        lines.append(f"{one.name:<12}{friction:>44}" + "".join(
            f"{cell:>{width}}" for cell, width in zip(cells, WIDTHS)) + "  " + (", ".join(one.missed) or "nothing"))
    first = runs[0]
    lines += [f"limits: angle {ANGLE:g} ± {MOST_ANGLE:g} degrees, zero {1e3 * ZERO:g} ± {1e3 * MOST_ZERO:g} mm, rms "
              f"below {1e3 * DEEP:g} mm {MOST_VELOCITY:g} m/s beyond the least; ±: standard error over the windows",
              f"least rms of a charge that is nowhere faster than the drum: {first.least:.4f} m/s; beyond it, root "
              "of the difference of squares: " + ", ".join(f"{one.name} {one.excess:.4f}" for one in runs) + " m/s",
              "", f"{'run':<12}{'u m/s at the surface: balls':>28}" +
              "".join(f"{f'tracer {1e3 * blur:g} mm':>14}" for blur in TRACER) +
              f"{'at 39 mm: balls':>17}" + "".join(f"{f'tracer {1e3 * blur:g} mm':>14}" for blur in TRACER) +
              f"{'down m2/s':>12}{'up m2/s':>10}"]
    blurs = (0.0, *TRACER)
    for one in runs:
        speeds = [f"{one.profile.at(depth, blur):.3f}" for depth in (one.profile.surface, 0.039) for blur in blurs]
        down, up = transport(one.profile.depth, np.nan_to_num(one.profile.velocity()), one.profile.solidity,
                             one.profile.zero)
        lines.append(f"{one.name:<12}" + "".join(f"{speed:>{width}}" for speed, width in zip(
            speeds, (28, 14, 14, 17, 14, 14))) + f"{down:12.5f}{up:10.5f}")
    down, up = measured_transport(measured, first.profile, first.radius)
    lines += [f"{'measured':<12}{measured[1].max():>28.3f}{'':>28}{np.interp(0.039, *measured):>17.3f}{'':>28}"
              f"{down:12.5f}{up:10.5f}",
              "down, up: volume of balls per length and time above and below the depth of zero velocity; measured: "
              f"with the solidity of {first.name}"]
    write_table(lines, out)


def plot(runs, measured, out):
    figure, (left, right) = plt.subplots(1, 2, figsize=(14, 6.2), constrained_layout=True)
    first = runs[0]
    for one in runs:
        line, = left.plot(one.profile.velocity(), 1e3 * one.profile.depth, lw=2 if one is first else 1,
                          label="{}: {:g}, {:g}; {:g}, {:g}".format(one.name, *one.friction))
        if one is first:
            for blur, style in zip(TRACER, ("--", ":")):
                left.plot(one.profile.velocity(blur), 1e3 * one.profile.depth, style, color=line.get_color(),
                          label=f"{one.name}, tracer of ±{1e3 * blur:g} mm")
    depth = np.linspace(0.055, first.radius, 2)
    left.plot(-abs(first.omega) * depth, 1e3 * depth, "k-", lw=0.8, label="the drum's rotation")
    left.plot(measured[1], 1e3 * measured[0], "ko", ms=4, mfc="none", label="measured")
    left.axhline(1e3 * DEEP, color="k", ls="-.", lw=0.7)
    left.set(xlabel="velocity down the slope, m/s", ylabel="depth below the axis, mm", xlim=(-0.2, 0.8),
             ylim=(1e3 * first.radius, 20), title="on the surface's normal; judged below the line")
    left.grid(alpha=0.3)
    left.legend(fontsize=8)

    charge, (x, y) = first.charge, first.charge.centres()
    picture = right.pcolormesh(1e3 * charge.x, 1e3 * charge.y, charge.solidity, cmap="YlOrBr", vmin=0, vmax=0.65)
    figure.colorbar(picture, ax=right, label="solidity")
    some = (slice(1, None, 3),) * 2
    velocity = np.where(charge.balls()[..., None] > 0.1, charge.velocity, np.nan)[some]
    right.quiver(1e3 * x[some[0]], 1e3 * y[some[1]], velocity[..., 0], velocity[..., 1], scale=6, width=0.002)
    slope, inward = directions(first.profile.angle)
    ends = first.profile.surface * inward + np.array([-0.5, 0.5])[:, None] * slope * np.sqrt(
        first.radius**2 - first.profile.surface**2)
    right.plot(*1e3 * ends.T, "b-", label=f"surface, {first.profile.angle:.1f} degrees")
    right.plot(*1e3 * np.outer((0, first.radius), inward).T, "b--", lw=1, label="its normal")
    turn = np.linspace(0, 2 * np.pi, 200)
    right.plot(1e3 * first.radius * np.cos(turn), 1e3 * first.radius * np.sin(turn), "k-", lw=1)
    right.set(aspect="equal", xlabel="mm", ylabel="mm", title=f"{first.name}: solidity and velocity")
    right.legend(fontsize=8, loc="upper right")
    figure.savefig(out, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("variant", nargs="?", choices=[name for name in VARIANTS if name != "quick"], default="fit",
                        help="fit: the slice of mill.yaml; scan: frictions; ends: a drum as thick as the slice, with "
                             "ends, and the slice; full: the whole length and the slice")
    parser.add_argument("--quick", action="store_true", help="the friction of mill.yaml in a slice of three beads")
    parser.add_argument("--read", nargs="+", type=Path, metavar="RUN", help="read these complete runs instead")
    parser.add_argument("--jobs", type=int, default=2, help="runs at a time")
    options = parser.parse_args()
    if options.quick and options.variant != "fit" or options.read and (options.quick or options.variant != "fit"):
        parser.error("--quick and --read replace the runs of a variant; expected only one of the three")
    measured = read_measured()
    if options.read:
        folders = {folder.resolve().name: folder.resolve() for folder in options.read}
    else:
        wanted = VARIANTS["quick" if options.quick else options.variant]
        folders = dict(zip(wanted, run_jobs(lambda name: perform(name, wanted[name], HERE / "runs"), wanted,
                                            options.jobs)))
    runs = []
    for name, folder in folders.items():
        runs.append(read_run(name, folder, measured))
        if not read_mill(folder).is_slice:
            runs.append(read_run(f"{name}, ends too", folder, measured, read_windows(folder / "solids.h5")))
    report(runs, measured, HERE / "rotating_drum.txt")
    plot(runs, measured, HERE / "rotating_drum.png")
    return 1 if runs[0].missed else 0


if __name__ == "__main__":
    sys.exit(main())
