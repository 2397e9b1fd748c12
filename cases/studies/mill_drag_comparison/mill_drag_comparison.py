#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The 12 cm mill's slice with every drag law, without drag, and with balls averaged over the whole run: place of
the slurry, its power, and the particle Reynolds numbers in the bed.

Runs are kept in the folder runs/ (millstudies.mill_runs): a complete run is not repeated. Exit code 1 if one
failed; the table and the figure then show the others."""
import argparse
import csv
import subprocess
import sys
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

from millfoam.files.flow_record import read_flow_record
from millfoam.files.written_times import MillFlow
from millfoam.plots.mill_plots import draw_mill
from millfoam.readings.shell_angles import LEVEL
from millfoam.readings.slurry_in_cells import read_shape
from millstudies.mill_runs import COARSE, MILL, Setting, make_runs

matplotlib.use("Agg")

HERE = Path(__file__).parent.resolve()
REFERENCE = "Beetstra"  # the mill case's law
NO_DRAG, WHOLE_RUN = "no_drag", "whole_run"
PERCENTS = (5, 50, 95)
# Column of the table: (number of Shape, unit, factor to it)
COLUMNS = {"centre x, mm": ("centre_x", 1e3), "centre y, mm": ("centre_y", 1e3), "toe, deg": ("toe", 1),
           "shoulder, deg": ("shoulder", 1), "torque, mN m": ("torque", 1e3), "power, W/m": ("power", 1)}


def laws():
    """Names of all drag laws, out of millDrag's table."""
    table = subprocess.run(["millDrag", "--ranges"], check=True, capture_output=True, text=True).stdout
    return [row["law"] for row in csv.DictReader(table.splitlines())]


def settings(mesh, prefix):
    """All runs, the mill case's law and what differs most from it first: names begin with `prefix`; mesh: its
    settings."""
    changes = {REFERENCE: (), NO_DRAG: ("flow.multiplier=0",),
               **{law: (f"flow.law={law}",) for law in laws() if law != REFERENCE}}
    found = [Setting(prefix + name, flow=(*mesh, *change)) for name, change in changes.items()]
    # One window, from averages.start to the end of the dry run
    return [*found[:2], Setting(prefix + WHOLE_RUN, averages=("averages.window=0.6",), flow=mesh), *found[2:]]


def late(flow):
    """Flow time from which on is averaged: the second half, s."""
    return flow.frames[-1][0] / 2


def cost(case):
    """Time that a run's flow took, s."""
    return read_flow_record(case).last["wall_s"]


def row_of(name, shape, case):
    """A row of the table: column -> number."""
    row = {"run": name}
    for column, (number, factor) in COLUMNS.items():
        mean, spread = shape.numbers[number]
        row[column], row[column + " ±"] = factor * mean, factor * spread
    for percent, value in zip(PERCENTS, shape.reynolds_percentiles(PERCENTS)):
        row[f"Re {percent} %"] = value
    return {**row, "steps": shape.steps, "time, s": cost(case)}


def write_tables(rows, failures, title):
    with open(HERE / "mill_drag_comparison.csv", "w", newline="") as file:
        table = csv.DictWriter(file, rows[0])
        table.writeheader()
        table.writerows({key: f"{value:.6g}" if isinstance(value, float) else value for key, value in row.items()}
                        for row in rows)
    lines = [title, f"{'run':<13}" + "".join(f"{column:>16}" for column in COLUMNS)
             + "".join(f"{f'Re {percent} %':>8}" for percent in PERCENTS) + f"{'steps':>7}{'time, s':>9}"]
    for row in rows:
        cells = (f"{row[column]:.1f} ± {row[column + ' ±']:.1f}" for column in COLUMNS)
        lines.append(f"{row['run']:<13}" + "".join(f"{cell:>16}" for cell in cells)
                     + "".join(f"{row[f'Re {percent} %']:8.0f}" for percent in PERCENTS)
                     + f"{row['steps']:7d}{row['time, s']:9.0f}")
    lines.append("±: half of the difference between the means over the two halves of the time averaged over. Angles "
                 "from straight down, the rising side positive.")
    lines += [f"FAILED: {failure}" for failure in failures]
    print("\n".join(lines))
    (HERE / "mill_drag_comparison.txt").write_text("\n".join(lines) + "\n")


