#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The 12 cm mill's slice with other cells, layers, time-steps, windows and voxels, without surface tension and with
another drag of mixed cells: observed order and error bar of the slurry's height, toe, shoulder, power and pool, the
entrained air, and whether the layers part. The last table is one to cite.

Runs are kept with those of mill_drag_comparison, with the same dry run (millstudies.mill_runs). A complete run is not
repeated. Exit code 1 if one failed; then there is no result for its series."""
import argparse
import sys
from dataclasses import dataclass
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

from millfoam.files.data_files import write_csv
from millstudies.convergence import judge
from millstudies.mean_columns import mean_columns, value_text
from millstudies.mill_runs import MILL, SLICES, Setting, make_runs, time_step_limits
from millstudies.steady_flows import NUMBERS, read_all, read_layers, title_of

matplotlib.use("Agg")

HERE = Path(__file__).parent.resolve()
RUNS = HERE.parent / "mill_drag_comparison" / "runs"
BASE = "Beetstra"  # nothing changed; its name in mill_drag_comparison
LENGTH = 0.024  # of the slice, m
CELL = 0.0045  # the mill's own
FINEST = 0.0015  # with --fine
# By cells per layer these are refined by 1.40 (from 6.75 to 4.5 mm), 1.42, 1.41 and 1.50
CELL_SIZES = (0.00225, 0.003, CELL, 0.00675)
LAYERS = (16, 8, 4, 2)
STEPS = (0.5, 1.0)
WINDOWS = (0.025, 0.05, 0.1)
VOXELS = (0.132 / 18, 0.132 / 12, 0.132 / 8)
# Other models: changes of the mill, and the cell sizes with which they are run
VARIANTS = {"no tension": (("slurry.surface_tension=0",), (0.003, CELL)),
            "permeability": (("flow.mixed_drag=permeability",), (0.00225, 0.003, CELL))}
CITED = ("height", "x", "toe", "shoulder", "power", "pool")
CHANCE = 3.0  # errors over time between two values; what is closer may be chance


@dataclass
class Family:
    """Runs that differ in one size alone: size -> the run's name; `base`: that of the base; `unit` of sizes times
    `factor`. A variant has another model in all its runs."""
    name: str
    runs: dict
    base: float
    unit: str
    factor: float = 1
    variant: bool = False


def cells(size):
    return (f"resolution.cell_size={size:g}",)


def name_of(family, label, is_base):
    return BASE if is_base else f"{family}_{label}"


def study(fine):
    """(settings of all runs by name, families, variants). The settings of the longest run come last."""
    settings = {BASE: Setting(BASE)}

    def family(name, unit, factor, values, base, label, averages=lambda value: (), flow=lambda value: ()):
        runs = {value: name_of(name, label(value), value == base) for value in values}
        for value, run in runs.items():
            settings.setdefault(run, Setting(run, averages(value), flow(value)))
        return Family(name, runs, base, unit, factor)

    millimetres = lambda value: f"{1e3 * value:.3g}mm"  # noqa: E731
    families = [
        family("cells", "mm", 1e3, CELL_SIZES[::-1], CELL, millimetres, flow=cells),
        family("steps", "of the limits", 1, STEPS[::-1], 1.0, str, flow=time_step_limits),
        family("window", "s", 1, WINDOWS, 0.05, str, averages=lambda value: (f"averages.window={value:g}",)),
        family("voxel", "mm", 1e3, VOXELS, VOXELS[1], millimetres,
               averages=lambda value: (f"averages.voxel_size={value:.12g}",)),
        family("layers", "mm", 1e3, [LENGTH / layers for layers in LAYERS[::-1]], LENGTH / LAYERS[-1],
               lambda thickness: str(round(LENGTH / thickness)),
               flow=lambda thickness: (f"resolution.layers={round(LENGTH / thickness) * SLICES}",))]
    variants = []
    for name, (changes, sizes) in VARIANTS.items():
        runs = {size: f"{name.replace(' ', '_')}_{millimetres(size)}" for size in sizes[::-1]}
        settings |= {run: Setting(run, flow=(*cells(size), *changes)) for size, run in runs.items()}
        variants.append(Family(name, runs, CELL, "mm", 1e3, variant=True))
    if fine:
        families[0].runs[FINEST] = f"cells_{millimetres(FINEST)}"
        settings[families[0].runs[FINEST]] = Setting(families[0].runs[FINEST], flow=cells(FINEST))
    return settings, families, variants


def measured_sizes(family, readings):
    """Sizes that the judgement uses: of meshes, by their cells in a layer."""
    if family.name != "cells" and not family.variant:
        return dict(zip(family.runs, family.runs))
    base = readings[family.runs[family.base]].columns
    return {size: family.base * np.sqrt(base / readings[name].columns) for size, name in family.runs.items()}


def seen(means):
    """Whether any two Means differ by more than CHANCE of their combined error."""
    return any(abs(one.value - other.value) > CHANCE * (one - other).error for one in means for other in means
               if one is not other)


def steady_runs(family, readings):
    """size -> name of a family's steady flows: others have no mean."""
    return {size: name for size, name in family.runs.items() if name in readings and not readings[name].drift}


