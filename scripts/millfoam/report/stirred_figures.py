# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of the report of a stirred mill: torques on walls and slurry against time, spectra of the contacts by
partner."""
from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from ..files.stirred_case import StirredCase
from ..readings.partner_spectra import PartnerSpectra
from ..readings.stirred_power import averaged_span
from .figures import BLUE, COLOURS, GREY, ORANGE, Curve, axes_of, lines_against, quarter_turns, running_mean


def torques(case: StirredCase) -> Figure:
    """Torque of the balls on each part against time, mean over a turn before each time."""
    figure, (axis,) = axes_of()
    times = case.torques["time_s"]
    for part, colour in zip(case.parts, COLOURS):
        values = case.torques[f"{part}_Nm"]
        axis.plot(times, values, color=colour, lw=0.4, alpha=0.4)
        axis.plot(*running_mean(times, values, case.turn), color=colour, label=part)
    axis.axvline(averaged_span(case)[0], color=GREY, ls="--", lw=1)
    axis.set(xlabel="time since the mill began to turn, s", ylabel="torque of the balls about +z, N m")
    axis.legend(loc="center right")
    return figure


def slurry_torques(case: StirredCase) -> Figure:
    """Torque of each wall and of the balls on the slurry against time, means over a quarter turn before each time."""
    figure, (axis,) = axes_of()
    parts = [name for name in case.balance if name.startswith("torque_") and name != "torque_all"]
    for name, colour in zip(parts, COLOURS):
        times, mean = quarter_turns(case, name)
        axis.plot(times, 1e3 * mean, color=colour, label=name.removeprefix("torque_"))
    axis.axvline(case.begin, color=GREY, ls="--", lw=1)
    axis.set(xlabel="flow time, s", ylabel="torque on the slurry about +z, mN m")
    axis.legend(loc="center right")
    return figure


def spectra(found: PartnerSpectra, turn: float) -> Figure:
    """Collisions per turn of `turn` s, dissipated power by partner, and its normal and tangential parts, by energy."""
    figure, (top, middle, bottom) = axes_of(3, height=2.5)
    shown = [k for k in range(len(found.partners)) if found.collisions[k].any()]
    for k in shown:
        name, colour = found.partners[k], COLOURS[k % len(COLOURS)]
        label = "ball on ball" if k == 0 else f"ball on {name}"
        top.step(*steps(found, turn * found.collisions[k]), where="mid", color=colour, label=label, lw=1.3)
        middle.step(*steps(found, found.total[k]), where="mid", color=colour, lw=1.3)
    for name, values, colour in (("normal", found.normal, BLUE), ("tangential", found.tangential, ORANGE),
                                 ("total", found.total, "k")):
        bottom.step(*steps(found, values.sum(axis=0)), where="mid", color=colour, label=name, lw=1.3)
    peak = found.peak()
    if peak:
        bottom.axvspan(peak.low, peak.high, color=GREY, alpha=0.3, lw=0)
    for axis, values in ((top, turn * found.collisions), (middle, found.total), (bottom, found.total)):
        axis.set(xscale="log", yscale="log")
        # Single touches of very low energy would stretch the axis
        axis.set_ylim(bottom=max(axis.get_ylim()[0], 1e-6 * values.max(initial=0)))
    top.set_ylabel("collisions per turn\nand bin")
    middle.set_ylabel("dissipated power,\nW per bin")
    bottom.set(ylabel="dissipated power of all,\nW per bin", xlabel="energy, J (5 bins per decade)")
    top.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=2)
    bottom.legend(loc="upper left")
    return figure


def steps(found: PartnerSpectra, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Middles of the bins between the edges (J), and their values, NaN where there is nothing."""
    inner = values[1:-1]
    return np.sqrt(found.edges[1:] * found.edges[:-1]), np.where(inner > 0, inner, np.nan)


def compared_spectra(curves: Sequence[tuple[str, PartnerSpectra]]) -> Figure:
    """Dissipated power of all contacts of several cases by energy."""
    lines: list[Curve] = [(name, *steps(found, found.total.sum(axis=0))) for name, found in curves]
    figure = lines_against(lines, "energy that a collision dissipates, J", "dissipated power, W per bin")
    largest = max(float(np.nanmax(values)) for _, _, values in lines)
    figure.axes[0].set(xscale="log", yscale="log", ylim=(1e-5 * largest, 3 * largest))
    return figure
