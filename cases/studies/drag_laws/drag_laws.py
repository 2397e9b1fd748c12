#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tabulates and draws every drag law over Reynolds number, solidity and velocity, and finds where Ergun crosses
Beetstra at solidity 0.5.

All numbers and ranges come from `millDrag`. Exit code 1 when the crossing is not the one that Malahe's thesis
(University of Cape Town, 2012, figure 2.8) shows, near Re 50."""
import csv
import subprocess
import sys
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

from millfoam.files.data_files import write_csv

matplotlib.use("Agg")

SOLIDITIES = (0.0, 0.15, 0.3, 0.5, 0.6)
REYNOLDS = (0.1, 10.0, 100.0, 1000.0)
REYNOLDS_AXIS = np.logspace(-2, 4, 241)
SOLIDITY_AXIS = np.linspace(0.005, 0.64, 128)
VELOCITY_AXIS = np.logspace(-4, 0, 161)  # superficial, m/s
DIAMETER = 5e-3
BED_SOLIDITIES = (0.5, 0.6)
# Slurry with 30 % solids by mass: plastic viscosity alone, and the apparent viscosity in the pores
FLUIDS = {
    "water": {"rho": 1000, "mu": 1e-3},
    "30 % slurry, plastic viscosity": {"rho": 1239, "mu": 0.0014},
    "30 % slurry, viscosity in the pores": {"rho": 1239, "mu": 0.0014, "tau0": 0.16, "viscosity-ratio": 1000},
}
CROSSING_SOLIDITY, CROSSING_REYNOLDS, CROSSING_FACTOR = 0.5, 50.3, 72.5
# Half of the last digit of the two expected numbers
TOLERANCE = 0.05

REFERENCE = "Beetstra"  # the law over which ratios are drawn
# Colour by family: beds of spheres (warm), single sphere times a function of voidage (green, brown), resolved
# simulations (blue, violet, grey)
STYLES = {
    "Ergun": ("#d62728", "o"), "Fand": ("#ff7f0e", "s"), "KozenyCarman": ("#e377c2", "^"), "Darcy": ("#f2b701", "v"),
    "WenYu": ("#2ca02c", "o"), "ErgunWenYu": ("#8c564b", "s"), "DiFelice": ("#17becf", "^"), "Rong": ("#8fb300", "v"),
    "Hill": ("#1f77b4", "o"), "Benyahia": ("#9467bd", "s"), "Beetstra": ("#000000", "^"), "Tang": ("#7f7f7f", "v"),
    "Tenneti": ("#0b2f8a", "D"),
}


def mill_drag(**options):
    """Rows of millDrag's table as dictionaries, numbers as floats."""
    words = ["millDrag"]
    for name, value in options.items():
        words.append(f"--{name}")
        if value is not True:
            words.append(",".join(f"{number:.12g}" for number in value) if np.iterable(value)
                         and not isinstance(value, str)
                         else str(value))
    table = subprocess.run(words, check=True, capture_output=True, text=True).stdout
    text = ("law", "reference")
    return [{key: word if key in text else float(word) for key, word in row.items()}
            for row in csv.DictReader(table.splitlines())]


def ranges():
    """Law: its range, in the table's order."""
    return {row["law"]: row for row in mill_drag(ranges=True)}


def inside(limits, solidity, reynolds):
    """1 within the law's range. Solidity 0 means the limit of a single ball, not the absence of drag."""
    return int(limits["phi_min"] <= solidity <= limits["phi_max"] and limits["Re_min"] <= reynolds <= limits["Re_max"])


def marked(rows, limits):
    """The rows with `in_range` added."""
    return [{**row, "in_range": inside(limits[row["law"]], row["phi"], row["Re"])} for row in rows]


def sign_changes(reynolds):
    """Pairs (i, i + 1) of the given Reynolds numbers between which Ergun - Beetstra changes sign, and Ergun's F."""
    factor = {law: np.array([row["F"] for row in mill_drag(law=law, phi=CROSSING_SOLIDITY, re=reynolds)])
              for law in ("Ergun", "Beetstra")}
    above = factor["Ergun"] > factor["Beetstra"]
    return np.flatnonzero(above[1:] != above[:-1]), factor["Ergun"]