def colours(names):
    """Colour of each run; the reference black, without drag grey, the whole run dashed by style."""
    others = [name for name in names if name not in (REFERENCE, NO_DRAG, WHOLE_RUN)]
    shades = plt.cm.turbo(np.linspace(0.02, 0.98, max(1, len(others))))
    return {REFERENCE: "black", NO_DRAG: "0.6", WHOLE_RUN: "tab:red", **dict(zip(others, shades))}


def draw_surfaces(axis, shapes, flow, colour):
    """The slurry's surface of every run: where it is half of the fluid, averaged over axis and time."""
    for name, shape in shapes.items():
        pixels = len(shape.share)
        at = 1e3 * flow.radius * ((np.arange(pixels) + 0.5) / pixels * 2 - 1)
        axis.contour(at, at, shape.share, [LEVEL], colors=[colour[name]],
                     linewidths=2.2 if name in (REFERENCE, NO_DRAG, WHOLE_RUN) else 1)
    draw_mill(axis, flow, flow.frames[-1][0])
    axis.set_title("slurry's surface (half of the fluid is slurry)")


def draw_numbers(axis, rows, columns, colour, title):
    """One or two columns of the table against the runs, with their bars."""
    for column, marker in zip(columns, ("o", "^")):
        for number, row in enumerate(rows):
            axis.errorbar(row[column], number, xerr=row[column + " ±"], fmt=marker, color=colour[row["run"]], capsize=3)
    axis.set_yticks(range(len(rows)), [row["run"] for row in rows])
    axis.invert_yaxis()
    axis.grid(alpha=0.25, axis="x")
    axis.set_title(title)


def draw_reynolds(axis, shapes, colour):
    """Histograms of the Reynolds number, by the volume of slurry in the bed."""
    edges = np.logspace(0, 3.5, 43)
    for name, shape in shapes.items():
        share, _ = np.histogram(shape.reynolds, edges, weights=shape.weights / shape.weights.sum())
        axis.stairs(100 * share, edges, color=colour[name], lw=2 if name in (REFERENCE, NO_DRAG, WHOLE_RUN) else 0.9,
                    label=name)
    axis.set(xscale="log", xlabel="particle Reynolds number, –", ylabel="slurry in the bed, %")
    axis.set_title("particle Reynolds numbers (solidity from 0.2 on)")
    axis.legend(fontsize=8, loc="upper left")


def plot(rows, shapes, flow, title):
    colour = colours(list(shapes))
    figure, axes = plt.subplots(2, 3, figsize=(17, 10.5), constrained_layout=True)
    draw_surfaces(axes[0, 0], shapes, flow, colour)
    draw_numbers(axes[0, 1], rows, ["centre y, mm"], colour, "height of the slurry's centre of mass, mm from the axis")
    draw_numbers(axes[0, 2], rows, ["power, W/m"], colour, "power that the slurry takes, W per m of mill")
    draw_reynolds(axes[1, 0], shapes, colour)
    draw_numbers(axes[1, 1], rows, ["toe, deg"], colour, "toe, degrees from straight down")
    draw_numbers(axes[1, 2], rows, ["shoulder, deg"], colour, "shoulder, degrees from straight down")
    figure.suptitle(title)
    figure.savefig(HERE / "mill_drag_comparison.png", dpi=90)
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--coarse", action="store_true", help="a quarter of the cells: 4.5 mm and two layers")
    mesh, prefix = (COARSE, "coarse_") if parser.parse_args().coarse else ((), "")
    cases, failures = make_runs(settings(mesh, prefix), HERE / "runs")
    if not cases:
        sys.exit("mill_drag_comparison.py: no run succeeded")
    shapes = {}
    for name, case in cases.items():
        flow = MillFlow(case)
        shapes[name.removeprefix(prefix)] = read_shape(flow, late(flow))
    rows = [row_of(name, shape, cases[prefix + name]) for name, shape in shapes.items()]
    title = (f"{MILL.parent.name}, slice, {flow.mesh.cells} cells; averages over flow time {late(flow):g} to "
             f"{flow.frames[-1][0]:g} s")
    write_tables(rows, failures, title)
    plot(rows, shapes, flow, title)
    print(HERE / "mill_drag_comparison.png")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