def not_judged(family, readings):
    """Why a family is not judged, or an empty text."""
    failed = [name for name in family.runs.values() if name not in readings]
    if failed:
        return f"a run failed: {', '.join(failed)}"
    steady = steady_runs(family, readings)
    if family.base not in steady:
        return "the base is not steady"
    return "" if len(steady) > 1 else "only the base is steady"


def judgements(families, readings):
    """(family's name, number's name) -> (Convergence of the base's own number, whether its values differ by more than
    chance), of families that are complete, by their steady flows."""
    found = {}
    for family in families:
        if not_judged(family, readings):
            continue
        steady, sizes = steady_runs(family, readings), measured_sizes(family, readings)
        for number in NUMBERS:
            means = [readings[name].mean(number) for name in steady.values()]
            if np.isfinite([mean.value for mean in means]).all():
                result = judge([sizes[size] for size in steady], [mean.value for mean in means], sizes[family.base])
                found[family.name, number] = result, seen(means)
    return found


def size_text(family, size):
    text = f"{family.factor * size:.3g} {family.unit}"
    return f"{text} ({round(LENGTH / size)})" if family.name == "layers" else text


def run_lines(families, readings):
    numbers = "".join(f"{f'{number}, {unit}':>16}" for number, (unit, _) in NUMBERS.items())
    yield f"{'':<13}{'size':>18}{numbers}{'steady':>8}{'steps':>8}{'time, s':>9}"
    for family in families:
        for size, name in family.runs.items():
            begin = f"{family.name:<13}{size_text(family, size):>18}"
            if name not in readings:
                yield f"{begin}{'failed':>16}"
                continue
            one = readings[name]
            texts = (value_text(mean.value, mean.error) for mean in map(one.mean, NUMBERS))
            yield (begin + "".join(f"{text:>16}" for text in texts)
                   + f"{one.steady:>8}{one.steps:8d}{one.time:9.0f}")


def judgement_lines(families, found, readings):
    yield f"{'':<13}{'number':<16}{'order':>14}{'limit':>10}{'bar':>8}  more than chance"
    for (name, number), (result, more) in found.items():
        order = "not monotone" if np.isnan(result.order) else "1 (taken)" if name == "steps" else f"{result.order:.2f}"
        limit = "" if np.isnan(result.limit) else f"{result.limit:.2f}"
        yield (f"{name:<13}{f'{number}, {NUMBERS[number].unit}':<16}{order:>14}{limit:>10}{result.bar:8.2f}  "
               f"{'yes' if more else 'no'}")
    for family in families:
        gone = [number for number in NUMBERS if (family.name, number) not in found]
        if gone:
            yield (f"NOT JUDGED: {family.name}: "
                   + (not_judged(family, readings) or f"a run has no {', no '.join(gone)}"))


def variant_lines(families, variants, readings):
    """Differences of the variants' numbers from those of the standard model on the same cells."""
    yield f"{'difference':<13}{'cells':>18}" + "".join(f"{f'{number}, {unit}':>16}"
                                                       for number, (unit, _) in NUMBERS.items())
    for variant in variants:
        for size, name in variant.runs.items():
            usual = families[0].runs[size]
            if name in readings and usual in readings:
                apart = (readings[name].mean(number) - readings[usual].mean(number) for number in NUMBERS)
                texts = (value_text(mean.value, mean.error, sign="+") for mean in apart)
                yield (f"{variant.name:<13}{size_text(variant, size):>18}"
                       + "".join(f"{text:>16}" for text in texts))


def layer_lines(layers):
    """layers: number of layers -> Layers."""
    yield (f"{'layers':<8}{'spread, mm':>16}{'by chance, mm':>15}{'at a time, mm':>15}{'apart':>7}"
           "  mean heights, mm")
    for count, one in layers.items():
        heights = " ".join(f"{1e3 * height:.1f}" for height in one.heights)
        spread = value_text(1e3 * one.spread.value, 1e3 * one.spread.error)
        yield (f"{count:<8}{spread:>16}{1e3 * one.by_chance:>15.2f}{1e3 * one.momentary:>15.2f}"
               f"{'yes' if one.apart else 'no':>7}  {heights}")


def cited_rows(families, found, readings):
    """Rows of the table to cite: the base's numbers, each with its bars and with the root of their summed squares; NaN
    for a bar that is missing, and then for their sum."""
    for number in CITED:
        mean = readings[BASE].mean(number)
        bars = {family.name: found[family.name, number][0].bar if (family.name, number) in found else np.nan
                for family in families}
        chance = [family.name for family in families
                  if (family.name, number) in found and not found[family.name, number][1]]
        total = float(np.sqrt(np.sum(np.square([*bars.values(), mean.error]))))
        yield {"number": number, "unit": NUMBERS[number].unit, "value": mean.value, **bars, "time": mean.error,
               "total": total, "may be chance": " ".join(chance)}


