#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Steady hold-up of the 30 cm mill against its feed: a table on the screen and, in the folder of the runs,
steady_holdup.txt, steady_holdup.csv and steady_holdup.png, with fitted exponents and with the models of Moys and of
Morrell & Stephenson. Runs that are not complete are listed."""
import argparse
import csv
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

from millfoam.files.data_files import read_json
from millfoam.files.mill import Mill
from millfoam.files.mill_case import MillCase
from millfoam.readings import models
from millfoam.readings.batches import batch_means
from millfoam.readings.means import Mean, block_mean

MESHES = ("coarse", "own")
STARTS = ("low", "high")
COLOURS = {75: "#D55E00", 60: "#0072B2"}


@dataclass(frozen=True)
class Held:
    """A flow that came to its end: mesh; name; its mill and case; feed (m3/s); over the turns that were judged: hold-up
    of the mill with its pulp lifters (m3), and of what lies in front of the grates (m3), discharge (m3/s), height of
    the slurry's centre (m); flow time of the end (s); why it ended; the verdict in words."""
    mesh: str
    name: str
    case: MillCase
    feed: float
    whole: Mean
    chamber: Mean
    discharge: Mean
    height: Mean
    end: float
    reason: str
    found: str

    @property
    def mill(self) -> Mill:
        return self.case.mill

    @property
    def group(self) -> tuple[str, int, bool]:
        """Flows that differ in their feed alone: mesh, speed (% of critical), whether they have balls."""
        return self.mesh, round(100 * self.mill.critical_share), bool(self.case.law)


def read_held(mesh: str, folder: Path) -> Held:
    """Held of a folder. RuntimeError if its flow has not come to its end."""
    if not (folder / "steady.json").is_file():
        raise RuntimeError("the flow has not come to its end")
    ended, case = read_json(folder / "steady.json", "steady"), MillCase(folder)
    if case.flow is None or case.balance is None:
        raise RuntimeError("; ".join(["no flow or no table of slurryBalance", *case.unusable]))
    turns = max(int((ended["end_s"] - ended["begin_s"]) / case.turn + 0.005), 1)
    begin = ended["end_s"] - turns * case.turn

    def over_turns(times: np.ndarray, values: np.ndarray) -> Mean:
        return block_mean(batch_means(times, values, begin, case.turn, turns))
    columns, axial = case.balance, case.axial("holdUp")
    if axial is None:
        raise RuntimeError("; ".join(["no table of axialProfiles", *case.unusable]))
    return Held(mesh, folder.name, case, case.feed or 0.0, over_turns(columns["Time"], columns["holdUp"]),
                over_turns(axial[1], axial[2].sum(axis=1)), over_turns(columns["Time"], columns["discharge"]),
                over_turns(columns["Time"], columns["y"]), ended["end_s"], ended["reason"], ended["found"])


def read_all(root: Path) -> tuple[list[Held], list[str]]:
    """Held of all complete flows, and why the others are not."""
    found, missing = [], []
    for mesh in MESHES:
        for folder in sorted((root / mesh).glob("*")):
            try:
                found.append(read_held(mesh, folder))
            except (RuntimeError, OSError) as error:
                missing.append(f"{mesh}/{folder.name}: {error}")
    return found, missing


def by_groups(found: Sequence[Held]) -> dict[tuple[str, int, bool], list[Held]]:
    """The flows of each group in order of their feed, without those from other starts."""
    groups: dict[tuple[str, int, bool], list[Held]] = {}
    for one in sorted(found, key=lambda one: one.feed):
        if one.name not in STARTS:
            groups.setdefault(one.group, []).append(one)
    return groups


