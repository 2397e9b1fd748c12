# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of the study's flows: profiles along the axis, velocity along the axis on the cross-section, hold-up against
time."""
from collections.abc import Sequence
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from millfoam.plots.mill_plots import draw_outline
from millfoam.readings.slurry_on_maps import axial_velocity

from flow_numbers import Flow
from runs import is_published

FASTEST = 40  # of the maps' colours, mm/s
COLUMNS = 4  # of maps in a row, at most
SOLIDS_COLOURS = {20: "#0072B2", 30: "#009E73", 40: "#D55E00"}
LAW_LINES = {None: "-", "Beetstra": "-", "ErgunWenYu": "--"}


def profiles(flows: Sequence[Flow]) -> Figure:
    """Height of the slurry's centre of mass along the axis: a panel for each speed without and with balls, and two for
    what changes the flow with 20 % slurry at 75 %, which is black there; panels without a flow, or with that one
    alone, are left out."""
    def of(speed: int, balls: bool) -> list[Flow]:
        return [one for one in flows
                if is_published(one.run) and one.run.speed == speed and bool(one.run.law) == balls]
    groups = [(f"{speed} % of critical, {words}", of(speed, balls), True)
              for balls, words in ((False, "without balls"), (True, "with balls")) for speed in (60, 75)]
    groups.append(("75 %, 20 % slurry, without balls: other layers and lifters", [
        one for one in flows if one.run.law is None and (not is_published(one.run) or one.run.name == "fluid_75_20")],
        False))
    groups.append(("75 %, 20 % slurry, with balls: other runs", [
        one for one in flows if one.run.law and (not is_published(one.run) or one.run.name == "Beetstra_75_20")],
        False))
    groups = [(title, group, published) for title, group, published in groups
              if group and (published or any(not is_published(one.run) for one in group))]
    rows = -(-len(groups) // 2)
    figure, axes = plt.subplots(rows, 2, figsize=(12, 4 * rows), layout="constrained", squeeze=False)
    for axis in axes.flat[len(groups):]:
        axis.set_visible(False)
    for axis, (title, group, all_published) in zip(axes.flat, groups):
        for one in group:
            z, heights = 1e3 * one.slices.z, 1e3 * one.slices.profile()
            style = {"color": "black"} if is_published(one.run) else {}
            if all_published:
                style = {"color": SOLIDS_COLOURS[one.run.solids], "ls": LAW_LINES[one.run.law]}
            line, = axis.plot(z, heights, marker="o", ms=3, label=one.run.name, **style)
            spread = 1e3 * one.slices.height.std(axis=0)
            axis.fill_between(z, heights - spread, heights + spread, color=line.get_color(), alpha=0.12, lw=0)
            along = np.linspace(*one.chamber.z[[0, -1]], 200)
            axis.plot(1e3 * along, 1e3 * one.chamber.humps.fitted(along), color=line.get_color(), lw=0.8, alpha=0.6)
            axis.axvline(1e3 * one.case.length, color="0.6", lw=0.8)
        axis.set(title=title, xlabel="z from the feed end, mm", ylabel="height of the slurry's centre of mass, mm")
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    figure.suptitle("Points: slices of 10 mm; thin lines: Gaussians through those in front of the grates "
                    "(grey); shaded: standard deviation of the turns", fontsize=10)
    return figure


def axial_flow_maps(flows: Sequence[Flow]) -> Figure:
    """Velocity along the axis where slurry is more than half of the fluid, a panel for each flow."""
    columns = min(COLUMNS, len(flows))
    rows = -(-len(flows) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(3.4 * columns + 1, 3.5 * rows), squeeze=False,
                                layout="constrained")
    for axis in axes.flat:
        axis.set_axis_off()
    for axis, one in zip(axes.flat, flows):
        axis.set_axis_on()
        slurry = one.slurry
        image = axis.pcolormesh(1e3 * slurry.x, 1e3 * slurry.y, 1e3 * axial_velocity(slurry), cmap="RdBu_r",
                                vmin=-FASTEST, vmax=FASTEST)
        draw_outline(axis, one.case.outline, one.case.radius, one.case.omega)
        axis.set_aspect("equal")
        axis.set_title(one.run.name, fontsize=9)
    figure.colorbar(image, ax=axes, extend="both", shrink=min(1.0, 1.5 / rows), aspect=25,
                    label="velocity along the axis, mm/s\n(red: to the discharge)")
    return figure


def holdup(flows: Sequence[Flow]) -> Figure:
    """Slurry in the mill, and discharge over half a turn, against time."""
    figure, axes = plt.subplots(2, 1, figsize=(9, 8), sharex=True, layout="constrained")
    for number, one in enumerate(flows):
        columns, style = one.case.balance, {"color": plt.cm.turbo((number + 0.5) / len(flows)), "lw": 1.2,
                                            "ls": "-" if one.run.law else ":"}
        axes[0].plot(columns["Time"], 1e3 * columns["holdUp"], label=one.run.name, **style)
        times = np.arange(0, one.case.last, one.case.turn / 2)
        out = np.diff(np.interp(times, columns["Time"], columns["discharged"])) / np.diff(times)
        axes[1].plot((times[1:] + times[:-1]) / 2, 1e6 * out, **style)
    axes[0].set_ylabel("slurry in the mill, l")
    axes[1].set(xlabel="flow time, s", ylabel="discharge over half a turn, ml/s")
    for axis in axes:
        axis.grid(alpha=0.3)
    axes[0].legend(loc="upper left", bbox_to_anchor=(1.01, 1), fontsize=8)
    return figure


def draw_all(folder: Path, flows: dict[str, Flow]) -> None:
    """Writes all pictures of the Flows into a folder."""
    if not flows:
        return
    for name, draw in (("profiles", profiles), ("axial_flow", axial_flow_maps), ("holdup", holdup)):
        figure = draw(list(flows.values()))
        figure.savefig(folder / f"{name}.png", dpi=100)
        plt.close(figure)
