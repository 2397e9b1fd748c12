#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs beds of moving balls in closed boxes and in ducts, and compares the pressure drop across each with its drag law.

The gradient is that of the publication (published_laws.py), a function of the superficial slip. millDrag's beta v/e,
with the interstitial slip v, must be the same. Exit code 1 if a bed exceeds the tolerance of its solver."""
import csv
import itertools
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

import published_laws
from millfoam.files import foam
from millfoam.run import run as run_program
from millfoam.run import case_options, copy_case, fresh_runs, marked, run_jobs, write_parameters, write_table

matplotlib.use("Agg")

RESOURCES = Path(__file__).resolve().parents[1] / "resources"
DENSITY, VISCOSITY, DIAMETER = 1000.0, 1e-3, 5e-3
BOXES = {"8 m": 1.0, "8 cm": 0.01}
CELLS = 32  # along the box
CELL = 0.25  # edge of a cell along the box in units of the box's scale
# Of the relative error, and beta dt/(e rho). With particleDrag the drag is explicit in the pressure equation, and below
# 0.002 that costs less than the tolerance. In slurryFoam it is implicit, and its explicit part is balanced at the
# faces.
SOLVERS = {"millInterFoam": (5e-3, 1e-3), "slurryFoam": (1e-6, 1.0), "slurryFoam, flow": (1e-6, 1.0)}
PRINTED = 1e-9  # of millDrag's gradient, over the publication's: it prints twelve digits
STEPS = 10
# Cells that the balls pass in a time-step: the contraction at a bed's sharp ends is explicit, and was unstable from 260
# on
MOST_PASSED = 20
# A flow through the duct is that much faster than its balls, whose speed is the slip. The same slip of superficial
# velocities would be far from it: 0 at the solidity 0.5.
FLUID_SPEED = 2
# Reynolds numbers on both sides of every switch in Re that the laws have at these solidities: Fand 2.3, 5, 80 and 120,
# Hill 2.7 and 6.6, Benyahia 4.7 and 6.6, Wen-Yu 1000. Switches in phi (0.2, 0.4) lie between the solidities.
SOLIDITIES = (0.15, 0.5)
REYNOLDS = (0.5, 5.0, 50.0, 500.0, 2000.0)
# First cell of a bed and its length in cells. interFoam's pressure at a wall has no drag, so its beds end inside.
PLACES = {
    "millInterFoam": ((8, 4), (8, 8), (8, 16)),
    "slurryFoam": ((8, 8), (0, 16), (0, CELLS)),
    "slurryFoam, flow": ((0, CELLS),),
}
# With --quick: solver, solidity, place, Reynolds number and laws (all where there are none)
QUICK = (
    ("slurryFoam", 0.15, (8, 4), 0.5, ()),
    ("slurryFoam", 0.5, (0, CELLS), 50.0, ()),
    ("slurryFoam, flow", 0.5, (0, CELLS), 50.0, ()),
    ("millInterFoam", 0.5, (8, 4), 50.0, ("Ergun", "Hill", "Beetstra")),
)


@dataclass
class Bed:
    """A bed of one law in one box; drops in Pa over what of its length, in m, lies between the end cells' centres."""
    solver: str
    box: str
    across: int  # cells of the box's edges across
    law: str
    solidity: float
    reynolds: float
    first: int
    cells: int
    beta: float
    numerical: float = np.nan
    overshoot: float = np.nan  # of the pressure close to the bed's ends, over the drop
    spurious: float = np.nan  # largest |u| over the balls' speed, in a flow its difference from that which comes in

    @property
    def flows(self):
        return self.solver.endswith("flow")

    @property
    def speed(self):
        """Of the balls, m/s, which is the interstitial slip."""
        return self.reynolds * VISCOSITY / (DENSITY * (1 - self.solidity) * DIAMETER)

    @property
    def cell(self):
        return CELL * BOXES[self.box]

    @property
    def length(self):
        return (min(self.first + self.cells, CELLS - 0.5) - max(self.first, 0.5)) * self.cell

    @property
    def analytic(self):
        gradient = published_laws.GRADIENTS[self.law]
        return gradient(self.solidity, (1 - self.solidity) * self.speed, DIAMETER, VISCOSITY, DENSITY) * self.length

    @property
    def printed(self):
        """millDrag's gradient over the publication's, less one."""
        return self.beta * self.speed / (1 - self.solidity) * self.length / self.analytic - 1

    @property
    def step(self):
        relaxed = SOLVERS[self.solver][1] * (1 - self.solidity) * DENSITY / self.beta
        return min(relaxed, (0.5 / FLUID_SPEED if self.flows else MOST_PASSED) * self.cell / self.speed)

    @property
    def error(self):
        return self.numerical / self.analytic - 1

    @property
    def tolerance(self):
        return SOLVERS[self.solver][0]

    @property
    def missed(self):
        return not (abs(self.error) <= self.tolerance and abs(self.printed) <= PRINTED)