def exponent(feeds: Sequence[float], holdups: Sequence[Mean]) -> tuple[Mean, float]:
    """n of H = k Q^n through hold-ups (m3) at feeds (m3/s), and k's logarithm, by least squares weighted by the errors
    of the hold-ups. The error of n is from these errors, or from the points' distances from the line where that is
    more. Two points have no distance. ValueError for fewer than two."""
    if len(feeds) < 2:
        raise ValueError(f"{len(feeds)} feeds; expected two or more")
    x, y = np.log(feeds), np.log([one.value for one in holdups])
    sigma = np.array([max(one.error / one.value, 1e-6) for one in holdups])
    weight = sigma**-2
    middle = np.average(x, weights=weight)
    spread = np.sum(weight * (x - middle)**2)
    slope = np.sum(weight * (x - middle) * y) / spread
    offset = np.average(y, weights=weight) - slope * middle
    error = spread**-0.5
    if len(x) > 2:
        misfit = np.sum(weight * (y - offset - slope * x)**2) / (len(x) - 2)
        error *= max(1.0, np.sqrt(misfit))
    return Mean(float(slope), float(error)), float(offset)


def model_holdups(mill: Mill, feed: float) -> dict[str, float]:
    """Name of a model -> hold-up (m3) of a mill with balls at a feed (m3/s)."""
    solidity = mill.derived("charge", "resting_solidity")
    bed = models.Charge(mill.radius, mill.length, 1 - solidity, mill.sauter_diameter)
    names = "inner_radius_m", "outer_radius_m", "sector_share", "open_fraction", "pegged"
    grates = {name: mill.derived("geometry", "grates", name) for name in names}
    area = np.pi * (grates["outer_radius_m"]**2 - grates["inner_radius_m"]**2) * (
        grates["sector_share"] * grates["open_fraction"] * (1 - grates["pegged"]))
    volume = np.pi * mill.radius**2 * mill.length
    return {"Moys": models.slurry_hold_up(bed, feed, mill.radius - mill.discharge_radius,
                                          mill.slurry("plastic_viscosity_Pa_s"), mill.slurry("density_kg_m3")),
            "Morrell & Stephenson": volume * models.grate_hold_up(
                feed, 2 * mill.radius, models.mean_grate_radius(grates["inner_radius_m"], grates["outer_radius_m"]),
                area, mill.critical_share, mill.derived("charge", "pore_volume_m3") / volume)}


def rows_of(found: Sequence[Held]) -> Iterator[dict[str, object]]:
    """Rows of the table: column -> text or number."""
    for one in found:
        row: dict[str, object] = {"mesh": one.mesh, "flow": one.name, "cells": one.case.flow.mesh.cells,
                                  "feed, ml/s": 1e6 * one.feed}
        for name, mean, scale in (("hold-up, l", one.whole, 1e3), ("in front of the grates, l", one.chamber, 1e3),
                                  ("discharge, ml/s", one.discharge, 1e6), ("height, mm", one.height, 1e3)):
            row[name], row[f"{name} ±"] = scale * mean.value, scale * mean.error
        for name, held in (model_holdups(one.mill, one.feed) if one.case.law else {}).items():
            row[f"{name}, l"] = 1e3 * held
        yield row | {"end, s": one.end, "ended by": one.reason}


def lines_of(found: Sequence[Held]) -> Iterator[str]:
    """The table as text, then the exponents of each group and of the models, then what other starts came to."""
    names = ("hold-up, l", "in front of the grates, l", "discharge, ml/s", "height, mm")
    yield f"{'flow':<26}{'feed, ml/s':>11}" + "".join(name.rjust(27) for name in names) + "  end, s  ended by"
    for row in rows_of(found):
        yield (f"{row['mesh']}/{row['flow']:<{25 - len(str(row['mesh']))}}{row['feed, ml/s']:11.1f}"
               + "".join(f"{row[name]:.3f} ± {row[f'{name} ±']:.3f}".rjust(27) for name in names)
               + f"{row['end, s']:8.1f}  {row['ended by']}")
    yield ""
    for (mesh, speed, balls), group in by_groups(found).items():
        feeds = [one.feed for one in group]
        if len(set(feeds)) < 2:
            continue
        slope, _ = exponent(feeds, [one.chamber for one in group])
        words = f"{mesh}, {speed} %, {'with' if balls else 'without'} balls: hold-up in front of the grates ~ feed^"
        yield f"{words}{slope.text('', 1, '.3f')}({len(group)} feeds)"
        if balls:
            held = [model_holdups(group[0].mill, feed) for feed in feeds]
            for name in held[0]:
                slope, _ = exponent(feeds, [Mean(one[name], 1e-3 * one[name]) for one in held])
                yield f"    {name}: ~ feed^{slope.value:.3f}"
    yield from starts(found)


