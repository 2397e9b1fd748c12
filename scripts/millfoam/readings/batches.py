# SPDX-License-Identifier: GPL-3.0-or-later
"""Means of a series over batches of equal time, by turns of the mill, and the errors that follow from them."""
import numpy as np

from .means import Mean, time_steps, turns_mean

BATCHES = 5  # at least, of each half of a series


def whole_turns(span: float, turn: float) -> int:
    """Whole turns of `turn` s in a span (s). Times are rounded, so the last one may lack 0.5 %."""
    return int(span / turn + 0.005)


def batches_of(span: float, turn: float) -> tuple[float, int]:
    """Length (s) of batches of equal time in a span (s) of a mill whose turn takes `turn` s, and their number in a
    half.

    One half begins with the span, the other ends with it. If two turns or more fit, each half is as many whole turns
    as fit, and the rest of the span, in the middle, belongs to neither: what repeats with every turn of the mill, as
    lifters do, is not a drift. A batch is one or more whole turns if a half has BATCHES of them, otherwise a half, a
    third, … of a turn."""
    turns = whole_turns(span / 2, turn)
    if turns < 1:
        return span / 2 / BATCHES, BATCHES
    if turns < BATCHES:
        per_turn = -(-BATCHES // turns)
        return turn / per_turn, turns * per_turn
    whole = turns // BATCHES
    return whole * turn, turns // whole


def batch_means(times: np.ndarray, values: np.ndarray, begin: float, length: float, count: int) -> np.ndarray:
    """Means of values over `count` batches of a length (s) from `begin` (s) on; NaN for a batch without a value. Each
    value is that of the time since the one before, belongs to the batch of the middle of this time, and is weighted by
    it."""
    steps = time_steps(times)
    places = np.floor((times - steps / 2 - begin) / length).astype(int)
    within = (places >= 0) & (places < count)
    weights, any_value = steps[within], values[within][0] if within.any() else 0.0
    # The differences from a value: equal values have an error of exactly 0
    with np.errstate(invalid="ignore"):
        return any_value + (np.bincount(places[within], weights * (values[within] - any_value), count)
                            / np.bincount(places[within], weights, count))


def error_about_line(times: np.ndarray, values: np.ndarray, begin: float, turn: float) -> float:
    """Standard error of the mean of values from `begin` (s) on, from what the means of the last whole turns of `turn` s
    differ from a straight line, so that a drift does not increase it; NaN if fewer than three fit. It does not allow
    for turns that are correlated."""
    turns = whole_turns(times[-1] - begin, turn)
    if turns < 3:
        return np.nan
    means = batch_means(times, values, times[-1] - turns * turn, turn, turns)
    place = np.arange(turns)
    apart = means - np.polyval(np.polyfit(place, means, 1), place)
    return float(np.sqrt(np.sum(apart**2) / (turns - 2) / turns))


def turn_means(times: np.ndarray, values: np.ndarray, begin: float, turn: float) -> np.ndarray:
    """Means [turns] of values from `begin` (s) on over each of the last whole turns of a mill whose turn takes `turn`
    s; empty if none fits."""
    turns = whole_turns(times[-1] - begin, turn)
    return batch_means(times, values, times[-1] - turns * turn, turn, turns) if turns > 0 else np.empty(0)


def mean_over_turns(times: np.ndarray, values: np.ndarray, begin: float, turn: float) -> Mean | None:
    """turns_mean of turn_means; None if fewer than two turns fit."""
    means = turn_means(times, values, begin, turn)
    return turns_mean(means) if len(means) > 1 else None


def error_over_turns(times: np.ndarray, values: np.ndarray, begin: float, turn: float) -> float:
    """Standard error of mean_over_turns; NaN if fewer than two turns fit."""
    found = mean_over_turns(times, values, begin, turn)
    return found.error if found else np.nan