def exchange_coefficients():
    """Rows of millDrag for every law, solidity and Reynolds number. ValueError if one is missing, or one is of another
    law than those of published_laws.py."""
    table = subprocess.run(
        ["millDrag", "--phi", ",".join(map(str, SOLIDITIES)), "--re", ",".join(map(str, REYNOLDS)),
         "--mu", str(VISCOSITY), "--rho", str(DENSITY), "--d", str(DIAMETER)],
        check=True, capture_output=True, text=True).stdout
    rows = list(csv.DictReader(table.splitlines()))
    found = {(row["law"], float(row["phi"]), float(row["Re"])) for row in rows}
    expected = set(itertools.product(published_laws.GRADIENTS, SOLIDITIES, REYNOLDS))
    for words, those in (("not printed by millDrag", expected - found), ("not in published_laws.py", found - expected)):
        if those:
            raise ValueError(f"{words}: " + "; ".join(f"{law}, phi {phi:g}, Re {re:g}" for law, phi, re in
                                                      sorted(those)))
    return rows


def beds():
    """Every bed of the study."""
    return [
        Bed(solver, box, 8, row["law"], float(row["phi"]), float(row["Re"]), first, cells, float(row["beta"]))
        for row in exchange_coefficients() for solver, places in PLACES.items() for first, cells in places
        for box in BOXES
    ]


def quick_beds():
    """Every law with slurryFoam in dilute and dense beds, and a few with particleDrag, in a narrow box. ValueError if
    an entry of QUICK names what millDrag was not asked for."""
    betas = {(row["law"], float(row["phi"]), float(row["Re"])): float(row["beta"]) for row in exchange_coefficients()}
    found = []
    for solver, phi, (first, cells), reynolds, laws in QUICK:
        for law in laws or published_laws.GRADIENTS:
            if (law, phi, reynolds) not in betas:
                raise ValueError(f"QUICK: {law}, phi {phi}, Re {reynolds} is no row of millDrag; expected one of "
                                 f"SOLIDITIES {SOLIDITIES}, REYNOLDS {REYNOLDS} and the laws of published_laws.py")
            found.append(Bed(solver, "8 cm", 2, law, phi, reynolds, first, cells, betas[law, phi, reynolds]))
    return found


def make_meshes(work, template, across):
    """One case with the mesh of each box, to copy."""
    for box, scale in BOXES.items():
        case = work / box.replace(" ", "")
        copy_case(case, RESOURCES / "common", template / "common")
        write_parameters(case, scale=scale, across=across, solver="blockMesh", endTime=1, step=1, steps=1)
        run_program(case, "blockMesh")


def run(bed, number, work, template):
    """Runs one bed in its own folder under `work` and fills in what it showed."""
    case = work / f"bed{number:04d}"
    program = bed.solver.split(",")[0]
    copy_case(case, work / bed.box.replace(" ", ""), template / program, *([template / "flow"] if bed.flows else []))
    write_parameters(
        case, solver=program, steps=STEPS, step=bed.step, endTime=STEPS * bed.step, slurryDensity=DENSITY,
        viscosity=VISCOSITY, convection="linearUpwind grad(U)", slurryKinematicViscosity=VISCOSITY / DENSITY,
        law=bed.law, bedBegin=bed.first * bed.cell, bedEnd=(bed.first + bed.cells) * bed.cell, solidity=bed.solidity,
        ballSpeed=bed.speed, diameter=DIAMETER, fluidSpeed=FLUID_SPEED * bed.speed)
    run_program(case, program)
    measure(bed, case)
    if not bed.missed:
        shutil.rmtree(case)


def measure(bed, case):
    """Drop between the end sections of the box, and the largest velocity that is left.

    With particleDrag the pressure oscillates within some four cells of a bed's sharp ends, by `overshoot` of the
    drop; therefore the sections are at the box's ends."""
    _, last = foam.times(case)[-1]
    cells = CELLS * bed.across**2
    # blockMesh numbers x fastest
    pressure = foam.read_field(last / "p_rgh", cells).reshape(bed.across, bed.across, CELLS).mean(axis=(0, 1))
    bed.numerical = pressure[0] - pressure[-1] if bed.flows else pressure[-1] - pressure[0]
    bed.overshoot = (pressure.max() - pressure.min()) / bed.numerical - 1
    velocity = foam.read_field(last / "U", cells) - [FLUID_SPEED * bed.speed if bed.flows else 0, 0, 0]
    bed.spurious = np.linalg.norm(velocity, axis=1).max() / bed.speed


