# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of the 30 cm mill and of the 12 cm mill's slice for comparisons, whether they are steady, and verdicts.

Verdicts: `confirmed` and `contradicted` if the difference is one with 95 % confidence (Mean.sign), `undecided` if it is
not, if the height of a run drifts (see `unsteady`), or if runs differ in more than what the statement names (see
`unlike`), `not tested` if a run is missing, which the verdict names, and `depends on the definition` where one
definition of a number confirms what another one contradicts. A verdict on runs that the report does not call steady
says so. Runs of the 30 cm mill count if they reach LATEST."""
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from millfoam.readings.batches import batch_means, mean_over_turns, whole_turns
from millfoam.readings.means import BLOCKS, mean_of_series
from millfoam.report.steadiness import halves

LATEST = 4.5  # flow time that a run of the 30 cm mill must have reached, s
# Share by which feeds, or slurries at first, may differ. Other random places of the balls change the latter by 0.3 %
ALIKE = 0.01
LARGE, SLICE = "30 cm mill", "12 cm slice"
CONFIRMED, CONTRADICTED, UNDECIDED, NOT_TESTED = "confirmed", "contradicted", "undecided", "not tested"


@dataclass(frozen=True)
class Verdict:
    """A statement, the runs with which it was compared, the verdict, and its number or what is missing."""
    statement: str
    runs: str
    verdict: str
    figure: str


def sign_of(mean):
    """Mean.sign; 0 for an error of 0 of blocks that are equal: they are too coarse to show one."""
    return mean.sign if mean.shows_error else 0


def by_sign(difference):
    """The verdict on a statement that a Mean is positive (sign_of)."""
    return {1: CONFIRMED, -1: CONTRADICTED, 0: UNDECIDED}[sign_of(difference)]


def all_positive(*differences):
    """The verdict on a statement that all of some Means are positive: one that is negative contradicts it."""
    signs = [sign_of(difference) for difference in differences]
    return CONTRADICTED if -1 in signs else CONFIRMED if all(sign == 1 for sign in signs) else UNDECIDED


def mill_of(run):
    """LARGE, SLICE, or None for another mill."""
    if abs(run.diameter - 0.3) < 1e-6 and run.ends:
        return LARGE
    return SLICE if abs(run.diameter - 0.12) < 1e-6 and not run.ends else None


class Which(NamedTuple):
    """A run to look for: speed (% of critical), law (None: no balls), slurry (% solids; None: any), mill."""
    speed: int
    law: str
    solids: int = None
    mill: str = LARGE

    def fits(self, run):
        """Whether a run is one of these."""
        same = (mill_of(run), run.speed, run.law) == (self.mill, self.speed, self.law)
        return same and self.solids in (None, run.solids)

    def __str__(self):
        if self.mill == SLICE:
            return f"{SLICE} at {self.speed} %, {self.law or 'without balls'}" + (
                f", {self.solids} % slurry" if self.solids else "")
        return (f"coupled_{self.speed}_{self.law}" if self.law else f"fluid_only_{self.speed}") + (
            f" with {self.solids} % slurry" if self.solids != 20 else "")


class Runs:
    """RunReadings to choose from, and why a run is missing."""

    def __init__(self, runs):
        self.short = [run for run in runs if mill_of(run) == LARGE and run.last < LATEST]
        self.runs = [run for run in runs if run not in self.short]

    def find(self, which):
        """The first run that is Which, or None."""
        return next((run for run in self.runs if which.fits(run)), None)

    def missing(self, which):
        """Text for a run that find() does not find."""
        for run in self.short:
            if which.fits(run):
                return f"{which} ends at {run.last:g} s; expected {LATEST:g} s or more"
        return f"missing: {which}"

    def of(self, mill):
        """The runs of a mill with balls."""
        return [run for run in self.runs if mill_of(run) == mill and run.law]

    def slice_speeds(self):
        """Speeds (% of critical) of the slice's runs; the mill case's if there are none."""
        return sorted({run.speed for run in self.runs if mill_of(run) == SLICE}) or [50]

    def places(self):
        """(mill, speed, slurries, % solids, two or more) at which runs with balls are compared. For the slice these are
        the existing ones; if there is only one, also one to compare it with."""
        found = [(LARGE, 75, [20, 40])]
        for speed in self.slice_speeds():
            solids = {run.solids for run in self.of(SLICE) if run.speed == speed and run.solids}
            if len(solids) < 2:
                solids = {20, 40} if not solids else solids | ({40} if max(solids) < 40 else {20})
            found.append((SLICE, speed, sorted(solids)))
        return found


def unread(run, runs, which):
    """Why a statement was not tested: its run is missing, or its failure."""
    return "; ".join(run.failures) or f"{run.name}: nothing was read" if run else runs.missing(which)


def unsteady(run):
    """Why a run is not steady over the averaged time, or an empty text: that time is shorter than a turn of the mill,
    or the height of the slurry's centre of mass differs between its halves with 95 % confidence (Mean.sign). Halves and
    error are those of the report, without the drift up to which the report calls a flow steady: differences of runs are
    smaller than that. One of 20 steady runs is called unsteady by chance if the batches of `halves` are independent,
    otherwise more: a third for a correlation time of half a turn and 2.8 turns."""
    if not run.series:
        return f"{run.name}: its height over time is not known"
    times, heights = run.series.times, height_over_time(run)
    span = times[-1] - times[0]
    if span < 0.999 * run.turn:  # times are rounded
        return f"{run.name}: averaged over {span:.2g} s, less than a turn of the mill, {run.turn:.2g} s"
    drift = halves(times, heights, 2 * times[0] - times[1], run.turn)
    if not np.isfinite(drift.error):
        return f"{run.name}: {len(times)} times are too few to find a drift"
    return f"{run.name}: its height drifts by {drift.text('mm', 1e3, '.2f')} between the halves" if drift.sign else ""


def unlike(*runs):
    """Why the slurry of runs cannot show what only the thing does that a statement names, its concentration or the law
    of its drag: their feeds or their slurries at first differ by more than ALIKE, which moves it, too. An empty text if
    they do not; what is not known counts as alike."""
    reasons = []
    for name, what, scale, unit in (("feed", "feeds", 1e6, "ml/s"), ("first_slurry", "slurries at first", 1e3, "l")):
        found = [getattr(run, name) for run in runs if getattr(run, name) is not None]
        if found and max(found) - min(found) > ALIKE * max(found):
            reasons.append(f"their {what} differ, too: {' and '.join(f'{scale * one:.3g}' for one in found)} {unit}")
    return "; ".join(reasons)


def withheld(verdict, figure, reason):
    """A verdict and its number; if there is a reason and it was tested, `undecided`, with the reason after the
    number."""
    return (UNDECIDED, f"{figure}; {reason}") if reason and verdict != NOT_TESTED else (verdict, figure)


def judged(verdict, figure, *runs):
    """A verdict on runs and its number, with the names of runs that the report does not call steady; if the height of a
    run drifts, `undecided` with the reason."""
    moving = [run.name for run in runs if run.steady not in (None, "holds")]
    if moving:
        figure += f" (not steady by the report: {', '.join(moving)})"
    reasons = [reason for reason in map(unsteady, runs) if reason]
    if reasons:
        return UNDECIDED, f"{figure}; not steady: {'; '.join(reasons)}"
    return verdict, figure


def height_over_time(run):
    """Height of the centre of mass of the slurry between the mill's ends (so in front of the grates) above the axis, at
    the times of a run's series (m)."""
    series = run.series
    known = np.where(series.holdup > 0, series.height, 0.0)
    return (known * series.holdup).sum(axis=1) / series.holdup.sum(axis=1)


def by_turn(run, values):
    """Means [turns, ...] of values [times, ...] at the times of a run's series over its last whole turns if two fit,
    otherwise over fifths of its time."""
    times, values = run.series.times, np.asarray(values, dtype=float)
    turns = whole_turns(times[-1] - times[0], run.turn)
    if turns < 2:
        return np.array([part.mean(axis=0) for part in np.array_split(values, min(BLOCKS, len(values)))])
    columns = values.reshape(len(values), -1).T
    means = [batch_means(times, column, times[-1] - turns * run.turn, run.turn, turns) for column in columns]
    return np.stack(means, axis=1).reshape(turns, *values.shape[1:])


def over_turns(run, values):
    """Mean of values at the times of a run's series, over its last whole turns if two fit, otherwise by fifths."""
    times = run.series.times
    return mean_over_turns(times, np.asarray(values), times[0], run.turn) or mean_of_series(values)


def height(run):
    """Mean of height_over_time (m)."""
    return over_turns(run, height_over_time(run))
