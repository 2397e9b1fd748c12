# SPDX-License-Identifier: GPL-3.0-or-later
"""Means over time with their standard errors, from blocks of successive times or windows; means and percentiles by
weight."""
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import stdtrit

from ..files.solids_file import SolidsMap, mean_map

BLOCKS = 5  # of the averaged time, for errors
CONFIDENCE = 0.95  # with which a difference is one
CORRELATED = 12  # turns; of fewer, the correlation of neighbours is hardly known


@dataclass(frozen=True)
class Mean:
    """A mean over time; its standard error, which is NaN for fewer than two blocks; and the error's degrees of freedom:
    one less than the blocks, infinity for an error that is exact. An error of 0 is exact only with infinite freedom.
    With less, the blocks' readings are equal: they are too coarse to show an error, see by_resolution."""
    value: float
    error: float = 0.0
    freedom: float = np.inf

    def __add__(self, other: "Mean") -> "Mean":
        """Sum of two means with independent errors. Degrees of freedom: B. L. Welch 1947, Biometrika 34:28; the fewer
        of both where both errors are 0."""
        parts = [(one.error**2, one.freedom) for one in (self, other) if one.error > 0]
        variance = sum(part for part, _ in parts)
        inexact = sum(part**2 / freedom for part, freedom in parts)
        return Mean(self.value + other.value, float(np.hypot(self.error, other.error)),
                    variance**2 / inexact if inexact > 0 else np.inf if variance > 0 else
                    min(self.freedom, other.freedom))

    def __neg__(self) -> "Mean":
        return Mean(-self.value, self.error, self.freedom)

    def __rmul__(self, factor: float) -> "Mean":
        """A number without an error times the mean."""
        return Mean(factor * self.value, abs(factor) * self.error, self.freedom)

    def __sub__(self, other: "Mean") -> "Mean":
        return self + -other

    @property
    def reach(self) -> float:
        """Half of the interval about the value that has the mean with a probability of CONFIDENCE, by Student's
        distribution: 2.0 errors if the error is exact, 2.8 for five blocks, 4.3 for three and 12.7 for two."""
        return float(stdtrit(self.freedom, (1 + CONFIDENCE) / 2)) * self.error

    @property
    def sign(self) -> int:
        """1 or -1 if the value is further from zero than `reach`, otherwise 0, also if the error is not known."""
        return int(np.sign(self.value)) if abs(self.value) > self.reach else 0

    @property
    def shows_error(self) -> bool:
        """Whether its error is known, and not 0 of blocks that are equal."""
        return self.error > 0 or (self.error == 0 and bool(np.isinf(self.freedom)))

    def text(self, unit: str, scale: float = 1.0, form: str = ".1f") -> str:
        """Value and error times `scale`, in a format, with a unit: `1.2 ± 0.1 mm`."""
        return f"{scale * self.value:{form}} ± {scale * self.error:{form}} {unit}"

    def full_text(self, unit: str, scale: float = 1.0, form: str = ".1f") -> str:
        """As text, with `reach` where its degrees of freedom make it larger than that of an exact error: `1.2 ± 0.1 mm
        (95 %: ± 0.4, 2.0 degrees of freedom)`."""
        words = self.text(unit, scale, form)
        if not np.isfinite(self.error) or np.isinf(self.freedom):
            return words
        return f"{words} (95 %: ± {abs(scale) * self.reach:{form}}, {self.freedom:.1f} degrees of freedom)"


def mean_variance(correlation: float, count: int) -> float:
    """Variance of the mean of `count` successive values over that of one value, in an autoregressive process of first
    order in which neighbours have this correlation, 0 to 1."""
    apart = np.arange(1, count)
    return float(1 + 2 * np.sum((1 - apart / count) * correlation**apart)) / count


