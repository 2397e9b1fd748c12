# SPDX-License-Identifier: GPL-3.0-or-later
"""Statements about slurry in the 30 cm mill (M. Malahe, MSc thesis, University of Cape Town, 2012) held against runs: each gives
verdicts with the numbers that say so.

Verdicts: `confirmed` and `contradicted` where the difference is more than twice its standard error over time, `undecided` where
it is not, `not tested` where a run is missing: which one is told. Tilts, numbers of humps and shares that are held against a
limit are compared as they are; their errors are told. Runs of the 30 cm mill count from LATEST on."""
from dataclasses import dataclass

import numpy as np
from scipy.signal import find_peaks

from .axial import fit_gaussians
from .flow_readings import Mean, series_mean

LATEST = 4.5  # flow time that a run of the 30 cm mill must have reached, s
FLAT_TILT, FLAT_DEVIATION = 5.0, 0.02  # of a flat surface, at most: degrees; deviation from its line over the mill's diameter
TWICE = (1.5, 2.5)  # what counts as about twice
SLIGHTLY = 0.03  # of a height, over the mill's diameter
CLEARLY = 1.1  # ratio of two pressure drops from which one is clearly larger
REYNOLDS = {20: 150, 40: 90}  # solids of the slurry, % by mass -> number that most of the slurry is below
CONFIRMED, CONTRADICTED, UNDECIDED, NOT_TESTED = "confirmed", "contradicted", "undecided", "not tested"


@dataclass(frozen=True)
class Verdict:
    """A statement, the runs it was held against, what came out, and the number that says so or what is missing."""
    statement: str
    runs: str
    verdict: str
    figure: str


def sign(difference):
    """1, -1 or 0: of a Mean, if it is more than twice its error from nought."""
    return 0 if not abs(difference.value) > 2 * difference.error else int(np.sign(difference.value))


def by_sign(difference):
    """The verdict on a statement that a Mean is positive."""
    return {1: CONFIRMED, -1: CONTRADICTED, 0: UNDECIDED}[sign(difference)]


def large_mill(run):
    return abs(run.diameter - 0.3) < 1e-6


class Runs:
    """RunReadings to choose from, and why a run that was asked for is not there."""

    def __init__(self, runs):
        self.short = [run for run in runs if large_mill(run) and run.last < LATEST]
        self.runs = [run for run in runs if run not in self.short]

    def find(self, speed, law, solids):
        """The run of the 30 cm mill with this speed (% of critical), law (None: no balls) and slurry (% solids), or None."""
        return next((run for run in self.runs if self._is(run, speed, law, solids)), None)

    @staticmethod
    def _is(run, speed, law, solids):
        return large_mill(run) and (run.speed, run.law, run.solids) == (speed, law, solids)

    def missing(self, speed, law, solids):
        """What to say of a run that find() does not find."""
        name = (f"coupled_{speed}_{law}" if law else f"fluid_only_{speed}") + (f" with {solids} % slurry" if solids != 20 else "")
        for run in self.short:
            if self._is(run, speed, law, solids):
                return f"{name} ends at {run.last:g} s; expected {LATEST:g} s or more"
        return f"missing: {name}"


def flat_without_balls(runs):
    """Without solids the slurry's free surface is flat across the mill."""
    statement, found = "without solids the free surface is flat across the mill", []
    for speed in (60, 75):
        run = runs.find(speed, None, 20)
        if not run or not run.surface:
            found.append(Verdict(statement, f"fluid_only_{speed}", NOT_TESTED, unread(run, runs, speed, None, 20)))
            continue
        tilt, deviation = run.surface.tilt, run.surface.deviation.value
        flat = abs(tilt.value) <= FLAT_TILT and deviation <= FLAT_DEVIATION * run.diameter
        found.append(Verdict(statement, run.name, CONFIRMED if flat else CONTRADICTED,
                             f"tilt {tilt.told('degrees')}, {1e3 * deviation:.1f} mm from a straight line (flat: {FLAT_TILT:g} "
                             f"degrees, {1e3 * FLAT_DEVIATION * run.diameter:g} mm)"))
    return found


def unread(run, runs, speed, law, solids):
    """Why a statement was not tested: its run is missing, or its failure."""
    return "; ".join(run.failures) or f"{run.name}: nothing was read" if run else runs.missing(speed, law, solids)


def maxima(z, height, error):
    """Places (m) of a profile's maxima, those at its ends too, that stand out: by more than a tenth of its range, and three times
    the error of the difference of two of its heights [n] (m), whose standard errors are `error` (m)."""
    padded = np.concatenate([[height.min() - 1], height, [height.min() - 1]])
    return z[find_peaks(padded, prominence=max(3 * np.sqrt(2) * error, 0.1 * np.ptp(height)))[0] - 1]