def crossing():
    """Re and F at which Ergun crosses Beetstra; None when it does not, or not once, over the Reynolds axis."""
    reynolds = REYNOLDS_AXIS
    while True:
        changes, factor = sign_changes(reynolds)
        if len(changes) != 1:
            return None
        low, high = reynolds[changes[0]], reynolds[changes[0] + 1]
        if high - low < 1e-6 * high:
            return low, factor[changes[0]]
        reynolds = np.linspace(low, high, 101)


def draw_law(axis, x, y, in_range, law):
    """One law's curve: solid within its range, thin and dashed outside it, with a few markers."""
    colour, marker = STYLES[law]
    in_range = np.asarray(in_range, bool)
    # A solid piece reaches to the first point outside, so that no gap shows
    joined = in_range | np.roll(in_range, 1) & (np.arange(len(in_range)) > 0)
    axis.plot(x, y, "--", lw=0.9, color=colour, alpha=0.75)
    axis.plot(x, np.where(joined, y, np.nan), "-", lw=1.9, color=colour)
    every = len(x) // 8
    start = list(STYLES).index(law) * every // len(STYLES)  # markers of different laws next to each other
    axis.plot(x[start::every], y[start::every], marker, ms=5, mfc="none", color=colour, mew=1.1)


def draw_panels(panels, name, out, title):
    """Columns of (heading, rows, mark): F above, F over the reference law's below; `name` is the key of the
    abscissa."""
    label = {"Re": "Reynolds number ρ e v d/μ, –", "phi": "solidity φ, –"}[name]
    figure, axes = plt.subplots(2, len(panels), figsize=(4.4 * len(panels), 9.5), sharex=True, sharey="row",
                                constrained_layout=True)
    for (heading, rows, mark), (above, below) in zip(panels, axes.T):
        curves = {law: [row for row in rows if row["law"] == law] for law in STYLES}
        reference = np.array([row["F"] for row in curves[REFERENCE]])
        for law, points in curves.items():
            x, factor, in_range = (np.array([row[key] for row in points]) for key in (name, "F", "in_range"))
            factor = np.where(factor > 0, factor, np.nan)
            draw_law(above, x, factor, in_range, law)
            draw_law(below, x, factor / reference, in_range, law)
        for axis in (above, below):
            axis.set(xscale="log" if name == "Re" else "linear", yscale="log")
            axis.grid(alpha=0.25, which="both", lw=0.5)
        above.set(title=heading)
        below.set(xlabel=label)
        if mark:
            mark_crossing(above, below, *mark)
    axes[0, 0].set(ylabel="F, –", ylim=(0.3, 2e4))
    axes[1, 0].set(ylabel=f"F over {REFERENCE}'s, –", ylim=(0.2, 5), yticks=(0.2, 0.5, 1, 2, 5))
    axes[1, 0].yaxis.set_major_formatter("{x:g}")
    axes[1, 0].yaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())
    finish(figure, out, title)


def mark_crossing(above, below, reynolds, factor):
    text = f"Ergun = Beetstra\nRe {reynolds:.1f}, F {factor:.1f}"
    for axis, at in ((above, factor), (below, 1)):
        axis.plot(reynolds, at, "o", ms=13, mfc="none", mec="k", mew=1.6)
    above.annotate(text, (reynolds, factor), (0.05, 0.9), textcoords="axes fraction", va="top", fontsize=10,
                   arrowprops={"arrowstyle": "-", "shrinkB": 7})


def finish(figure, out, title):
    handles = [plt.Line2D([], [], color=colour, marker=marker, mfc="none", lw=1.9, label=law)
               for law, (colour, marker) in STYLES.items()]
    handles.append(plt.Line2D([], [], color="0.4", ls="--", lw=0.9, label="outside its range"))
    figure.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0), ncol=7, fontsize=11)
    figure.suptitle(title)
    figure.savefig(out, dpi=100, bbox_inches="tight")
    plt.close(figure)


def study_reynolds(limits, found, folder):
    rows = marked(mill_drag(phi=SOLIDITIES, re=REYNOLDS_AXIS), limits)
    write_csv(folder / "factor_reynolds.csv", rows)
    panels = [(f"φ = {phi:g}", [row for row in rows if row["phi"] == phi], found if phi == CROSSING_SOLIDITY else None)
              for phi in SOLIDITIES]
    draw_panels(panels, "Re", folder / "factor_reynolds.png",
                "Force on a ball of a bed over Stokes's, F, against Reynolds number")