def neighbour_correlation(values: np.ndarray) -> float:
    """Correlation of neighbours in values [n] that are not all equal, as an autoregressive process of first order:
    without the bias of a short series, -(1 + 4 r)/n (Marriott & Pope 1954, Biometrika 41:390; Kendall 1954, 41:403); at
    least 0 and at most 1 - 2/n."""
    apart = values - values.mean()
    found = np.sum(apart[1:] * apart[:-1]) / np.sum(apart**2)
    return float(np.clip(found + (1 + 4 * found) / len(values), 0, 1 - 2 / len(values)))


def block_mean(values: ArrayLike) -> Mean:
    """Mean of readings [n] of blocks of time, or of runs, that are independent."""
    values = np.asarray(values, dtype=float)
    count = len(values)
    return Mean(float(values.mean()), float(values.std(ddof=1) / np.sqrt(count)) if count > 1 else np.nan, count - 1)


def by_resolution(mean: Mean, deviation: float) -> Mean:
    """A mean of readings that are known only to a resolution, with the standard deviation that this gives to a single
    one: of values that are rounded to steps h, h/sqrt(12), that of a uniform distribution of width h. Readings of all
    blocks may be rounded alike, so more of them do not make it smaller. It is the least error, exact, that the mean
    has: it is taken where its `reach` is more than that of the error over the blocks, which may be 0. The two are not
    added: with few blocks, the sum would have more degrees of freedom and a smaller reach."""
    least = Mean(mean.value, deviation)
    return least if least.reach > mean.reach else mean


def deviation_freedom(correlation: float, count: int) -> float:
    """Degrees of freedom of the variance of `count` successive values about their own mean, in an autoregressive
    process of first order in which neighbours have this correlation, 0 to 1: twice the square of the variance's mean
    over its variance, as for values that are independent (F. E. Satterthwaite 1946, Biometrics Bulletin 2:110)."""
    order = np.arange(count)
    about_mean = correlation**np.abs(order[:, None] - order)
    for axis in (0, 1):
        about_mean = about_mean - about_mean.mean(axis=axis, keepdims=True)
    return float(np.trace(about_mean)**2 / np.sum(about_mean**2))


def turns_mean(values: ArrayLike, least: float = 0.0) -> Mean:
    """Mean of readings [n] of successive turns, in order of time; least: correlation of neighbours that is known, below
    1; it may be more.

    From CORRELATED turns on its error allows for neighbours that are correlated, as in an autoregressive process of
    first order (A. M. Law, Simulation Modeling and Analysis, section 9.5.3): the hold-up of a mill with a feed changes
    over ten turns or more. It is still too small where readings change more slowly than over a tenth of the turns, and
    by up to a quarter too large for few turns that are independent. Of fewer turns, the error is that of block_mean.
    With `least` it holds for any number of turns. Degrees of freedom are deviation_freedom of a correlation that is
    known. Where the turns show a larger one, which they hardly know, they are one less than the number of independent
    turns whose mean would have the same variance: of 12 turns with correlations of 0, 0.3, 0.6 and 0.8, `reach` has the
    mean in 96, 94, 90 and 84 %."""
    values = np.asarray(values, dtype=float)
    count, spread = len(values), values.std()
    if count < 2 or not spread > 0 or (count < CORRELATED and not least > 0):
        return block_mean(values)
    found = neighbour_correlation(values)
    share = mean_variance(max(found, least), count)
    freedom = max(1 / share - 1, 1.0) if found > least else deviation_freedom(least, count)
    # The deviations are from the values' own mean, which takes its variance from theirs
    return Mean(float(values.mean()), float(spread * np.sqrt(share / (1 - share))), freedom)


def series_mean(values: ArrayLike, blocks: int = BLOCKS) -> tuple[np.ndarray, np.ndarray]:
    """Mean of a series [times, …] by as many blocks of successive times: value [...] and standard error [...]."""
    values = np.asarray(values, dtype=float)
    parts = np.array([np.mean(part, axis=0) for part in np.array_split(values, min(blocks, len(values)))])
    error = parts.std(axis=0, ddof=1) / np.sqrt(len(parts)) if len(parts) > 1 else np.full(parts.shape[1:], np.nan)
    return np.mean(values, axis=0), error


