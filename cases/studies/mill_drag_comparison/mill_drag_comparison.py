#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The 12 cm mill's slice with every drag law, without drag, and with balls averaged over the whole record: place of
the slurry, its power, and the particle Reynolds numbers in the bed; and which laws differ from the mill's own by more
than the errors over time.

Runs are kept in the folder runs/ (millstudies.mill_runs): a complete run is not repeated. Exit code 1 if one failed;
the tables and the figure then show the others."""
import argparse
import csv
import subprocess
import sys
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

from millfoam.files.data_files import write_csv
from millfoam.files.written_times import MillFlow
from millfoam.plots.mill_plots import draw_mill
from millfoam.readings.shell_angles import LEVEL
from millstudies.mean_columns import mean_columns, mean_text
from millstudies.mill_runs import FINE, MILL, Setting, make_runs
from millstudies.steady_flows import NUMBERS, read_all, title_of

matplotlib.use("Agg")

HERE = Path(__file__).parent.resolve()
REFERENCE = "Beetstra"  # the mill case's law
NO_DRAG, WHOLE_RUN = "no_drag", "whole_run"
PERCENTS = (5, 50, 95)
LIMIT = 5.0  # errors by which a run differs from the reference; with other time-steps some numbers changed by 3


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
    return [*found[:2], Setting(prefix + WHOLE_RUN, averages=("averages.window=1",), flow=mesh), *found[2:]]


def row_of(name, readings):
    """A row of the table: column -> number or text."""
    row = {"run": name}
    for number, (unit, _) in NUMBERS.items():
        row |= mean_columns(f"{number}, {unit}", readings.mean(number))
    for percent, value in zip(PERCENTS, readings.reynolds_percentiles(PERCENTS)):
        row[f"Re {percent} %"] = value
    return {**row, "steady": readings.steady, "steps": readings.steps, "time, s": readings.time}


def row_of_differences(name, readings, reference):
    """A row of the second table: number -> a run's difference from the reference over the root of the sum of both
    errors' squares."""
    apart = {number: readings.mean(number) - reference.mean(number) for number in NUMBERS}
    with np.errstate(invalid="ignore", divide="ignore"):  # angles of a ring may be the same in every turn
        return {"run": name, **{number: float(np.divide(mean.value, mean.error)) for number, mean in apart.items()}}


def run_lines(rows):
    columns = [f"{number}, {unit}" for number, (unit, _) in NUMBERS.items()]
    yield (f"{'run':<14}" + "".join(f"{column:>16}" for column in columns)
           + "".join(f"{f'Re {percent} %':>8}" for percent in PERCENTS) + f"{'steady':>8}{'steps':>8}{'time, s':>9}")
    for row in rows:
        yield (f"{row['run']:<14}" + "".join(f"{mean_text(row, column):>16}" for column in columns)
               + "".join(f"{row[f'Re {percent} %']:8.0f}" for percent in PERCENTS)
               + f"{row['steady']:>8}{row['steps']:8d}{row['time, s']:9.0f}")
    yield ("±: standard error of the mean over time, from the means of whole turns. Angles from straight down, the "
           "rising side positive.")


def difference_lines(rows):
    yield f"Difference from {REFERENCE} over the combined error over time; *: {LIMIT:g} errors or more"
    yield f"{'run':<14}" + "".join(f"{number:>11}" for number in NUMBERS)
    for row in rows:
        cells = (f"{row[number]:+.1f}{'*' if abs(row[number]) >= LIMIT else ' '}" for number in NUMBERS)
        yield f"{row['run']:<14}" + "".join(f"{cell:>11}" for cell in cells)


def write_tables(readings, failures, title):
    """Both tables on the screen, as text and as csv; returns the rows of the first."""
    rows = [row_of(name, one) for name, one in readings.items()]
    lines = [title, *run_lines(rows)]
    lines += [f"NOT STEADY: {name}: {one.drift}" for name, one in readings.items() if one.drift]
    write_csv(HERE / "mill_drag_comparison.csv", rows, digits=6)
    if REFERENCE in readings:
        apart = [row_of_differences(name, one, readings[REFERENCE])
                 for name, one in readings.items() if name != REFERENCE]
        lines += ["", *difference_lines(apart)]
        if apart:
            write_csv(HERE / "mill_drag_differences.csv", apart, digits=6)
    lines += [f"FAILED: {failure}" for failure in failures]
    print("\n".join(lines))
    (HERE / "mill_drag_comparison.txt").write_text("\n".join(lines) + "\n")
    return rows


