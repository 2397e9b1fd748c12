# SPDX-License-Identifier: GPL-3.0-or-later
"""Statements about slurry in mills (M. Malahe, MSc thesis, University of Cape Town, 2012) compared with runs of the 30
cm mill. Statements that do not concern the axis are also compared with the 12 cm mill's slice. Each gives verdicts (see
compared_runs) with their numbers. A number is compared with a limit by the sign of its distance from it, with its error
over time (Mean.sign)."""
import numpy as np
from scipy.signal import find_peaks

from millfoam.readings.axial import fit_gaussians, known_distances
from millfoam.readings.means import Mean, series_mean
from millfoam.readings import slurry_over_time
from millfoam.readings.slurry_over_time import read_series
from millfoam.report.steadiness import flow_steadiness

from .axial_slices import jackknife
from .compared_runs import (CONFIRMED, CONTRADICTED, LARGE, NOT_TESTED, SLICE, UNDECIDED, Runs, Verdict, Which,
                            all_positive, by_sign, by_turn, height, judged, over_turns, sign_of, unlike, unread,
                            withheld)
from .run_readings import read_run

# Of a flat surface, at most: degrees; deviation from its line over the mill's diameter
FLAT_TILT, FLAT_DEVIATION = 5.0, 0.02
TWICE = (1.5, 2.5)  # what counts as about twice
SLIGHTLY = 0.03  # of a height, over the mill's diameter
DEPENDS = "depends on the definition"  # a verdict
CLEARLY = 1.1  # least ratio of two pressure drops of which one is clearly larger
# All that is published: solids of the slurry, % by mass -> number that most of it is below
REYNOLDS = {20: 150, 40: 90}


def flat_without_balls(runs):
    """Without solids the slurry's free surface is flat across the mill."""
    statement, found = "without solids the free surface is flat across the mill", []
    slices = [Which(speed, None, None, SLICE) for speed in runs.slice_speeds()]
    for which in (Which(60, None, 20), Which(75, None, 20), *slices):
        run = runs.find(which)
        if not run or not run.surface:
            found.append(Verdict(statement, str(which), NOT_TESTED, unread(run, runs, which)))
            continue
        tilt, deviation, most = run.surface.tilt, run.surface.deviation, FLAT_DEVIATION * run.diameter
        verdict = all_positive(Mean(FLAT_TILT) - tilt, Mean(FLAT_TILT) + tilt, Mean(most) - deviation)
        figure = (f"tilt {tilt.full_text('degrees')}, {deviation.full_text('mm', 1e3)} from a straight line (flat: "
                  f"{FLAT_TILT:g} degrees, {1e3 * most:g} mm)")
        found.append(Verdict(statement, run.name, *judged(verdict, figure, run)))
    return found


def maxima(z, height, error):
    """Places (m) of a profile's clear maxima between its ends, which the feed and the pulp lifters raise. Their
    prominence is more than a tenth of the range, and three times the error of the difference of two heights [n] (m)
    with the standard errors `error` (m)."""
    return z[find_peaks(height, prominence=max(3 * np.sqrt(2) * error, 0.1 * np.ptp(height)))[0]]


def two_maxima(z, height, error):
    """The verdict on whether a profile has two clear maxima (maxima); undecided where the error decides, or is not
    known."""
    counts = {len(maxima(z, height, error)), len(maxima(z, height, 0.0))}
    if np.isnan(error) or (len(counts) > 1 and min(counts) <= 2 <= max(counts)):
        return UNDECIDED
    return CONFIRMED if counts == {2} else CONTRADICTED


def humps_without_balls(runs):
    """Two humps along the axis without solids, about twice as far apart at 75 % of the critical speed as at 60 %."""
    statement, found, apart = "without solids the height of the centre of mass has two humps along the axis", [], {}
    for which in (Which(60, None, 20), Which(75, None, 20)):
        run = runs.find(which)
        if not run or not run.series:
            found.append(Verdict(statement, str(which), NOT_TESTED, unread(run, runs, which)))
            continue
        height, errors = series_mean(run.series.height)
        error = float(np.sqrt(np.mean(errors**2)))
        try:
            fit = fit_gaussians(run.series.z, height, 2)
        except RuntimeError as failure:
            found.append(Verdict(statement, run.name, NOT_TESTED, str(failure)))
            continue
        places = maxima(run.series.z, height, error)
        verdict = two_maxima(run.series.z, height, error)
        apart[which.speed] = hump_distance(run), verdict == CONFIRMED, run
        seen = f"maxima at {millimetres(places)} mm" if len(places) else "no maximum"
        figure = (f"{seen} between the ends, {millimetres(run.series.z[[0, -1]])} mm; two Gaussians at "
                  f"{millimetres(fit.places)} mm, RMSD {1e3 * fit.rmsd:.1f} mm; error {1e3 * error:.1f} mm")
        found.append(Verdict(statement, run.name, *judged(verdict, figure, run)))
    return found + [distance_ratio(apart)]


