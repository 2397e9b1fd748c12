# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the report of a case, or the comparison of several cases."""
import datetime
from collections.abc import Sequence
from pathlib import Path

from ..files.mill import read_mill
from ..files.mill_case import MillCase
from ..files.stirred_case import StirredCase
from . import comparison, measurements, page, stirred_sections
from .case_readings import Readings
from .checks import all_checks
from .headline import fines_words, first_lines, summary
from .sections import SECTIONS
from .verdict import Check
from .words import Name, typeset

FOOT = "Written by millFoam's scripts/report on {:%Y-%m-%d %H:%M}."


def report_case(folder: Path | str, begin: float | None = None, measured: Path | None = None,
                tracers: Sequence[Path] = ()) -> str:
    """HTML text of the report of a case's folder; measured: CSV of a measured map; tracers: files of tracks.
    RuntimeError if the folder is not that of a case that was run, or a file cannot be read."""
    if read_mill(folder, None).machine == StirredCase.machine:
        if measured or tracers:
            raise RuntimeError(f"{folder}: the mill is stirred; expected a tumbling one with --measured and --tracer")
        return report_stirred(StirredCase(folder, begin))
    case = MillCase(folder, begin)
    against = [measurements.measured_section(case, measured)] if measured else []
    against += [measurements.tracer_section(case, tracers)] if tracers else []
    readings = Readings(case)
    sections = [(name, heading, section(case, readings)) for name, heading, section in SECTIONS]
    found = all_checks(case)
    sections.insert(1, ("checks", "Can it be believed?", [page.verdicts(found)]))
    sections[3:3] = against
    fines = f", {fines_words(case.mill)}" if case.mill.fines_share > 0 else ""
    return page.page(Name(title_of(case) + fines), summary(case), sections, FOOT.format(datetime.datetime.now()),
                     first_lines(case, found))


def title_of(case: MillCase) -> Name:
    """The mill's title and the folder's name, if they differ."""
    return Name(f"{case.title} – {case.name}" if case.title != case.name else case.title)


def named_lines(cases: Sequence[MillCase], names: Sequence[str], found: Sequence[list[Check]]) -> list[Name]:
    """First lines of cases with these lists of checks, with their names."""
    return [Name(f"{name}: {typeset(line)}") for name, case, checks in zip(names, cases, found)
            for line in first_lines(case, checks)]


def compared_words(names: Sequence[str]) -> Name:
    """That all but the first of these cases are compared with it."""
    return Name(f"{', '.join(names[1:])} compared with {names[0]}")


def report_stirred(case: StirredCase) -> str:
    """HTML text of the report of a stirred mill."""
    found = all_checks(case)
    sections = [(name, heading, section(case)) for name, heading, section in stirred_sections.SECTIONS]
    sections.insert(1, ("checks", "Can it be believed?", [page.verdicts(found)]))
    return page.page(title_of(case), stirred_sections.summary(case), sections, FOOT.format(datetime.datetime.now()),
                     first_lines(case, found))


def compare_cases(folders: Sequence[Path | str], begin: float | None = None,
                  names: Sequence[str] | None = None) -> str:
    """HTML text of a comparison of cases' folders with the first one; names: of the cases, otherwise of their folders.
    RuntimeError for mills of both machines."""
    machines = [read_mill(folder, None).machine for folder in folders]
    if len(set(machines)) > 1:
        raise RuntimeError("expected mills of one machine: " + ", ".join(
            f"{folder} is {machine}" for folder, machine in zip(folders, machines)))
    if machines[0] == StirredCase.machine:
        return compare_stirred([StirredCase(folder, begin) for folder in folders], names)
    cases = [MillCase(folder, begin) for folder in folders]
    readings = [Readings(case) for case in cases]
    names = [Name(name) for name in names or comparison.distinct(cases)]
    found = [all_checks(case) for case in cases]
    lines = named_lines(cases, names, found)
    return page.page("Comparison of mills", compared_words(names), comparison.sections(cases, readings, names, found),
                     FOOT.format(datetime.datetime.now()), lines)


def compare_stirred(cases: Sequence[StirredCase], names: Sequence[str] | None = None) -> str:
    """HTML text of a comparison of stirred mills with the first one; names: as compare_cases has them."""
    names = [Name(name) for name in names or comparison.distinct(cases)]
    found = [all_checks(case) for case in cases]
    lines = named_lines(cases, names, found)
    return page.page("Comparison of stirred mills", compared_words(names),
                     stirred_sections.compared(cases, names, found), FOOT.format(datetime.datetime.now()), lines)
