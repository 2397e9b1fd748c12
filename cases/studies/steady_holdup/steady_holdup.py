#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Steady hold-up of the 30 cm mill against its feed: a table on the screen and, in the folder of the runs,
steady_holdup.txt, steady_holdup.csv and steady_holdup.png, with fitted exponents and with the models of Moys and of
Morrell & Stephenson. Runs that are not complete are listed."""
import argparse
import itertools
import sys
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

from millfoam.files.data_files import write_csv
from millfoam.files.mill import Mill
from millfoam.readings import models
from millfoam.readings.means import Mean
from millstudies.mean_columns import Row, freedom_columns, freedom_text, value_text

from held_flows import (Held, Stay, Trial, at_feed, by_groups, expected_volume, named, read_all, read_held, read_trial,
                        read_trials, scatter)

STEADY, STEADY_IN_FRONT = "steady, l", "steady, in front of the grates, l"
FEW = 10  # degrees of freedom; with fewer an error is not well known
COLOURS = {75: "#D55E00", 60: "#0072B2"}


def exponent(feeds: Sequence[float], holdups: Sequence[Mean]) -> tuple[Mean, float]:
    """n of H = k Q^n through hold-ups (m3) at feeds (m3/s), and k's logarithm, by least squares weighted by the errors
    of the hold-ups. The error of n is from these errors, with the degrees of freedom that follow from theirs, or from
    the points' distances from the line where that is more: then it has two degrees of freedom less than points. Two
    points have no distance. ValueError for fewer than two."""
    if len(feeds) < 2:
        raise ValueError(f"{len(feeds)} feeds; expected two or more")
    x, y = np.log(feeds), np.log([one.value for one in holdups])
    sigma = np.array([max(one.error / one.value, 1e-6) for one in holdups])
    weight = sigma**-2
    middle = np.average(x, weights=weight)
    spread = np.sum(weight * (x - middle)**2)
    slope = np.sum(weight * (x - middle) * y) / spread
    offset = np.average(y, weights=weight) - slope * middle
    error, parts = spread**-0.5, weight * (x - middle)**2 / spread**2  # of the variance
    inexact = np.sum(parts**2 / [one.freedom for one in holdups])
    freedom = error**4 / inexact if inexact > 0 else np.inf
    misfit = np.sum(weight * (y - offset - slope * x)**2) / (len(x) - 2) if len(x) > 2 else 0.0
    if misfit > 1:
        error, freedom = error * np.sqrt(misfit), len(x) - 2
    return Mean(float(slope), float(error), float(freedom)), float(offset)


def exponent_words(slope: Mean, group: Sequence[Held]) -> str:
    """An exponent with its error, the number of feeds and, if the error is of few degrees of freedom, how far the
    exponent may be; and which flows did not end because they are steady."""
    words = [f"{len(group)} feeds"]
    if slope.freedom < FEW:
        words.append(f"error of {slope.freedom:.2g} degree{'' if slope.freedom == 1 else 's'} of freedom: 95 % within "
                     f"± {slope.reach:.2g}")
    words += [f"{one.name} ended by {one.reason}" for one in group if not one.ended_steady]
    return f"{slope.text('', 1, '.3f')}({'; '.join(words)})"


def model_holdups(mill: Mill, feed: float) -> dict[str, float]:
    """Name of a model -> hold-up (m3) of a mill with balls at a feed (m3/s). Moys' needs the lip of the discharge,
    which a mill without pulp lifters has not."""
    solidity = mill.derived("charge", "resting_solidity")
    bed = models.Charge(mill.radius, mill.length, 1 - solidity, mill.sauter_diameter)
    names = "inner_radius_m", "outer_radius_m", "sector_share", "open_fraction", "pegged"
    grates = {name: mill.derived("geometry", "grates", name) for name in names}
    area = np.pi * (grates["outer_radius_m"]**2 - grates["inner_radius_m"]**2) * (
        grates["sector_share"] * grates["open_fraction"] * (1 - grates["pegged"]))
    volume = np.pi * mill.radius**2 * mill.length
    found = {"Morrell & Stephenson": volume * models.grate_hold_up(
        feed, 2 * mill.radius, models.mean_grate_radius(grates["inner_radius_m"], grates["outer_radius_m"]), area,
        mill.critical_share, mill.derived("charge", "pore_volume_m3") / volume)}
    if mill.discharge_radius is None:
        return found
    return {"Moys": models.slurry_hold_up(bed, feed, mill.radius - mill.discharge_radius,
                                          mill.slurry("plastic_viscosity_Pa_s"), mill.slurry("density_kg_m3")), **found}


def rows_of(found: Sequence[Held]) -> Iterator[Row]:
    """Rows of the table: column -> text or number; errors and their degrees of freedom after each mean."""
    for one in found:
        row: Row = {"mesh": one.mesh, "flow": one.name, "cells": one.case.flow.mesh.cells,
                    "feed, ml/s": 1e6 * one.feed}
        readings = [("hold-up, l", one.whole, 1e3), ("in front of the grates, l", one.chamber, 1e3),
                    ("discharge, ml/s", one.discharge, 1e6), ("height, mm", one.height, 1e3)]
        if one.steady:
            readings += [(STEADY, one.steady.whole, 1e3), (STEADY_IN_FRONT, one.steady.chamber, 1e3)]
        for name, mean, scale in readings:
            row |= freedom_columns(name, mean, scale)
        for name, held in (model_holdups(one.mill, one.feed) if one.case.law else {}).items():
            row[f"{name}, l"] = 1e3 * held
        yield row | {"end, s": one.end, "ended by": one.reason}


def lines_of(found: Sequence[Held]) -> Iterator[str]:
    """The table as text, with degrees of freedom of the errors in brackets, then the exponents of each group and of the
    models, then what other starts and changed mills came to."""
    names = {"hold-up, l": 22, "discharge, ml/s": 24, "height, mm": 22, STEADY: 22, STEADY_IN_FRONT: 35}
    yield (f"{'flow':<36}{'feed, ml/s':>11}" + "".join(name.rjust(width) for name, width in names.items())
           + "  end, s  ended by")
    for row in rows_of(found):
        numbers = (freedom_text(row, name, 3).rjust(width) for name, width in names.items())
        yield (f"{row['mesh']}/{row['flow']}".ljust(36) + f"{row['feed, ml/s']:11.1f}" + "".join(numbers)
               + f"{row['end, s']:8.1f}  {row['ended by']}")
    yield ""
    for (mesh, kind), group in by_groups(found).items():
        feeds = [one.feed for one in group]
        if len(set(feeds)) < 2:
            continue
        slope, _ = exponent(feeds, [one.holdups.chamber for one in group])
        words = f"{mesh}, {kind}: hold-up in front of the grates ~ feed^"
        yield words + exponent_words(slope, group)
        if kind.balls:
            held = [model_holdups(group[0].mill, feed) for feed in feeds]
            for name in held[0]:
                slope, _ = exponent(feeds, [Mean(one[name], 1e-3 * one[name]) for one in held])
                yield f"    {name}: ~ feed^{slope.value:.3f}"
    yield from comparisons(found)


def trial_lines(trials: Sequence[Trial]) -> Iterator[str]:
    """Hold-up and discharge of each trial."""
    for one in sorted(trials, key=lambda one: (one.kind, one.volume)):
        yield f"trial at {one.kind}: {1e3 * one.volume:.3f} l discharge {one.discharge.text('ml/s', 1e6, '.1f')}"


def scatter_lines(found: Sequence[Held], trials: Sequence[Trial]) -> Iterator[str]:
    """By how much single turns differ, for flows of more than one late turn with trials."""
    for one in found:
        apart = scatter(one, trials) if one.turns > 1 else None
        if apart:
            yield (f"{one.mesh}/{one.name}: {one.turns} turns scatter by {1e6 * apart.discharge:.1f} ml/s and "
                   f"{1e6 * apart.holdup:.0f} ml; independent discharges give {1e6 * apart.expected:.0f} ml")


def stay_lines(stays: Sequence[Stay]) -> Iterator[str]:
    """How long slurry stays, over hold-up over feed, and how its times are spread."""
    for one in stays:
        found = one.found
        mean, spread = (100 * abs(share) for share in found.doubt)
        yield (f"residence/{one.name}: slurry stays {found.mean:.1f} s, {100 * (found.mean / one.expected - 1):+.1f} % "
               f"from hold-up over feed, {one.expected:.1f} s; {found.tanks:.2f} stirred tanks in series, Pe "
               f"{found.peclet:.2f}; estimates, mean and spread by {mean:.1f} and {spread:.1f} % with another fit of "
               f"the tail; {100 * found.left:.0f} % had not left; concentration from {one.lowest:.1e} to 1 "
               f"{one.highest - 1:+.1e}")


def difference_line(one: Held, base: Held) -> str:
    """By how much the hold-up of a flow differs from another one's, as for comparisons."""
    both_steady = one.steady and base.steady
    found_of_both = (flow.holdups if both_steady else flow.measured for flow in (one, base))
    ours, theirs = ((both.chamber if one.kind.change else both.whole) for both in found_of_both)
    words = ("" if both_steady else "over the late turns ") + ("in front of the grates " if one.kind.change else "")
    apart = 100 / theirs.value * (ours - theirs)
    known = f", 95 %: ± {apart.reach:.2f}," if apart.freedom < FEW else ""
    return (f"{one.mesh}/{one.name}: hold-up {words}{value_text(apart.value, apart.error, sign='+')} %{known} from "
            f"{base.name}'s, after {one.end:.1f} s")


