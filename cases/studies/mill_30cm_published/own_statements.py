# SPDX-License-Identifier: GPL-3.0-or-later
"""Verdicts on published statements that only this study can read: the humps of the profile as it was published, the
pressure's drop by each definition, the dry patch, the shoulder's top, and balls that feel the slurry; and whether
another random insertion of the balls changes the charge. Of a flow that may not be judged as the published one
(as_published) all are undecided."""
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from millfoam.files.mill_case import MillCase
from millfoam.files.solids_file import SolidsMap, mean_map
from millfoam.readings.batches import whole_turns
from millfoam.readings.compare import difference
from millfoam.readings.free_surface import toe_and_shoulder
from millfoam.readings.means import Mean, of_reading, with_error
from millstudies.axial_slices import PRESSURES, Profile, jackknife
from millstudies.compared_runs import (CONFIRMED, NOT_TESTED, UNDECIDED, Runs, Verdict, by_sign, judged,
                                       unlike, withheld)
from millstudies.statements import (about_twice, circulation, larger_drop, maxima, millimetres, ratio_words,
                                    reynolds_below, surface_follows, two_maxima)

from as_published import why_withheld
from flow_numbers import Flow

DRY = 0.5  # share of slurry in the fluid below which the centre of circulation is a dry patch
POOR = 0.1  # root mean square of a fit's residuals over the profile's amplitude, above which it shows no humps
HARDLY = 0.02  # difference of two maps of solidity (compare.Difference) that is hardly one: that of a turn by 4 degrees
FELT = ("direct_75_20", "iterated_75_20")  # the runs whose balls feel the slurry

Flows = dict[str, Flow]
Cases = dict[str, MillCase]


def tested(statement: str, flows: Flows, names: tuple[str, ...],
           judge: Callable[..., tuple[str, str]]) -> Verdict:
    """The verdict of judge(flows of these names), if all of them are complete."""
    gone = [name for name in names if name not in flows]
    if gone:
        return Verdict(statement, ", ".join(names), NOT_TESTED, "not complete: " + ", ".join(gone))
    chosen = [flows[name] for name in names]
    return Verdict(statement, ", ".join(names), *judged(*judge(*chosen), *(one.readings for one in chosen)))


def is_known(profile: Profile) -> bool:
    """Whether the first peaks of a Profile's Gaussians are apart with 95 % confidence, and describe it."""
    return profile.distances[0].sign > 0 and profile.humps.rmsd <= POOR * profile.amplitude.value


def clear_maxima(profile: Profile) -> np.ndarray:
    """Places (m) of a Profile's maxima between its ends (statements.maxima)."""
    return maxima(profile.z, profile.height, profile.error)


def has_two(profile: Profile) -> str:
    """Verdict on two maxima of a Profile (statements.two_maxima)."""
    return two_maxima(profile.z, profile.height, profile.error)


def apart_words(distance: Mean) -> str:
    """How far the first two peaks are apart (m), in words."""
    return f"{distance.full_text('mm', 1e3)} apart" if np.isfinite(distance.value) else "their distance is not known"


def humps(flows: Flows, which: str, where: str) -> Iterator[Verdict]:
    """Two humps of a Profile of the flows, by its name in Flow, and twice as far apart at 75 % speed."""
    def two(flow: Flow) -> tuple[str, str]:
        profile = getattr(flow, which)
        seen = clear_maxima(profile)
        return has_two(profile), (
            f"{f'maxima at {millimetres(seen)} mm' if len(seen) else 'no maximum'} between the ends; two Gaussians at "
            f"{profile.marked_peaks} mm (*: at the end of the fit), "
            f"{apart_words(profile.distances[0])}, RMSD {1e3 * profile.humps.rmsd:.1f} mm, amplitude "
            f"{profile.amplitude.text('mm', 1e3)}")

    def twice(slow: Flow, fast: Flow) -> tuple[str, str]:
        ends = [getattr(one, which) for one in (slow, fast)]
        less, more = (one.distances[0] for one in ends)
        figure = ratio_words(less, more)
        if any(has_two(one) != CONFIRMED for one in ends):
            return UNDECIDED, figure + "; not both profiles have two maxima"
        if not all(map(is_known, ends)):
            return UNDECIDED, figure + "; the peaks move from turn to turn, or the fit is poor"
        return about_twice(less, more), figure

    for solids in (20, 30, 40):
        for speed in (60, 75):
            yield tested(f"without solids the profile {where} has two humps", flows, (f"fluid_{speed}_{solids}",), two)
        yield tested(f"{where} they are about twice as far apart at 75 % speed", flows,
                     (f"fluid_60_{solids}", f"fluid_75_{solids}"), twice)


def drops(flows: Flows) -> Iterator[Verdict]:
    """The axial pressure drop is clearly larger with Ergun/Wen-Yu, by each definition of the drop."""
    for name, words in PRESSURES.items():
        def larger(less: Flow, more: Flow, name: str = name) -> tuple[str, str]:
            small, large = less.drops[name], more.drops[name]
            return withheld(larger_drop(small, large), f"{large.text('Pa')} compared with {small.text('Pa')}",
                            unlike(less.readings, more.readings))

        for solids in (20, 30, 40):
            yield tested(f"the drop of the {words} is clearly larger with Ergun/Wen-Yu".replace("the p_rgh", "p_rgh"),
                         flows, (f"Beetstra_75_{solids}", f"ErgunWenYu_75_{solids}"), larger)


