#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The 12 cm mill's slice on three meshes, with two time-steps, three window lengths and three voxel sizes: observed
order and error bar of the slurry's height, toe and shoulder.

Runs are kept with those of mill_drag_comparison, with the same dry run (millstudies.mill_runs). A complete run is not
repeated. Exit code 1 if one failed; then there is no result for its series."""
import argparse
import csv
import sys
from dataclasses import dataclass
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

from millfoam.files.written_times import MillFlow
from millfoam.readings.slurry_in_cells import read_shape
from millstudies.convergence import judge
from millstudies.mill_runs import COARSE, MILL, Setting, make_runs, time_step_limits

matplotlib.use("Agg")

HERE = Path(__file__).parent.resolve()
RUNS = HERE.parent / "mill_drag_comparison" / "runs"
BASE = "Beetstra"  # nothing changed; its name in mill_drag_comparison
# By cells per layer (3840, 2028, 1005 and 513) these are refined by 1.38, 1.42 and 1.40 each.
CELL_SIZES, COARSE_CELL_SIZES = (0.0023, 0.003, 0.0045), (0.003, 0.0045, 0.00675)
STEPS = (0.5, 1.0)
WINDOWS = (0.025, 0.05, 0.1)
VOXELS = (0.132 / 18, 0.132 / 12, 0.132 / 8)
# Name: (number of Shape, unit, factor to it)
NUMBERS = {"height": ("centre_y", "mm", 1e3), "toe": ("toe", "deg", 1), "shoulder": ("shoulder", "deg", 1)}


@dataclass
class Family:
    """Runs that differ in one size alone: size -> the run's name; `base`: that of the base; `unit` of sizes times
    `factor`."""
    name: str
    runs: dict
    base: float
    unit: str
    factor: float


def study(coarse):
    """(settings of all runs by name, families)."""
    prefix, sizes, base = ("coarse_", COARSE_CELL_SIZES, COARSE_CELL_SIZES[1]) if coarse else ("", CELL_SIZES, 0.003)
    mesh = COARSE if coarse else ()
    settings = {prefix + BASE: Setting(prefix + BASE, flow=mesh)}

    def family(name, unit, factor, values, base, label, averages=lambda value: (), flow=lambda value: ()):
        runs = {value: prefix + (BASE if value == base else f"{name}_{label(value)}") for value in values}
        for value, run in runs.items():
            settings.setdefault(run, Setting(run, averages(value), (*mesh, *flow(value))))
        return Family(name, runs, base, unit, factor)

    millimetres = lambda value: f"{1e3 * value:.3g}mm"  # noqa: E731
    families = [
        family("cells", "mm", 1e3, sizes, base, millimetres, flow=lambda value: (f"resolution.cell_size={value:g}",)),
        family("steps", "of the limits", 1, STEPS, 1.0, str, flow=time_step_limits),
        family("window", "s", 1, WINDOWS, 0.05, str, averages=lambda value: (f"averages.window={value:g}",)),
        family("voxel", "mm", 1e3, VOXELS, VOXELS[1], millimetres,
               averages=lambda value: (f"averages.voxel_size={value:.12g}",))]
    return settings, families


def measured_sizes(family, shapes):
    """Sizes that the judgement uses: of meshes, by their cells in a layer."""
    if family.name != "cells":
        return dict(zip(family.runs, family.runs))
    base = shapes[family.runs[family.base]].columns
    return {size: family.base * np.sqrt(base / shapes[name].columns) for size, name in family.runs.items()}


def judgements(families, shapes):
    """(family's name, number's name) -> Convergence of the base's own number, of families that are complete."""
    found = {}
    for family in families:
        if any(name not in shapes for name in family.runs.values()):
            continue
        sizes = measured_sizes(family, shapes)
        for label, (number, _, factor) in NUMBERS.items():
            values = [factor * shapes[name].numbers[number][0] for name in family.runs.values()]
            found[family.name, label] = judge(list(sizes.values()), values, sizes[family.base])
    return found


def total_bar(label, found, families, shape):
    """Root of the summed squares of a number's bars and of the spread over time."""
    number, _, factor = NUMBERS[label]
    bars = [found[family.name, label].bar for family in families if (family.name, label) in found]
    return float(np.sqrt(np.sum(np.square(bars)) + (factor * shape.numbers[number][1]) ** 2))


def run_lines(families, shapes):
    numbers = "".join(f"{f'{label}, {unit}':>20}" for label, (_, unit, _) in NUMBERS.items())
    yield f"{'':<8}{'size':>22}{numbers}{'steps':>8}"
    for family in families:
        for size, name in family.runs.items():
            if name not in shapes:
                yield f"{family.name:<8}{f'{family.factor * size:.3g} {family.unit}':>22}{'failed':>20}"
                continue
            cells = (" ± ".join(f"{factor * value:.2f}" for value in shapes[name].numbers[number])
                     for number, _, factor in NUMBERS.values())
            yield (f"{family.name:<8}{f'{family.factor * size:.3g} {family.unit}':>22}"
                   + "".join(f"{cell:>20}" for cell in cells)
                   + f"{shapes[name].steps:8d}")


