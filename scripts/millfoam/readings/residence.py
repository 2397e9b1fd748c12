# SPDX-License-Identifier: GPL-3.0-or-later
"""Time that slurry stays in a mill, from the table of a slurryTracer: its distribution and the fits of it."""
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

from ..files.tables import TableError, read_table

LEFT = 0.4  # of the tracer that may still be in the mill; above it no tail can be fitted


@dataclass(frozen=True)
class TracerTable:
    """A slurryTracer's table: time [n] of the ends of its rows, and their lengths [n], s; tracer in the mill [n], m3;
    tracer that came in and left in a row's time [n], m3; rates of slurry in and out [n], m3/s; whether the feed was a
    pulse or a step; begin: of its tracer, s; missing: largest volume that the balance misses, over all tracer; lowest
    and highest concentration, nan if no cell ever held slurry."""
    time: np.ndarray
    length: np.ndarray
    tracer: np.ndarray
    into: np.ndarray
    out: np.ndarray
    slurry_in: np.ndarray
    slurry_out: np.ndarray
    pulse: bool
    begin: float
    missing: float
    lowest: float
    highest: float


@dataclass(frozen=True)
class Residence:
    """Distribution of residence times: time [n] since the middle of the pulse or the begin of the step, s, and E(t)
    [n], 1/s, of what has left; mean, s, and variance, s2, with the tail; left: share of the tracer that has not left,
    whose times are those of an exponential tail; tail: its time, s."""
    time: np.ndarray
    density: np.ndarray
    mean: float
    variance: float
    left: float
    tail: float

    @property
    def spread(self) -> float:
        """Variance over the square of the mean: 0 for plug flow, 1 for a stirred tank."""
        return self.variance / self.mean**2

    @property
    def tanks(self) -> float:
        """Number of stirred tanks in series with this spread."""
        return 1 / self.spread

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
    all_tracer = max(values["tracer"].max(), values["allIn"].max())
    missing = float(np.abs(values["missing"]).max() / all_tracer) if all_tracer > 0 else 0.0
    return TracerTable(time, length, values["tracer"], into, out, values["slurryIn"], values["slurryOut"],
                       bool(not fed[-1]), begin, missing, float(np.fmin.reduce(values["smallest"])),
                       float(np.fmax.reduce(values["largest"])))


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
    than t."""
    after = (table.time > table.begin) & (table.slurry_out > 0)
    length = table.length[after]
    # The outflow of a row is a mean over its time
    middle = table.time[after] - length / 2 - table.begin
    younger = np.concatenate([[0.0], table.out[after] / (table.slurry_out[after] * length)])
    age = np.concatenate([[0.0], middle])
    return of_shares((age[1:] + age[:-1]) / 2, np.diff(younger), np.diff(age), float(middle[-1]), 0.0)


def of_shares(time: np.ndarray, share: np.ndarray, length: np.ndarray, end: float, wide: float) -> Residence:
    """Residence of shares of the tracer that left around these times [n] (s), over lengths [n] (s); end: of the record,
    s; wide: variance of the feed, s2."""
    left, tail = end_of(time, share)
    mean = float((share * time).sum() + left * (end + tail))
    square = float((share * time**2).sum() + left * ((end + tail)**2 + tail**2))
    return Residence(time, share / length, mean, square - mean**2 - wide, left, tail)


def end_of(time: np.ndarray, share: np.ndarray) -> tuple[float, float]:
    """Share that has not left, and the time (s) of its exponential tail: that with which the last of what has left came
    out. RuntimeError if more than LEFT has not left, if more left than was fed, or if what leaves does not decay."""
    left = float(1 - share.sum())
    if left < -1e-3:
        raise RuntimeError(f"{-100 * left:.3g} % more tracer left than was fed; expected at most 0.1 %")
    if left > LEFT:
        raise RuntimeError(f"{100 * left:.0f} % of the tracer has not left at the end; expected at most "
                           f"{100 * LEFT:.0f} %: let the flow run longer")
    if left < 1e-6:
        return max(left, 0.0), 0.0
    # What is still to come at each time falls by the exponential
    to_come = 1 - np.cumsum(share)
    late = (to_come < max(0.5, left + 0.2)) & (to_come > 0)
    slope = np.polyfit(time[late], np.log(to_come[late]), 1)[0] if late.sum() > 2 else 0.0
    if not slope < 0:
        raise RuntimeError(f"{100 * left:.2g} % of the tracer has not left at the end, and what leaves does not decay: "
                           "let the flow run longer")
    return left, float(-1 / slope)
