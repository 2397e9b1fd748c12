# SPDX-License-Identifier: GPL-3.0-or-later
"""Along the axis of a mill: height of the slurry's centre of mass, hold-up and head by slices; humps; discharge."""
import warnings
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import curve_fit

from ..files.flow_record import read_flow_record
from ..files.written_times import MillFlow
from .batches import mean_over_turns
from .means import Mean

FLAT = 1e-9  # m: a range of heights that round-off can make


@dataclass
class AxialProfile:
    """Means over time of axial slices [n] of the mill (without pulp lifters): z (m), height of the slurry's centre of
    mass above the axis (m) and its standard deviation over time, hold-up (m3), p_rgh weighted by slurry (Pa)."""
    z: np.ndarray
    height: np.ndarray
    height_spread: np.ndarray
    holdup: np.ndarray
    pressure: np.ndarray


@dataclass
class Humps:
    """height = base + sum of Gaussians, in order of place: places z, heights above the base, widths (standard
    deviations) [count] and base (m); rmsd: root mean square of the residuals (m)."""
    places: tuple[float, ...]
    heights: tuple[float, ...]
    widths: tuple[float, ...]
    base: float
    rmsd: float

    @property
    def distances(self) -> tuple[float, ...]:
        """Between each peak and the next, m [count - 1]."""
        return tuple(b - a for a, b in zip(self.places, self.places[1:]))

    def fitted(self, z: np.ndarray) -> np.ndarray:
        """The fit's height at z (m), m."""
        return gaussians(z, self.base, *np.ravel(np.transpose((self.heights, self.places, self.widths))))


@dataclass
class AxialSeries:
    """Axial slices [n] of the mill (without pulp lifters) against time: z (m); times [times] (s); height of the
    slurry's centre of mass above the axis (m), hold-up (m3) and p_rgh weighted by slurry (Pa), each [times, n], NaN in
    slices without slurry."""
    z: np.ndarray
    times: np.ndarray
    height: np.ndarray
    holdup: np.ndarray
    pressure: np.ndarray


def axial_series(flow: MillFlow, begin: float) -> AxialSeries:
    """AxialSeries of a MillFlow's written times from flow time `begin` (s) on."""
    z, layer = np.unique(np.round(flow.centres[flow.chamber, 2], 7), return_inverse=True)
    times, heights, holdups, pressures = [], [], [], []
    for time, path in flow.frames_with_slurry(begin):
        slurry = flow.slurry(path)[flow.chamber]
        y = flow.turned(flow.centres[flow.chamber, :2], time)[:, 1]
        holdup = np.bincount(layer, slurry)
        with np.errstate(invalid="ignore", divide="ignore"):
            heights.append(np.bincount(layer, slurry * y) / holdup)
            pressures.append(np.bincount(layer, slurry * flow.field("p_rgh", path)[flow.chamber]) / holdup)
        holdups.append(holdup)
        times.append(time)
    if not heights:
        raise RuntimeError(f"{flow.case}: no time from {begin} s on was written")
    return AxialSeries(z, *map(np.array, (times, heights, holdups, pressures)))


