#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Dry runs of the 12 cm mill compared with published readings: RMSD of the tangential velocity from a cubic, and of the
free surface from a logistic, with their errors over time. The same mills with one change show the cause of a
difference.

Every run has a folder runs/NAME as those of dem_matrix; complete runs of dem_matrix are read, and not changed. Complete
runs are kept, interrupted ones are resumed. Dumps are removed after they are averaged."""
import argparse
import csv
import sys
from dataclasses import dataclass
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import LogLocator, NullFormatter

from millfoam.files.data_files import write_csv
from millfoam.files.solids_file import read_windows
from millfoam.plots.charge_plots import draw_charge
from millfoam.readings.charge import Charge, charge_with_errors, read_charge
from millfoam.readings.means import with_error
from millfoam.run import RunError, run
from millstudies import other_readings, published_mills
from millstudies.dry_run_options import add_options, chosen
from millstudies.dry_runs import is_whole, make_dry_run
from millstudies.mean_columns import value_text
from millstudies.published_mills import Setting, run_name

matplotlib.use("Agg")

HERE = Path(__file__).parent.resolve()
REPORT = HERE.parents[2] / "scripts" / "report"
RADIUS = 0.06  # m
PARTS = 8  # of the averaged time, for errors
QUICK = 0.2, 0.016, 0.1, 0.01  # duration, s; slice, m; of the averages: left out, window, s
COLUMNS = ("run", "balls", "steady", "steady_from_s", "power_W", "power_error_W", "cubic_rmsd_m_s", "cubic_error_m_s",
           "cubic_published_m_s", "logistic_rmsd_mm", "logistic_error_mm", "logistic_published_mm", "centre_x_mm",
           "centre_y_mm", "centre_error_mm", "toe_deg", "toe_error_deg", "shoulder_deg", "shoulder_error_deg",
           "wall_time_s")
# What a variant changes of the mill
VARIANTS = {
    "stiff": ["dem.youngs_modulus=1.0e8"],
    "lifters3mm": ["geometry.lifters.width=0.003"],
    "lifters9mm": ["geometry.lifters.width=0.009"],
    "lifters_trapezoid": ["geometry.lifters.width=0.009", "geometry.lifters.top_width=0.003"],
    "friction0.5": ["materials.ball_ball.friction=0.5"],
    "rolling0.05": [f"materials.{contact}.rolling_friction=0.05" for contact in ("ball_ball", "ball_wall")],
    "wall_aluminium": ["materials.ball_wall=glass-aluminium"],
    "wall_nylon": ["materials.ball_wall=glass-nylon"],
    "other_seed": ["dem.seed=20122"],
}


@dataclass(frozen=True)
class Case:
    """A run of the study: the published one, and the variant of it, or "" for the mill as published."""
    setting: Setting
    variant: str

    @property
    def name(self):
        return self.setting.name + (f"_{self.variant}" if self.variant else "")

    def mill(self, *extent):
        """Its Mill; extent: duration, slice's length, and more as published_mills.mill takes it."""
        return published_mills.mill(self.setting, *extent, changes=VARIANTS.get(self.variant, ()))


def published():
    """Setting -> (RMSD of the cubic in m/s, of the logistic in mm); NaN without a published one."""
    with open(HERE / "published.csv", newline="") as file:
        return {Setting("12cm", line["load_percent"], int(line["speed_percent"])):
                tuple(float(line[key] or "nan") for key in ("cubic_rmsd_m_s", "logistic_rmsd_mm"))
                for line in csv.DictReader(file)}


def cases():
    """Every run by name: those with published readings, each followed by its variants."""
    found = [Case(setting, variant) for setting in published() for variant in ("", *VARIANTS)]
    return {case.name: case for case in found}


def asked(case, options):
    """Folder of a run and its Mill; dem_matrix's folder where it has that very run."""
    if options.quick:
        return HERE / "runs_quick" / case.name, case.mill(*QUICK)
    mill = case.mill(options.duration or case.setting.duration, options.slice)
    name = run_name(case.name, options.slice)
    theirs = HERE.parent / "dem_matrix" / "runs" / name
    return (theirs if is_whole(theirs, mill) else HERE / "runs" / name), mill


