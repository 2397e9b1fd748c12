#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Power of mills against the share of the resting charge's pores that slurry fills: a table on the screen, and, in the
folder of the runs, power_filling.txt, power_filling.csv, power_filling.png (power, with the classical models),
power_filling_relative.png (direct: the drive's power over that of the dry mill) and power_filling_maps.png (charge and
slurry). Runs that are not complete are listed."""
import argparse
import itertools
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

from millfoam.coupling.passes import Pass, read_pass
from millfoam.files.data_files import read_json, write_csv
from millfoam.files.mill import Mill
from millfoam.files.mill_case import MillCase
from millfoam.files.slurry_file import SlurryMap
from millfoam.plots.mill_plots import draw_outline
from millfoam.readings import power_models
from millfoam.readings.means import Mean
from millfoam.readings.mill_power import given_power, result_power
from millfoam.readings.slurry_on_maps import pool, solidity_at_pixels
from millfoam.readings.slurry_over_time import mean_slurry, slurry_blocks
from millfoam.report.charge_checks import charge_steadiness
from millfoam.report.steadiness import flow_steadiness
from millstudies.own_mill import require_own_mill

WAYS = {"one_way": "one way", "direct": "direct"}
POWERS = {"drive_power": "drive", "charge_power": "charge", "slurry_power": "slurry", "given_power": "given"}
READINGS = ("toe", "shoulder", "slurry_x", "slurry_y")
UNITS = {"toe": "deg", "shoulder": "deg", "slurry_x": "m", "slurry_y": "m"}  # of readings that are not powers
HALF = 0.5  # share of the slurry's outline
RUN = re.compile(rf"({'|'.join(WAYS)})_(\d+\.?\d*)")  # name of a run's folder


@dataclass(frozen=True)
class Run:
    """A complete run: way, a key of WAYS; fill: volume of slurry over that of the pores; its numbers; its map of the
    slurry; pooled: share of the slurry that is in the pool clear of the charge; unsteady: what the report does not call
    steady, `flow` or `charge`, and whether that is undecided; unbalanced: of a direct run, torque between balls and
    slurry that is not the same for both, over the drive's, None if it is not known."""
    way: str
    fill: float
    case: MillCase
    numbers: Pass
    slurry: SlurryMap
    pooled: float
    unsteady: str
    unbalanced: Mean | None


@dataclass(frozen=True)
class Study:
    """A mill: its name; power of its dry charge, W; its runs, and the names of those that are not complete;
    dry_unsteady: "charge" if power and energies of the dry run did not become steady, otherwise empty."""
    name: str
    mill: Mill
    dry: Mean
    runs: list[Run]
    missing: list[str]
    dry_unsteady: str = ""


def require_of(case: MillCase, charge: str, fill: float | None) -> None:
    """RuntimeError if files of a case are of another mill than its own, if its charge does not have this fingerprint,
    or if its slurry does not fill this share of the pores."""
    require_own_mill(case)
    if case.mill.fingerprint.get("charge") != charge:
        raise RuntimeError(f"{case.folder}: its charge is not that of the dry run: fingerprint "
                           f"{case.mill.fingerprint.get('charge')}, expected {charge}")
    filled = (case.mill.asked("flow", "start") or {}).get("fill")
    if fill is not None and filled != fill:
        raise RuntimeError(f"{case.folder}: flow.start.fill is {filled}; expected {fill:g}, as the folder is named")