def mean_profile(series: AxialSeries) -> AxialProfile:
    """AxialProfile of an AxialSeries: means over its times, of slices where and when they hold slurry; NaN in those
    that never do, except for the hold-up."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)  # of numpy about slices that never hold slurry
        return AxialProfile(series.z, np.nanmean(series.height, axis=0), np.nanstd(series.height, axis=0),
                            np.mean(series.holdup, axis=0), np.nanmean(series.pressure, axis=0))


def axial_profile(flow: MillFlow, begin: float) -> AxialProfile:
    """AxialProfile of a MillFlow from flow time `begin` (s) on, by its written times."""
    return mean_profile(axial_series(flow, begin))


def drop(profile: AxialProfile) -> float:
    """Fall of p_rgh in the slurry of an AxialProfile from its first to its last slice, by a straight line through all,
    Pa."""
    return line_drop(profile.z, profile.pressure)


def line_drop(z: np.ndarray, pressure: np.ndarray) -> float:
    """Fall (Pa) of a pressure [n] (Pa, NaN in slices without slurry) from the first to the last of slices at z [n] (m),
    by a straight line; NaN if fewer than two are known."""
    known = np.isfinite(pressure)
    if known.sum() < 2:
        return np.nan
    return float(-(z[-1] - z[0]) * np.polyfit(z[known], pressure[known], 1)[0])


def drop_over_turns(series: AxialSeries, begin: float, turn: float) -> Mean | None:
    """Drop of an AxialSeries' profiles, Pa, as mean_over_turns has it, of whole turns of `turn` s from `begin` (s) on;
    None if fewer than two fit."""
    drops = np.array([line_drop(series.z, pressure) for pressure in series.pressure])
    return mean_over_turns(series.times, drops, begin, turn)


def gaussians(z: ArrayLike, base: float, *humps: float) -> np.ndarray:
    """base + the sum of height exp(-((z - place)/width)^2 / 2); humps: height, place, width of each in turn."""
    z = np.asarray(z, dtype=float)
    return base + sum(height * np.exp(-((z - place) / width) ** 2 / 2)
                      for height, place, width in np.reshape(humps, (-1, 3)))


def fit_gaussians(z: ArrayLike, height: ArrayLike, count: int) -> Humps:
    """Humps of a profile: the best least-squares fit of `count` Gaussians from many first guesses of their places.

    z [n] (m), rising; height [n] (m). Places are within the profile, heights are not negative. Widths are from 3 % to
    100 % of its length, and at least half of the distance between two slices: a narrower hump could be between them.
    RuntimeError if it has fewer points than the fit has values, a slice without slurry (NaN) or no more range than
    FLAT, or if no fit was found."""
    z, height = np.asarray(z, dtype=float), np.asarray(height, dtype=float)
    if len(z) < 1 + 3 * count:
        raise RuntimeError(f"{len(z)} places along the axis; a fit of {count} Gaussians needs at least {1 + 3 * count}")
    if not np.all(np.isfinite(height)):
        dry = z[~np.isfinite(height)][0]
        raise RuntimeError(f"no slurry in the slice at {1e3 * dry:.4g} mm; a fit of {count} Gaussians needs it in all")
    length, scale = z[-1] - z[0], np.ptp(height)
    if scale <= FLAT:
        raise RuntimeError(f"the heights differ by {scale:.1g} m; a profile with humps differs by more than {FLAT:g} m")
    narrowest = max(0.03 * length, np.diff(z).max() / 2)
    lower = [height.min() - scale, *([0, z[0], narrowest] * count)]
    upper = [height.max(), *([3 * scale, z[-1], length] * count)]
    best = None
    for places in combinations((0.1, 0.25, 0.4, 0.5, 0.6, 0.75, 0.9), count):
        width = max(0.3 / count * length, 1.1 * narrowest)
        guess = [height.min(), *np.ravel([(scale / 2, z[0] + place * length, width) for place in places])]
        try:
            values, _ = curve_fit(gaussians, z, height, guess, bounds=(lower, upper), maxfev=2000)
        except RuntimeError:
            continue
        rmsd = float(np.sqrt(np.mean((gaussians(z, *values) - height) ** 2)))
        if best is None or rmsd < best[0]:
            best = rmsd, values
    if best is None:
        raise RuntimeError(f"no fit of {count} Gaussians to the axial profile was found")
    humps = sorted(best[1][1:].reshape(-1, 3), key=lambda hump: hump[1])
    heights, places, widths = (tuple(map(float, values)) for values in zip(*humps))
    return Humps(places, heights, widths, float(best[1][0]), best[0])


def are_at_ends(humps: Humps, z: np.ndarray) -> tuple[bool, ...]:
    """Whether each of Humps is at an end of the slices z [n] (m): there, the profile shows no maximum, and its place is
    a bound of the fit."""
    first, last = z[0] + 0.1 * (z[1] - z[0]), z[-1] - 0.1 * (z[-1] - z[-2])
    return tuple(place < first or place > last for place in humps.places)


def humps_at_ends(humps: Humps, z: np.ndarray) -> int:
    """Number of Humps that are_at_ends of the slices z [n] (m)."""
    return sum(are_at_ends(humps, z))


def known_distances(humps: Humps, z: np.ndarray) -> tuple[float, ...]:
    """Distances of Humps (m), NaN of those of which one are_at_ends of the slices z [n] (m)."""
    bounds = are_at_ends(humps, z)
    return tuple(np.nan if one or other else apart for apart, one, other in zip(humps.distances, bounds, bounds[1:]))


def slice_thickness(z: np.ndarray) -> np.ndarray:
    """Thickness (m) of two slices or more with the middles z [n] (m): their distance or, of unequal slices, what fills
    the mill from z = 0 on."""
    apart = np.diff(z)
    if np.allclose(apart, apart[0], rtol=1e-3):
        return np.full(len(z), apart.mean())
    ends = [0.0]
    for middle in z:
        ends.append(2 * middle - ends[-1])
    return np.diff(ends)


def slurry_volumes(case: Path | str) -> tuple[np.ndarray, np.ndarray]:
    """Times (s) and volumes of slurry (m3) at the ends of the steps [steps] of a case's flow, its restarts joined.
    RuntimeError if slurryFoam wrote no steps."""
    steps = read_flow_record(case).steps
    if steps is None:
        raise RuntimeError(f"{case}: no postProcessing/flow/START/steps.csv; expected a flow by slurryFoam")
    return steps["time_s"], steps["slurry_m3"]


def discharge(times: np.ndarray, volumes: np.ndarray, feed: float, begin: float) -> float:
    """Mean discharge (m3/s) from `begin` (s) to the last time: the feed (m3/s) minus the gain of volume."""
    chosen = times >= begin
    if chosen.sum() < 2:
        raise RuntimeError(f"the flow has no two steps from {begin} s on")
    t, v = times[chosen], volumes[chosen]
    return float(feed - (v[-1] - v[0]) / (t[-1] - t[0]))
