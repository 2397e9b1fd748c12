# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of the report that are about time, the axis and the run; for maps see millfoam.report.maps."""
from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..files.mill_case import MillCase
from ..plots import mill_plots
from ..readings.axial import AxialProfile, slice_thickness
from ..readings.means import time_steps

Curve = tuple[str, np.ndarray, np.ndarray]  # label, x, y
# Okabe & Ito's colours, which colour-blind readers can distinguish
BLUE, ORANGE, GREEN, RED, SKY, GREY = "#0072B2", "#E69F00", "#009E73", "#D55E00", "#56B4E9", "#6b7580"
COLOURS = (BLUE, RED, GREEN, ORANGE, "#CC79A7", SKY, "#000000")
LINES = ("-", "--", "-.", ":")
# Figures are as wide as a card, so that their text is readable on a phone
plt.rcParams.update({"font.size": 10.5, "legend.fontsize": 9, "legend.frameon": False})


def axes_of(rows: int = 1, *, width: float = 5.4, height: float = 2.5) -> tuple[Figure, np.ndarray]:
    """A figure with panels below each other in the report's style."""
    figure, axes = plt.subplots(rows, 1, figsize=(width, height * rows if rows > 1 else 3.4), sharex=True,
                                constrained_layout=True, squeeze=False)
    for axis in axes[:, 0]:
        axis.grid(alpha=0.25)
        axis.spines[["top", "right"]].set_visible(False)
    return figure, axes[:, 0]


def running_mean(times: np.ndarray, values: np.ndarray, width: float) -> tuple[np.ndarray, np.ndarray]:
    """Times (s) from a time `width` (s) after the first one on, and the mean over `width` before each of them; steps
    count by their length. Both are empty in a shorter series."""
    steps = time_steps(times)
    total = np.concatenate([[0], np.cumsum(values * steps)])
    clock = np.concatenate([[times[0] - steps[0]], times])
    late = times >= times[0] + width * (1 - 1e-9)  # times are rounded
    return times[late], (total[1:][late] - np.interp(times[late] - width, clock, total)) / width


def quarter_turns(case: MillCase, name: str) -> tuple[np.ndarray, np.ndarray]:
    """Times (s) of slurryBalance, and a column's mean over the quarter turn before each. They begin where the mean is
    free of the first steps."""
    columns, width = case.balance, case.turn / 4
    times, mean = running_mean(columns["Time"], columns[name], width)
    free = times >= columns["Time"][0] + 1.05 * width
    return times[free], mean[free]


def late_limits(times: np.ndarray, values: np.ndarray) -> tuple[float, float]:
    """Limits of an axis that shows the second half of the time and zero. On either side they reach further by half of
    that span, as far as there are values. The start-up may lie beyond. Without values they are 0 and 1."""
    if len(times) == 0:
        return 0.0, 1.0
    late = values[times >= times[0] / 2 + times[-1] / 2]
    low, high = min(0, late.min()), max(0, late.max())
    more = (high - low) / 2
    return 1.1 * min(low, max(low - more, values.min())), 1.1 * max(high, min(high + more, values.max())) or 1e-12