def summary(results):
    """One line a solver; the last line of the table says how many missed."""
    for solver, (tolerance, _) in SOLVERS.items():
        own = [bed for bed in results if bed.solver == solver]
        if not own:
            continue
        worst = max(own, key=lambda bed: abs(bed.error))
        spurious = max(bed.spurious for bed in own)
        yield (f"{solver}: {len(own)} beds; largest error {100 * abs(worst.error):.2g} % ({worst.law}, phi "
               f"{worst.solidity}, Re {worst.reynolds:g}, cells {worst.first} to {worst.first + worst.cells}, "
               f"{worst.box} box), tolerance {100 * tolerance:g} %; largest spurious |u|/u_s {spurious:.1e}")
    yield f"{sum(bed.missed for bed in results)} of {len(results)} beds missed their tolerance"


def print_table(results, out):
    head = f"{'solver':<16} {'box':>5} {'law':<12} {'phi':>5} {'Re':>7} {'first':>5} {'cells':>5} " \
           f"{'published Pa':>12} {'millDrag':>9} {'found Pa':>12} {'error %':>9} {'overshoot %':>11} {'|u|/u_s':>9}"
    lines = [head]
    for bed in results:
        lines.append(marked(
            f"{bed.solver:<16} {bed.box:>5} {bed.law:<12} {bed.solidity:5.2f} {bed.reynolds:7.1f} {bed.first:5d} "
            f"{bed.cells:5d} {bed.analytic:12.5g} {bed.printed:9.1e} {bed.numerical:12.5g} {100 * bed.error:9.1e} "
            f"{100 * bed.overshoot:11.1e} {bed.spurious:9.1e}", bed.missed))
    lines += summary(results)
    write_table(lines, out)


def place(bed, laws):
    """The place of a bed in the picture: laws side by side at each Reynolds number."""
    return bed.reynolds * 1.09 ** (laws.index(bed.law) - len(laws) / 2)


def plot(results, out):
    laws = list(dict.fromkeys(bed.law for bed in results))
    colours = plt.get_cmap("tab20")
    figure, axes = plt.subplots(len(SOLVERS), 2, figsize=(14, 11), squeeze=False, sharex=True, constrained_layout=True)
    for (solver, (tolerance, _)), (drop, error) in zip(SOLVERS.items(), axes):
        for bed in (bed for bed in results if bed.solver == solver):
            style = dict(ms=3 + bed.cells / 6, mfc="none", color=colours(laws.index(bed.law)), ls="",
                         marker="o" if bed.solidity < 0.3 else "s")
            at = place(bed, laws)
            drop.plot(at, bed.numerical / bed.length, **style)
            drop.plot([at * 0.97, at * 1.03], [bed.analytic / bed.length] * 2, "k-", lw=1)
            error.plot(at, max(100 * abs(bed.error), 1e-14), **style)
        error.axhline(100 * tolerance, color="k", ls="--", lw=1)
        error.annotate("tolerance", (REYNOLDS[0], 100 * tolerance), va="bottom", fontsize=8)
        drop.set(xscale="log", yscale="log", title=f"{solver}: gradient, Pa/m (dash: the law's)")
        error.set(xscale="log", yscale="log", title=f"{solver}: |relative error|, %")
        for axis in (drop, error):
            axis.grid(alpha=0.3)
    for axis in axes[-1]:
        axis.set_xlabel("Reynolds number (laws side by side)")
    handles = [plt.Line2D([], [], marker="o", ls="", color=colours(i), label=law) for i, law in enumerate(laws)]
    handles += [plt.Line2D([], [], marker=m, ls="", color="k", mfc="none", label=f"φ = {phi}")
                for m, phi in zip("os", SOLIDITIES)]
    figure.legend(handles=handles, loc="lower center", ncol=8, fontsize=8, bbox_to_anchor=(0.5, -0.08))
    figure.suptitle("Pressure drop across a bed of moving balls in a box or a duct (size of marker: length of bed)")
    figure.savefig(out, dpi=110, bbox_inches="tight")


def main():
    options = case_options(__doc__, quick="a few beds of every law in a narrow box")
    here = Path(__file__).parent.resolve()
    work = fresh_runs(here)
    results = quick_beds() if options.quick else beds()
    make_meshes(work, here / "template", results[0].across)
    run_jobs(lambda item: run(item[1], item[0], work, here / "template"), enumerate(results), options.jobs)
    print_table(results, here / "pressure_drop.txt")
    plot(results, here / "pressure_drop.png")
    return 1 if any(bed.missed for bed in results) else 0


if __name__ == "__main__":
    sys.exit(main())
