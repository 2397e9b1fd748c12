#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the complete runs of the study: a table and verdicts on the screen and, in the folder of the runs,
stirred_scale_up.txt with both, runs.csv, statements.csv and stirred_scale_up.png. Runs that are not complete are
listed."""
import argparse
from collections.abc import Sequence
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

from millstudies.mean_columns import Row, mean_columns
from millstudies.published_stirred import WET
from millstudies.stirred_runs import Numbers, read_all
from millstudies.stirred_settings import MILLS
from millstudies.stirred_tables import drive_columns, write_study

from runs import RUNS, SPEEDS
from scale_up_verdicts import density, verdicts

COLOURS = dict(zip(MILLS, ("#0072B2", "#009E73", "#D55E00")))


def row_of(one: Numbers) -> Row:
    """A run's line of the table."""
    run = RUNS[one.name]
    known = WET.get((run.mill, run.speed))
    row: Row = {"run": run.name, "mill": run.mill, "tip speed, m/s": one.mill.derived("speed", "tip_speed_m_s"),
                "slurry": run.slurry, **drive_columns(one)}
    row |= mean_columns("power per volume of slurry, kW/m3", density(one), 1e-3)
    row["published with slurry, by balls, kW/m3"] = known.balls / 1e3 if known else None
    row |= mean_columns("mean speed of balls, m/s", one.speed)
    row["over tip speed"] = one.speed.value / row["tip speed, m/s"]
    return row | {"published with slurry, m/s": known.speed if known else None}


def placed(name: str) -> tuple[str, float]:
    """Where a run stands among the others: its mill, then its speed (m/s)."""
    return RUNS[name].mill, SPEEDS[RUNS[name].speed]


def draw(found: Sequence[Numbers]) -> plt.Figure:
    """Figure: power, power per volume and mean speed of the balls against the speed of the tips, by mill."""
    figure, axes = plt.subplots(1, 3, figsize=(14, 4.6), layout="constrained")
    highest = {axes[2]: max(one.speed for one in WET.values())}
    for mill, colour in COLOURS.items():
        known = [(SPEEDS[speed], one.speed) for (name, speed), one in WET.items() if name == mill]
        if known:
            axes[2].plot(*zip(*known), "s", mfc="none", color=colour, label=f"{mill}, published, with slurry")
        runs = sorted((one for one in found if RUNS[one.name].mill == mill), key=lambda one: placed(one.name))
        if not runs:
            continue
        tips = [SPEEDS[RUNS[one.name].speed] for one in runs]
        for axis, means in zip(axes, ([one.power for one in runs], [density(one) for one in runs],
                                      [one.speed for one in runs])):
            scale = 1e-3 if axis is axes[1] else 1.0
            values, errors = (scale * np.array([getattr(one, name) for one in means]) for name in ("value", "error"))
            highest[axis] = max(highest.get(axis, 0.0), values.max())
            axis.errorbar(tips, values, errors, fmt="o-", capsize=3, color=colour, label=f"{mill}, dry")
    for axis, label in zip(axes, ("power, W", "power per volume of slurry, kW/m³", "mean speed of the balls, m/s")):
        axis.set(xlabel="speed of the tips, m/s", ylabel=label, xlim=(1.3, 2.4), ylim=(0, 1.15 * highest[axis]))
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    return figure


def main() -> None:
    matplotlib.use("Agg")
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("runs", type=Path, help="folder with the folders of the runs")
    root = parser.parse_args().runs
    found, missing = read_all(root, RUNS)
    if not found:
        parser.exit(1, "\n".join(["no run is complete:", *missing]) + "\n")
    rows = [row_of(one) for one in sorted(found.values(), key=lambda one: placed(one.name))]
    print(write_study(root, "stirred_scale_up", rows, verdicts(found), missing), end="")
    draw(list(found.values())).savefig(root / "stirred_scale_up.png", dpi=130)


if __name__ == "__main__":
    main()
