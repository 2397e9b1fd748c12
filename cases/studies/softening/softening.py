#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The 12 cm mill's slice with balls of three moduli: maps of solidity and velocity compared with the stiffest's,
power, overlap and cost. The same mill with another seed shows the difference of two equal mills. Complete runs are
kept."""
import argparse
from itertools import pairwise
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

from millfoam.files.data_files import write_csv
from millfoam.readings.compare import difference
from millstudies.dry_runs import make_dry_run
from millstudies.mean_columns import value_text
from millstudies.mill_runs import MILL, resolved
from millstudies.published_mills import averages

matplotlib.use("Agg")

HERE = Path(__file__).parent.resolve()
MODULI = (1e7, 1e8, 1e9)
SEEDS = (20121, 20122)  # the other seed: of all but the stiffest
DENSE = 0.05  # solidity from which on a voxel's speed is shown
VOXELS = 24  # across the mill
WHOLE, QUICK = (1.6, 0.6), (0.2, 0.1)  # duration, begin of the averages, s
COLUMNS = ("run", "modulus_Pa", "time_step_us", "wall_time_s", "power_W", "power_error_W", "overlap_largest_percent",
           "overlap_99_percent", "solidity_difference", "velocity_x_difference", "velocity_y_difference",
           "centroid_x_mm", "centroid_y_mm")


def settings(quick):
    """(name, modulus, seed) of every run, the stiffest last."""
    moduli = MODULI[:2] if quick else MODULI
    for modulus in moduli:
        exponent = round(np.log10(modulus))
        for seed in SEEDS[:1] if modulus == moduli[-1] else SEEDS:
            yield f"1e{exponent}" + ("" if seed == SEEDS[0] else "_other_seed"), modulus, seed


def make(name, modulus, seed, quick):
    duration, start = QUICK if quick else WHOLE
    mill = resolved(MILL, (f"dem.youngs_modulus={modulus:g}", f"dem.seed={seed}", f"dem.duration={duration:g}",
                           averages(VOXELS, start, duration - start)))
    print(f"{name} …", flush=True)
    return make_dry_run(HERE / ("runs_quick" if quick else "runs") / name, mill)


def row(dry, modulus, stiffest):
    """One line of the table; differences are to the stiffest run's map."""
    smallest = dry.number("smallest_diameter_m")
    apart = difference(dry.charge, stiffest.charge)
    x, y = dry.charge.centroid()
    return dict(zip(COLUMNS, (dry.name, modulus, 1e6 * dry.number("timestep_s"), dry.number("wall_time_s"),
                              dry.number("power_W"), dry.number("power_error_W"),
                              100 * dry.number("ball_overlap_largest_m") / smallest,
                              100 * dry.number("ball_overlap_99_m") / smallest, apart.solidity, apart.velocity_x,
                              apart.velocity_y, 1e3 * x, 1e3 * y)))


def chance_rows(runs, chosen):
    """Lines of the table with the differences of two runs that differ in the seed alone: DryRun in `runs`, each of the
    setting (name, modulus, seed) in `chosen`."""
    for (dry, (name, modulus, _)), (other, (_, its_modulus, _)) in pairwise(zip(runs, chosen)):
        if modulus == its_modulus:
            apart = difference(dry.charge, other.charge)
            yield {"run": f"{name}, two seeds", "modulus_Pa": modulus, "solidity_difference": apart.solidity,
                   "velocity_x_difference": apart.velocity_x, "velocity_y_difference": apart.velocity_y}


def write_table(rows, chance, path):
    write_csv(path.with_suffix(".csv"), [*rows, *chance])
    lines = [f"{'run':<16}{'step us':>9}{'wall s':>8}{'power W':>16}{'overlap %':>16}{'solidity':>10}{'vel. x':>8}"
             f"{'vel. y':>8}{'centroid mm':>17}"]
    for r in rows:
        power = value_text(r["power_W"], r["power_error_W"], 4)
        overlap = f"{r['overlap_99_percent']:.2f} / {r['overlap_largest_percent']:.1f}"
        centroid = f"{r['centroid_x_mm']:.2f}, {r['centroid_y_mm']:.2f}"
        lines.append(f"{r['run']:<16}{r['time_step_us']:9.2f}{r['wall_time_s']:8.0f}{power:>16}{overlap:>16}"
                     f"{r['solidity_difference']:10.4f}{r['velocity_x_difference']:8.4f}"
                     f"{r['velocity_y_difference']:8.4f}{centroid:>17}")
    lines += [f"{r['run']:<65}{r['solidity_difference']:10.4f}{r['velocity_x_difference']:8.4f}"
              f"{r['velocity_y_difference']:8.4f}" for r in chance]
    lines.append("overlap: 99 % below / largest, of the smallest diameter; solidity, velocity: mean differences to the "
                 "last run; two seeds: of two equal mills, by chance")
    path.write_text("\n".join(lines) + "\n")


def plot(runs, path):
    """Solidity and speed across the axis of every run, and below each its difference from the last run's."""
    last = runs[-1].charge
    figure, axes = plt.subplots(4, len(runs), figsize=(3.1 * len(runs), 12), constrained_layout=True, squeeze=False)
    for column, dry in enumerate(runs):
        charge = dry.charge
        inside, speed = charge.inside > 0.01, np.linalg.norm(charge.velocity[..., :2], axis=-1)
        # Where balls are rare the difference is chance
        dense = (charge.solidity > DENSE) & (last.solidity > DENSE)
        panels = (("solidity, –", charge.solidity, inside, "YlOrBr", (0, 0.65)),
                  ("difference of solidity, –", charge.solidity - last.solidity, inside, "RdBu_r", (-0.1, 0.1)),
                  ("speed, m/s", speed, charge.solidity > DENSE, "viridis", (0, 0.9)),
                  ("difference of speed, m/s", speed - np.linalg.norm(last.velocity[..., :2], axis=-1), dense,
                   "RdBu_r", (-0.05, 0.05)))
        for axis, (label, values, shown, colours, limits) in zip(axes[:, column], panels):
            image = axis.pcolormesh(1e3 * charge.x, 1e3 * charge.y, np.where(shown, values, np.nan), cmap=colours,
                                    vmin=limits[0], vmax=limits[1])
            axis.set(aspect="equal", ylabel="" if column else "y, mm")
            less = f" minus {runs[-1].name}" if label.startswith("difference") else ""
            axis.set_title(dry.name + less, fontsize=9)
            if column == len(runs) - 1:
                figure.colorbar(image, ax=axis, shrink=0.8, label=label)
        axes[-1, column].set_xlabel("x, mm")
    figure.savefig(path, dpi=70, bbox_inches="tight")
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true",
                        help="0.2 s of the two softest: tests the study, without meaningful results")
    quick = parser.parse_args().quick
    chosen = list(settings(quick))
    runs = [make(*setting, quick) for setting in chosen]
    rows = [row(dry, modulus, runs[-1]) for dry, (_, modulus, _) in zip(runs, chosen)]
    result = HERE / ("softening_quick" if quick else "softening")
    write_table(rows, list(chance_rows(runs, chosen)), result.with_suffix(".txt"))
    plot(runs, result.with_suffix(".png"))
    print(result.with_suffix(".txt").read_text())


if __name__ == "__main__":
    main()