def colours(names):
    """Colour of each run; the reference black, without drag grey, the whole run dashed by style."""
    others = [name for name in names if name not in (REFERENCE, NO_DRAG, WHOLE_RUN)]
    shades = plt.cm.turbo(np.linspace(0.02, 0.98, max(1, len(others))))
    return {REFERENCE: "black", NO_DRAG: "0.6", WHOLE_RUN: "tab:red", **dict(zip(others, shades))}


def draw_surfaces(axis, readings, flow, colour):
    """The slurry's surface of every run: where it is half of the fluid, averaged over axis and time."""
    for name, one in readings.items():
        pixels = len(one.share)
        at = 1e3 * flow.radius * ((np.arange(pixels) + 0.5) / pixels * 2 - 1)
        axis.contour(at, at, one.share, [LEVEL], colors=[colour[name]],
                     linewidths=2.2 if name in (REFERENCE, NO_DRAG, WHOLE_RUN) else 1)
    draw_mill(axis, flow, flow.frames[-1][0])
    axis.set_title("slurry's surface (half of the fluid is slurry)")


def draw_numbers(axis, rows, column, colour, title):
    """A column of the table against the runs, with their errors."""
    for number, row in enumerate(rows):
        axis.errorbar(row[column], number, xerr=row[column + " ±"], fmt="o", color=colour[row["run"]], capsize=3)
    names = [row["run"] + ("" if row["steady"] == "yes" else " (not steady)") for row in rows]
    axis.set_yticks(range(len(rows)), names)
    axis.invert_yaxis()
    axis.grid(alpha=0.25, axis="x")
    axis.set_title(title)


def draw_reynolds(axis, readings, colour):
    """Histograms of the Reynolds number, by the volume of slurry in the bed."""
    edges = np.logspace(0, 3.5, 43)
    for name, one in readings.items():
        share, _ = np.histogram(one.reynolds, edges, weights=one.weights / one.weights.sum())
        axis.stairs(100 * share, edges, color=colour[name], lw=2 if name in (REFERENCE, NO_DRAG, WHOLE_RUN) else 0.9,
                    label=name)
    axis.set(xscale="log", xlabel="particle Reynolds number, –", ylabel="slurry in the bed, %")
    axis.set_title("particle Reynolds numbers (solidity from 0.2 on)")
    axis.legend(fontsize=8, loc="upper left")


def plot(rows, readings, flow, title):
    colour = colours(list(readings))
    figure, axes = plt.subplots(2, 3, figsize=(17, 10.5), constrained_layout=True)
    draw_surfaces(axes[0, 0], readings, flow, colour)
    draw_numbers(axes[0, 1], rows, "height, mm", colour, "height of the slurry's centre of mass, mm from the axis")
    draw_numbers(axes[0, 2], rows, "power, W/m", colour, "power that the slurry takes, W per m of mill")
    draw_reynolds(axes[1, 0], readings, colour)
    draw_numbers(axes[1, 1], rows, "toe, deg", colour, "toe, degrees from straight down")
    draw_numbers(axes[1, 2], rows, "shoulder, deg", colour, "shoulder, degrees from straight down")
    figure.suptitle(title)
    figure.savefig(HERE / "mill_drag_comparison.png", dpi=90)
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fine", action="store_true", help="four times the cells: 3 mm and four layers")
    mesh, prefix = (FINE, "fine_") if parser.parse_args().fine else ((), "")
    cases, failures = make_runs(settings(mesh, prefix), HERE / "runs")
    readings = {name.removeprefix(prefix): one for name, one in read_all(cases, failures).items()}
    if not readings:
        sys.exit("mill_drag_comparison.py: no run succeeded")
    last = cases[prefix + next(reversed(readings))]
    title = f"{MILL.parent.name}, slice, {title_of(last)}"
    rows = write_tables(readings, failures, title)
    plot(rows, readings, MillFlow(last), title)
    print(HERE / "mill_drag_comparison.png")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