def cited_lines(rows):
    bars = [key for key in rows[0] if key not in ("number", "unit", "value", "may be chance")]
    yield f"{'':<10}{'':<6}{'value':>9}" + "".join(f"{key:>10}" for key in bars)
    for row in rows:
        texts = ("–" if np.isnan(row[key]) else
                 f"({row[key]:.2f})" if key in row["may be chance"].split() else f"{row[key]:.2f}" for key in bars)
        yield (f"{row['number']:<10}{row['unit']:<6}{row['value']:>9.2f}"
               + "".join(f"{text:>10}" for text in texts))
    yield f"( ): no two values of this family differ by {CHANCE:g} errors over time; the bar may be chance alone."


def csv_rows(families, readings):
    for family in families:
        for size, name in family.runs.items():
            if name in readings:
                row = {"family": family.name, "size": float(family.factor * size), "unit": family.unit, "run": name}
                for number, (unit, _) in NUMBERS.items():
                    row |= mean_columns(f"{number}, {unit}", readings[name].mean(number))
                yield {**row, "steady": readings[name].steady, "steps": readings[name].steps,
                       "time, s": readings[name].time}


def write_tables(families, variants, readings, layers, found, failures, title):
    cited = list(cited_rows(families, found, readings))
    lines = [title, *run_lines([*families, *variants], readings),
             "±: standard error of the mean over time, from the means of whole turns."]
    lines += [f"NOT STEADY: {name}: {one.drift}" for name, one in readings.items() if one.drift]
    lines += ["", *judgement_lines(families, found, readings), "", *variant_lines(families, variants, readings)]
    if layers:
        lines += ["", *layer_lines(layers)]
    lines += ["", "To cite: value and error bars of each family, error over time, and all together",
              *cited_lines(cited), *(f"FAILED: {failure}" for failure in failures)]
    print("\n".join(lines))
    (HERE / "mill_resolution.txt").write_text("\n".join(lines) + "\n")
    write_csv(HERE / "mill_resolution.csv", list(csv_rows([*families, *variants], readings)), digits=6)
    write_csv(HERE / "mill_resolution_to_cite.csv", cited, digits=6)


def plot(families, variants, readings, found, title):
    figure, axes = plt.subplots(len(NUMBERS), len(families), figsize=(18, 2.6 * len(NUMBERS)), sharey="row",
                                constrained_layout=True)
    for family, column in zip(families, axes.T):
        for (number, (unit, _)), axis in zip(NUMBERS.items(), column):
            for drawn in [family, *(variants if family.name == "cells" else [])]:
                draw_family(axis, drawn, readings, number)
            if (family.name, number) in found:
                result, _ = found[family.name, number]
                draw_judgement(axis, result, family.factor * family.base, readings[BASE].mean(number).value)
            axis.grid(alpha=0.25)
            axis.set_xlim(left=0)
        column[0].set_title(family.name)
        column[-1].set_xlabel(f"{family.name}, {family.unit}")
    for (number, (unit, _)), axis in zip(NUMBERS.items(), axes[:, 0]):
        axis.set_ylabel(f"{number}, {unit}")
    axes[0, 0].legend(fontsize=8)
    figure.suptitle(title)
    figure.savefig(HERE / "mill_resolution.png", dpi=70)
    plt.close(figure)


def draw_family(axis, family, readings, number):
    """Means of a family's or variant's number over its sizes, with their errors over time."""
    means = {size: readings[name].mean(number) for size, name in family.runs.items() if name in readings}
    sizes = sorted(means)
    axis.errorbar([family.factor * size for size in sizes], [means[size].value for size in sizes],
                  yerr=[means[size].error for size in sizes], fmt="^--" if family.variant else "o-", capsize=4,
                  label=family.name if family.variant else "mean and error over time")


def draw_judgement(axis, result, at, value):
    """The bar of the base's own value, and the limit at size 0."""
    axis.errorbar([at], [value], yerr=[result.bar], fmt="s", ms=8, mfc="none", color="tab:red", capsize=7, lw=1.6,
                  label="error bar of the base's value")
    if not np.isnan(result.limit):
        axis.plot([0], [result.limit], "*", ms=11, color="tab:red", clip_on=False, label="extrapolated")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fine", action="store_true", help="also cells of 1.5 mm, which take hours")
    settings, families, variants = study(parser.parse_args().fine)
    cases, failures = make_runs(settings.values(), RUNS)
    readings = read_all(cases, failures)
    if BASE not in readings:
        sys.exit(f"mill_resolution.py: {failures[0]}")
    layered = next(family for family in families if family.name == "layers")
    layers = {round(LENGTH / size): read_layers(cases[name]) for size, name in layered.runs.items()
              if name in readings}
    found = judgements(families, readings)
    title = f"{MILL.parent.name}, slice, around {title_of(cases[BASE])}"
    write_tables(families, variants, readings, layers, found, failures, title)
    plot(families, variants, readings, found, title)
    print(HERE / "mill_resolution.png")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