def hump_distance(run):
    """Distance (m) of the two Gaussians of a run's profile, with the error of the jackknife over its turns (by_turn);
    NaN if one of them is at an end of the profile, or there is no fit, with all turns or without one."""
    heights = by_turn(run, run.series.height)

    def apart(turns):
        return known_distances(fit_gaussians(run.series.z, heights[turns].mean(axis=0), 2), run.series.z)
    try:
        (value,), (error,) = jackknife(apart, len(heights))
    except RuntimeError:
        return Mean(np.nan, np.nan)
    return Mean(float(value if np.isfinite(error) else np.nan), float(error), len(heights) - 1)


def about_twice(less, more):
    """The verdict on whether a Mean is TWICE another one, both positive."""
    return all_positive(more - TWICE[0] * less, TWICE[1] * less - more)


def ratio_words(less, more):
    """Two lengths (Mean, m) and their ratio in words."""
    if np.isnan(less.value + more.value):
        return "no distance: a peak is at the end of the fit, or there is no fit"
    return f"{more.full_text('mm', 1e3)} over {less.full_text('mm', 1e3)} = {more.value / less.value:.2f}"


def millimetres(lengths):
    return ", ".join(f"{1e3 * length:.0f}" for length in lengths)


def distance_ratio(apart):
    """Verdict on the distances of two Gaussians by speed: speed -> (Mean, m; whether the profile has two humps; run).
    """
    statement, names = "the humps are about twice as far apart at 75 % speed as at 60 %", "fluid_only_60, fluid_only_75"
    gone = [f"the profile of fluid_only_{speed}" for speed in (60, 75) if speed not in apart]
    if gone:
        return Verdict(statement, names, NOT_TESTED, "missing: " + ", ".join(gone))
    both = apart[60][1] and apart[75][1]
    verdict = about_twice(apart[60][0], apart[75][0]) if both else UNDECIDED
    figure = ratio_words(apart[60][0], apart[75][0]) + (
        "" if both else ", of Gaussians; not both profiles have two humps")
    return Verdict(statement, names, *judged(verdict, figure, apart[60][2], apart[75][2]))


def surface_follows(runs):
    """With solids the free surface follows the charge: its tilt is nearer to the charge's than to level."""
    statement, found = "with solids the free surface follows the charge", []
    for run in (*runs.of(LARGE), *runs.of(SLICE)):
        if run.surface and run.surface.charge_tilt is not None:
            tilt, charge = run.surface.tilt, run.surface.charge_tilt
            margin = Mean(abs(tilt.value) - abs(charge - tilt.value), 2 * tilt.error, tilt.freedom)
            figure = f"tilt of the slurry {tilt.text('degrees')}, of the charge {charge:.1f} (level: 0)"
            found.append(Verdict(statement, run.name, *judged(by_sign(margin), figure, run)))
        else:
            found.append(Verdict(statement, run.name, NOT_TESTED, unread(run, runs, None)))
    return found + [Verdict(statement, which.mill, NOT_TESTED, runs.missing(which)) for which in lacking(runs)]


def lacking(runs):
    """Run to name for each mill without a run with balls."""
    named = Which(75, "Beetstra", 20), Which(50, "Beetstra", None, SLICE)
    return [which for which in named if not runs.of(which.mill)]


def pair(runs, statement, first, second, judge):
    """Verdict of judge(run, run) on two runs (Which), undecided if they are `unlike`; `not tested` if one is missing,
    or they have other slices."""
    found = [runs.find(which) for which in (first, second)]
    gone = [unread(run, runs, which) for run, which in zip(found, (first, second)) if not run or not run.series]
    names = f"{first}; {second}"
    if not gone and not same_slices(*(one.series.z for one in found)):
        gone = [f"{one.name} has {len(one.series.z)} slices along the axis, the first one at "
                f"{1e3 * one.series.z[0]:.1f} mm" for one in found] + ["expected the same slices"]
    if gone:
        return Verdict(statement, names, NOT_TESTED, "; ".join(gone))
    return Verdict(statement, names, *judged(*withheld(*judge(*found), unlike(*found)), *found))