def comparisons(found: Sequence[Held]) -> Iterator[str]:
    """What flows from other starts and of changed mills hold, compared with the flow that they belong to: by their
    steady hold-ups if both have them, otherwise by those over their late turns. A changed mill may have no pulp
    lifters, so it is compared by what it holds in front of the grates. Flows from a low and a high start are compared
    with each other, too."""
    for one in (one for one in found if not one.is_base):
        alike = [flow for flow in found if flow.mesh == one.mesh and flow.kind == replace(one.kind, change="")
                 and np.isclose(flow.feed, one.feed)]
        bases = [flow for flow in alike if flow.is_base]
        if one.name.endswith("high"):
            bases += [flow for flow in alike if flow.name.endswith("low")]
        if not bases:
            yield f"{one.mesh}/{one.name}: no flow to compare it with is complete"
        yield from (difference_line(one, base) for base in bases)


def draw_discharge(axis: plt.Axes, found: Sequence[Held], trials: Sequence[Trial]) -> None:
    """Discharge against the hold-up of the mill: trials, and flows on coarse cells that ended because they are
    steady. Changed mills are left out."""
    for kind in sorted({one.kind for one in trials if not one.kind.change}):
        points = sorted((1e3 * one.volume, 1e6 * one.discharge.value, 1e6 * one.discharge.error)
                        for one in trials if one.kind == kind)
        axis.errorbar(*zip(*points), fmt="s" if kind.balls else "o", ls=":", lw=1, capsize=2, fillstyle="none",
                      color=COLOURS[kind.speed], label=f"trials, {kind}")
    for one in found:
        if one.mesh == "coarse" and one.reason == "steady" and not one.kind.change:
            axis.errorbar(1e3 * one.whole.value, 1e6 * one.discharge.value, 1e6 * one.discharge.error, capsize=2,
                          fmt="s" if one.kind.balls else "o", color=COLOURS[one.kind.speed])
    axis.set(title="discharge against hold-up; filled: over the late turns", ylabel="discharge, ml/s", ylim=(0, None),
             xlabel="hold-up with the pulp lifters, l")
    axis.grid(alpha=0.3)
    if trials:
        axis.legend(fontsize=7)