@dataclass
class Result:
    """A complete run: case, folder, time of a turn (s), its results and map (DryRun), maps of its windows, its readings
    (Charge), with errors (name -> Reading); the latter two are None where there is nothing to read."""
    case: Case
    folder: Path
    turn: float
    dry: object
    maps: list
    charge: Charge = None
    errors: dict = None

    @property
    def part(self):
        """Share of a turn of the mill in each of the PARTS from which the errors are."""
        return (self.maps[-1].end - self.maps[0].begin) / min(PARTS, len(self.maps)) / self.turn


def make(case, options):
    """Result of a run, which is made unless it is complete."""
    folder, mill = asked(case, options)
    print(f"{folder.name} …", flush=True)
    dry = make_dry_run(folder, mill, ranks=options.ranks, keep_dumps=options.keep_dumps)
    result = Result(case, folder, mill.turn, dry, read_windows(folder / "solids.h5"))
    try:
        result.charge = read_charge(dry.charge, RADIUS)
        result.errors = charge_with_errors(result.maps, RADIUS, blocks=PARTS)
    except RuntimeError as error:
        print(f"{folder.name}: not read: {error}")
    return result


def row(result):
    """One line of the table; NaN where there is nothing to read."""
    dry, (cubic, logistic) = result.dry, published()[result.case.setting]

    def read(name, scale=1.0):
        found = result.errors[name] if result.errors else None
        if not found:
            return (np.full(2, np.nan),) * 2
        return scale * np.atleast_1d(found.value), scale * np.atleast_1d(found.error)

    (velocity, velocity_error), (surface, surface_error) = read("tangential_rmsd"), read("surface_rmsd", 1e3)
    (centre, centre_error), (ends, ends_error) = read("centre", 1e3), read("ends")
    return dict(zip(COLUMNS, (
        dry.name, dry.number("balls"), dry.steady, dry.number("steady_from_s"), dry.number("power_W"),
        dry.number("power_error_W"), velocity[0], velocity_error[0], cubic, surface[0], surface_error[0], logistic,
        *centre, float(np.hypot(*centre_error)), ends[0], ends_error[0], ends[1], ends_error[1],
        dry.number("wall_time_s"))))


def print_table(rows):
    width = max(len(r["run"]) for r in rows) + 2
    print(f"{'run':<{width}}{'balls':>6}{'steady':>7}{'power W':>17}{'cubic m/s':>18}{'publ.':>8}{'logistic mm':>15}"
          f"{'publ.':>7}{'centre mm':>14}{'toe':>6}{'shoulder':>10}{'time s':>8}")
    for r in rows:
        centre = f"{r['centre_x_mm']:.1f}, {r['centre_y_mm']:.1f}"
        print(f"{r['run']:<{width}}{r['balls']:6d}{r['steady']:>7}{value_text(r['power_W'], r['power_error_W'], 4):>17}"
              f"{value_text(r['cubic_rmsd_m_s'], r['cubic_error_m_s'], 4):>18}{r['cubic_published_m_s']:8.4f}"
              f"{value_text(r['logistic_rmsd_mm'], r['logistic_error_mm'], 2):>15}{r['logistic_published_mm']:7.2f}"
              f"{centre:>14}{r['toe_deg']:6.0f}{r['shoulder_deg']:10.0f}{r['wall_time_s']:8.0f}")


def warning(results):
    """Line on the errors of the table: parts shorter than a turn make them too small."""
    shortest = min(result.part for result in results)
    return f"±: standard error of parts of {shortest:.2f} turns or more" + (
        "; those of parts below a turn are lower bounds" if shortest < 1 else "")


def readings(result):
    """Rows of the other readings of one run."""
    rows = []
    for kind, group, scale, number in (("cubic, m/s", other_readings.VELOCITY, 1.0, 0),
                                       ("logistic, mm", other_readings.SURFACE, 1e3, 1)):
        for name, reading in group.items():
            try:
                found = with_error(lambda one, read=reading: read(one, RADIUS), result.maps, PARTS)
                value, error = float(found.value), float(found.error)
            except RuntimeError:
                value = error = np.nan
            rows.append({"run": result.dry.name, "rmsd_of": kind, "reading": name, "value": scale * value,
                         "error": scale * error,
                         "single_windows": scale * other_readings.mean_of_windows(reading, result.maps, RADIUS),
                         "published": published()[result.case.setting][number]})
    return rows


