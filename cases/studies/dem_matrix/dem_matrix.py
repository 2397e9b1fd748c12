#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Dry runs of the published matrix: the 12 cm mill with 4 loads at 8 speeds, the 30 cm mill at 2 speeds.

Every run has a folder runs/NAME with its mill.json, walls, dumps/results.json, dumps/energy.csv and solids.h5 (its
averages on 65 x 65 voxels over the mill's length, without the first second, in windows of 0.1 s). Complete runs are
kept, interrupted ones are resumed. Dumps are removed after they are averaged."""
import argparse
import sys
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt

from millfoam.files.data_files import write_csv
from millstudies.dry_run_options import add_options, chosen
from millstudies.dry_runs import is_whole, make_dry_run
from millstudies.mean_columns import value_text
from millstudies.published_mills import matrix, mill, run_name

matplotlib.use("Agg")

HERE = Path(__file__).parent.resolve()
COLUMNS = ("run", "mill", "load_percent", "speed_percent", "balls", "power_W", "power_error_W", "steady",
           "steady_from_s", "kinetic_J", "potential_J", "overlap_99_um", "overlap_largest_um", "centroid_x_mm",
           "centroid_y_mm", "wall_time_s")


def asked(setting, options):
    """Folder of a run and its Mill."""
    folder = HERE / "runs" / run_name(setting.name, options.slice)
    return folder, mill(setting, options.duration or setting.duration, options.slice)


def make(setting, options):
    """Runs one setting unless it is complete."""
    folder, chosen_mill = asked(setting, options)
    print(f"{folder.name} …", flush=True)
    return make_dry_run(folder, chosen_mill, ranks=options.ranks, keep_dumps=options.keep_dumps)


def row(setting, dry):
    x, y = dry.charge.centroid()
    return dict(zip(COLUMNS, (
        dry.name, setting.mill, setting.load, setting.speed, dry.number("balls"), dry.number("power_W"),
        dry.number("power_error_W"), dry.steady, dry.number("steady_from_s"), dry.number("kinetic_energy_J"),
        dry.number("potential_energy_J"), 1e6 * dry.number("ball_overlap_99_m"),
        1e6 * dry.number("ball_overlap_largest_m"), 1e3 * x, 1e3 * y, dry.number("wall_time_s"))))


def write_table(rows):
    write_csv(HERE / "dem_matrix.csv", rows)
    print(f"{'run':<32}{'balls':>7}{'power W':>18}{'steady from s':>15}{'centroid mm':>17}{'wall time s':>13}")
    for r in rows:
        power = value_text(r["power_W"], r["power_error_W"], 4)
        steady = f"{r['steady_from_s']:.2f}" if r["steady"] == "yes" else "NOT STEADY"
        centroid = f"{r['centroid_x_mm']:.1f}, {r['centroid_y_mm']:.1f}"
        print(f"{r['run']:<32}{r['balls']:7d}{power:>18}{steady:>15}{centroid:>17}{r['wall_time_s']:13.0f}")


def plot(rows):
    """Power against speed, a line for each load; and every run's place."""
    figure, axis = plt.subplots(figsize=(6.4, 4.4), constrained_layout=True)
    lines = sorted({(r["mill"], r["load_percent"]) for r in rows}, key=lambda item: (item[0], float(item[1])))
    for size, load in lines:
        line = sorted((r for r in rows if (r["mill"], r["load_percent"]) == (size, load)),
                      key=lambda r: r["speed_percent"])
        axis.errorbar([r["speed_percent"] for r in line], [r["power_W"] for r in line],
                      [r["power_error_W"] for r in line], marker="o", ms=4, capsize=3, label=f"{size}, {load} % load")
    axis.set(xlabel="speed, % of critical", ylabel="power that the charge takes, W", ylim=(0, None))
    axis.grid(alpha=0.3)
    axis.legend(fontsize=8)
    figure.savefig(HERE / "dem_matrix.png", dpi=110)
    plt.close(figure)


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_options(parser, "all 34", "4; of the 30 cm mill 6.25 and 5")
    return parser.parse_args(), parser


def main():
    options, parser = parse()
    settings = matrix()
    if options.list or not options.runs:
        for name, setting in settings.items():
            print(name, "complete" if is_whole(*asked(setting, options)) else "")
        return 0
    rows, failures = [], []
    for setting in chosen(options.runs, settings, parser):
        try:
            rows.append(row(setting, make(setting, options)))
        except RuntimeError as error:
            failures.append(f"{setting.name}: {error}")
            print(failures[-1], flush=True)
    if rows:
        write_table(rows)
        plot(rows)
    if failures:
        print(f"NOT COMPLETE: {len(failures)} of {len(failures) + len(rows)} runs failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