def read_run(folder: Path, charge: str) -> Run:
    """Run of a folder WAY_FILL; charge: fingerprint of the dry run's. RuntimeError if it is not complete, or of another
    mill."""
    way, _, filling = folder.name.rpartition("_")
    fill, direct = float(filling), way == "direct"
    place = folder / "direct" if direct else folder
    case = MillCase(place)
    require_of(case, charge, fill)
    numbers = read_pass(2 if direct else 1, place)
    if case.is_cut_short:
        raise RuntimeError(f"{place}: the flow ends at {case.last:.3g} s; expected {case.duration:.3g} s")
    numbers.quantities["given_power"] = given_power(case)
    slurry = mean_slurry(case, list(slurry_blocks(case)))
    area = pool(slurry, solidity_at_pixels(numbers.charge, slurry)).area
    whole = fill * case.mill.derived("charge", "pore_volume_m3")
    judged = {"flow": flow_steadiness(case), "charge": charge_steadiness(case)}
    exchanged = read_json(folder / "coupling.json", "coupling") if direct else {}
    apart, error = (exchanged.get(f"torque_unbalanced{end}") for end in ("", "_error"))
    return Run(way, fill, case, numbers, slurry, area * case.length / whole,
               ", ".join(name + (" (undecided)" if check.undecided else "") for name, check in judged.items()
                         if check.state != "holds"),
               None if apart is None else Mean(apart, np.nan if error is None else error))


def read_study(folder: Path) -> Study:
    """Study of a folder with the runs of a mill. RuntimeError without a complete dry run."""
    dry = MillCase(folder / "dry")
    if dry.results is None:
        raise RuntimeError(f"{folder / 'dry'}: the dry run has no results; run Allrun")
    charge = dry.mill.fingerprint["charge"]
    require_of(dry, charge, None)
    names = [match for match in map(RUN.fullmatch, (path.name for path in folder.iterdir())) if match]
    runs, missing = [], []
    for match in sorted(names, key=lambda match: (list(WAYS).index(match[1]), float(match[2]))):
        try:
            runs.append(read_run(folder / match[0], charge))
        except (RuntimeError, OSError) as error:
            missing.append(f"{match[0]}: {error}")
    return Study(folder.name, dry.mill, result_power(dry), runs, missing,
                 "" if dry.results.get("steady") else "charge")


def models(mill: Mill) -> dict[str, Callable[[float], float]]:
    """Name of a model -> power (W) at a filling of the pores, NaN where it does not apply. Pores are filled up to their
    whole; with more, there is a pool, which Morrell's model of an overflow mill has."""
    solidity, slurry = mill.derived("charge", "resting_solidity"), mill.slurry("density_kg_m3")
    mass, diameter = mill.derived("charge", "mass_kg"), 2 * mill.radius
    filling = power_models.filling_of(mass, mill.ball_density, solidity, diameter, mill.length)
    size = diameter, mill.length, mill.critical_share, filling

    def density(fill: float) -> float:
        return power_models.bulk_density(mill.ball_density, solidity, slurry, min(fill, 1.0))

    return {f"Hogg & Fuerstenau, {power_models.REPOSE:g}°":
            lambda fill: power_models.hogg_fuerstenau(*size, density(fill)),
            "Morrell, C-model": lambda fill: power_models.morrell(*size, density(fill)).net,
            # Its pool is that of an overflow mill, whatever is beyond the pores
            "Morrell, with its pool": lambda fill: power_models.morrell(
                *size, density(fill), slurry, True).net if fill >= 1 else np.nan,
            "Bond, wet": lambda fill: power_models.bond(diameter, *size[2:], mass)}


def columns_of(key: str, mean: Mean) -> list[tuple[str, float]]:
    """(column, number) of one of the readings of a run, its error, and the error's degrees of freedom."""
    unit = UNITS.get(key, "W")
    return [(f"{key}_{unit}", mean.value), (f"{key}_error_{unit}", mean.error), (f"{key}_freedom", mean.freedom)]


def rows_of(study: Study):
    """Rows of the table: column -> text or number."""
    yield {"mill": study.name, "coupling": "dry", "filling": 0.0,
           **{name: value for key in ("drive_power", "charge_power") for name, value in columns_of(key, study.dry)},
           "not_steady": study.dry_unsteady}
    for run in study.runs:
        row = {"mill": study.name, "coupling": WAYS[run.way], "filling": run.fill}
        for key in (*POWERS, *READINGS):
            row |= dict(columns_of(key, run.numbers.quantities[key]))
        yield row | {"slurry_in_pool": run.pooled, "force_over_weight": run.numbers.load,
                     "unbalanced": run.unbalanced.value if run.unbalanced else np.nan,
                     "unbalanced_error": run.unbalanced.error if run.unbalanced else np.nan,
                     "not_steady": run.unsteady}


