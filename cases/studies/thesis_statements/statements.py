#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holds the thesis' statements about slurry in the 30 cm mill against runs: a table on the screen, statements.csv and
statements.md."""
import argparse
import csv
import sys
from dataclasses import asdict, fields
from pathlib import Path

from millfoam.flow_readings import read_run
from millfoam.report.sources import MillCase
from millfoam.statements import Verdict, verdicts

HERE = Path(__file__).parent.resolve()
MILLS = HERE.parents[1] / "mills"
VARIANTS = ("fluid_only_60", "fluid_only_75", "coupled_75_Beetstra", "coupled_75_ErgunWenYu")


def is_run(folder):
    return (folder / "constant" / "millProperties").is_file()


def folders_there():
    """The runs of mill_30cm, all on 33 layers or else all on 9, as those of one statement must be alike, and mill_12cm."""
    layers = [[MILLS / "mill_30cm" / f"{name}{slurry}" / variant for slurry in ("", "_slurry_40") for variant in VARIANTS]
              for name in ("runs_33", "runs_9")]
    begun = next((folders for folders in layers if any(map(is_run, folders))), [])
    return [folder for folder in [*begun, MILLS / "mill_12cm"] if is_run(folder)]


def read_cases(folders):
    """RunReadings of the folders that hold a run, and a message for each of the others and for what could not be read."""
    runs, messages = [], []
    for folder in folders:
        try:
            case = MillCase(folder)
            if not case.flow:
                raise RuntimeError(f"{folder}: no flow; expected reconstructed times with alpha.slurry in it")
            print(f"{folder} …", flush=True)
            runs.append(read_run(case))
            messages += runs[-1].failures
        except (RuntimeError, OSError) as error:
            messages.append(str(error))
    return runs, messages


def write(found, messages, folder):
    columns = [field.name for field in fields(Verdict)]
    with open(folder / "statements.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, columns)
        writer.writeheader()
        writer.writerows(map(asdict, found))
    lines = ["| statement | runs | verdict | number |", "|---|---|---|---|"]
    lines += [f"| {one.statement} | {one.runs} | {one.verdict} | {one.figure} |" for one in found]
    (folder / "statements.md").write_text("\n".join(lines + [""] + [f"- {text}" for text in messages]) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("cases", nargs="*", type=Path, metavar="CASE",
                        help="folders of runs [mill_30cm's on 33 layers, or else on 9, and mill_12cm]")
    parser.add_argument("--output", type=Path, default=HERE, help="folder of the tables [this study's]")
    options = parser.parse_args()
    runs, messages = read_cases(options.cases or folders_there())
    found = verdicts(runs)
    statement = None
    for one in found:
        if one.statement != statement:
            print(f"\n{one.statement}")
        statement = one.statement
        print(f"    {one.verdict:<13} {one.runs}: {one.figure}" if one.runs else f"    {one.verdict:<13} {one.figure}")
    for text in messages:
        print(f"not read: {text}")
    write(found, messages, options.output)
    return 0


if __name__ == "__main__":
    sys.exit(main())
