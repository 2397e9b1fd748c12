# SPDX-License-Identifier: GPL-3.0-or-later
"""Time that slurry stays in a mill, from the table of a slurryTracer: its distribution and the fits of it."""
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

from ..files.tables import TableError, read_table
from .batches import error_over_turns
from .means import Mean, time_mean

# Share of the tracer that may still be in the mill. With 20 % the mean of two to five stirred tanks is 1 % too large
# and the variance over its square 7 to 12 %; with 28 % they are 3 and 12 to 20 %
LEFT = 0.2
NEGLIGIBLE = 1e-3  # share of the tracer that may leave at the end of the record if no exponential is found for it
LATE, WIDER = 1.5, 3.0  # times what has not left: what is still to come where the tail is fitted, and for another fit
FEWEST = 5  # rows of a fit
CLEAR = 0.5  # of fitted_share, of a decay that is none of noise: exponentials have 0.99, noise of a step up to 0.05
ROUND_OFF = 1e-6  # of the tracer, a share that has left; of what is still to come, a fall that is no decay
SPARSE = 0.01  # of the tracer that left, by which rates times rows may differ from it


@dataclass(frozen=True)
class TracerTable:
    """A slurryTracer's table: time [n] of the ends of its rows, and their lengths [n], s; tracer in the mill [n], m3;
    tracer that came in and left in a row's time [n], m3; rate of slurry out [n], m3/s; whether the feed was a pulse or
    a step; begin: of its tracer, s; missing: largest volume that the balance misses, over all tracer; lowest and
    highest concentration, nan if no cell ever held slurry; skipped: by how much the rates at the rows' ends, times
    their lengths, differ from the tracer that left, over all of it: 0 if each time-step has a row."""
    time: np.ndarray
    length: np.ndarray
    tracer: np.ndarray
    into: np.ndarray
    out: np.ndarray
    slurry_out: np.ndarray
    pulse: bool
    begin: float
    missing: float
    lowest: float
    highest: float
    skipped: float = 0.0


@dataclass(frozen=True)
class Residence:
    """Distribution of residence times: time [n] since the middle of the pulse or the begin of the step, s, lengths [n]
    of the rows about these times, s, and E(t) [n], 1/s, of what has left; mean, s, and variance, s2, with the tail;
    left: share of the tracer that has not left, whose times are those of an exponential tail; tail: its time, s, 0 if
    what has not left is taken to leave at the end; other_mean, other_variance: with another fit of the tail, to WIDER
    instead of LATE, NaN if there is none, None if nothing is left. For stirred tanks the mean and variance are off by
    up to twice the difference to these, for a zone that exchanges its slurry slowly by up to seven times."""
    time: np.ndarray
    length: np.ndarray
    density: np.ndarray
    mean: float
    variance: float
    left: float
    tail: float
    other_mean: float | None = None
    other_variance: float | None = None

    @property
    def spread(self) -> float:
        """Variance over the square of the mean: 0 for plug flow, 1 for a stirred tank."""
        return self.variance / self.mean**2

    @property
    def tanks(self) -> float:
        """Number of stirred tanks in series with this spread; inf for no spread, or one below 0 by the wide feed."""
        return 1 / self.spread if self.spread > 0 else np.inf

    def binned(self, width: float) -> tuple[np.ndarray, np.ndarray]:
        """Middles (s) of bins of a width (s) from time 0 to the end of the record, and E(t) (1/s) over each of them:
        E of single rows of a step is the difference of neighbouring values, which is noise."""
        ends = self.time + self.length / 2
        edges = width * np.arange(int(ends[-1] / width + 1e-9) + 1)
        gone = np.interp(edges, np.concatenate([[ends[0] - self.length[0]], ends]),
                         np.concatenate([[0.0], np.cumsum(self.density * self.length)]))
        return (edges[1:] + edges[:-1]) / 2, np.diff(gone) / width

    @property
    def doubt(self) -> tuple[float, float]:
        """How much mean and spread differ, as shares, with another fit of the tail; NaN if there is none."""
        if self.other_mean is None or self.other_variance is None:
            return 0.0, 0.0
        other = self.other_variance / self.other_mean**2
        return self.other_mean / self.mean - 1, other / self.spread - 1 if self.spread > 0 else np.nan

    @property
    def peclet(self) -> float:
        """Pe = u L/D of axial dispersion in a vessel that is closed at both ends (closed_spread); inf for no spread, 0
        if the spread is that of a stirred tank or more."""
        if self.spread >= 1:
            return 0.0
        if self.spread <= closed_spread(1e6):
            return np.inf
        return float(brentq(lambda peclet: closed_spread(peclet) - self.spread, 1e-6, 1e6))


