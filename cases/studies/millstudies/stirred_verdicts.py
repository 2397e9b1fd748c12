# SPDX-License-Identifier: GPL-3.0-or-later
"""Verdicts on dry runs of stirred mills (Numbers of stirred_runs): order and ratio of two runs, a published number."""
from collections.abc import Callable, Iterator

import numpy as np

from millfoam.readings.means import Mean
from millstudies.compared_runs import CONFIRMED, CONTRADICTED, NOT_TESTED, UNDECIDED, Verdict, by_sign
from millstudies.stirred_runs import Numbers

BALANCED = 0.03  # of the impeller's torque, which may be missing on the walls at rest

Found = dict[str, Numbers]  # by their names
Reading = Callable[[Numbers], Mean]
Judge = Callable[..., tuple[str, str]]  # Numbers of runs -> verdict and figure


def tested(statement: str, found: Found, names: tuple[str, ...], judge: Judge) -> Verdict:
    """The verdict of judge(Numbers of the runs with these names), if all of them are complete and steady."""
    gone = [name for name in names if name not in found]
    if gone:
        return Verdict(statement, ", ".join(names), NOT_TESTED, "not finished: " + ", ".join(gone))
    verdict, figure = judge(*(found[name] for name in names))
    moving = [f"{name} drifts in {', '.join(found[name].drifting)}" for name in names if found[name].drifting]
    if moving:
        return Verdict(statement, ", ".join(names), UNDECIDED, "; ".join([figure, *moving]))
    return Verdict(statement, ", ".join(names), verdict, figure)


def speed(one: Numbers) -> Mean:
    """Mean speed of the balls, m/s."""
    return one.speed


def power(one: Numbers) -> Mean:
    """Power of the drive, W."""
    return one.power


def ratio(one: Mean, other: Mean) -> Mean:
    """A mean over another, with the error that theirs give."""
    value = one.value / other.value
    return Mean(value, float(abs(value) * np.hypot(one.error / one.value, other.error / other.value)))


def higher(read: Reading, unit: str, scale: float = 1.0) -> Judge:
    """A judge of two runs: whether what is read of the second is higher, with 95 % confidence."""

    def judge(low: Numbers, high: Numbers) -> tuple[str, str]:
        return by_sign(read(high) - read(low)), " and ".join(read(one).text(unit, scale, ".3f") for one in (low, high))
    return judge


def has_value(read: Reading, unit: str, expected: float, share: float) -> Judge:
    """A judge of a run: whether what is read of it is a published number within a share of that."""
    def judge(one: Numbers) -> tuple[str, str]:
        return near(read(one).value, expected, share * abs(expected)), (
            f"{read(one).text(unit, 1, '.3f')}, expected {expected:g}")
    return judge


def has_ratio(read: Reading, expected: float, by: float) -> Judge:
    """A judge of two runs: whether what is read of the second over that of the first is a published ratio, give or take
    `by`."""
    def judge(first: Numbers, second: Numbers) -> tuple[str, str]:
        over = ratio(read(second), read(first))
        return near(over.value, expected, by), f"{over.value:.3f} ± {over.error:.3f}, published {expected:.3f}"
    return judge


def near(value: float, expected: float, by: float) -> str:
    """Whether a number is another, give or take `by`."""
    return CONFIRMED if abs(value - expected) <= by else CONTRADICTED


def balanced(found: Found) -> Iterator[Verdict]:
    """Whether the walls at rest of each run take the impeller's torque within BALANCED."""
    def judge(one: Numbers) -> tuple[str, str]:
        return near(one.at_rest.value, 1, BALANCED), f"{one.at_rest.value:.4f} of it"
    for name in found:
        yield tested(f"the walls at rest take the impeller's torque within {100 * BALANCED:g} %", found, (name,), judge)