def judgement_lines(families, shapes, found, base):
    yield f"{'':<8}{'number':<14}{'order':>14}{'limit':>10}{'bar':>8}"
    for (name, label), result in found.items():
        order = "not monotone" if np.isnan(result.order) else "1 (taken)" if name == "steps" else f"{result.order:.2f}"
        limit = "" if np.isnan(result.limit) else f"{result.limit:.2f}"
        yield f"{name:<8}{f'{label}, {NUMBERS[label][1]}':<14}{order:>14}{limit:>10}{result.bar:8.2f}"
    missing = [family.name for family in families if (family.name, "height") not in found]
    if missing:
        yield f"NOT JUDGED, a run failed: {', '.join(missing)}"
    for label, (number, unit, factor) in NUMBERS.items():
        value = factor * shapes[base].numbers[number][0]
        yield f"{label}: {value:.1f} ± {total_bar(label, found, families, shapes[base]):.1f} {unit}"


def write_tables(families, shapes, found, base, title):
    lines = [title, *run_lines(families, shapes),
             "±: half of the difference between the means over the two halves of the time averaged over.", "",
             *judgement_lines(families, shapes, found, base)]
    print("\n".join(lines))
    (HERE / "mill_resolution.txt").write_text("\n".join(lines) + "\n")
    with open(HERE / "mill_resolution.csv", "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["family", "size", "unit", "run",
                        *(f"{label}{end}, {unit}" for label, (_, unit, _) in NUMBERS.items()
                          for end in ("", " ±"))])
        for family in families:
            for size, name in family.runs.items():
                if name in shapes:
                    numbers = (f"{factor * value:.6g}" for number, _, factor in NUMBERS.values()
                               for value in shapes[name].numbers[number])
                    table.writerow([family.name, f"{family.factor * size:.6g}", family.unit, name, *numbers])


def plot(families, shapes, found, title):
    figure, axes = plt.subplots(len(NUMBERS), len(families), figsize=(15, 10), sharey="row", constrained_layout=True)
    for family, column in zip(families, axes.T):
        for (label, (number, unit, factor)), axis in zip(NUMBERS.items(), column):
            there = {size: shapes[name].numbers[number] for size, name in family.runs.items() if name in shapes}
            at = family.factor * np.array(list(there))
            mean, spread = factor * np.array(list(there.values())).reshape(-1, 2).T
            axis.errorbar(at, mean, yerr=spread, fmt="o-", color="tab:blue", capsize=4,
                          label="mean and drift over time")
            if (family.name, label) in found:
                draw_judgement(axis, found[family.name, label], family.factor * family.base,
                               factor * there[family.base][0])
            axis.grid(alpha=0.25)
            axis.set_xlim(left=0)
        column[0].set_title(family.name)
        column[-1].set_xlabel(f"{family.name}, {family.unit}")
    for (label, (_, unit, _)), axis in zip(NUMBERS.items(), axes[:, 0]):
        axis.set_ylabel(f"{label}, {unit}")
    axes[0, 0].legend(fontsize=8)
    figure.suptitle(title)
    figure.savefig(HERE / "mill_resolution.png", dpi=90)
    plt.close(figure)


def draw_judgement(axis, result, at, value):
    """The bar of the base's own value, and the limit at size 0."""
    axis.errorbar([at], [value], yerr=[result.bar], fmt="s", ms=8, mfc="none", color="tab:red", capsize=7, lw=1.6,
                  label="error bar of the base's value")
    if not np.isnan(result.limit):
        axis.plot([0], [result.limit], "*", ms=11, color="tab:red", clip_on=False, label="extrapolated")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--coarse", action="store_true", help="around cells of 4.5 mm, in two layers")
    coarse = parser.parse_args().coarse
    settings, families = study(coarse)
    cases, failures = make_runs(settings.values(), RUNS)
    base = next(iter(settings))
    if base not in cases:
        sys.exit(f"mill_resolution.py: {failures[0]}")
    flows = {name: MillFlow(case) for name, case in cases.items()}
    end = flows[base].frames[-1][0]
    shapes = {name: read_shape(flow, end / 2) for name, flow in flows.items()}
    found = judgements(families, shapes)
    title = (f"{MILL.parent.name}, slice, around {flows[base].mesh.cells} cells; averages over flow time {end / 2:g} "
             f"to {end:g} s")
    write_tables(families, shapes, found, base, title)
    plot(families, shapes, found, title)
    print(HERE / "mill_resolution.png")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