def same_slices(first, second):
    """Whether two profiles have the same slices: z of their middles (m) within a thousandth of the profile."""
    return len(first) == len(second) and np.allclose(first, second, rtol=0, atol=1e-3 * np.max(np.abs(second)))


def concentration_raises(runs):
    """A higher concentration of the slurry raises it: the highest of a mill and law compared with the lowest."""
    def judge(thin, thick):
        rise = height(thick) - height(thin)
        return by_sign(rise), f"rises by {rise.text('mm', 1e3, '.2f')}"

    places = [(law, *place) for place in runs.places() for law in ("Beetstra", "ErgunWenYu")]
    return [pair(runs, "a higher slurry concentration raises it",
                 *(Which(speed, law, one, mill) for one in (solids[0], solids[-1])), judge)
            for law, mill, speed, solids in (*places, ("Beetstra", LARGE, 60, (20, 40)))]


def drag_raises(runs):
    """Ergun/Wen-Yu puts the slurry slightly higher than Beetstra, by less with 40 % slurry than with 20 %; in the slice
    with each slurry that there is, and by less with the thickest than with the thinnest."""
    def judge(beetstra, ergun):
        rise = height(ergun) - height(beetstra)
        return all_positive(rise, Mean(SLIGHTLY * ergun.diameter) - rise), f"higher by {rise.text('mm', 1e3, '.2f')}"

    higher, shrinks = [], []
    for mill, speed, solids in runs.places():
        laws = {one: [Which(speed, law, one, mill) for law in ("Beetstra", "ErgunWenYu")] for one in solids}
        there = [one for one in solids if all(map(runs.find, laws[one]))] if mill == SLICE else []
        higher += [pair(runs, "Ergun/Wen-Yu puts the slurry slightly higher than Beetstra", *laws[one], judge)
                   for one in there or solids[:1]]
        ends = (there[0], there[-1]) if len(there) > 1 else (solids[0], solids[-1])
        shrinks.append(drag_difference_shrinks(runs, laws[ends[0]] + laws[ends[1]]))
    return higher + shrinks


def drag_difference_shrinks(runs, four):
    """Verdict on the size of the difference between the heights with both laws: four Which, both laws with the thin
    slurry, then with the thick one."""
    thin, thick = (which.solids for which in (four[0], four[2]))
    statement = f"that difference shrinks from {thin} % to {thick} % slurry"
    found = [runs.find(which) for which in four]
    gone = [unread(run, runs, which) for which, run in zip(four, found) if not run or not run.series]
    names = "; ".join(map(str, four[:2])) + f" ({thin}, {thick} %)"
    if gone:
        return Verdict(statement, names, NOT_TESTED, "; ".join(gone))
    rises = [height(found[second]) - height(found[second - 1]) for second in (1, 3)]
    figure = " and ".join(rise.text("mm", 1e3, ".2f") for rise in rises)
    sizes = [rise if rise.value >= 0 else -rise for rise in rises]
    verdict = withheld(by_sign(sizes[0] - sizes[1]), figure, unlike(*found))
    return Verdict(statement, names, *judged(*verdict, *found))


def reynolds_below(runs):
    """Particle Reynolds numbers are mostly, for more than half of the slurry in the bed, under a limit that is
    published for some concentrations. It is not published by which length: by the balls' diameter, or by their radius
    as in the laws of the same publication that are in half of that number. So both are judged."""
    statement, found = "particle Reynolds numbers are mostly under {} for {} % slurry", []
    for solids, limit in REYNOLDS.items():
        for mill, speed in ((LARGE, 75), (SLICE, runs.slice_speeds()[0])):
            tested = [run for run in runs.of(mill) if run.solids == solids]
            for run in tested:
                if not run.reynolds:
                    found.append(Verdict(statement.format(limit, solids), run.name, NOT_TESTED,
                                         unread(run, runs, None)))
                    continue
                verdict, figure = by_both_lengths(run.reynolds, limit)
                found.append(Verdict(statement.format(limit, solids), run.name, *judged(verdict, figure, run)))
            if not tested:
                which = Which(speed, "Beetstra", solids, mill)
                found.append(Verdict(statement.format(limit, solids), mill, NOT_TESTED, runs.missing(which)))
    others = [run for mill in (LARGE, SLICE) for run in runs.of(mill) if run.solids not in REYNOLDS and run.reynolds]
    return found + [Verdict("particle Reynolds numbers are mostly under a limit", run.name, NOT_TESTED,
                            f"none is published for {f'{run.solids} %' if run.solids else 'this'} slurry, for "
                            f"{' and '.join(map(str, REYNOLDS))} % only; median {run.reynolds.median:.0f}")
                    for run in others]