def humps_without_balls(runs):
    """Two humps along the axis without solids, about twice as far apart at 75 % of the critical speed as at 60 %."""
    statement, found, apart = "without solids the height of the centre of mass has two humps along the axis", [], {}
    for speed in (60, 75):
        run = runs.find(speed, None, 20)
        if not run or not run.series:
            found.append(Verdict(statement, f"fluid_only_{speed}", NOT_TESTED, unread(run, runs, speed, None, 20)))
            continue
        height, errors = series_mean(run.series.height)
        error = float(np.sqrt(np.mean(errors**2)))
        try:
            fit = fit_gaussians(run.series.z, height, 2)
        except (RuntimeError, ValueError) as failure:
            found.append(Verdict(statement, run.name, NOT_TESTED, str(failure)))
            continue
        places = maxima(run.series.z, height, error)
        apart[speed] = fit.distances[0], len(places) == 2
        found.append(Verdict(statement, run.name, CONFIRMED if len(places) == 2 else CONTRADICTED,
                             f"maxima at {millimetres(places)} mm of {millimetres(run.series.z[[0, -1]])}; two Gaussians at "
                             f"{millimetres(fit.places)} mm, RMSD {1e3 * fit.rmsd:.1f} mm; error {1e3 * error:.1f} mm"))
    return found + [distance_ratio(apart)]


def millimetres(lengths):
    return ", ".join(f"{1e3 * length:.0f}" for length in lengths)


def distance_ratio(apart):
    """Verdict on the distances of two Gaussians by speed: speed -> (m, whether the profile has two humps)."""
    statement, names = "the humps are about twice as far apart at 75 % speed as at 60 %", "fluid_only_60, fluid_only_75"
    gone = [f"the profile of fluid_only_{speed}" for speed in (60, 75) if speed not in apart]
    if gone:
        return Verdict(statement, names, NOT_TESTED, "missing: " + ", ".join(gone))
    ratio = apart[75][0] / apart[60][0]
    both = apart[60][1] and apart[75][1]
    verdict = (CONFIRMED if TWICE[0] <= ratio <= TWICE[1] else CONTRADICTED) if both else UNDECIDED
    return Verdict(statement, names, verdict, f"{1e3 * apart[75][0]:.0f} over {1e3 * apart[60][0]:.0f} mm = {ratio:.2f}"
                                              + ("" if both else ", of Gaussians; not both profiles have two humps"))


def surface_follows(runs):
    """With solids the free surface follows the charge: its tilt is nearer to the charge's than to level."""
    statement, found = "with solids the free surface follows the charge", []
    for run in runs.runs:
        if run.law and run.surface and run.surface.charge_tilt is not None:
            tilt, charge = run.surface.tilt, run.surface.charge_tilt
            margin = Mean(abs(tilt.value) - abs(charge - tilt.value), 2 * tilt.error)
            found.append(Verdict(statement, run.name, by_sign(margin),
                                 f"tilt of the slurry {tilt.told('degrees')}, of the charge {charge:.1f} (level: 0)"))
    return found or [Verdict(statement, "", NOT_TESTED, runs.missing(75, "Beetstra", 20))]


def height(run):
    """Mean height of the slurry's centre of mass above the axis (m)."""
    series = run.series
    known = np.where(series.holdup > 0, series.height, 0.0)
    value, error = series_mean((known * series.holdup).sum(axis=1) / series.holdup.sum(axis=1))
    return Mean(float(value), float(error))


def pair(runs, statement, first, second, judge):
    """Verdict of judge(run, run) on two runs (speed, law, solids); `not tested` where one is missing, or one has more slices."""
    found = [runs.find(*which) for which in (first, second)]
    gone = [unread(run, runs, *which) for run, which in zip(found, (first, second)) if not run or not run.series]
    names = ", ".join(f"coupled_{which[0]}_{which[1]}" + (f" ({which[2]} %)" if first[2] != second[2] else "")
                      for which in (first, second))
    if not gone and len(found[0].series.z) != len(found[1].series.z):
        gone = [f"{one.name} has {len(one.series.z)} slices along the axis" for one in found] + ["expected as many"]
    return Verdict(statement, names, NOT_TESTED, "; ".join(gone)) if gone else Verdict(statement, names, *judge(*found))


def concentration_raises(runs):
    """A higher concentration of the slurry raises it."""
    def judge(thin, thick):
        rise = height(thick) - height(thin)
        return by_sign(rise), f"rises by {rise.told('mm', 1e3, '.2f')}"

    return [pair(runs, "a higher slurry concentration raises it", (75, law, 20), (75, law, 40), judge)
            for law in ("Beetstra", "ErgunWenYu")]


