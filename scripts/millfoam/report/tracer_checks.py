# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks of the tracers of a flow: their bounds, and the mean time in the mill."""
import numpy as np

from ..files.mill_case import MillCase
from ..readings.residence import hold_up_over_feed, read_tracer, residence, tracer_names
from .verdict import Check, judged

BOUNDS = 1e-10  # of the inlet's concentration, by which a tracer may be below 0 or above it
MEAN_TIME, ERRORS = 0.01, 3.0  # of hold-up over feed, or standard errors, by which the mean time may differ
NO_TRACER = "Let the flow run longer."


def tracer_bounds(case: MillCase) -> Check:
    """Whether the concentrations of all tracers stay between 0 and that of the inlet, 1."""
    name = "The tracer stays within its bounds"
    tables = {one: read_tracer(case.folder, one) for one in tracer_names(case.folder)}
    beyond = {one: max(-table.lowest, table.highest - 1, 0.0) for one, table in tables.items()
              if np.isfinite([table.lowest, table.highest]).all()}
    if not beyond:
        return Check(name, "unknown", "no cell had slurry whose concentration is judged", NO_TRACER)
    words = ", ".join(f"{one} is from {tables[one].lowest:.1e} to 1 {tables[one].highest - 1:+.1e}" for one in beyond)
    return judged(name, max(beyond.values()), BOUNDS, f"{words} of the inlet's concentration (limit {BOUNDS:.0e} "
                  "beyond 0 and 1)", "Run the flow again with this version, and give the tracer's solver a tolerance "
                  "(fvSolution) of 1e-12 or less.")


def mean_time(case: MillCase) -> Check:
    """Whether slurry stays in the mill for the hold-up over the feed, by all tracers whose time is known."""
    name = "The tracer stays as long as hold-up over feed"
    advice = "Begin the tracer when the flow is steady, and let the flow run longer."
    over, words = [], []
    for one in tracer_names(case.folder):
        table = read_tracer(case.folder, one)
        try:
            found = residence(table)
        except RuntimeError as reason:
            words.append(f"{one}: {reason}")
            continue
        expected = hold_up_over_feed(case.balance, table, case.turn) if case.balance is not None else None
        if expected is None:
            words.append(f"{one}: the feed is not known")
            continue
        share = found.mean / expected.value - 1
        # How much the mean depends on the fit of what has not left is an error of it
        errors = np.array([expected.error / expected.value, found.doubt[0]])
        limit = max(MEAN_TIME, ERRORS * float(np.hypot(*np.nan_to_num(errors))))
        if abs(share) > limit and np.isnan(errors).any():
            words.append(f"{one}: {found.mean:.4g} s, {100 * share:+.2g} % from {expected.value:.4g} s; its error is "
                         "not known")
            continue
        over.append(abs(share) / limit)
        words.append(f"{one}: {found.mean:.4g} s, {100 * share:+.2g} % from {expected.value:.4g} s (limit "
                     f"{100 * limit:.2g} %: {ERRORS:g} standard errors, or {100 * MEAN_TIME:g} %)")
    if not over:
        return Check(name, "unknown", "; ".join(words), advice)
    return judged(name, float(np.max(over)), 1, "; ".join(words), advice, doubtful=2)