def closed_spread(peclet: float) -> float:
    """Variance over the square of the mean of a vessel with axial dispersion that is closed at both ends: 2/Pe - 2 (1 -
    exp(-Pe))/Pe^2 (Danckwerts, Chem. Eng. Sci. 2 (1953) 1; van der Laan, ib. 7 (1958) 187). Pe above 0."""
    if peclet < 1e-2:
        return 1 - peclet / 3 + peclet**2 / 12
    return 2 / peclet + 2 * np.expm1(-peclet) / peclet**2


def tracer_names(case: Path | str) -> list[str]:
    """Names of the slurryTracers of which a case has a table, sorted."""
    return sorted({table.parent.parent.name for table in Path(case).glob("postProcessing/*/*/slurryTracer*.dat")})


def hold_up_over_feed(columns: dict[str, np.ndarray], table: TracerTable, turn: float) -> Mean | None:
    """Mean time (s) that slurry stays in a steady mill, from the begin of a tracer on, with the error of the hold-up
    over whole turns, NaN for fewer than two; None without a feed. columns: of slurryBalance; turn: of the mill, s."""
    held, fed = (time_mean(columns["Time"], columns[name], table.begin) for name in ("holdUp", "feed"))
    if not fed > 0:
        return None
    return Mean(held / fed, error_over_turns(columns["Time"], columns["holdUp"], table.begin, turn) / fed)


def read_tracer(case: Path | str, name: str = "tracer") -> TracerTable:
    """TracerTable of a case's function object of this name. TableError if it has no table of two rows
    or more."""
    columns, rows = read_table(case, name, "slurryTracer")
    values = dict(zip([column.split("_")[0] for column in columns], rows.T))
    time = values["Time"]
    if len(time) < 2:
        raise TableError(f"{case}: the table of {name} has {len(time)} rows; expected 2 or more")
    # By the integrals, which have every time-step: a table may have fewer rows. The first row's length is not known
    length = np.diff(time, prepend=2 * time[0] - time[1])
    into, out = (np.diff(values[key], prepend=0.0) for key in ("allIn", "allOut"))
    fed = into > 1e-9 * values["slurryIn"] * length  # after a pulse less than round-off
    begin = float((time - length)[fed][0]) if fed.any() else np.nan
    by_rates = np.abs(values["out"] * length - out)[1:].sum()
    skipped = float(by_rates / out.sum()) if out.sum() > 0 else 0.0
    all_tracer = max(values["tracer"].max(), values["allIn"].max())
    missing = float(np.abs(values["missing"]).max() / all_tracer) if all_tracer > 0 else 0.0
    return TracerTable(time, length, values["tracer"], into, out, values["slurryOut"], bool(not fed[-1]), begin,
                       missing, float(np.fmin.reduce(values["smallest"])), float(np.fmax.reduce(values["largest"])),
                       skipped)


def residence(table: TracerTable) -> Residence:
    """Residence of a pulse or a step in the feed of a mill through which slurry flows. RuntimeError without tracer in
    the feed, and as end_of."""
    if not table.into.any():
        raise RuntimeError("no tracer was fed; expected feed, and a tracer whose begin is before the flow's end")
    return of_pulse(table) if table.pulse else of_step(table)


def of_pulse(table: TracerTable) -> Residence:
    """Residence of a pulse: what leaves, over all that was fed."""
    middle = table.time - table.length / 2
    fed = float(table.into.sum())
    begin = float((table.into * middle).sum() / fed)
    wide = float((table.into * (middle - begin)**2).sum() / fed)
    share = table.out / fed
    return of_shares(middle - begin, share, table.length, float(table.time[-1]) - begin, wide)


