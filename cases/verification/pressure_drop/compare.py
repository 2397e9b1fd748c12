#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs beds of moving balls in closed boxes and compares the pressure drop across each with its drag law.

The law's own gradient is beta v/e with beta from `millDrag`, whose F is checked elsewhere against independent values.
Exit code 1 when a bed misses the tolerance."""
import argparse
import csv
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from millfoam import foam
from millfoam.run import run as run_program
from millfoam.run import write_parameters

DENSITY, VISCOSITY, DIAMETER = 1000.0, 1e-3, 5e-3
BOXES = {"8 m": 1.0, "8 cm": 0.01}
CELLS = (32, 8, 8)
CELL = 0.25  # edge of a cell in units of the box's scale
FIRST_CELL = 8  # of every bed
TOLERANCE = 5e-3
STEPS = 10
# beta dt/(e rho): below 0.002 the drag, explicit in the pressure equation, costs less than the tolerance
STIFFNESS = 1e-3
# Reynolds numbers on both sides of every switch in Re that the laws have at these solidities: Hill 2.7 and 6.6,
# Benyahia 4.7 and 6.6, Wen-Yu 1000. Their switches in phi (0.2, 0.4) lie between the solidities.
SOLIDITIES = (0.15, 0.5)
BRANCHES = (0.5, 50.0, 2000.0)
REYNOLDS = (0.5, 5.0, 50.0, 500.0, 2000.0)
LENGTHS = (4, 8, 16)  # cells


@dataclass
class Bed:
    """A bed of one law in one box; drops in Pa over its length in m."""
    box: str
    law: str
    solidity: float
    reynolds: float
    cells: int
    beta: float
    speed: float
    length: float
    analytic: float
    numerical: float = np.nan
    overshoot: float = np.nan  # of the pressure beside the bed's ends, over the drop
    spurious: float = np.nan  # largest |u| over the balls' speed

    @property
    def error(self):
        return self.numerical / self.analytic - 1


def beds(quick):
    """Every bed of the study; with `quick` one length and three speeds, which still visit every branch of every law."""
    chosen = BRANCHES if quick else REYNOLDS
    table = subprocess.run(
        ["millDrag", "--phi", ",".join(map(str, SOLIDITIES)), "--re", ",".join(map(str, chosen)),
         "--mu", str(VISCOSITY), "--rho", str(DENSITY), "--d", str(DIAMETER)],
        check=True, capture_output=True, text=True).stdout
    rows = list(csv.DictReader(table.splitlines()))
    result = []
    for box, scale in BOXES.items():
        for row in rows:
            phi, reynolds, beta = float(row["phi"]), float(row["Re"]), float(row["beta"])
            speed = reynolds * VISCOSITY / (DENSITY * (1 - phi) * DIAMETER)
            for cells in LENGTHS[:1] if quick else LENGTHS:
                length = cells * CELL * scale
                drop = beta * speed / (1 - phi) * length
                result.append(Bed(box, row["law"], phi, reynolds, cells, beta, speed, length, drop))
    return result


def run(bed, number, work, template):
    """Runs one bed in its own folder under `work` and fills in what it showed."""
    scale = BOXES[bed.box]
    case = work / f"bed{number:03d}"
    shutil.copytree(template, case)
    step = STIFFNESS * (1 - bed.solidity) * DENSITY / bed.beta
    write_parameters(
        case, scale=scale, steps=STEPS, step=step, endTime=STEPS * step, density=DENSITY, viscosity=VISCOSITY,
        kinematicViscosity=VISCOSITY / DENSITY, law=bed.law, bedBegin=FIRST_CELL * CELL * scale,
        bedEnd=(FIRST_CELL + bed.cells) * CELL * scale, solidity=bed.solidity, ballSpeed=bed.speed,
        diameter=DIAMETER)
    run_program(case, "blockMesh")
    run_program(case, "millInterFoam")
    measure(bed, case)
    if abs(bed.error) <= TOLERANCE:
        shutil.rmtree(case)


def measure(bed, case):
    """Drop between the fluid at rest on the two sides of the bed, and the largest velocity that is left.

    The pressure is read in the boxes' end sections: within some four cells of the bed's sharp ends a collocated
    pressure oscillates, by `overshoot` of the drop."""
    _, last = foam.times(case)[-1]
    cells = int(np.prod(CELLS))
    # blockMesh numbers x fastest
    pressure = foam.read_field(last / "p_rgh", cells).reshape(CELLS[::-1]).mean(axis=(0, 1))
    bed.numerical = pressure[-1] - pressure[0]
    bed.overshoot = (pressure.max() - pressure.min()) / bed.numerical - 1
    bed.spurious = np.linalg.norm(foam.read_field(last / "U", cells), axis=1).max() / bed.speed


def print_table(results, out):
    head = f"{'box':>5} {'law':<11} {'phi':>5} {'Re':>7} {'cells':>5} {'law Pa':>12} {'found Pa':>12} {'error %':>9} " \
           f"{'overshoot %':>11} {'|u|/u_s':>9}"
    lines = [head]
    for bed in results:
        lines.append(f"{bed.box:>5} {bed.law:<11} {bed.solidity:5.2f} {bed.reynolds:7.1f} {bed.cells:5d} "
                     f"{bed.analytic:12.5g} {bed.numerical:12.5g} {100 * bed.error:9.4f} "
                     f"{100 * bed.overshoot:11.2f} {bed.spurious:9.2e}")
    worst = max(results, key=lambda bed: abs(bed.error))
    spurious = max(results, key=lambda bed: bed.spurious)
    missed = sum(not abs(bed.error) <= TOLERANCE for bed in results)
    lines.append(f"{len(results)} beds; largest error {100 * abs(worst.error):.4f} % ({worst.law}, phi {worst.solidity}, "
                 f"Re {worst.reynolds:g}, {worst.cells} cells, {worst.box} box); largest spurious |u|/u_s "
                 f"{spurious.spurious:.2e}; {missed} missed the tolerance of {100 * TOLERANCE} %")
    print("\n".join(lines))
    out.write_text("\n".join(lines) + "\n")
    return missed


def plot(results, out):
    panels = [
        ("law, Pa", lambda bed: bed.analytic, "log"),
        ("computed, Pa", lambda bed: bed.numerical, "log"),
        ("|difference|, Pa", lambda bed: abs(bed.numerical - bed.analytic), "log"),
        ("|relative error|, %", lambda bed: 100 * abs(bed.error), "log"),
    ]
    laws = list(dict.fromkeys(bed.law for bed in results))
    longest = max(bed.cells for bed in results)
    colours = plt.get_cmap("tab10")

    def place(bed):
        """Laws stand side by side at each Reynolds number."""
        return bed.reynolds * 1.12 ** (laws.index(bed.law) - len(laws) / 2)

    figure, axes = plt.subplots(len(BOXES), 4, figsize=(16, 7.5), squeeze=False, sharex=True, constrained_layout=True)
    for row, box in zip(axes, BOXES):
        for axis, (title, value, scale) in zip(row, panels):
            for bed in (bed for bed in results if bed.box == box):
                axis.plot(place(bed), value(bed), "o" if bed.solidity < 0.3 else "s", ms=2 + bed.cells / 4, mfc="none",
                          color=colours(laws.index(bed.law)))
            for law in laws:
                for phi in SOLIDITIES:
                    line = [bed for bed in results if (bed.box, bed.law, bed.solidity, bed.cells) == (box, law, phi, longest)]
                    axis.plot([place(bed) for bed in line], [value(bed) for bed in line], lw=0.7,
                              color=colours(laws.index(law)))
            axis.set(xscale="log", yscale=scale, title=f"{box} box: {title}")
            axis.grid(alpha=0.3)
        row[3].axhline(100 * TOLERANCE, color="k", ls="--", lw=1)
        row[3].annotate("tolerance", (REYNOLDS[0], 100 * TOLERANCE), va="bottom", fontsize=8)
    for axis in axes[-1]:
        axis.set_xlabel("Reynolds number (laws side by side)")
    handles = [plt.Line2D([], [], marker="o", ls="", color=colours(i), label=law) for i, law in enumerate(laws)]
    handles += [plt.Line2D([], [], marker=m, ls="", color="k", mfc="none", label=f"φ = {phi}")
                for m, phi in zip("os", SOLIDITIES)]
    figure.legend(handles=handles, loc="lower center",
                  ncol=len(handles), fontsize=8, bbox_to_anchor=(0.5, -0.05))
    figure.suptitle("Pressure drop across a bed of moving balls in a closed box (size of marker: length of bed)")
    figure.savefig(out, dpi=110, bbox_inches="tight")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true", help="beds of four cells only")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    here = Path(__file__).parent.resolve()
    work = here / "runs"
    shutil.rmtree(work, ignore_errors=True)
    results = beds(options.quick)
    with ThreadPoolExecutor(options.jobs) as pool:
        list(pool.map(lambda item: run(item[1], item[0], work, here / "template"), enumerate(results)))
    missed = print_table(results, here / "pressure_drop.txt")
    plot(results, here / "pressure_drop.png")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
