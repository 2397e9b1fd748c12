#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the piles and compares their slopes: repose.txt and repose.png. Exits 1 unless superquadrics that are spheres
have the slope of spheres, and blunt bodies pile up steeper. Piles that are complete are kept."""
import argparse
import json
import shutil
import sys
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

from millfoam.readings.means import Mean, block_mean
from millfoam.run import run_jobs, write_table
from repose import DIAMETER, Ledge, Shape, run_pile, slope

HERE = Path(__file__).parent.resolve()
SPHERES, ROUND, BLUNT = SHAPES = (Shape("spheres"), Shape("round", (1.0, 1.0, 1.0)),
                                  Shape("blunt", (2.70274, 2.00172, 1.67844), 6.0))
LEDGE, QUICK_LEDGE = Ledge(14, 5, 34), Ledge(10, 4, 26)
PILES, QUICK_PILES = 3, 2  # of each shape
HOLDS, FAILS, UNDECIDED = "holds", "FAILS", "UNDECIDED"
SAME = 2.0  # degrees between spheres and round superquadrics, and its reach, at most
STEEPER = 2.0  # degrees that blunt bodies pile up steeper at least


def pile(folder: Path, shape: Shape, ledge: Ledge, seed: int) -> np.ndarray:
    """Places of the balls of a pile [n, 3], m, which is made unless it is complete."""
    done = folder / "pile.json"
    if not done.exists():
        shutil.rmtree(folder, ignore_errors=True)
        balls = run_pile(folder, shape, ledge, seed)
        done.with_suffix(".part").write_text(json.dumps(balls.tolist()))
        done.with_suffix(".part").rename(done)
    return np.array(json.loads(done.read_text()))


def draw(piles: dict[str, np.ndarray], angles: dict[str, Mean], ledge: Ledge) -> plt.Figure:
    """Figure: the balls of the first pile of each shape, from the side, with the slope."""
    figure, axes = plt.subplots(len(piles), 1, figsize=(6, 2.6 * len(piles)), layout="constrained", sharex=True)
    for axis, (name, balls) in zip(axes, piles.items()):
        axis.plot(balls[:, 0] / DIAMETER, balls[:, 2] / DIAMETER, "o", ms=4, mfc="0.8", mec="0.4")
        reach = np.array([0, ledge.length])
        axis.plot(reach, 1 + (ledge.length - reach) * np.tan(np.radians(angles[name].value)), "r-")
        axis.set(title=f"{name}: {angles[name].value:.1f}°", ylabel="z, diameters", aspect="equal",
                 xlim=(0, ledge.length), ylim=(0, None))
    axes[-1].set(xlabel="x, diameters (red: the mean slope, from the lip)")
    return figure


def verdicts(angles: dict[str, Mean]) -> list[tuple[str, str]]:
    """(verdict, sentence) of what is compared. A difference has a `reach`, with 95 % confidence; that of single piles
    is not known."""
    apart, steeper = (angles[shape.name] - angles[SPHERES.name] for shape in (ROUND, BLUNT))
    same = (FAILS if abs(apart.value) - apart.reach > SAME else
            HOLDS if abs(apart.value) <= SAME and apart.reach <= SAME else UNDECIDED)
    more = steeper.value - STEEPER
    blunt = UNDECIDED if not abs(more) >= steeper.reach else HOLDS if more >= 0 else FAILS
    return [(same, f"round superquadrics less spheres: {text(apart)}, expected {SAME:g} or less, and a reach of "
             f"{SAME:g} or less"),
            (blunt, f"blunt bodies less spheres: {text(steeper)}, expected {STEEPER:g} or more")]


def text(difference: Mean) -> str:
    """A difference of slopes with its reach, in words."""
    return f"{difference.value:+.2f} ± {difference.reach:.2f} degrees (95 % confidence)"


def main() -> int:
    matplotlib.use("Agg")
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true", help="two smaller piles of each shape, in the folder quick/")
    parser.add_argument("--piles", type=int, help=f"of each shape [{PILES}, quick: {QUICK_PILES}]")
    parser.add_argument("--jobs", type=int, default=1, help="piles at the same time")
    options = parser.parse_args()
    root, ledge, piles = ("quick", QUICK_LEDGE, QUICK_PILES) if options.quick else ("runs", LEDGE, PILES)
    seeds = range(1, (piles if options.piles is None else options.piles) + 1)
    if len(seeds) < 2:
        parser.error(f"--piles {options.piles}; expected two or more, whose slopes have an error")
    wanted = [(shape, seed) for seed in seeds for shape in SHAPES[::-1]]
    found = dict(zip(wanted, run_jobs(
        lambda item: pile(HERE / root / f"{item[0].name}_{item[1]}", item[0], ledge, item[1]), wanted, options.jobs)))
    slopes = {shape.name: [slope(found[shape, seed], ledge) for seed in seeds] for shape in SHAPES}
    angles = {name: block_mean(values) for name, values in slopes.items()}
    lines = [f"{name:<8} {angles[name].value:6.2f} degrees ± {angles[name].error:.2f}, piles: "
             + ", ".join(f"{one:.2f}" for one in values) for name, values in slopes.items()]
    judged = verdicts(angles)
    lines += [f"{verdict}: {sentence}" for verdict, sentence in judged]
    if any(verdict == UNDECIDED for verdict, _ in judged):
        lines.append("More piles decide it: --piles N")
    write_table(lines, HERE / "repose.txt")
    draw({shape.name: found[shape, seeds[0]] for shape in SHAPES}, angles, ledge).savefig(
        HERE / "repose.png", dpi=130)
    return 1 if any(verdict != HOLDS for verdict, _ in judged) else 0


if __name__ == "__main__":
    sys.exit(main())