def drag_raises(runs):
    """Ergun/Wen-Yu puts the slurry slightly higher than Beetstra, by less with 40 % slurry than with 20 %."""
    def judge(beetstra, ergun):
        rise = height(ergun) - height(beetstra)
        slight = abs(rise.value) <= SLIGHTLY * ergun.diameter
        return by_sign(rise) if slight else CONTRADICTED, f"higher by {rise.told('mm', 1e3, '.2f')}"

    laws, rises, gone = ("Beetstra", "ErgunWenYu"), {}, []
    for solids in (20, 40):
        both = {law: runs.find(75, law, solids) for law in laws}
        if all(run and run.series for run in both.values()):
            rises[solids] = height(both["ErgunWenYu"]) - height(both["Beetstra"])
        gone += [unread(run, runs, 75, law, solids) for law, run in both.items() if not run or not run.series]
    names, statement = "coupled_75_Beetstra, coupled_75_ErgunWenYu (20, 40 %)", "that difference shrinks from 20 % to 40 % slurry"
    if gone:
        shrinks = Verdict(statement, names, NOT_TESTED, "; ".join(gone))
    else:
        shrinks = Verdict(statement, names, by_sign(rises[20] - rises[40]),
                          f"{rises[20].told('mm', 1e3, '.2f')} and {rises[40].told('mm', 1e3, '.2f')}")
    return [pair(runs, "Ergun/Wen-Yu puts the slurry slightly higher than Beetstra", (75, "Beetstra", 20), (75, "ErgunWenYu", 20),
                 judge), shrinks]


def reynolds_below(runs):
    """Particle Reynolds numbers are mostly, for more than half of the slurry in the bed, under a limit."""
    found = []
    for solids, limit in REYNOLDS.items():
        statement = f"particle Reynolds numbers are mostly under {limit} for {solids} % slurry"
        tested = [run for run in runs.runs if large_mill(run) and run.solids == solids and run.reynolds]
        for run in tested:
            number, slurry = run.reynolds
            share = slurry[number < limit].sum() / slurry.sum()
            order = np.argsort(number)
            median = number[order][np.searchsorted(np.cumsum(slurry[order]), slurry.sum() / 2)]
            found.append(Verdict(statement, run.name, CONFIRMED if share > 0.5 else CONTRADICTED,
                                 f"{100 * share:.0f} % of the slurry in the bed is under {limit}; median {median:.0f}"))
        if not tested:
            found.append(Verdict(statement, "", NOT_TESTED, runs.missing(75, "Beetstra", solids)))
    return found


def drop(run):
    """Fall of p_rgh in the slurry from feed to discharge (Pa): of the straight line through all slices, over their way."""
    series = run.series
    slopes = [np.polyfit(series.z[known], line[known], 1)[0]
              for line, known in zip(series.pressure, np.isfinite(series.pressure)) if known.sum() > 1]
    value, error = series_mean(slopes)
    way = series.z[-1] - series.z[0]
    return Mean(float(-way * value), float(way * error))


def pressure_drops(runs):
    """The axial pressure drop is clearly larger with Ergun/Wen-Yu than with Beetstra."""
    def judge(beetstra, ergun):
        less, more = drop(beetstra), drop(ergun)
        verdict = by_sign(more - less)
        if verdict == CONFIRMED and (sign(more) <= 0 or more.value < CLEARLY * less.value):
            verdict = CONTRADICTED
        return verdict, f"{more.told('Pa')} against {less.told('Pa')}" + (
            "; the pressure does not fall towards the discharge" if max(more.value, less.value) < 0 else "")

    return [pair(runs, "the axial pressure drop is clearly larger with Ergun/Wen-Yu than with Beetstra", (75, "Beetstra", 20),
                 (75, "ErgunWenYu", 20), judge)]


def circulation(runs):
    """Slurry moves towards the discharge at the toe and back towards the feed at the shoulder."""
    statement, found = "slurry moves to the discharge in the toe region and back at the shoulder", []
    for run in runs.runs:
        if large_mill(run) and run.law and run.toe:
            signs = sign(run.toe), sign(run.shoulder)
            verdict = CONFIRMED if signs == (1, -1) else CONTRADICTED if signs[0] < 0 or signs[1] > 0 else UNDECIDED
            found.append(Verdict(statement, run.name, verdict, f"mean {run.toe.told('mm/s', 1e3)} on the toe's half, "
                                                               f"{run.shoulder.told('mm/s', 1e3)} on the shoulder's"))
    return found or [Verdict(statement, "", NOT_TESTED, runs.missing(75, "Beetstra", 20))]


STATEMENTS = (flat_without_balls, humps_without_balls, surface_follows, concentration_raises, drag_raises, reynolds_below,
              pressure_drops, circulation)


def verdicts(runs):
    """[Verdict] of all statements on RunReadings."""
    found = Runs(runs)
    return [verdict for statement in STATEMENTS for verdict in statement(found)]
