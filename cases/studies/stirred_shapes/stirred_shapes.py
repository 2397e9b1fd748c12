#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the complete runs of the study: a table and verdicts on the screen and, in the folder of the runs,
stirred_shapes.txt with both, runs.csv, statements.csv, stirred_shapes.png (numbers against the sphericity), maps.png
(means in the r-z plane) and balls.png (sections through the balls of the last record) of mill A. Runs that are not
complete are listed."""
import argparse
from collections.abc import Sequence
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

from millfoam.files.dumps import numbered_dumps, read_timestep
from millfoam.files.mill import Mill
from millfoam.files.rings_file import Rings, read_rings
from millfoam.plots.ball_sections import section
from millfoam.plots.stirred_plots import DARK, draw_meridian, label_of
from millfoam.readings.means import Mean
from millfoam.readings.stirred import bands
from millfoam.readings.stirred_slurry import in_impeller
from millstudies.mean_columns import Row, mean_columns
from millstudies.stirred_runs import Numbers, read_all
from millstudies.stirred_settings import MILLS
from millstudies.stirred_tables import drive_columns, write_study

from runs import RUNS, SHAPES
from shape_verdicts import PUBLISHED, WITH_SLURRY, over_spheres, shape_of, verdicts

COLOURS = dict(zip(MILLS, ("#0072B2", "#009E73", "#D55E00")))
SHOWN = 0.095  # m, height of the pictures
PIXELS = 700  # across the mill


def sphericity(one: Numbers) -> float:
    """Mean sphericity of the charge."""
    return one.mill.derived("charge", "sphericity")


def solidity_of(mill: Mill, rings: Rings) -> dict[str, float]:
    """Mean solidity by bands of the height: below the lower pins `below`, at the pins `impeller`, and `above`."""
    return {band: float(mean.balls.sum() / mean.room.sum()) for band, mean in bands(mill, rings).items()}


def row_of(one: Numbers, found: dict[str, Numbers], solidity: dict[str, float]) -> Row:
    """A run's line of the table."""
    known = PUBLISHED.get(one.name)
    row: Row = {"run": one.name, "mill": RUNS[one.name].mill, "shape": shape_of(one.name),
                "sphericity": sphericity(one), **drive_columns(one)}
    for read, words in (("power", "power"), ("speed", "mean speed")):
        over = over_spheres(read, one, found) or Mean(np.nan, np.nan)
        row |= mean_columns(f"{words} over that with spheres, 1", over)
    row |= mean_columns("mean speed of balls, m/s", one.speed)
    return row | {"published, m/s": known.speed if known else None,
                  "published with slurry, m/s": WITH_SLURRY.get(one.name),
                  "solidity below the pins": solidity["below"], "solidity at the pins": solidity["impeller"]}


def draw_numbers(found: dict[str, Numbers], solidity: dict[str, dict[str, float]]) -> plt.Figure:
    """Figure: power over that with spheres in A, mean speed and solidity against the sphericity."""
    figure, axes = plt.subplots(1, 3, figsize=(14, 4.4), layout="constrained")
    spheres = found.get("A_spheres")
    for mill, colour in COLOURS.items():
        runs = sorted((one for one in found.values() if RUNS[one.name].mill == mill), key=sphericity)
        if not runs:
            continue
        places = [sphericity(one) for one in runs]
        if spheres:
            axes[0].errorbar(places, [one.power.value / spheres.power.value for one in runs],
                             [one.power.error / spheres.power.value for one in runs], fmt="o-", capsize=3,
                             color=colour, label=f"{mill}, dry")
        axes[1].errorbar(places, [one.speed.value for one in runs], [one.speed.error for one in runs], fmt="o-",
                         capsize=3, color=colour, label=f"{mill}, dry")
        for band, mark in (("below", "v-"), ("impeller", "o--")):
            axes[2].plot(places, [solidity[one.name][band] for one in runs], mark, color=colour,
                         label=f"{mill}, {'below the pins' if band == 'below' else 'at the pins'}")
        for known, label, mark in (({name: one.speed for name, one in PUBLISHED.items()}, "published", "s"),
                                   (WITH_SLURRY, "published, with slurry", "^")):
            there = [one for one in runs if one.name in known]
            if there:
                axes[1].plot([sphericity(one) for one in there], [known[one.name] for one in there], mark, mfc="none",
                             color=colour, label=f"{mill}, {label}")
    for axis, label in zip(axes, ("power over that of A with spheres", "mean speed of the balls, m/s", "solidity")):
        axis.set(xlabel="mean sphericity", ylabel=label, ylim=(0, None))
        axis.grid(alpha=0.3)
        if axis.get_legend_handles_labels()[0]:
            axis.legend(fontsize=8)
    return figure


