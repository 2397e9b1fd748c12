#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the thesis' statements about slurry with runs of the 30 cm mill and of the 12 cm mill's slice: a table on
the screen, statements.csv and statements.md."""
import argparse
import sys
from dataclasses import asdict
from pathlib import Path

from millfoam.files.data_files import write_csv
from millfoam.files.mill_case import MillCase
from millstudies.mill_runs import summary_of_whole
from millstudies.own_mill import require_own_mill
from millstudies.statements import read, verdicts

HERE = Path(__file__).parent.resolve()
MILLS = HERE.parents[1] / "mills"
LAWS = HERE.parent / "mill_drag_comparison" / "runs" / "flows"
FINE = "fine_"  # before a law's name: on the finer mesh
VARIANTS = ("fluid_only_60", "fluid_only_75", "coupled_75_Beetstra", "coupled_75_ErgunWenYu")


def is_run(folder):
    return (folder / "constant" / "millProperties").is_file()


def slices_there(runs=LAWS):
    """The 12 cm slices of mill_drag_comparison that are complete, with the laws' own drag and the mill's own windows:
    of the finer mesh, or else all of the mill's own. Only these have names without an underscore, but for FINE."""
    whole = [folder for folder in sorted(runs.glob("*"))
             if "_" not in folder.name.removeprefix(FINE) and summary_of_whole(folder)]
    return [folder for folder in whole if folder.name.startswith(FINE)] or whole


def folders_there():
    """The runs of mill_30cm, all on 33 layers or else all on 9, because one statement compares equal
    layers; the slices of mill_drag_comparison, which share their balls; and mill_12cm."""
    layers = [[MILLS / "mill_30cm" / f"{name}{slurry}" / variant for slurry in ("", "_slurry_40")
               for variant in VARIANTS]
              for name in ("runs_33", "runs_9")]
    begun = next((folders for folders in layers if any(map(is_run, folders))), [])
    return [folder for folder in [*begun, *slices_there(), MILLS / "mill_12cm"] if is_run(folder)]


def refuse_multiplied(case):
    """RuntimeError if a MillCase's drag is not that of its law."""
    factor = case.mill.flow("multiplier", 1)
    if case.law and factor != 1:
        raise RuntimeError(f"{case.mill.path}: flow.multiplier {factor:g}; expected 1, the law's own drag")


def refuse_interrupted(case):
    """RuntimeError if a MillCase is a slice whose flow was interrupted. A 30 cm mill counts from LATEST on."""
    if case.is_slice and case.is_cut_short:
        raise RuntimeError(f"the flow ends at {case.last:.3g} s; expected {case.duration:.3g} s")


def read_case(folder):
    """MillCase of a folder whose flow can be judged; RuntimeError for another one."""
    case = MillCase(folder)
    if not case.flow:
        raise RuntimeError(f"{folder}: no flow; expected reconstructed times with alpha.slurry in it")
    refuse_multiplied(case)
    for refuse in (require_own_mill, refuse_interrupted):
        try:
            refuse(case)
        except RuntimeError as error:
            raise RuntimeError(f"{folder}: {error}") from error
    return case


def read_cases(folders):
    """RunReadings of the folders that hold a run, and a message for each of the others and for what could not be
    read."""
    runs, messages = [], []
    for folder in folders:
        try:
            case = read_case(folder)
            print(f"{folder} …", flush=True)
            runs.append(read(case))
            messages += runs[-1].failures
        except (RuntimeError, OSError) as error:
            messages.append(str(error))
    return runs, messages


def write(found, messages, folder):
    write_csv(folder / "statements.csv", [asdict(one) for one in found])
    lines = ["| statement | runs | verdict | number |", "|---|---|---|---|"]
    lines += [f"| {one.statement} | {one.runs} | {one.verdict} | {one.figure} |" for one in found]
    (folder / "statements.md").write_text("\n".join(lines + [""] + [f"- {text}" for text in messages]) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("cases", nargs="*", type=Path, metavar="CASE",
                        help="folders of runs [mill_30cm's on 33 layers, or else on 9, mill_drag_comparison's, "
                             "mill_12cm]")
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