def print_readings(rows):
    for r in rows:
        if r is rows[0] or r["run"] != rows[rows.index(r) - 1]["run"]:
            print(f"\n{r['run']:<66}{'whole':>18}{'a window':>10}{'publ.':>9}")
        print(f"  {r['rmsd_of']:<14}{r['reading']:<50}{value_text(r['value'], r['error'], 4):>18}"
              f"{r['single_windows']:10.4f}"
              f"{r['published']:9.4g}")


def plot(results, rows, path):
    """Top: simulated and published RMSDs; bottom: the maps with their readings."""
    across = min(len(results), 4)
    lines = -(-len(results) // across)
    figure = plt.figure(figsize=(max(5.2 * across, 10), 5 + 6.4 * lines), constrained_layout=True)
    grid = figure.add_gridspec(1 + lines, 2 * across, height_ratios=[5] + [6.4] * lines)
    titles = (("cubic_{}_m_s", "tangential velocity from its cubic, m/s"),
              ("logistic_{}_mm", "free surface from its logistic, mm"))
    place = np.arange(len(rows))
    for k, (key, title) in enumerate(titles):
        axis = figure.add_subplot(grid[0, k * across:(k + 1) * across])
        axis.errorbar(place, [r[key.format("rmsd")] for r in rows], [r[key.format("error")] for r in rows], fmt="o",
                      capsize=4, color="#0072B2", label="this study, standard error over time")
        axis.plot(place, [r[key.format("published")] for r in rows], "D", color="#D55E00", label="published")
        axis.set(yscale="log", title=f"RMSD of the {title}", xlim=(-0.6, len(rows) - 0.4))
        axis.set_xticks(place, [r["run"].removeprefix("12cm_") for r in rows], rotation=20, ha="right", fontsize=8)
        axis.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axis.yaxis.set_major_formatter("{x:g}")
        axis.yaxis.set_minor_formatter(NullFormatter())
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    maps, image = [], None
    for k, result in enumerate(results):
        axis = figure.add_subplot(grid[1 + k // across, 2 * (k % across):2 * (k % across) + 2])
        maps.append(axis)
        if result.charge:
            image = draw_charge(axis, result.dry.charge, result.charge, RADIUS)
        axis.set_title(result.dry.name + ("" if result.charge else ": nothing to read"), fontsize=9, loc="left")
    if image:
        figure.colorbar(image, ax=maps, label="solidity, –", shrink=min(1.0, 1.0 / lines), aspect=25)
    figure.savefig(path, dpi=90)
    plt.close(figure)


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_options(parser, "no variants", f"{published_mills.DURATION:g}")
    parser.add_argument("--quick", action="store_true",
                        help="0.2 s of two thin slices: tests the study, without meaningful results")
    parser.add_argument("--readings", action="store_true",
                        help="other ways to read both numbers, in a table of their own")
    options = parser.parse_args()
    if options.quick and (options.duration or options.slice):
        parser.error("--quick has a duration and a slice of its own; expected no --duration and no --slice with it")
    return options, parser


def report(results, options):
    """Tables, picture and reports of complete runs."""
    name = "dem_12cm_quick" if options.quick else "dem_12cm"
    rows = [row(result) for result in results]
    write_csv(HERE / f"{name}.csv", rows)
    print_table(rows)
    print(warning(results))
    plot(results, rows, HERE / f"{name}.png")
    if options.readings:
        lines = [line for result in results for line in readings(result)]
        write_csv(HERE / f"{name}_readings.csv", lines)
        print_readings(lines)
    for result in results:
        # A run of dem_matrix has its report here
        own = HERE / "runs" / result.folder.name if result.folder.parent.parent != HERE else result.folder
        own.mkdir(parents=True, exist_ok=True)
        run(own, REPORT, result.folder, "-o", "report.html")
    if len(results) > 1:
        run(HERE, REPORT, *(result.folder for result in results), "-o", f"{name}_comparison.html")


def main():
    options, parser = parse()
    known = cases()
    if options.list or not (options.runs or options.quick):
        for case in known.values():
            print(case.name, "complete" if is_whole(*asked(case, options)) else "")
        return 0
    names = options.runs or ["12cm_load37.5_speed50", "12cm_load37.5_speed50_other_seed"]
    results, failures = [], []
    for case in chosen(names, known, parser, lambda case: not case.variant):
        try:
            results.append(make(case, options))
        except RunError as error:
            failures.append(f"{case.name}: {error}")
            print(failures[-1], flush=True)
    if results:
        report(results, options)
    if failures:
        print(f"NOT COMPLETE: {len(failures)} of {len(failures) + len(results)} runs failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