def draw_maps(chosen: Sequence[Numbers], rings: dict[str, Rings]) -> plt.Figure:
    """Figure: solidity and speed in the r-z plane, a column for each run, with the same colours."""
    figure, axes = plt.subplots(2, len(chosen), figsize=(4.0 * len(chosen), 6.4), layout="constrained", squeeze=False)
    for row, quantity, largest in zip(axes, ("solidity", "speed"), (0.7, 1.4)):
        for axis, one in zip(row, chosen):
            image = draw_meridian(axis, one.mill, rings[one.name], quantity, largest)
            axis.set_ylim(0, 1e3 * SHOWN)
            axis.set_title(shape_of(one.name), fontsize=10, loc="left")
        figure.colorbar(image, ax=list(row), label=label_of(quantity), shrink=0.8)
    figure.supxlabel("left: half of the azimuth near the lower pins; right: the other half", fontsize=9)
    return figure


def draw_balls(chosen: Sequence[Numbers], root: Path) -> plt.Figure:
    """Figure: the vertical section through the lower pins at the last record, with each ball's speed."""
    figure, axes = plt.subplots(len(chosen), 1, figsize=(7.4, 3.6 * len(chosen)), layout="constrained", squeeze=False)
    for axis, one in zip(axes[:, 0], chosen):
        mill, dumps = one.mill, root / one.name / "dumps"
        step, path = numbered_dumps(dumps)[-1]
        lower = min(mill.impeller["pins"], key=lambda pins: float(pins["height_m"]))
        pins_at = np.radians(lower["angle_deg"])  # in the impeller's frame
        angle = pins_at + mill.omega * step * read_timestep(dumps)
        across, up = np.linspace(-mill.radius, mill.radius, PIXELS), np.arange(0, SHOWN, 2 * mill.radius / PIXELS)
        along, still = (np.array([np.cos(turned), np.sin(turned), 0.0]) for turned in (angle, pins_at))
        speeds = section(path, along, across, up)
        axis.set_facecolor("0.95")
        image = axis.pcolormesh(1e3 * across, 1e3 * up, speeds, cmap="viridis", vmin=0, vmax=1.2)
        points = across[None, :, None] * still + up[:, None, None] * np.array([0, 0, 1])
        axis.contourf(1e3 * across, 1e3 * up, in_impeller(mill, points), [0.5, 1.5], colors=[DARK])
        axis.set(xlim=(-1e3 * mill.radius, 1e3 * mill.radius), ylim=(0, 1e3 * SHOWN), aspect="equal",
                 xlabel="along the lower pins, mm", ylabel="z, mm")
        axis.set_title(shape_of(one.name), fontsize=10, loc="left")
        figure.colorbar(image, ax=axis, label="speed of the ball, m/s", shrink=0.8)
    return figure


def main() -> None:
    matplotlib.use("Agg")
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("runs", type=Path, help="folder with the folders of the runs")
    root = parser.parse_args().runs
    found, missing = read_all(root, RUNS)
    rings = {}
    for name in list(found):
        try:
            rings[name] = read_rings(root / name / "solids.h5")
        except RuntimeError as error:
            missing.append(f"{name}: {error}")
            del found[name]
    if not found:
        parser.exit(1, "\n".join(["no run is complete:", *missing]) + "\n")
    solidity = {name: solidity_of(one.mill, rings[name]) for name, one in found.items()}
    ordered = sorted(found.values(), key=lambda one: (RUNS[one.name].mill, SHAPES.index(RUNS[one.name].shape)))
    rows = [row_of(one, found, solidity[one.name]) for one in ordered]
    print(write_study(root, "stirred_shapes", rows, verdicts(found, solidity), missing), end="")
    draw_numbers(found, solidity).savefig(root / "stirred_shapes.png", dpi=130)
    in_a = [one for one in ordered if RUNS[one.name].mill == "A"]
    if in_a:
        draw_maps(in_a, rings).savefig(root / "maps.png", dpi=130)
        draw_balls(in_a, root).savefig(root / "balls.png", dpi=130)


if __name__ == "__main__":
    main()