def lines_of(rows):
    """The table as text, a block for each mill."""
    for mill in dict.fromkeys(row["mill"] for row in rows):
        yield (f"{mill:<16}{'filling':>8}" + "".join(f"{f'{name}, W':>20}" for name in POWERS.values())
               + f"{'pool':>8}{'unbalanced':>16}  not steady")
        for row in (row for row in rows if row["mill"] == mill):
            powers = "".join(f"{row[f'{key}_W']:11.4f} ± {row[f'{key}_error_W']:.4f}"
                             if np.isfinite(row.get(f"{key}_W", np.nan)) else f"{'–':>20}" for key in POWERS)
            share, apart, error = (row.get(name, np.nan) for name in ("slurry_in_pool", "unbalanced",
                                                                      "unbalanced_error"))
            told = "–" if np.isnan(apart) else f"{apart:+.1%}" + (f" ± {error:.1%}" if np.isfinite(error) else "")
            yield (f"{row['coupling']:<16}{row['filling']:8.2f}{powers}"
                   + ("" if np.isnan(share) else f"{share:8.2f}{told:>16}")
                   + f"  {row.get('not_steady', '')}").rstrip()
        yield ""


def draw_power(studies):
    """Figure with a panel for each mill: power of drive and charge over the filling, and the models."""
    columns = min(2, len(studies))
    lines = -(-len(studies) // columns)
    figure, axes = plt.subplots(lines, columns, figsize=(6.4 * columns, 5 * lines), squeeze=False, layout="constrained")
    fills = np.linspace(0, 1.5, 61)
    for axis in axes.flat[len(studies):]:
        axis.set_axis_off()
    for axis, study in zip(axes.flat, studies):
        axis.errorbar(0, study.dry.value, study.dry.error, fmt="ks", label="dry charge")
        for way, marker, colour in (("one_way", "o", "#D55E00"), ("direct", "D", "#0072B2")):
            runs = [run for run in study.runs if run.way == way]
            for key, line, fill in (("drive_power", "-", "full"), ("charge_power", ":", "none")):
                # Of a flow of fewer turns than three the power is not known
                found = [(run.fill, one.value, one.error) for run in runs
                         if np.isfinite((one := run.numbers.quantities[key]).value)]
                if found:
                    axis.errorbar(*zip(*found), ls=line, marker=marker, color=colour, fillstyle=fill, capsize=2,
                                  label=f"{POWERS[key]}, {WAYS[way]}")
        for (name, model), line in zip(models(study.mill).items(), ("-", "--", "-.", ":")):
            try:
                axis.plot(fills, [model(fill) for fill in fills], line, color="0.5", lw=1, label=name)
            except ValueError as error:
                print(f"{study.name}: {name}: {error}")
        axis.set(xlabel="volume of slurry over that of the resting charge's pores", ylabel="power, W", ylim=(0, None),
                 title=f"{study.name}: {200 * study.mill.radius:.0f} cm, {100 * study.mill.critical_share:.0f} % of "
                       f"critical, load {100 * study.mill.load:.3g} %")
        axis.title.set_fontsize(9)
        axis.grid(alpha=0.3)
        axis.legend(fontsize=7, ncols=2)
    return figure


def relative_power(study: Study) -> list[tuple[float, Mean]]:
    """(filling, drive's power over the dry mill's) of the direct runs whose power is known. The errors of the two are
    independent."""
    dry, found = study.dry, []
    for run in study.runs:
        drive = run.numbers.quantities["drive_power"]
        if run.way == "direct" and np.isfinite(drive.value):
            ratio = drive.value / dry.value
            found.append((run.fill, 1 / dry.value * drive + Mean(0.0, ratio * dry.error / dry.value, dry.freedom)))
    return found


def voxel_size(mill: Mill) -> float:
    """Width of a Mill's voxels across its axis, m."""
    box = mill.content["derived"]["averages"]
    return (box["upper_m"][0] - box["lower_m"][0]) / box["shape"][0]


def draw_relative(studies):
    """Figure with a curve for each mill: drive's power with balls that feel the slurry, over that of the dry mill."""
    figure, axis = plt.subplots(figsize=(7, 4.5), layout="constrained")
    axis.plot(0, 1, "k*", label="dry")
    for study, marker in zip(studies, itertools.cycle("osD^v<>P")):
        found = [(fill, one.value, one.error) for fill, one in relative_power(study)]
        if found:
            axis.errorbar(*zip(*found), marker=marker, capsize=2,
                          label=f"{study.name}, voxels of {1e3 * voxel_size(study.mill):.2g} mm")
    axis.set(xlabel="volume of slurry over that of the resting charge's pores",
             ylabel="power of the drive over that of the dry mill", title="Balls and slurry at the same time")
    axis.grid(alpha=0.3)
    axis.legend()
    return figure


def draw_maps(studies):
    """Figure with a row for each mill and a panel for each filling with direct coupling: solidity and slurry."""
    rows = [[run for run in study.runs if run.way == "direct"] for study in studies]
    most = max(1, *map(len, rows))
    figure, axes = plt.subplots(len(studies), most, figsize=(2.1 * most + 1.2, 2.5 * len(studies) + 0.4),
                                squeeze=False, layout="constrained")
    for line, study, runs in zip(axes, studies, rows):
        for axis in line[len(runs):]:
            axis.set_axis_off()
        for axis, run in zip(line, runs):
            charge = run.numbers.charge
            mesh = axis.pcolormesh(1e3 * charge.x, 1e3 * charge.y, np.where(charge.inside > 0, charge.solidity, np.nan),
                                   vmin=0, vmax=0.65, cmap="YlOrBr")
            x, y = (1e3 * at for at in run.slurry.centres())
            share = np.nan_to_num(run.slurry.share)
            if share.max() > HALF:
                axis.contour(x, y, share, [HALF], colors="#0072B2")
            draw_outline(axis, run.case.outline, run.case.radius, run.case.omega)
            axis.set(title=f"{study.name}, filling {run.fill:g}", aspect="equal", xlabel="x, mm",
                     ylabel="y, mm" if axis is line[0] else "")
            axis.title.set_fontsize(8)
    if any(rows):
        figure.colorbar(mesh, ax=axes, label="solidity, –", shrink=0.8)
    figure.suptitle("Solidity; blue: where half of the fluid is slurry. Balls and slurry at the same time", fontsize=9)
    return figure


def main():
    matplotlib.use("Agg")
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("runs", type=Path, help="folder with the folders of the mills")
    parser.add_argument("mills", nargs="+", metavar="MILL")
    options = parser.parse_args()
    studies, failures = [], []
    for mill in options.mills:
        try:
            studies.append(read_study(options.runs / mill))
        except RuntimeError as error:
            failures.append(f"not complete: {error}")
    if not studies:
        parser.exit(1, "\n".join(failures) + "\n")
    rows = [row for study in studies for row in rows_of(study)]
    write_csv(options.runs / "power_filling.csv", rows)
    lines = [*lines_of(rows), *(f"not complete: {study.name}/{text}" for study in studies for text in study.missing),
             *failures]
    (options.runs / "power_filling.txt").write_text("\n".join(lines) + "\n")
    print("\n".join(lines))
    draw_power(studies).savefig(options.runs / "power_filling.png", dpi=130)
    draw_relative(studies).savefig(options.runs / "power_filling_relative.png", dpi=130)
    draw_maps(studies).savefig(options.runs / "power_filling_maps.png", dpi=130)


if __name__ == "__main__":
    main()
