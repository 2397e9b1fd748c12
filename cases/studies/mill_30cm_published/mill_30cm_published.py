#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the complete runs of the study: tables on the screen and, in the folder of the runs, charges.csv, flows.csv,
statements.csv, costs.csv, mill_30cm_published.txt with all of them, profiles.png, axial_flow.png, holdup.png, and
comparison.html, one page of all runs. Runs that are not complete, or cannot be read, are listed. It fails, after all is
written, if a run does not conserve its slurry or is not fed as asked."""
import argparse
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np

from millfoam.files.data_files import read_json, write_csv
from millfoam.files.mill_case import MillCase
from millfoam.readings.charge import charge_with_errors
from millfoam.readings.means import Mean, of_reading
from millfoam.readings.mill_power import result_power
from millfoam.readings.slurry_conservation import AS_ASKED, CONSERVED
from millfoam.report.build import compare_cases
from millstudies.axial_slices import PRESSURES, Profile
from millstudies.compared_runs import NOT_TESTED, SLICE, Verdict
from millstudies.mean_columns import Row, freedom_columns, freedom_text
from millstudies.statements import verdicts

import drawings
from flow_numbers import Flow, NotFinished, folders_of, read_flow
from own_statements import own_verdicts
from runs import RUNS, Run, is_published

REFERENCE = RUNS["Beetstra_75_20"]  # on the page of all runs, where it is complete


def version_of(summary: dict[str, Any]) -> str:
    """Version of the program that wrote a summary, as it is written there: `0.3.0+eb3f671b1`; a dash if it is not."""
    return str(summary.get("program") or "–").rsplit(" ", 1)[-1]


def charge_row(run: Run, case: MillCase) -> Row:
    """A dry run's line of the table."""
    found = charge_with_errors(case.charge_windows, case.radius)

    def mean(name: str, k: int = 0) -> Mean:
        return of_reading(found[name], k)
    return {"run": run.name, "version": version_of(case.results or {}), "speed, %": run.speed,
            "steady from, s": case.result("steady_from_s"),
            **freedom_columns("power, W", result_power(case)),
            **freedom_columns("centre of circulation x, mm", mean("centre", 0), 1e3),
            **freedom_columns("centre of circulation y, mm", mean("centre", 1), 1e3),
            **freedom_columns("toe, deg", mean("ends", 0)), **freedom_columns("shoulder, deg", mean("ends", 1)),
            **freedom_columns("RMSD of the cubic, m/s", mean("tangential_rmsd")),
            **freedom_columns("RMSD of the logistic, mm", mean("surface_rmsd"), 1e3)}


def profile_columns(words: str, profile: Profile) -> Row:
    """A profile's columns of the table, after these words."""
    return {**freedom_columns(f"{words}amplitude, mm", profile.amplitude, 1e3),
            f"{words}peaks (*: end of fit), mm": profile.marked_peaks,
            **freedom_columns(f"{words}first distance, mm", profile.distances[0], 1e3),
            **freedom_columns(f"{words}last distance, mm", profile.distances[-1], 1e3),
            f"{words}RMSD of the fit, mm": 1e3 * profile.humps.rmsd}


def flow_row(flow: Flow) -> Row:
    """A flow's line of the table."""
    run, readings = flow.run, flow.readings
    unknown = Mean(np.nan, np.nan)
    first, last = flow.holdup
    return {"run": run.name, "version": version_of(flow.case.record.last), "speed, %": run.speed,
            "solids, %": run.solids, "law": run.law or "–",
            "turns": flow.turns, "steady": readings.steady, "hold-up at first, l": 1e3 * first,
            "hold-up at last, l": 1e3 * last, "feed, ml/s": 1e6 * (flow.case.feed or 0),
            **freedom_columns("discharge, ml/s", flow.discharge, 1e6), **freedom_columns("net, ml/s", flow.net, 1e6),
            **freedom_columns("height, mm", flow.height, 1e3),
            **freedom_columns("in front of the grates: height, mm", flow.chamber_height, 1e3),
            **profile_columns("", flow.profile), **profile_columns("in front of the grates: ", flow.chamber),
            **freedom_columns("velocity at the toe, mm/s", readings.toe or unknown, 1e3),
            **freedom_columns("velocity at the shoulder, mm/s", readings.shoulder or unknown, 1e3),
            **freedom_columns("velocity at the shoulder's top, mm/s", flow.top_velocity, 1e3),
            **{key: value for name, words in PRESSURES.items()
               for key, value in freedom_columns(f"drop of {words}, Pa", flow.drops[name]).items()},
            **freedom_columns("slurry at the centre of circulation, %", flow.centre_share, 100),
            "force over weight": flow.case.load[0] if flow.case.load else np.nan,
            "missing over hold-up": flow.missing, "error of the feed": flow.feed_error}


def beyond_limits(flow: Flow) -> Iterator[str]:
    """Why the numbers of a flow are not to be trusted: slurry is missing, or it is not fed as asked."""
    if not flow.missing <= CONSERVED:
        yield f"{flow.run.name}: {flow.missing:.1e} of the slurry is missing; expected {CONSERVED:g} or less"
    if flow.case.feed and not flow.feed_error <= AS_ASKED:
        yield (f"{flow.run.name}: the feed differs by {flow.feed_error:.1e} of it from what was asked; expected "
               f"{AS_ASKED:g} or less")