def bed(flows: Flows) -> Iterator[Verdict]:
    """A dry patch at the centre of circulation; slurry returns at the top of the shoulder: of each flow with balls."""
    def patch(flow: Flow) -> tuple[str, str]:
        return withheld(by_sign(Mean(DRY) - flow.centre_share),
                        f"slurry takes {flow.centre_share.text('%', 100)} of the fluid there",
                        why_withheld(flow, flows))

    def returns(flow: Flow) -> tuple[str, str]:
        return withheld(by_sign(Mean(0.0) - flow.top_velocity),
                        f"{flow.top_velocity.text('mm/s', 1e3)} (+: to the discharge)", why_withheld(flow, flows))

    for name in [name for name, flow in flows.items() if flow.run.law] or ["Beetstra_75_20"]:
        yield tested("the charge has a dry patch at its centre of circulation", flows, (name,), patch)
        yield tested("slurry returns to the feed at the top of the shoulder", flows, (name,), returns)


def felt(flows: Flows) -> Iterator[Verdict]:
    """What is published of each flow with balls, of those whose balls feel the slurry."""
    for flow in (flows[name] for name in FELT if name in flows):
        readings, reason = flow.readings, why_withheld(flow, flows)
        for statement in (surface_follows, reynolds_below, circulation):
            for one in (one for one in statement(Runs([readings])) if one.runs == readings.name):
                verdict, figure = withheld(one.verdict, one.figure, reason)
                yield replace(one, verdict=verdict, figure=figure)


def turns_of(case: MillCase) -> list[SolidsMap]:
    """SolidsMap of each of the whole turns, two at least, into which the windows of a charge are divided."""
    windows = case.charge_windows
    turns = max(whole_turns(windows[-1].end - windows[0].begin, case.turn), 2)
    return [mean_map([windows[number] for number in part]) for part in np.array_split(np.arange(len(windows)), turns)
            if len(part)]


def map_difference(one: MillCase, other: MillCase) -> Mean:
    """Difference of the maps of solidity of two charges (compare.Difference), with the error of the jackknife over the
    turns of each."""
    found = Mean(difference(one.charge, other.charge).solidity)
    for case, rest in ((one, other), (other, one)):
        turns = turns_of(case)
        _, error = jackknife(lambda some, turns=turns, rest=rest: np.array(
            difference(mean_map([turns[number] for number in some]), rest.charge).solidity), len(turns))
        found += Mean(0.0, float(error), len(turns) - 1)
    return found


def charge_apart(one: MillCase, other: MillCase) -> tuple[Mean, str]:
    """Difference of the maps of solidity of two charges (map_difference), and in words, with toe and shoulder."""
    apart, solidity = difference(one.charge, other.charge), map_difference(one, other)
    ends = [with_error(lambda part, case=case: toe_and_shoulder(part, case.radius), case.charge_windows)
            for case in (one, other)]
    toe, shoulder = (of_reading(ends[0], k) - of_reading(ends[1], k) for k in (0, 1))
    return solidity, (f"solidity differs by {solidity.full_text('%', 100, '.2f')} in the mean, velocities by "
                      f"{100 * apart.velocity_x:.1f} and {100 * apart.velocity_y:.1f} % of the largest, toe by "
                      f"{toe.full_text('degrees', 1, '.2f')}, shoulder by "
                      f"{shoulder.full_text('degrees', 1, '.2f')}")


def noise(case: MillCase) -> float:
    """Difference of the maps of solidity of the two halves of a charge's time."""
    windows = case.charge_windows
    return difference(*(mean_map(half) for half in (windows[:len(windows) // 2], windows[len(windows) // 2:]))).solidity


def charges(flows: Flows, dry: Cases) -> Iterator[Verdict]:
    """The balls' map hardly differs where they feel the slurry, and after another random insertion."""
    wet = [name for name in FELT if name in flows] or list(FELT[:1])
    cases = {**dry, **{name: flows[name].case for name in wet if name in flows}}
    for statement, name in (*(("the balls' map hardly differs where they feel the slurry", name) for name in wet),
                            ("the balls' map hardly differs after another random insertion", "dry_seed")):
        gone = [one for one in (name, "dry_75") if one not in cases]
        if gone:
            yield Verdict(statement, f"{name}, dry_75", NOT_TESTED, "not complete: " + ", ".join(gone))
            continue
        apart, words = charge_apart(cases[name], cases["dry_75"])
        yield Verdict(statement, f"{name}, dry_75", *withheld(
            by_sign(Mean(HARDLY) - apart), f"{words} (limit {100 * HARDLY:g} % of solidity; halves of dry_75 differ by "
            f"{100 * noise(dry['dry_75']):.2f} %)", why_withheld(flows[name], flows) if name in flows else ""))


def own_verdicts(flows: Flows, dry: Cases) -> list[Verdict]:
    """All verdicts of this module, on the complete Flows and the complete dry runs' cases by name."""
    return [*humps(flows, "profile", "of 338 mm"), *humps(flows, "chamber", "in front of the grates"), *drops(flows),
            *bed(flows), *felt(flows), *charges(flows, dry)]