def draw_over_time(axis: plt.Axes, found: Sequence[Held]) -> None:
    """Hold-up of the mill against time: the colour is the speed, the line the feed. Thick: with balls. Pale: on the
    mill's own cells. Changed mills are left out."""
    unchanged = [one for one in found if not one.kind.change]
    lines = dict(zip(sorted({round(1e6 * one.feed) for one in unchanged}), itertools.cycle((":", "--", "-", "-."))))
    for one in unchanged:
        columns = one.case.balance
        axis.plot(columns["Time"], 1e3 * columns["holdUp"], lines[round(1e6 * one.feed)], color=COLOURS[one.kind.speed],
                  lw=1.8 if one.kind.balls else 0.8, alpha=0.5 if one.mesh == "own" else 1,
                  label=f"{one.mesh}/{one.name}")
    axis.set(title="hold-up against time; thick: with balls", xlabel="flow time, s",
             ylabel="hold-up with the pulp lifters, l")
    axis.grid(alpha=0.3)
    axis.legend(fontsize=6, ncols=2)


def draw(found: Sequence[Held], trials: Sequence[Trial]) -> plt.Figure:
    """Figure: hold-up against feed with the fits and the models, without and with balls; discharge against hold-up;
    hold-up against time."""
    figure, grid = plt.subplots(2, 2, figsize=(12, 9), layout="constrained")
    axes = grid.ravel()
    draw_discharge(axes[2], found, trials)
    for (mesh, kind), group in by_groups(found).items():
        speed = kind.speed
        axis, feeds = axes[int(kind.balls)], np.array([one.feed for one in group])
        style = {"color": COLOURS[speed], "fillstyle": "full" if mesh == "own" else "none"}
        chambers = [one.holdups.chamber for one in group]
        held = np.array([(one.value, one.error) for one in chambers]).T
        axis.errorbar(1e6 * feeds, *(1e3 * held), fmt="o", capsize=2, label=f"{speed} % of critical, {mesh} cells",
                      **style)
        others = [not one.ended_steady for one in group]
        axis.plot(1e6 * feeds[others], 1e3 * held[0][others], "kx", ms=9,
                  label="crossed: ended before they were steady" if any(others) else None)
        along = np.geomspace(30e-6, 140e-6, 50)
        if len(set(feeds)) > 1:
            slope, offset = exponent(feeds, chambers)
            axis.plot(1e6 * along, 1e3 * np.exp(offset) * along**slope.value, color=COLOURS[speed],
                      ls="-" if mesh == "own" else "--", lw=1, label=f"~ feed^{slope.value:.2f} ± {slope.error:.2f}"
                      + (f" (95 %: ± {slope.reach:.2f})" if slope.freedom < FEW else ""))
        if kind.balls and mesh == "coarse":
            for name, line in (("Moys", ":"), ("Morrell & Stephenson", "-.")):
                axis.plot(1e6 * along, [1e3 * model_holdups(group[0].mill, feed)[name] for feed in along], line,
                          color=COLOURS[speed], lw=1, alpha=0.7, label=f"{name}, {speed} %")
    for axis, words in zip(axes, ("without balls", "with balls, Beetstra")):
        axis.set(title=words, xlabel="feed, ml/s", ylabel="hold-up in front of the grates, l", ylim=(0, None))
        axis.grid(alpha=0.3)
        axis.set_visible(axis.has_data())
        if axis.has_data():
            axis.legend(fontsize=7)
    draw_over_time(axes[3], found)
    return figure


