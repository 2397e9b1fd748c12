# SPDX-License-Identifier: GPL-3.0-or-later
"""Along the axis of a mill: height of the slurry's centre of mass, hold-up and head by slices; humps; discharge."""
import re
from dataclasses import dataclass

import numpy as np
from scipy.optimize import curve_fit


@dataclass
class AxialProfile:
    """Means over time of axial slices [n] of the mill (without pulp lifters): z (m), height of the slurry's centre of mass
    above the axis (m) and its standard deviation over time, hold-up (m3), p_rgh weighted by slurry (Pa)."""
    z: np.ndarray
    height: np.ndarray
    height_spread: np.ndarray
    holdup: np.ndarray
    pressure: np.ndarray


@dataclass
class Humps:
    """height = base + sum of two Gaussians: places z (m), heights above the base (m), root mean square of what is left (m)."""
    places: tuple
    heights: tuple
    base: float
    rmsd: float

    @property
    def distance(self):
        return abs(self.places[1] - self.places[0])


def axial_profile(flow, begin):
    """AxialProfile of a MillFlow from flow time `begin` (s) on."""
    z, layer = np.unique(np.round(flow.centres[flow.chamber, 2], 7), return_inverse=True)
    heights, holdups, pressures = [], [], []
    for time, path in flow.frames:
        if time < max(begin, 1e-9) - 1e-9:
            continue
        slurry = flow.slurry(path)[flow.chamber]
        y = flow.turned(flow.centres[flow.chamber, :2], time)[:, 1]
        holdup = np.bincount(layer, slurry)
        with np.errstate(invalid="ignore", divide="ignore"):
            heights.append(np.bincount(layer, slurry * y) / holdup)
            pressures.append(np.bincount(layer, slurry * flow.field("p_rgh", path)[flow.chamber]) / holdup)
        holdups.append(holdup)
    if not heights:
        raise RuntimeError(f"{flow.case}: no time from {begin} s on was written")
    return AxialProfile(z, np.mean(heights, axis=0), np.std(heights, axis=0), np.mean(holdups, axis=0), np.mean(pressures, axis=0))


def two_gaussians(z, base, height1, place1, width1, height2, place2, width2):
    return (base + height1 * np.exp(-((z - place1) / width1) ** 2 / 2) + height2 * np.exp(-((z - place2) / width2) ** 2 / 2))


def find_humps(z, height):
    """Humps of a profile: the best least-squares fit of two Gaussians within the mill from several first guesses."""
    z, height = np.asarray(z), np.asarray(height)
    length, scale = z[-1] - z[0], np.ptp(height) or 1e-12
    lower = [height.min() - scale, 0, z[0], 0.03 * length, 0, z[0], 0.03 * length]
    upper = [height.max(), 3 * scale, z[-1], length, 3 * scale, z[-1], length]
    best = None
    for first, second in ((0.15, 0.85), (0.25, 0.75), (0.35, 0.65), (0.1, 0.5), (0.5, 0.9)):
        guess = [height.min(), scale / 2, z[0] + first * length, 0.15 * length, scale / 2, z[0] + second * length, 0.15 * length]
        try:
            values, _ = curve_fit(two_gaussians, z, height, guess, bounds=(lower, upper), maxfev=20000)
        except RuntimeError:
            continue
        rmsd = float(np.sqrt(np.mean((two_gaussians(z, *values) - height) ** 2)))
        if best is None or rmsd < best[0]:
            best = rmsd, values
    if best is None:
        raise RuntimeError("no fit of two Gaussians to the axial profile was found")
    rmsd, (base, height1, place1, _, height2, place2, _) = best
    pairs = sorted([(place1, height1), (place2, height2)])
    return Humps(tuple(float(p) for p, _ in pairs), tuple(float(h) for _, h in pairs), float(base), rmsd)


def slurry_volumes(log):
    """Times (s) and volumes of slurry (m3) [steps] that a log of slurryFoam tells. Where the time goes back, a flow that was
    broken off went on from there: what it had computed beyond is left out."""
    times, volumes, now = [], [], None
    for line in log.splitlines():
        if found := re.match(r"Time = (\S+)", line):
            now = float(found.group(1))
        elif now is not None and (found := re.match(r"Slurry (\S+) m3", line)):
            while times and times[-1] >= now:
                times.pop()
                volumes.pop()
            times.append(now)
            volumes.append(float(found.group(1)))
    return np.array(times), np.array(volumes)


def discharge(times, volumes, feed, begin):
    """Mean discharge (m3/s) from `begin` (s) to the last time: what was fed (m3/s) less what was kept."""
    chosen = times >= begin
    if chosen.sum() < 2:
        raise RuntimeError(f"the log has no two steps from {begin} s on")
    t, v = times[chosen], volumes[chosen]
    return float(feed - (v[-1] - v[0]) / (t[-1] - t[0]))