def cost_row(run: Run, root: Path) -> Row:
    """What a run took, with all of its passes, and what Allrun --plan foretold where it was asked. A plan has the times
    of a single pass, so those of balls and slurry in turn are left out."""
    cases = [MillCase(folder) for folder in folders_of(root, run)]
    summaries = [one for case in cases if case.flow for _, one in case.record.summaries]
    # The first case of a run that is not dry has the balls of its dry run
    made = cases if run.way == "dry" else cases[1:]
    memory = [one.get("memory_bytes") for one in summaries or [case.results or {} for case in cases]]
    row: Row = {"run": run.name, "cells": cases[-1].flow.mesh.cells if cases[-1].flow else None,
                "steps": sum(one["steps"] for one in summaries) or None,
                "flow, min": sum(one["wall_s"] for one in summaries) / 60 or None,
                "dry run, min": sum(case.result("wall_time_s") for case in made) / 60 or None,
                "memory, GB": max(memory) / 1e9 if all(memory) else None,
                "disk, GB": sum(one.stat().st_size for one in (root / run.name).rglob("*")
                                if one.is_file() and not one.is_symlink()) / 1e9}
    plan = root / run.name / "plan.json"
    if plan.is_file():
        content = read_json(plan, "plan")
        planned = {one["stage"]: one for one in content["stages"]}
        for stage in ("charge", "flow") if len(cases) == 1 else ():
            row[f"planned {stage}, min"] = planned[stage]["time_s"] / 60 if stage in planned else None
        row["planned memory, GB"] = content["total"]["memory_bytes"] / 1e9
        row["planned disk, GB"] = content["total"]["disk_bytes"] / 1e9
    return row


def cell(row: Row, key: str) -> str:
    """A row's entry in the printed table, with its error and, if that is not exact, its degrees of freedom."""
    value = row.get(key)
    if value is None or value == "" or isinstance(value, float) and np.isnan(value):
        return "–"
    if not isinstance(value, float):
        return str(value)
    error = row.get(f"{key} ±", np.nan)
    if np.isnan(error):
        return f"{value:.4g}"
    return freedom_text(row, key, 2 if abs(value) < 1000 else 0)


def lines_of(rows: Sequence[Row]) -> Iterator[str]:
    """The table as text: a line for each quantity and a column for each run, in blocks of six runs. In
    brackets: degrees of freedom of the errors."""
    for begin in range(0, len(rows), 6):
        block = rows[begin:begin + 6]
        for key in (one for row in block[:1] for one in row if not one.endswith((" ±", ", freedom"))):
            yield key.ljust(46) + "".join(cell(row, key).rjust(21) for row in block)
        yield ""


def read_each(root: Path, chosen: Sequence[Run], read: Callable[[Run, Path], Any]) -> tuple[dict[str, Any], list[str]]:
    """Run -> what is read of its folder; and why the others are not finished or not read."""
    found, missing = {}, []
    for run in chosen:
        try:
            found[run.name] = read(run, folders_of(root, run)[-1])
        except NotFinished as error:
            missing.append(f"not finished: {run.name}: {error}")
        except (RuntimeError, OSError) as error:
            missing.append(f"not read: {run.name}: {error}" if (root / run.name / "mill.json").is_file()
                           else f"not finished: {run.name}: not begun")
    return found, missing


def dry_case(_: Run, folder: Path) -> MillCase:
    """The case of a dry run. NotFinished if it is not complete."""
    case = MillCase(folder)
    if case.results is None or case.solids is None:
        raise NotFinished("; ".join(["the dry run has no results or no averages", *case.unusable]))
    return case


def write_all(root: Path, dry: dict[str, MillCase], flows: dict[str, Flow], missing: list[str]) -> list[str]:
    """Writes tables, pictures and the page; the lines of the text."""
    charges = [charge_row(RUNS[name], case) for name, case in dry.items()]
    rows = [flow_row(flow) for flow in flows.values()]
    costs = [cost_row(RUNS[name], root) for name in (*dry, *flows)]
    published = [flow.readings for flow in flows.values() if is_published(flow.run)]
    found = [*(one for one in verdicts(published) if SLICE not in one.runs + one.figure), *own_verdicts(flows, dry)]
    for name, table in (("charges", charges), ("flows", rows), ("costs", costs),
                        ("statements", [asdict(one) for one in found])):
        if table:
            write_csv(root / f"{name}.csv", table)
        else:
            (root / f"{name}.csv").unlink(missing_ok=True)
    drawings.draw_all(root, flows)
    cases = {**dry, **{name: flow.case for name, flow in flows.items()}}
    names = sorted(cases, key=lambda name: (RUNS[name].speed != REFERENCE.speed, name != REFERENCE.name))
    if len(names) > 1:
        (root / "comparison.html").write_text(compare_cases([cases[name].folder for name in names], names=names))
    return [*lines_of(charges), *lines_of(rows), *lines_of(costs), *map(line_of, found), "",
            *missing]


def line_of(one: Verdict) -> str:
    """A verdict as a line of the text."""
    where = one.runs if one.verdict != NOT_TESTED or one.runs else "–"
    return f"{one.verdict:<13} {one.statement}; {where}: {one.figure}"


def main() -> None:
    matplotlib.use("Agg")
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("runs", type=Path, help="folder with the folders of the runs")
    root = parser.parse_args().runs
    dry, missing = read_each(root, [run for run in RUNS.values() if run.way == "dry"], dry_case)
    flows, lacking = read_each(root, [run for run in RUNS.values() if run.way != "dry"], read_flow)
    if not dry and not flows:
        parser.exit(1, "\n".join(["no run is complete:", *missing, *lacking]) + "\n")
    beyond = [f"not conserved: {words}" for flow in flows.values() for words in beyond_limits(flow)]
    lines = write_all(root, dry, flows, [*missing, *lacking, *beyond])
    (root / "mill_30cm_published.txt").write_text("\n".join(lines) + "\n")
    print("\n".join(lines))
    if beyond:
        sys.exit("\n".join(["mill_30cm_published: error: these flows are beyond their limits:", *beyond]))


if __name__ == "__main__":
    main()