def mean_of_series(values: ArrayLike, blocks: int = BLOCKS) -> Mean:
    """series_mean of a series [times] as a Mean."""
    value, error = series_mean(values, blocks)
    return Mean(float(value), float(error), min(blocks, np.size(values)) - 1)


def angle_mean(angles: ArrayLike) -> Mean:
    """block_mean of angles [n] (degrees), which may be on both sides of 180; from -180 to 180."""
    about = np.degrees(np.angle(np.mean(np.exp(1j * np.radians(angles)))))
    found = block_mean((np.asarray(angles) - about + 180) % 360 - 180)
    return Mean(float((found.value + about + 180) % 360 - 180), found.error, found.freedom)


@dataclass
class Reading:
    """value: of the mean over all windows, a number or an array; error: its standard error from `blocks` blocks of
    windows, NaN for fewer than two; failed: number of further blocks without this reading."""
    value: np.ndarray
    error: np.ndarray
    blocks: int
    failed: int


def of_reading(reading: Reading, place: int = 0) -> Mean:
    """A number of a Reading, or the one at `place` of its array, as a Mean."""
    value, error = (np.atleast_1d(part)[place] for part in (reading.value, reading.error))
    return Mean(float(value), float(error), reading.blocks - 1)


def with_error(reading: Callable[[SolidsMap], ArrayLike], maps: Sequence[SolidsMap], blocks: int = 8) -> Reading:
    """A reading of the mean of SolidsMap of successive windows, with its standard error over time.

    reading: SolidsMap -> number, or array of fixed shape; it raises RuntimeError, or returns NaN, if a map does not
    have it. An error for the mean of all windows is passed on. maps: from read_windows. They are divided into at most
    `blocks` equal blocks of successive windows (the first ones may be one window longer). Each block is averaged and
    read. The error is the readings' standard deviation over the root of their number. It holds if blocks are longer
    than the correlation time of the charge, about a turn of the charge. Method of batch means: A. M. Law, Simulation
    Modeling and Analysis, section 9.5.3. ValueError for fewer than two maps."""
    if len(maps) < 2 or blocks < 2:
        raise ValueError(f"{len(maps)} windows in {blocks} blocks: an error over time needs at least two of each")
    value = np.asarray(reading(mean_map(maps)), dtype=float)
    parts = np.array_split(np.arange(len(maps)), min(blocks, len(maps)))
    found = []
    for part in parts:
        try:
            one = np.asarray(reading(mean_map([maps[i] for i in part])), dtype=float)
        except RuntimeError:
            continue
        if np.all(np.isfinite(one)):
            found.append(one)
    error = np.std(found, axis=0, ddof=1) / np.sqrt(len(found)) if len(found) > 1 else np.full(value.shape, np.nan)
    return Reading(value, error, len(found), len(parts) - len(found))


def time_steps(times: np.ndarray) -> np.ndarray:
    """Time (s) from the time before to each of times [n] (s); the first has that of the second, a single one 1 s."""
    return np.diff(times, prepend=2 * times[0] - times[1]) if len(times) > 1 else np.ones(len(times))


def time_mean(times: ArrayLike, values: ArrayLike, begin: float) -> float:
    """Mean of values [times] from `begin` (s) on, each that of the time since the one before, whose middle counts, and
    weighted by it; NaN if there are none."""
    times = np.asarray(times)
    steps = time_steps(times)
    late = times - steps / 2 >= begin
    return float(np.average(np.asarray(values)[late], weights=steps[late])) if late.any() else np.nan


def weighted_percentile(values: np.ndarray, weights: np.ndarray, percents: ArrayLike) -> np.ndarray:
    """Values below which these percents of the weight lie."""
    order = np.argsort(values)
    below = np.cumsum(weights[order]) - weights[order] / 2
    return np.interp(np.asarray(percents) / 100 * weights.sum(), below, values[order])
