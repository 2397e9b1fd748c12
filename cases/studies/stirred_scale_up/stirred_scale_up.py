#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the complete runs of the study: a table and verdicts on the screen and, in the folder of the runs,
stirred_scale_up.txt with both, runs.csv, statements.csv and stirred_scale_up.png. Runs that are not complete are
listed."""
import argparse
import csv
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

from millfoam.readings.means import Mean
from millstudies.compared_runs import NOT_TESTED

from run_numbers import Numbers, read_numbers
from runs import MILLS, RUNS, SPEEDS
from scale_up_verdicts import PUBLISHED, density, verdicts

Row = dict[str, Any]
COLOURS = dict(zip(MILLS, ("#0072B2", "#009E73", "#D55E00")))
IN_LINE = 5  # runs next to each other in the printed table


def pair(name: str, unit: str, mean: Mean, scale: float = 1.0) -> Row:
    """Two columns of a table: a number and its error."""
    return {f"{name}, {unit}": scale * mean.value, f"{name}, {unit} ±": scale * mean.error}


def row_of(one: Numbers) -> Row:
    """A run's line of the table. The power of a part is its torque times the impeller's speed: what the part takes out
    of the drive."""
    run, known = one.run, PUBLISHED.get((one.run.mill, one.run.speed))
    omega = one.mill.omega
    row: Row = {"run": run.name, "mill": run.mill, "tip speed, m/s": one.mill.derived("speed", "tip_speed_m_s"),
                "slurry": run.slurry, "balls": one.balls, "turns": one.turns, "read from, s": one.begin,
                "drift in these turns": " ".join(one.drifting) or "none",
                "millDem: steady": "yes" if one.whole_steady else "no", **pair("power", "W", one.power)}
    for part, torque in one.torques.items():
        row |= pair(f"torque on {part}", "N m", torque)
        if part != "impeller":
            row |= pair(f"power by {part}", "W", Mean(torque.value, torque.error), omega)
    row |= pair("at rest over impeller", "1", one.at_rest)
    row |= pair("power per volume of slurry", "kW/m3", density(one), 1e-3)
    row["published with slurry, by balls, kW/m3"] = known.balls / 1e3 if known else None
    row |= pair("mean speed of balls", "m/s", one.speed)
    row["over tip speed"] = one.speed.value / row["tip speed, m/s"]
    return row | {"published with slurry, m/s": known.speed if known else None}


def write_csv(rows: Sequence[Row], path: Path) -> None:
    """Writes rows of the same columns."""
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)


def cell(row: Row, key: str) -> str:
    """A row's entry in the printed table, with its error; a dash for a number that is not known."""
    value, error = row[key], row.get(f"{key} ±")
    if value is None or isinstance(value, float) and np.isnan(value):
        return "–"
    if error is not None:
        return f"{value:.4g} ± {error:.2g}"
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def lines_of(rows: Sequence[Row]) -> Iterator[str]:
    """The table as text: a line for each quantity and a column for each run."""
    for begin in range(0, len(rows), IN_LINE):
        block = rows[begin:begin + IN_LINE]
        for key in (one for one in block[0] if not one.endswith(" ±")):
            yield key.ljust(39) + "".join(cell(row, key).rjust(20) for row in block)
        yield ""


def draw(found: Sequence[Numbers]) -> plt.Figure:
    """Figure: power, power per volume and mean speed of the balls against the speed of the tips, by mill."""
    figure, axes = plt.subplots(1, 3, figsize=(14, 4.6), layout="constrained")
    highest = {axes[2]: max(one.speed for one in PUBLISHED.values())}
    for mill, colour in COLOURS.items():
        known = [(SPEEDS[speed], one.speed) for (name, speed), one in PUBLISHED.items() if name == mill]
        if known:
            axes[2].plot(*zip(*known), "s", mfc="none", color=colour, label=f"{mill}, published, with slurry")
        runs = sorted((one for one in found if one.run.mill == mill), key=lambda one: SPEEDS[one.run.speed])
        if not runs:
            continue
        tips = [SPEEDS[one.run.speed] for one in runs]
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


def read_all(root: Path) -> tuple[dict[str, Numbers], list[str]]:
    """Run -> its Numbers, in the order of the study; and why the others are not complete."""
    found, missing = {}, []
    for name, run in RUNS.items():
        if not (root / name / "mill.json").is_file():
            missing.append(f"{name}: not begun")
            continue
        try:
            found[name] = read_numbers(run, root / name)
        except RuntimeError as error:
            missing.append(f"{name}: {error}")
    return found, missing


def main() -> None:
    matplotlib.use("Agg")
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("runs", type=Path, help="folder with the folders of the runs")
    root = parser.parse_args().runs
    found, missing = read_all(root)
    if not found:
        parser.exit(1, "\n".join(["no run is complete:", *missing]) + "\n")
    rows = [row_of(one) for one in sorted(found.values(), key=lambda one: (one.run.mill, SPEEDS[one.run.speed]))]
    judged = verdicts(found)
    write_csv(rows, root / "runs.csv")
    write_csv([asdict(one) for one in judged], root / "statements.csv")
    known = [one for one in judged if one.verdict != NOT_TESTED]
    lines = [*lines_of(rows), *(f"{one.verdict:<13} {one.statement}; {one.runs}: {one.figure}" for one in known), "",
             f"not tested, because a run is not finished: {len(judged) - len(known)} statements",
             *(f"not finished: {text}" for text in missing)]
    (root / "stirred_scale_up.txt").write_text("\n".join(lines) + "\n")
    print("\n".join(lines))
    draw(list(found.values())).savefig(root / "stirred_scale_up.png", dpi=130)


if __name__ == "__main__":
    main()