def by_both_lengths(found, limit):
    """Verdict on whether most ReynoldsNumbers are below a limit, and the numbers, by the balls' diameter and by their
    radius: DEPENDS if one confirms what the other contradicts, undecided if one of them is."""
    judgements, words = [], []
    for length, factor in (("diameter", 1.0), ("radius", 0.5)):
        share = found.share_below(limit / factor)
        judgements.append(by_sign(share - Mean(0.5)))
        words.append(f"by the {length} {judgements[-1]}: {share.full_text('%', 100)} of the slurry in the bed is under "
                     f"{limit}; median {factor * found.median:.0f}")
    verdict = judgements[0] if len(set(judgements)) == 1 else UNDECIDED if UNDECIDED in judgements else DEPENDS
    return verdict, "; ".join(words)


def drop(run):
    """Fall of p_rgh in the slurry from feed to discharge (Pa): of the straight line through the slices but the first
    and the last, over the way of all. In these two slurry enters and leaves, with a pressure of its own."""
    series = run.series
    z, pressure = series.z[1:-1], series.pressure[:, 1:-1]
    slopes = [np.polyfit(z[known], line[known], 1)[0] if known.sum() > 1 else np.nan
              for line, known in zip(pressure, np.isfinite(pressure))]
    found, way = over_turns(run, slopes), series.z[-1] - series.z[0]
    return Mean(-way * found.value, way * found.error, found.freedom)


def larger_drop(less, more):
    """The verdict on whether a drop of the pressure (Mean) is a drop and clearly larger than another: whether it is
    above zero and above CLEARLY times the other one, by their errors."""
    verdict = by_sign(more - less)
    if verdict != CONFIRMED:
        return verdict
    floor = max(Mean(0.0), Mean(CLEARLY * less.value, CLEARLY * less.error, less.freedom), key=lambda one: one.value)
    verdict = by_sign(more - floor)
    return UNDECIDED if verdict == CONFIRMED and sign_of(more) <= 0 else verdict


def pressure_drops(runs):
    """The axial pressure drop is clearly larger with Ergun/Wen-Yu than with Beetstra."""
    def judge(beetstra, ergun):
        less, more = drop(beetstra), drop(ergun)
        return larger_drop(less, more), f"{more.text('Pa')} compared with {less.text('Pa')}" + (
            "; the pressure does not fall towards the discharge" if max(more.value, less.value) < 0 else "")

    return [pair(runs, "the axial pressure drop is clearly larger with Ergun/Wen-Yu than with Beetstra",
                 Which(75, "Beetstra", 20), Which(75, "ErgunWenYu", 20), judge)]


def circulation(runs):
    """Slurry moves towards the discharge at the toe and back towards the feed at the shoulder."""
    statement, found = "slurry moves to the discharge in the toe region and back at the shoulder", []
    for run in runs.of(LARGE):
        if run.toe:
            verdict = {"yes": CONFIRMED, "no": CONTRADICTED, "undecided": UNDECIDED}[
                slurry_over_time.circulation(run.toe, run.shoulder)]
            figure = (f"mean {run.toe.text('mm/s', 1e3)} on the toe's half, {run.shoulder.text('mm/s', 1e3)} on the "
                      "shoulder's")
            found.append(Verdict(statement, run.name, *judged(verdict, figure, run)))
        else:
            found.append(Verdict(statement, run.name, NOT_TESTED, unread(run, runs, None)))
    which = Which(75, "Beetstra", 20)
    return found or [Verdict(statement, which.mill, NOT_TESTED, runs.missing(which))]


STATEMENTS = (flat_without_balls, humps_without_balls, surface_follows, concentration_raises, drag_raises,
              reynolds_below, pressure_drops, circulation)


def verdicts(runs):
    """[Verdict] of all statements on RunReadings."""
    found = Runs(runs)
    return [verdict for statement in STATEMENTS for verdict in statement(found)]


def read(case):
    """RunReadings of a MillCase with a flow; also a slice gets its series, which shows whether it is steady."""
    found = read_run(case)
    found.steady = flow_steadiness(case).state
    if found.series is None and not found.ends:
        try:
            found.series = read_series(case)
        except (RuntimeError, OSError) as error:
            found.failures.append(f"{case.name}: height over time not read: {error}")
    return found