def of_step(table: TracerTable) -> Residence:
    """Residence of a step: the feed's concentration is 1, that of the outflow the share F(t) of slurry that is younger
    than t. RuntimeError if no slurry leaves, or if time-steps have no row: their flow of slurry is not known."""
    if table.skipped > SPARSE:
        raise RuntimeError(f"a step needs a row for each time-step, and rates times rows differ by "
                           f"{100 * table.skipped:.2g} % from the tracer that left; expected at most {100 * SPARSE:g} "
                           "%: let the tracer write every step, or feed a pulse")
    after = (table.time > table.begin) & (table.slurry_out > 0)
    if not after.any():
        raise RuntimeError(f"no slurry has left since the tracer's begin at {table.begin:.4g} s, up to "
                           f"{table.time[-1]:.4g} s: let the flow run longer")
    length = table.length[after]
    # The outflow of a row is a mean over its time
    middle = table.time[after] - length / 2 - table.begin
    younger = np.concatenate([[0.0], table.out[after] / (table.slurry_out[after] * length)])
    age = np.concatenate([[0.0], middle])
    return of_shares((age[1:] + age[:-1]) / 2, np.diff(younger), np.diff(age), float(middle[-1]), 0.0)


def of_shares(time: np.ndarray, share: np.ndarray, length: np.ndarray, end: float, wide: float) -> Residence:
    """Residence of shares of the tracer that left around these times [n] (s), over lengths [n] (s); end: of the record,
    s; wide: variance of the feed, s2."""
    left, tail, other = end_of(time, share)

    def moments(tail: float) -> tuple[float, float]:
        mean = float((share * time).sum() + left * (end + tail))
        square = float((share * time**2).sum() + left * ((end + tail)**2 + tail**2))
        return mean, square - mean**2 - wide
    return Residence(time, length, share / length, *moments(tail), left, tail, *(moments(other) if left else ()))


def end_of(time: np.ndarray, share: np.ndarray) -> tuple[float, float, float]:
    """Share that has not left, and the time (s) of its exponential tail: that with which the last of what has left came
    out, while LATE times the rest were still to come; and the same for WIDER, NaN if what left in this time does not
    decay. If at most NEGLIGIBLE has not left and what leaves does not decay, this leaves at the end: both times are 0.
    So does at most NEGLIGIBLE whose time is longer than the record and is mostly noise, by fitted_share; then the other
    time is NaN. RuntimeError if more has not left and does not decay, if more than LEFT has not left, or if more left
    than was fed."""
    left = float(1 - share.sum())
    if left < -1e-3:
        raise RuntimeError(f"{-100 * left:.3g} % more tracer left than was fed; expected at most 0.1 %")
    if left > LEFT:
        raise RuntimeError(f"{100 * left:.0f} % of the tracer has not left at the end; expected at most "
                           f"{100 * LEFT:.0f} %: let the flow run longer")
    if left < ROUND_OFF:
        return 0.0, 0.0, 0.0
    to_come = 1 - np.cumsum(share)
    tail, other = (decay(time, to_come, times * left) for times in (LATE, WIDER))
    if left <= NEGLIGIBLE:
        if tail is None:
            return left, 0.0, 0.0
        if tail > time[-1] and fitted_share(time, to_come, LATE * left) < CLEAR:
            return left, 0.0, np.nan
    if tail is None:
        raise RuntimeError(f"{100 * left:.2g} % of the tracer has not left at the end, and what leaves does not decay: "
                           "let the flow run longer")
    return left, tail, np.nan if other is None else other


def decay(time: np.ndarray, to_come: np.ndarray, most: float) -> float | None:
    """Time (s) of the exponential by which what is still to come at times [n] (s) falls while it is less than `most`,
    at least in the last FEWEST rows; None if it does not."""
    late = late_rows(to_come, most)
    slope = np.polyfit(time[late], np.log(to_come[late]), 1)[0] if late.sum() > 2 else 0.0
    return float(-1 / slope) if slope * np.ptp(time[late]) < -ROUND_OFF else None


def fitted_share(time: np.ndarray, to_come: np.ndarray, most: float) -> float:
    """Share of the variance of decay's logarithms that its straight line has: 1 for an exponential, little for noise,
    as of a step's outflow."""
    late = late_rows(to_come, most)
    return float(np.corrcoef(time[late], np.log(to_come[late]))[0, 1]**2)


def late_rows(to_come: np.ndarray, most: float) -> np.ndarray:
    """Which rows [n] decay fits."""
    late = (to_come < most) & (to_come > 0)
    late[-FEWEST:] = to_come[-FEWEST:] > 0
    return late
