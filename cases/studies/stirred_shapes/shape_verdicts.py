# SPDX-License-Identifier: GPL-3.0-or-later
"""Verdicts on published numbers of mills whose balls are not spheres."""
from collections.abc import Iterator

from millfoam.readings.means import Mean
from millstudies.compared_runs import Verdict
from millstudies.published_stirred import DRY, SOLIDITY, WET_SPEEDS
from millstudies.stirred_runs import Numbers
from millstudies.stirred_verdicts import (Found, balanced, has_ratio, has_value, higher, near, power, ratio, speed,
                                          tested)

NEAR = 0.15  # between a mean speed, or a ratio of two mills, and the published one
BY_POWER = 0.2  # between the ratio of powers of groups 3 and 1 and the published one


PUBLISHED = {"_".join(mill_and_shape): known for mill_and_shape, known in DRY.items()}  # by names of runs
WITH_SLURRY = {f"A_{shape}": known for shape, known in WET_SPEEDS.items()}  # mean speed of the balls, m/s


def published_speeds(found: Found) -> Iterator[Verdict]:
    """Mean speeds are the published ones."""
    for name, known in PUBLISHED.items():
        yield tested(f"the mean speed of the balls is the published one within {100 * NEAR:g} %", found, (name,),
                     has_value(speed, "m/s", known.speed, NEAR))


def published_ratios(found: Found) -> Iterator[Verdict]:
    """Ratios of power and mean speed of two groups in A, and of group 3 in two mills, are the published ones."""
    one, three, large = PUBLISHED
    expected = PUBLISHED[three].power / PUBLISHED[one].power
    yield tested(f"the ratio of powers of groups 3 and 1 is the published one, give or take {BY_POWER:g}", found,
                 (one, three), has_ratio(power, expected, BY_POWER))
    for names in ((one, three), (three, large)):
        first, second = (PUBLISHED[name] for name in names)
        expected = second.speed / first.speed
        yield tested(f"the ratio of mean speeds is the published one within {100 * NEAR:g} %", found, names,
                     has_ratio(speed, expected, NEAR * expected))
    expected = PUBLISHED[large].power / PUBLISHED[three].power
    yield tested(f"the ratio of powers of B and A is the published one within {100 * NEAR:g} %", found,
                 (three, large), has_ratio(power, expected, NEAR * expected))


def order_of_shapes(found: Found) -> Iterator[Verdict]:
    """Orders of the shapes in A: published for the power with and without slurry, for the mean speed with slurry."""
    for low, high in (("A_spheres", "A_group_1"), ("A_group_1", "A_group_3")):
        yield tested(f"the power is higher with {shape_of(high)} than with {shape_of(low)}", found, (low, high),
                     higher(power, "W"))
    ordered = sorted(WITH_SLURRY, key=lambda name: WITH_SLURRY[name])
    for low, high in zip(ordered, ordered[1:]):
        yield tested(f"the mean speed of the balls is higher with {shape_of(high)} than with {shape_of(low)}", found,
                     (low, high), higher(speed, "m/s"))


def shape_of(name: str) -> str:
    """The shape in a run's name, in words: `spheres`, `group 1`."""
    return name.partition("_")[2].replace("_", " ")


def published_solidity(found: Found, solidity: dict[str, dict[str, float]]) -> Iterator[Verdict]:
    """The solidity of group 3 in A, below the lower pins and above their lowest edge, is in the published ranges."""
    name = "A_group_3"
    for band, (low, high) in SOLIDITY.items():
        place = "below the lower pins" if band == "below" else "from there to the pins' top"

        def judge(one: Numbers, band: str = band, low: float = low, high: float = high) -> tuple[str, str]:
            value = solidity[one.name][band]
            return near(value, (low + high) / 2, (high - low) / 2), f"{value:.3f}, published {low:g} to {high:g}"
        yield tested(f"the solidity {place} is in the published range", found, (name,), judge)


def over_spheres(read: str, one: Numbers, found: Found) -> Mean | None:
    """A Mean of a run, `power` or `speed`, over that of spheres in the same mill, or None without such a run."""
    spheres = found.get(f"{one.name.partition('_')[0]}_spheres")
    return ratio(getattr(one, read), getattr(spheres, read)) if spheres else None


def verdicts(found: Found, solidity: dict[str, dict[str, float]]) -> list[Verdict]:
    """All verdicts on runs, name -> Numbers; solidity: name -> mean solidity in the bands of SOLIDITY."""
    return [*published_ratios(found), *published_speeds(found), *order_of_shapes(found),
            *published_solidity(found, solidity), *balanced(found)]