def starts(found: Sequence[Held]) -> Iterator[str]:
    """What flows from other starts came to, over the flow that they belong to."""
    others = [one for one in found if one.name in STARTS]
    for one in others:
        base = next((flow for flow in found if flow.name not in STARTS and flow.group == one.group
                     and np.isclose(flow.feed, one.feed)), None)
        if base:
            apart = one.whole - base.whole
            yield (f"from the {one.name} start: hold-up {100 * apart.value / base.whole.value:+.2f} ± "
                   f"{100 * apart.error / base.whole.value:.2f} % from {base.name}'s, after {one.end:.1f} s")


def draw(found: Sequence[Held]) -> plt.Figure:
    """Figure: hold-up against feed with the fits and the models, without and with balls; hold-up against time."""
    figure, axes = plt.subplots(1, 3, figsize=(16, 5), layout="constrained")
    for (mesh, speed, balls), group in by_groups(found).items():
        axis, feeds = axes[int(balls)], np.array([one.feed for one in group])
        style = {"color": COLOURS[speed], "fillstyle": "full" if mesh == "own" else "none"}
        held = np.array([(one.chamber.value, one.chamber.error) for one in group]).T
        axis.errorbar(1e6 * feeds, *(1e3 * held), fmt="o", capsize=2, label=f"{speed} % of critical, {mesh} cells",
                      **style)
        along = np.geomspace(30e-6, 140e-6, 50)
        if len(set(feeds)) > 1:
            slope, offset = exponent(feeds, [one.chamber for one in group])
            axis.plot(1e6 * along, 1e3 * np.exp(offset) * along**slope.value, color=COLOURS[speed],
                      ls="-" if mesh == "own" else "--", lw=1, label=f"~ feed^{slope.value:.2f} ± {slope.error:.2f}")
        if balls and mesh == "coarse":
            for name, line in (("Moys", ":"), ("Morrell & Stephenson", "-.")):
                axis.plot(1e6 * along, [1e3 * model_holdups(group[0].mill, feed)[name] for feed in along], line,
                          color=COLOURS[speed], lw=1, alpha=0.7, label=f"{name}, {speed} %")
    for axis, words in zip(axes, ("without balls", "with balls, Beetstra")):
        axis.set(title=words, xlabel="feed, ml/s", ylabel="hold-up in front of the grates, l", ylim=(0, None))
        axis.grid(alpha=0.3)
        if axis.has_data():
            axis.legend(fontsize=7)
    for number, one in enumerate(found):
        columns = one.case.balance
        axes[2].plot(columns["Time"], 1e3 * columns["holdUp"], lw=1, color=plt.cm.turbo((number + 0.5) / len(found)),
                     label=f"{one.mesh}/{one.name}")
    axes[2].set(title="with the pulp lifters", xlabel="flow time, s", ylabel="hold-up, l")
    axes[2].grid(alpha=0.3)
    axes[2].legend(fontsize=6, ncols=2)
    return figure


def main() -> None:
    matplotlib.use("Agg")
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, help="with the runs")
    parser.add_argument("--volume", action="store_true",
                        help="only prints the steady hold-up, m3, of the run in this folder")
    options = parser.parse_args()
    if options.volume:
        print(f"{read_held('', options.folder).whole.value:.6g}")
        return
    found, missing = read_all(options.folder)
    if not found:
        parser.exit(1, "\n".join(["no flow is complete:", *missing]) + "\n")
    rows = list(rows_of(found))
    with open(options.folder / "steady_holdup.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, list(dict.fromkeys(key for row in rows for key in row)))
        writer.writeheader()
        writer.writerows(rows)
    lines = [*lines_of(found), *(f"not finished: {text}" for text in missing)]
    (options.folder / "steady_holdup.txt").write_text("\n".join(lines) + "\n")
    print("\n".join(lines))
    draw(found).savefig(options.folder / "steady_holdup.png", dpi=110)


if __name__ == "__main__":
    main()
