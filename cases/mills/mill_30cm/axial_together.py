#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""One picture of several runs of the 30 cm mill: height of the slurry's centre of mass and p_rgh along the axis out of
their pictures/axial.csv, and maps of their velocity along the axis where the slurry's share is over a half, averaged
from 2 s on (or over the second half of a run of 3 s or less)."""
import argparse
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

from millfoam.files.written_times import MillFlow
from millfoam.plots import mill_plots
from millfoam.readings.slurry_on_maps import axial_velocity

matplotlib.use("Agg")

LIMIT = 30  # of the maps' colours, mm/s


def draw_profiles(axes, cases):
    for case in cases:
        z, height, spread, _, pressure = np.loadtxt(case / "pictures" / "axial.csv", delimiter=",", skiprows=1,
                                                    unpack=True)
        line, = axes[0].plot(1e3 * z, 1e3 * height, "o-", ms=3, label=case.name)
        axes[0].fill_between(1e3 * z, 1e3 * (height - spread), 1e3 * (height + spread), color=line.get_color(),
                             alpha=0.15, lw=0)
        axes[1].plot(1e3 * z, pressure, "o-", ms=3)
    axes[0].set(xlabel="z from the feed end, mm",
                ylabel="height of the slurry's centre of mass, mm\n(shaded: deviation over time)")
    axes[1].set(xlabel="z from the feed end, mm", ylabel="p_rgh in the slurry, Pa")
    axes[0].legend(fontsize=8)
    for axis in axes:
        axis.grid(alpha=0.3)


def draw_map(axis, case):
    flow = MillFlow(case)
    last = flow.frames[-1][0]
    slurry = mill_plots.mean_flow(flow, 2.0 if last > 3 else last / 2)
    image = axis.pcolormesh(1e3 * slurry.x, 1e3 * slurry.y, 1e3 * axial_velocity(slurry), cmap="RdBu_r", vmin=-LIMIT,
                            vmax=LIMIT)
    mill_plots.draw_mill(axis, flow, last)
    axis.set_title(case.name, fontsize=9)
    return image


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("cases", nargs="+", type=Path, metavar="CASE")
    parser.add_argument("-o", "--output", type=Path, default=Path("axial_together.png"))
    options = parser.parse_args()
    cases = [case.resolve() for case in options.cases]
    figure = plt.figure(figsize=(max(10, 3 * len(cases)), 6.6), constrained_layout=True)
    upper, lower = figure.subfigures(2, 1, height_ratios=(1.35, 1))
    draw_profiles(upper.subplots(1, 2), cases)
    axes = lower.subplots(1, len(cases), squeeze=False)[0]
    for axis, case in zip(axes, cases):
        image = draw_map(axis, case)
    lower.colorbar(image, ax=axes, extend="both", shrink=0.8,
                   label="velocity along the axis, mm/s\n(red: to the discharge)")
    figure.savefig(options.output, dpi=80)
    print(options.output)


if __name__ == "__main__":
    main()
