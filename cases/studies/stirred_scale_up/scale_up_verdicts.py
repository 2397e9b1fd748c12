# SPDX-License-Identifier: GPL-3.0-or-later
"""Verdicts on the order of three mills by size and by speed, and on their published numbers."""
from collections.abc import Iterator

from millfoam.readings.means import Mean
from millstudies.compared_runs import Verdict
from millstudies.published_stirred import DRY, WET
from millstudies.stirred_runs import Numbers
from millstudies.stirred_verdicts import Found, balanced, has_ratio, has_value, higher, power, speed, tested

from runs import MILLS, SPEEDS

NEAR = 0.15  # between a mean speed, or a ratio of two runs, and the published one: dry runs and wet ones
SAME = 0.05  # between a run and an independent one of the same mill

Place = tuple[str, str]  # mill and speed, as runs name them


SHAPED = "A", "B"  # with published dry runs of balls of another shape
# The same mill by LIGGGHTS alone, with the same modulus, from 0.6 to 1.2 s
INDEPENDENT = ("A", "2.2"), 24.9, 0.635  # run, W, m/s


def names_of(*places: Place) -> tuple[str, ...]:
    """Names of the dry runs of mills at their speeds."""
    return tuple("_".join((*place, "dry")) for place in places)


def density(one: Numbers) -> Mean:
    """Power of the drive for each m3 of slurry, W/m3."""
    return Mean(one.power.value / one.volume, one.power.error / one.volume, one.power.freedom)


def order_of_speeds(found: Found) -> Iterator[Verdict]:
    """Power and mean speed rise with the speed of the tips, in each mill."""
    rising = sorted(SPEEDS, key=lambda name: SPEEDS[name])
    for words, read, unit in (("the mean speed of the balls", speed, "m/s"), ("the power", power, "W")):
        for mill in MILLS:
            for low, high in zip(rising, rising[1:]):
                yield tested(f"{words} is higher at {high} than at {low} m/s", found,
                             names_of((mill, low), (mill, high)), higher(read, unit))


def order_of_mills(found: Found) -> Iterator[Verdict]:
    """Mean speed, and power for each m3 of slurry, fall from the smallest mill to the largest."""
    for words, read, unit, scale in (("the mean speed of the balls", speed, "m/s", 1.0),
                                     ("the power per volume", density, "kW/m3", 1e-3)):
        for at in SPEEDS:
            for small, large in zip(list(MILLS), list(MILLS)[1:]):
                yield tested(f"{words} is higher in mill {small} than in {large}", found,
                             names_of((large, at), (small, at)), higher(read, unit, scale))


def published_speeds(found: Found) -> Iterator[Verdict]:
    """Mean speeds of dry runs are those of the published ones with slurry."""
    for place, known in WET.items():
        yield tested(f"the mean speed of the balls is the published one within {100 * NEAR:g} %", found,
                     names_of(place), has_value(speed, "m/s", known.speed, NEAR))


def shaped_ratios(found: Found) -> Iterator[Verdict]:
    """Ratios of mean speed and power of mill B to mill A are those of dry runs with balls of another shape."""
    one, other = (DRY[mill, "group_3"] for mill in SHAPED)
    for words, read, expected in (("mean speeds", speed, other.speed / one.speed),
                                  ("powers", power, other.power / one.power)):
        yield tested(f"the ratio of {words} of B and A is that of published dry runs with balls of another shape "
                     f"within {100 * NEAR:g} %", found, names_of(*((mill, "1.8") for mill in SHAPED)),
                     has_ratio(read, expected, NEAR * expected))


def published_ratios(found: Found) -> Iterator[Verdict]:
    """Ratios of mean speeds and of powers per volume of two runs are those of the published ones, by the balls."""
    base = ("A", "1.8")
    for words, read, known in (("mean speeds", speed, "speed"), ("powers per volume", density, "balls")):
        for place in WET:
            if place == base:
                continue
            expected = getattr(WET[place], known) / getattr(WET[base], known)
            yield tested(f"the ratio of {words} to that of A at 1.8 m/s is the published one within {100 * NEAR:g} %",
                         found, names_of(base, place), has_ratio(read, expected, NEAR * expected))


def own_checks(found: Found) -> Iterator[Verdict]:
    """What each run must hold, and what another program found."""
    yield from balanced(found)
    place, watts, metres = INDEPENDENT
    for words, read, unit, expected in (("power", power, "W", watts), ("mean speed", speed, "m/s", metres)):
        yield tested(f"{words} is that of LIGGGHTS alone within {100 * SAME:g} %", found, names_of(place),
                     has_value(read, unit, expected, SAME))


def verdicts(found: Found) -> list[Verdict]:
    """All verdicts on runs, name -> Numbers."""
    return [*order_of_speeds(found), *order_of_mills(found), *published_speeds(found), *published_ratios(found),
            *shaped_ratios(found), *own_checks(found)]
