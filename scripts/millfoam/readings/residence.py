# SPDX-License-Identifier: GPL-3.0-or-later
"""Time that slurry stays in a mill, from the table of a slurryTracer: its distribution and the fits of it."""
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

from ..files.tables import read_table

LEFT = 0.5  # of the tracer that may still be in the mill; above it no tail can be fitted


@dataclass(frozen=True)
class TracerTable:
    """A slurryTracer's table: time [n] of the ends of its steps, s; tracer in the mill [n], m3; rates of tracer and
    slurry in and out [n], m3/s; whether the feed was a pulse or a step; begin: of its tracer, s; missing: largest
    volume that the balance misses, over all tracer; lowest and highest concentration."""
    time: np.ndarray
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
    """TracerTable of a case's function object of this name. TableError if it has no table."""
    columns, rows = read_table(case, name, "slurryTracer")
    values = dict(zip([column.split("_")[0] for column in columns], rows.T))
    # After a pulse the feed has less than round-off
    time, fed = values["Time"], values["in"] > 1e-9 * values["slurryIn"]
    step = np.diff(time, prepend=time[0])
    begin = float(time[fed][0] - step[fed][0]) if fed.any() else np.nan
    all_tracer = max(values["tracer"].max(), values["allIn"].max())
    missing = float(np.abs(values["missing"]).max() / all_tracer) if all_tracer > 0 else 0.0
    return TracerTable(time, values["tracer"], values["in"], values["out"], values["slurryIn"], values["slurryOut"],
                       bool(not fed[-1]), begin, missing,
                       float(values["smallest"].min()), float(values["largest"].max()))


def residence(table: TracerTable) -> Residence:
    """Residence of a pulse or a step in the feed of a mill through which slurry flows. RuntimeError without tracer in
    the feed, or if more than half of a pulse is still in the mill, or the outflow of a step has less than half of the
    feed's concentration."""
    if not table.into.any():
        raise RuntimeError("no tracer was fed; expected feed, and a tracer whose begin is before the flow's end")
    return of_pulse(table) if table.pulse else of_step(table)


def of_pulse(table: TracerTable) -> Residence:
    """Residence of a pulse: what leaves, over all that was fed."""
    length = np.diff(table.time, prepend=2 * table.time[0] - table.time[1])
    middle = table.time - length / 2
    fed = float((table.into * length).sum())
    begin = float((table.into * length * middle).sum() / fed)
    wide = float((table.into * length * (middle - begin)**2).sum() / fed)
    time, share = middle - begin, table.out * length / fed
    left, tail = end_of(time, share)
    end = time[-1] + length[-1] / 2
    mean = float((share * time).sum() + left * (end + tail))
    square = float((share * time**2).sum() + left * ((end + tail)**2 + tail**2))
    return Residence(time, share / length, mean, square - mean**2 - wide, left, tail)


def of_step(table: TracerTable) -> Residence:
    """Residence of a step: the feed's concentration is 1, that of the outflow the share F(t) of slurry that is younger
    than t."""
    after = (table.time > table.begin) & (table.slurry_out > 0)
    time = np.concatenate([[0.0], table.time[after] - table.begin])
    younger = np.concatenate([[0.0], table.out[after] / table.slurry_out[after]])
    middle, length, share = (time[1:] + time[:-1]) / 2, np.diff(time), np.diff(younger)
    left, tail = end_of(middle, share)
    mean = float((share * middle).sum() + left * (time[-1] + tail))
    square = float((share * middle**2).sum() + left * ((time[-1] + tail)**2 + tail**2))
    return Residence(middle, share / length, mean, square - mean**2, left, tail)


def end_of(time: np.ndarray, share: np.ndarray) -> tuple[float, float]:
    """Share that has not left, and the time (s) of its exponential tail: that with which the last half of what has
    left after the median came out. RuntimeError if more than LEFT has not left."""
    left = float(max(0.0, 1 - share.sum()))
    if left > LEFT:
        raise RuntimeError(f"{100 * left:.0f} % of the tracer has not left at the end; expected at most "
                           f"{100 * LEFT:.0f} %: let the flow run longer")
    if left < 1e-6:
        return left, 0.0
    # What is still to come at each time falls by the exponential
    to_come = 1 - np.cumsum(share)
    late = (to_come < (0.5 + left) / 2) & (to_come > 0)
    if late.sum() < 3:
        return left, 0.0
    slope = np.polyfit(time[late], np.log(to_come[late]), 1)[0]
    return left, float(-1 / slope) if slope < 0 else 0.0
