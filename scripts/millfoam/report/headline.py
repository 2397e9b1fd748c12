# SPDX-License-Identifier: GPL-3.0-or-later
"""What the reader of a report must know first: numbers of a start-up, a repeated charge, checks that a longer run
cannot change."""
from collections.abc import Sequence

import numpy as np

from ..files.mill import Mill
from ..files.mill_case import MillCase
from .steadiness import NAME as FLOW_IS_STEADY
from .verdict import Check


def first_lines(case: MillCase, checks: Sequence[Check]) -> list[str]:
    """Sentences for the top of the report of a MillCase with these checks. The first says whether the flow's numbers
    describe its start."""
    lines = []
    if case.flow:
        lines += [line for line in (start_words(case, checks), repetition_words(case)) if line]
    elif case.record.last and not case.record.last.get("complete"):
        lines.append("The flow was cut short, and its fields are not shown.")
    failed = [check for check in checks if check.name == "All stages belong to this mill" and check.state == "fails"]
    if failed:
        lines.append("Stages of different mills are mixed in this case: see “All stages belong to this mill” below.")
    if case.mill.fines_share > 0:
        lines.append(f"The charge is simulated {fines_words(case.mill)}: its load is {100 * case.mill.load:.3g} %, "
                     f"mill.yaml requests {100 * case.mill.load_asked:.3g} %.")
    return lines + [lasting_words(check) for check in checks if check.lasting]


def start_words(case: MillCase, checks: Sequence[Check]) -> str:
    """That the flow's numbers describe its start, because it was cut short or is not steady; otherwise empty."""
    if case.is_cut_short:
        asked = f" of {case.duration:.3g} s" if np.isfinite(case.duration) else ""
        return (f"The flow was cut short: it ends at {case.last:.3g} s{asked}. Its numbers describe the start of the "
                "flow.")
    steady = next((check.state for check in checks if check.name == FLOW_IS_STEADY), "unknown")
    words = {"fails": "The flow is not steady: its numbers describe the start of the flow. A longer run changes them "
                      "(flow.duration).",
             "look": "It is doubtful whether the flow is steady: its numbers may describe the start of the flow."}
    return words.get(steady, "")


def repetition_words(case: MillCase) -> str:
    """That the dry record was repeated, and how often; empty if it was not."""
    times = (case.record.last.get("solids") or {}).get("repeated") or 0
    return (f"The record of the dry charge is shorter than the flow and was repeated {times} "
            f"{'time' if times == 1 else 'times'}: the charge's motion repeats itself." if times else "")


def lasting_words(check: Check) -> str:
    """That a longer run cannot make a check hold, and what it means."""
    word = "fails" if check.state == "fails" else "is doubtful"
    return f"“{check.name}” {word}, and a longer run does not change that: {check.meaning}."


def summary(case: MillCase) -> str:
    """One line on a MillCase: what was run."""
    mill = case.mill
    part = f" of {1e3 * mill.whole_length:.4g} mm" if mill.length < 0.999 * mill.whole_length else ""
    length = f"{1e3 * mill.length:.4g} mm" + (f" (periodic slice{part})" if mill.is_slice else "")
    words = [f"{2e3 * mill.radius:.4g} × {length}",
             f"{mill.sense} at {100 * mill.critical_share:.3g} % of critical ({abs(mill.omega):.2f} rad/s)"]
    words += [f"{int(case.results['balls'])} balls"] if case.results else []
    words += [fines_words(mill)] if mill.fines_share > 0 else []
    if case.flow:
        words.append(f"slurry {mill.slurry('density_kg_m3'):.4g} kg/m³")
        unknown = "drag law not known" if case.flow.displaced else "no balls in the flow"
        words.append(f"drag: {case.law}" if case.law else unknown)
    return ", ".join(words)


def fines_words(mill: Mill) -> str:
    """In words, the part of a Mill's charge that is not simulated."""
    return f"without balls of {1e3 * mill.largest_fines:.3g} mm and less ({100 * mill.fines_share:.0f} % of the mass)"
