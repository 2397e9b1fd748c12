# SPDX-License-Identifier: GPL-3.0-or-later
"""Verdicts on published statements that only this study can read: the humps of the profile as it was published, the
pressure's drop by each definition, the dry patch, the shoulder's top, and balls that feel the slurry."""
from collections.abc import Callable, Iterator

from millfoam.files.mill_case import MillCase
from millfoam.readings.compare import difference
from millfoam.readings.means import Mean
from millstudies.axial_slices import PRESSURES, Profile
from millstudies.compared_runs import (CONFIRMED, CONTRADICTED, NOT_TESTED, UNDECIDED, Verdict, by_sign, judged, sign)
from millstudies.statements import CLEARLY, TWICE

from flow_numbers import Flow

DRY = 0.5  # share of slurry in the fluid below which the centre of circulation is a dry patch
POOR = 0.1  # root mean square of a fit's residuals over the profile's amplitude, above which it shows no humps
HARDLY = 0.02  # difference of two maps of solidity (compare.Difference) that is hardly one

Flows = dict[str, Flow]


def tested(statement: str, flows: Flows, names: tuple[str, ...],
           judge: Callable[..., tuple[str, str]]) -> Verdict:
    """The verdict of judge(flows of these names), if all of them are complete."""
    gone = [name for name in names if name not in flows]
    if gone:
        return Verdict(statement, ", ".join(names), NOT_TESTED, "not complete: " + ", ".join(gone))
    chosen = [flows[name] for name in names]
    return Verdict(statement, ", ".join(names), *judged(*judge(*chosen), *(one.readings for one in chosen)))


def is_known(profile: Profile) -> bool:
    """Whether the distance of a Profile's first peaks is more than two errors, and the Gaussians describe it."""
    return (profile.distances[0].value > 2 * profile.distances[0].error
            and profile.humps.rmsd <= POOR * profile.amplitude.value)


def humps(flows: Flows, which: str, where: str) -> Iterator[Verdict]:
    """Two humps of a Profile of the flows, by its name in Flow, and twice as far apart at 75 % speed."""
    def two(flow: Flow) -> tuple[str, str]:
        profile = getattr(flow, which)
        places = ", ".join(f"{1e3 * one:.0f}" for one in profile.humps.places)
        return (CONTRADICTED if profile.at_ends else CONFIRMED if is_known(profile) else UNDECIDED,
                f"two Gaussians at {places} mm ({profile.at_ends} at the profile's ends), "
                f"{profile.distances[0].text('mm', 1e3)} apart, RMSD {1e3 * profile.humps.rmsd:.1f} mm, amplitude "
                f"{profile.amplitude.text('mm', 1e3)}")

    def twice(slow: Flow, fast: Flow) -> tuple[str, str]:
        ends = [getattr(one, which) for one in (slow, fast)]
        ratio = ends[1].distances[0].value / ends[0].distances[0].value
        figure = f"{ratio:.2f} times"
        if any(one.at_ends for one in ends):
            return UNDECIDED, figure + "; not all peaks are maxima of the profile"
        if not all(map(is_known, ends)):
            return UNDECIDED, figure + "; the peaks move from turn to turn, or the fit is poor"
        return CONFIRMED if TWICE[0] <= ratio <= TWICE[1] else CONTRADICTED, figure

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
            verdict = by_sign(large - small)
            if verdict == CONFIRMED and (sign(large) <= 0 or large.value < CLEARLY * small.value):
                verdict = CONTRADICTED
            return verdict, f"{large.text('Pa')} compared with {small.text('Pa')}"

        for solids in (20, 30, 40):
            yield tested(f"the drop of the {words} is clearly larger with Ergun/Wen-Yu".replace("the p_rgh", "p_rgh"),
                         flows, (f"Beetstra_75_{solids}", f"ErgunWenYu_75_{solids}"), larger)


def bed(flows: Flows) -> Iterator[Verdict]:
    """A dry patch at the centre of circulation; slurry returns at the top of the shoulder."""
    def patch(flow: Flow) -> tuple[str, str]:
        return (CONFIRMED if flow.centre_share < DRY else CONTRADICTED,
                f"slurry takes {100 * flow.centre_share:.0f} % of the fluid there")

    def returns(flow: Flow) -> tuple[str, str]:
        return by_sign(Mean(0.0) - flow.top_velocity), f"{flow.top_velocity.text('mm/s', 1e3)} (+: to the discharge)"

    for name in ("Beetstra_75_20", "ErgunWenYu_75_20", "Beetstra_75_40", "ErgunWenYu_75_40", "Beetstra_60_20"):
        yield tested("the charge has a dry patch at its centre of circulation", flows, (name,), patch)
        yield tested("slurry returns to the feed at the top of the shoulder", flows, (name,), returns)


def coupled_balls(flows: Flows, dry: dict[str, MillCase]) -> Iterator[Verdict]:
    """The balls' map hardly differs where they feel the slurry."""
    statement = "the balls' map hardly differs where they feel the slurry"
    if "direct_75_20" not in flows or "dry_75" not in dry:
        yield Verdict(statement, "direct_75_20, dry_75", NOT_TESTED, "not complete: direct_75_20")
        return
    apart = difference(flows["direct_75_20"].case.charge, dry["dry_75"].charge)
    yield Verdict(statement, "direct_75_20, dry_75", CONFIRMED if apart.solidity <= HARDLY else CONTRADICTED,
                  f"solidity differs by {100 * apart.solidity:.1f} % in the mean, velocities by "
                  f"{100 * apart.velocity_x:.1f} and {100 * apart.velocity_y:.1f} % of the largest")


def own_verdicts(flows: Flows, dry: dict[str, MillCase]) -> list[Verdict]:
    """All verdicts of this module, on the complete Flows and the complete dry runs' cases by name."""
    return [*humps(flows, "profile", "of 338 mm"), *humps(flows, "chamber", "in front of the grates"), *drops(flows),
            *bed(flows), *coupled_balls(flows, dry)]
