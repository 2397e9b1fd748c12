#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the tables of this study's runs with those of another machine or version, number by number: flows.csv, and
charges.csv where both have it. It fails if a run differs in more numbers than chance explains."""
import argparse
import sys
from dataclasses import replace
from pathlib import Path

from millfoam.files.data_files import DataError
from millfoam.readings.means import CONFIDENCE
from millstudies.compared_tables import CHANCE, ComparedRun, compared, lines_of, read_table, require_same

from runs import RUNS

FLOWS, CHARGES = "flows.csv", "charges.csv"
# Begin of the names of the columns that are compared. Errors of the charge's other numbers are of blocks that are
# shorter than a turn: lower bounds
COMPARED = {FLOWS: "", CHARGES: "power, W"}
# What a run is made with
SETTINGS = {FLOWS: ("speed, %", "solids, %", "law", "turns", "feed, ml/s"), CHARGES: ("speed, %",)}


def tables_of(other: Path) -> dict[str, Path]:
    """Name of a table -> its file, of a flows.csv or of a folder with one: charges.csv, too, if it is next to it."""
    flows = other / FLOWS if other.is_dir() else other
    beside = flows.with_name(CHARGES)
    return {FLOWS: flows, **({CHARGES: beside} if beside.is_file() else {})}


def compare(root: Path, other: Path) -> tuple[list[ComparedRun], list[str]]:
    """Runs that the tables in `root` and those of `other` have, compared, and lines on what only one of them has.
    DataError if a table cannot be compared."""
    runs, missing = [], []
    for name, path in tables_of(other).items():
        there = read_table(path, RUNS)
        if not (root / name).is_file():
            missing.append(f"not here: {name}, with {', '.join(there)}")
            continue
        here = read_table(root / name, RUNS)
        require_same(here, there, path, SETTINGS[name])
        runs += [compared(run, here[run], there[run], COMPARED[name]) for run in here if run in there]
        missing += [f"not {where}: {run}" for one, rest, where in ((here, there, "there"), (there, here, "here"))
                    for run in one if run not in rest]
    if CHARGES not in tables_of(other) and (root / CHARGES).is_file():
        missing.append(f"not there: {CHARGES}, so dry runs are not compared")
    return [replace(one, chance=CHANCE / len(runs)) for one in runs], missing


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("other", type=Path, help="the other flows.csv, or the folder with it")
    parser.add_argument("runs", type=Path, nargs="?",
                        help="folder with the tables here; without it, the other tables are only checked")
    options = parser.parse_args()
    try:
        if options.runs is None:
            for path in tables_of(options.other).values():
                read_table(path, RUNS)
            return
        runs, missing = compare(options.runs, options.other)
    except DataError as error:
        sys.exit(f"against: error: {error}")
    print("\n".join([*(lines_of(runs) if runs else ["no run is in both"]), *missing]))
    if not runs:
        sys.exit(1)
    if apart := [run.name for run in runs if run.differs]:
        sys.exit(f"against: error: more numbers than chance gives in {1 - CHANCE:.0%} of cases differ with "
                 f"{CONFIDENCE:.0%} confidence: {', '.join(apart)}")


if __name__ == "__main__":
    main()