def energy(case: MillCase, begin: float) -> Figure:
    """Power and energies of the balls against time. begin: DEM time (s) from which their power is averaged; NaN if it
    is not known."""
    figure, (top, bottom) = axes_of(2)
    time, columns = case.energy["time_s"], case.energy
    top.plot(time, columns["power_W"], color=SKY, lw=0.5, alpha=0.7, label="record")
    top.plot(*running_mean(time, columns["power_W"], case.turn / 4), color=BLUE, label="mean over a quarter turn")
    late = columns["power_W"][len(time) // 4:]
    top.set_ylim(min(0, np.percentile(late, 0.5)), 1.3 * np.percentile(late, 99.5))
    top.set_ylabel("power, W")
    top.legend(loc="lower right")
    bottom.plot(time, columns["kinetic_J"], color=RED, label="kinetic")
    bottom.plot(time, columns["potential_J"] - columns["potential_J"][0], color=GREEN,
                label="potential, from its first value")
    bottom.set(ylabel="energy, J", xlabel="time since the mill began to turn, s")
    bottom.legend(loc="best")
    if np.isfinite(begin):
        top.axvline(begin, color=GREY, ls="--", lw=1)
    if case.results.get("steady"):
        bottom.axvline(case.result("steady_from_s"), color=GREY, ls="--", lw=1)
    return figure


def overlaps(case: MillCase) -> Figure:
    """Histogram of the contacts' overlaps."""
    figure, (axis,) = axes_of()
    overlap, balls, walls = (case.overlaps[key] for key in ("overlap_m", "ball_contacts", "wall_contacts"))
    diameter = case.result("smallest_diameter_m")
    for counts, colour, label in ((balls, BLUE, "ball on ball"), (walls, ORANGE, "ball on wall")):
        axis.step(100 * overlap / diameter, counts / max(counts.sum(), 1), where="mid", color=colour, label=label)
    largest = 100 * overlap[np.flatnonzero(balls + walls)[-1:]].max(initial=0) / diameter
    axis.set(yscale="log", xlabel="overlap, % of the smallest diameter", ylabel="share of the contacts",
             xlim=(0, 1.1 * largest or None))
    axis.legend()
    return figure


def holdup(case: MillCase) -> Figure:
    """Hold-up, feed and discharge of the slurry against time."""
    columns, is_open = case.balance, case.is_open and not case.is_slice
    figure, axes = axes_of(2 if is_open else 1)
    axes[0].plot(columns["Time"], 1e6 * columns["holdUp"], color=BLUE)
    axes[0].set_ylabel("hold-up, ml")
    if not is_open:  # in a closed mill, an automatic axis would show round-off
        axes[0].set_ylim(0, 1.2e6 * columns["holdUp"].max())
    else:
        for key, colour in (("feed", GREEN), ("discharge", RED)):
            times, mean = quarter_turns(case, key)
            axes[1].plot(times, 1e6 * mean, color=colour, label=key)
        axes[1].set_ylabel("ml/s, mean over a\nquarter turn")
        axes[1].set_ylim(bottom=0)
        axes[1].legend()
    axes[-1].set_xlabel("flow time, s")
    return figure


def centre_and_power(case: MillCase) -> Figure:
    """Centre of the slurry and the power given to it, against time."""
    columns = case.balance
    figure, (top, bottom) = axes_of(2)
    top.plot(columns["Time"], -1e3 * np.sign(case.omega) * columns["x"], color=BLUE, label="x (below 0: rising side)")
    top.plot(columns["Time"], 1e3 * columns["y"], color=RED, label="y")
    top.set_ylabel("centre of the slurry, mm")
    top.legend()
    times, power = quarter_turns(case, "power")
    bottom.plot(times, power, color=BLUE)
    bottom.set_ylim(late_limits(times, power))
    bottom.set(ylabel="power for the slurry, W\n(mean over a quarter turn)", xlabel="flow time, s")
    return figure


def reynolds(case: MillCase) -> Figure:
    """Particle Reynolds numbers in slurry against time."""
    columns = case.balance
    figure, (axis,) = axes_of()
    axis.plot(columns["Time"], columns["Re_mean"], color=BLUE, label="mean over the balls")
    axis.plot(columns["Time"], columns["Re_95"], color=RED, label="95 % of the balls below")
    axis.set(xlabel="flow time, s", ylabel="particle Reynolds number",
             ylim=(0, 1.1 * max(np.percentile(columns["Re_95"], 99.5), columns["Re_mean"].max())))
    axis.legend()
    return figure


def holdup_along(profile: AxialProfile, z: np.ndarray, model: np.ndarray) -> Figure:
    """Hold-up per length along the axis: of an AxialProfile, and of a model (m2) at z (m)."""
    figure, (axis,) = axes_of()
    axis.plot(1e3 * profile.z, 1e3 * profile.holdup / slice_thickness(profile.z), "o-", ms=4, color=BLUE,
              label="simulation")
    axis.plot(1e3 * z, 1e3 * model, color=RED, label="Moys")
    axis.set(xlabel="z from the feed end, mm", ylabel="hold-up, ml per mm", ylim=(0, None))
    axis.legend()
    return figure


def axial(profile: AxialProfile, fits: Sequence[Curve], along: str) -> Figure:
    """Height of the slurry's centre of mass, hold-up and head along the axis; along: the axis' label; fits: curves
    (label, z, height)."""
    figure, (height, held, head) = axes_of(3, height=2.3)
    z = 1e3 * profile.z
    height.fill_between(z, 1e3 * (profile.height - profile.height_spread),
                        1e3 * (profile.height + profile.height_spread),
                        alpha=0.2, color=BLUE, label="standard deviation over time")
    height.plot(z, 1e3 * profile.height, "o", ms=4, color=BLUE, label="mean over time")
    for (label, at, curve), colour in zip(fits, (RED, GREEN)):
        height.plot(1e3 * at, 1e3 * curve, color=colour, lw=1.2, label=label)
    height.set_ylabel("height of the\ncentre, mm")
    height.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=1
                  if any("end)" in label for label, _, _ in fits) else 2)
    held.plot(z, 1e3 * profile.holdup / slice_thickness(profile.z), "o-", ms=3, color=BLUE)
    held.set_ylabel("hold-up, ml per mm")
    head.plot(z, profile.pressure, "o-", ms=3, color=BLUE)
    head.set(ylabel="p_rgh, Pa", xlabel=along)
    return figure


