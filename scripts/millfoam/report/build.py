# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts the report of a case, or of several beside each other, together."""
import datetime

from . import checks, comparison, page
from .sections import SECTIONS, Readings
from .sources import MillCase

FOOT = "Written by millFoam's scripts/report on {:%Y-%m-%d %H:%M}."


def report_case(folder, begin=None):
    """HTML text of the report of a case's folder. RuntimeError where that is none or was not run."""
    case = MillCase(folder, begin)
    readings = Readings(case)
    sections = [(name, heading, section(case, readings)) for name, heading, section in SECTIONS]
    sections.insert(1, ("checks", "Can it be believed?", [page.verdicts(checks.all_checks(case))]))
    title = case.mill.get("title") or case.name
    return page.page(f"{title} – {case.name}", case.summary(), sections, FOOT.format(datetime.datetime.now()))


def compare_cases(folders, begin=None):
    """HTML text of a comparison of cases' folders, the first being what the others are held against."""
    cases = [MillCase(folder, begin) for folder in folders]
    readings = [Readings(case) for case in cases]
    subtitle = f"{cases[0].name} against " + ", ".join(case.name for case in cases[1:])
    return page.page("Comparison of mills", subtitle, comparison.sections(cases, readings), FOOT.format(datetime.datetime.now()))