def main() -> None:
    matplotlib.use("Agg")
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, help="with the runs")
    printed = parser.add_mutually_exclusive_group()
    printed.add_argument("--volume", action="store_true",
                         help="only prints the steady hold-up, m3, of the run in this folder")
    printed.add_argument("--trial", action="store_true",
                         help="only prints the hold-up, m3, of the trial in this folder")
    printed.add_argument("--expected", type=float, metavar="FEED",
                         help="only prints the hold-up, m3, at which a mill discharges this feed, ml/s, by the trials"
                              " in this folder and in OTHER")
    parser.add_argument("other", type=Path, nargs="?", help="folder of the second trial")
    options = parser.parse_args()
    if (options.expected is None) != (options.other is None):
        parser.error("expected --expected FEED with the folders of two trials")
    if options.volume:
        one = named(options.folder, lambda folder: read_held("", folder))
        trials, _ = read_trials(options.folder.parent.parent)
        print(f"{(at_feed(one, trials) or one).whole.value:.6g}")
        return
    if options.trial:
        print(f"{named(options.folder, read_trial).volume:.6g}")
        return
    if options.expected is not None:
        pair = [named(folder, read_trial) for folder in (options.folder, options.other)]
        print(f"{expected_volume(1e-6 * options.expected, pair):.6g}")
        return
    found, trials, stays, missing = read_all(options.folder)
    if not found:
        parser.exit(1, "\n".join([f"{options.folder}: no flow is complete", *missing]) + "\n")
    rows = list(rows_of(found))
    write_csv(options.folder / "steady_holdup.csv", rows)
    lines = [*lines_of(found), "", *trial_lines(trials), *scatter_lines(found, trials), *stay_lines(stays),
             *(f"not finished: {text}" for text in missing)]
    (options.folder / "steady_holdup.txt").write_text("\n".join(lines) + "\n")
    print("\n".join(lines))
    draw(found, trials).savefig(options.folder / "steady_holdup.png", dpi=110)


if __name__ == "__main__":
    try:
        main()
    except (RuntimeError, OSError) as error:
        sys.exit(f"steady_holdup: error: {error}")