def axial_against_time(places: np.ndarray, times: np.ndarray, values: np.ndarray, along: str) -> Figure:
    """Height of the centre of mass over the axis and time; along: the axis' label."""
    figure, axis = plt.subplots(figsize=(5.4, 3.4), constrained_layout=True)
    lower, upper = np.percentile(1e3 * values[len(times) // 5:], (1, 99))
    image = axis.pcolormesh(times, 1e3 * places, 1e3 * values.T, cmap="cividis", shading="nearest", vmin=lower,
                            vmax=upper,
                            rasterized=True)
    figure.colorbar(image, ax=axis, label="height of the centre, mm")
    axis.set(xlabel="flow time, s", ylabel=along)
    return figure


def _legend_above(axis: Axes, labels: Sequence[str]) -> None:
    """A legend above the panel, where it hides no curve; short names are in two columns."""
    axis.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=2 if max(map(len, labels)) < 22 else 1)


def lines_against(curves: Sequence[Curve], xlabel: str, ylabel: str,
                  limits: tuple[float, float] | None = None) -> Figure:
    """Curves (label, x, y) of several cases in one panel; limits of y."""
    figure, (axis,) = axes_of()
    for number, (label, x, y) in enumerate(curves):
        axis.plot(x, y, color=COLOURS[number % len(COLOURS)], ls=LINES[number // len(COLOURS) % len(LINES)],
                  label=label, lw=1.3)
    axis.set(xlabel=xlabel, ylabel=ylabel, ylim=limits)
    _legend_above(axis, [label for label, _, _ in curves])
    return figure


def surfaces(lines: Sequence[tuple[str, np.ndarray]], radius: float, omega: float) -> Figure:
    """Free surfaces (label, [n, 2] m) in the circle of a mill that turns at `omega` (rad/s)."""
    figure, axis = plt.subplots(figsize=(5.2, 5), constrained_layout=True)
    angle = np.linspace(0, 2 * np.pi, 361)
    axis.plot(1e3 * radius * np.cos(angle), 1e3 * radius * np.sin(angle), color="0.15", lw=1)
    for number, (label, points) in enumerate(lines):
        axis.plot(*(1e3 * np.asarray(points).T), color=COLOURS[number % len(COLOURS)], label=label, lw=1.8,
                  ls=LINES[(number + 2 * (number // len(COLOURS))) % len(LINES)])
    mill_plots.draw_sense(axis, radius, omega)
    _legend_above(axis, [label for label, _ in lines])
    return figure