def study_solidity(limits, folder):
    rows = marked(mill_drag(phi=SOLIDITY_AXIS, re=REYNOLDS), limits)
    write_csv(folder / "factor_solidity.csv", rows)
    panels = [(f"Re = {re:g}", [row for row in rows if row["Re"] == re], None) for re in REYNOLDS]
    draw_panels(panels, "phi", folder / "factor_solidity.png",
                "Force on a ball of a bed over Stokes's, F, against solidity")


def study_gradient(limits, folder):
    """Pressure gradient in fixed beds of three fluids."""
    rows = [{"fluid": fluid, **row} for fluid, options in FLUIDS.items()
            for row in marked(mill_drag(phi=BED_SOLIDITIES, superficial=VELOCITY_AXIS, d=DIAMETER, **options), limits)]
    write_csv(folder / "pressure_gradient.csv", rows)
    figure, axes = plt.subplots(len(BED_SOLIDITIES), len(FLUIDS), figsize=(16, 11), sharex=True, sharey=True,
                                constrained_layout=True)
    for line, phi in zip(axes, BED_SOLIDITIES):
        for axis, fluid in zip(line, FLUIDS):
            for law in STYLES:
                points = [row for row in rows if (row["fluid"], row["phi"], row["law"]) == (fluid, phi, law)]
                x, gradient, in_range = (np.array([row[key] for row in points]) for key in ("U", "dpdx", "in_range"))
                draw_law(axis, x, gradient, in_range, law)
            axis.set(xscale="log", yscale="log", title=f"{fluid}, φ = {phi:g}")
            axis.grid(alpha=0.25, which="both", lw=0.5)
        line[0].set(ylabel="pressure gradient −dp/dx, Pa/m")
    for axis in axes[-1]:
        axis.set(xlabel="superficial velocity U = e v, m/s")
    finish(figure, folder / "pressure_gradient.png", f"Pressure gradient in a bed of {1e3 * DIAMETER:g} mm balls")


def spread_table(limits):
    """The spread of the laws that are within their range, at a few points."""
    lines = [f"{'phi':>5} {'Re':>6} {'smallest F':>24} {'largest F':>24} {'ratio':>6}   (laws within their range)"]
    for row_phi in SOLIDITIES[1:]:
        for re in REYNOLDS:
            points = [row for row in marked(mill_drag(phi=row_phi, re=re), limits) if row["in_range"]]
            least, most = min(points, key=lambda row: row["F"]), max(points, key=lambda row: row["F"])
            lines.append(f"{row_phi:5.2f} {re:6g} {least['law']:>13} {least['F']:10.4g} {most['law']:>13} "
                         f"{most['F']:10.4g} {most['F'] / least['F']:6.2f}")
    return lines


def judge(found):
    """Whether the crossing is the expected one, and a sentence about it."""
    expected = f"expected Re {CROSSING_REYNOLDS}, F {CROSSING_FACTOR}"
    if found is None:
        where = f"at solidity {CROSSING_SOLIDITY}"
        return False, f"Ergun and Beetstra do not cross exactly once {where}; {expected}: MISSED"
    good = all(abs(a - b) <= TOLERANCE for a, b in zip(found, (CROSSING_REYNOLDS, CROSSING_FACTOR)))
    return good, (f"Ergun crosses Beetstra at solidity {CROSSING_SOLIDITY}: Re {found[0]:.3f}, F {found[1]:.3f}; "
                  f"{expected}"
                  + ("" if good else ": MISSED"))


def main():
    folder = Path(__file__).parent.resolve()
    limits = ranges()
    if set(limits) != set(STYLES):
        sys.exit(f"drag_laws.py: millDrag lists the laws {', '.join(limits)}; STYLES here has {', '.join(STYLES)}")
    found = crossing()
    study_reynolds(limits, found, folder)
    study_solidity(limits, folder)
    study_gradient(limits, folder)
    good, sentence = judge(found)
    lines = spread_table(limits) + [sentence]
    print("\n".join(lines))
    (folder / "drag_laws.txt").write_text("\n".join(lines) + "\n")
    for name in ("factor_reynolds", "factor_solidity", "pressure_gradient"):
        print(f"{folder / name}.csv, .png")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
