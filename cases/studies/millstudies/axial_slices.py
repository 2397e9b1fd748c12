# SPDX-License-Identifier: GPL-3.0-or-later
"""The slurry of a run by slices along the axis and by whole turns, from slurry.h5, read as the study was published: the
profile of the centre of mass with its humps, and the fall of the pressure along the axis by several definitions."""
from collections.abc import Callable
from dataclasses import dataclass

import h5py
import numpy as np

from millfoam.files.mill_case import MillCase
from millfoam.readings.axial import Humps, are_at_ends, fit_gaussians, known_distances
from millfoam.readings.batches import whole_turns
from millfoam.readings.means import Mean, block_mean

LEFT_OUT = 3, 1  # slices at the feed end and at the discharge end that the published profile leaves out
SHARE, BED = 0.5, 0.2  # of slurry in the fluid, and of balls, above which a voxel is in the wet bed
LEVEL = -0.1  # of the pressure at a single level, over the mill's diameter: y is -30 mm, inside the bed
PRESSURES = {"p_rgh": "p_rgh in the slurry", "pressure": "pressure in the slurry",
             "level": "pressure at one level inside the bed"}


@dataclass(frozen=True)
class Slices:
    """Slices [n] of the voxels, and means over whole turns [turns]: z (m), their middles; holdup (m3), height of the
    slurry's centre of mass (m), pressures of PRESSURES (Pa), each [turns, n], NaN where there is none."""
    z: np.ndarray
    holdup: np.ndarray
    height: np.ndarray
    pressures: dict[str, np.ndarray]

    def count_before(self, length: float) -> int:
        """Number of the slices that end before z = length (m)."""
        half = (self.z[1] - self.z[0]) / 2
        return int(np.sum(self.z + half <= length + 1e-9))

    def read(self, length: float = np.inf) -> slice:
        """The slices of the published profile, of those that end before z = length (m)."""
        return slice(LEFT_OUT[0], self.count_before(length) - LEFT_OUT[1])

    def profile(self, turns: np.ndarray | slice = slice(None)) -> np.ndarray:
        """Height (m) [n] of the centre of mass over some of the turns."""
        weight = self.holdup[turns]
        with np.errstate(invalid="ignore", divide="ignore"):
            return np.nansum(weight * self.height[turns], axis=0) / weight.sum(axis=0)


@dataclass(frozen=True)
class Profile:
    """What is read of a profile: z (m) and mean height (m) [n] of its slices; error (m) of a slice's height, the root
    mean square of the standard errors over the turns, NaN for a single turn; fit of Gaussians; distances (m) of
    successive peaks and amplitude (m), highest minus lowest slice, with errors over the turns. Distances are NaN where
    one of the peaks is at an end of the profile, with all turns or without one of them: it may be anywhere beyond."""
    z: np.ndarray
    height: np.ndarray
    error: float
    humps: Humps
    distances: list[Mean]
    amplitude: Mean

    @property
    def at_ends(self) -> tuple[bool, ...]:
        """Whether each of its peaks is at an end of it (axial.are_at_ends)."""
        return are_at_ends(self.humps, self.z)

    @property
    def marked_peaks(self) -> str:
        """Places of its peaks in mm, with a * for those at an end of it."""
        return " ".join(f"{1e3 * place:.0f}{'*' * end}" for place, end in zip(self.humps.places, self.at_ends))


def turn_windows(case: MillCase, begins: np.ndarray, ends: np.ndarray) -> list[np.ndarray]:
    """Numbers of the windows of slurry.h5 (DEM times, s) in each of a MillCase's last whole averaged turns. A window
    belongs to the turn of its middle. RuntimeError if no turn fits."""
    last = case.flow.time0 + case.last
    turns = whole_turns(case.last - case.begin, case.turn)
    if turns < 1:
        raise RuntimeError(f"{case.folder}: averaged over {case.last - case.begin:.3g} s; expected a turn of "
                           f"{case.turn:.3g} s or more")
    turn_of = np.floor(((begins + ends) / 2 - last) / case.turn).astype(int) + turns
    return [np.flatnonzero(turn_of == number) for number in range(turns)]


class _Sums:
    """Sums over windows of what the slices of Slices are the means of."""

    def __init__(self, file: h5py.File):
        self.file = file
        lower, upper, shape = (np.asarray(file["grid"].attrs[name]) for name in ("lower", "upper", "shape"))
        self.voxel = np.prod((upper - lower) / shape)
        _, y, self.z = ((np.arange(count) + 0.5) * (high - low) / count + low
                        for low, high, count in zip(lower, upper, shape))
        self.y = y[None, :, None]
        self.row = int(np.argmin(np.abs(y - LEVEL * (upper[1] - lower[1]))))

    def of(self, windows: np.ndarray) -> dict[str, np.ndarray]:
        """Means over some windows: holdup, height and the pressures [n]."""
        room = volume = moment = np.zeros(())
        heads = {name: np.zeros(()) for name in PRESSURES}
        level_weight = np.zeros(())
        for window in windows:
            inside = self.file["grid/insideFraction"][window]
            slurry, voidage = self.file["slurry"][window], self.file["voidage"][window]
            held = self.voxel * inside * slurry
            room, volume = room + 1, volume + held.sum(axis=(1, 2))
            moment = moment + (held * self.y).sum(axis=(1, 2))
            for name in ("p_rgh", "pressure"):
                heads[name] = heads[name] + (held * self.file[name][window]).sum(axis=(1, 2))
            row = np.s_[:, self.row]
            wet = held[row] * (slurry[row] > SHARE * voidage[row])
            if "balls" in self.file:
                wet = wet * (1 - voidage[row] > BED)
            heads["level"] = heads["level"] + (wet * self.file["pressure"][window][row]).sum(axis=1)
            level_weight = level_weight + wet.sum(axis=1)
        with np.errstate(invalid="ignore", divide="ignore"):
            return {"holdup": volume / room, "height": moment / volume, "p_rgh": heads["p_rgh"] / volume,
                    "pressure": heads["pressure"] / volume, "level": heads["level"] / level_weight}


def read_slices(case: MillCase) -> Slices:
    """Slices of a MillCase. RuntimeError without a complete slurry.h5, or for less than a whole averaged turn."""
    if case.slurry is None:
        raise RuntimeError("; ".join([f"{case.folder}: no slurry.h5", *case.unusable]))
    with h5py.File(case.slurry) as file:
        sums = _Sums(file)
        turns = [sums.of(part) for part in turn_windows(case, file["window/begin"][:], file["window/end"][:])]
        return Slices(sums.z, *(np.stack([one[name] for one in turns]) for name in ("holdup", "height")),
                      {name: np.stack([one[name] for one in turns]) for name in PRESSURES})


def jackknife(read: Callable[[np.ndarray], np.ndarray], turns: int) -> tuple[np.ndarray, np.ndarray]:
    """Values [m] of read(numbers of turns) of all turns, and their standard errors over the turns, from all turns but
    one; NaN for a single turn."""
    everything = np.arange(turns)
    value = np.asarray(read(everything), dtype=float)
    if turns < 2:
        return value, np.full(value.shape, np.nan)
    without = np.stack([read(np.delete(everything, number)) for number in everything])
    return value, np.sqrt((turns - 1) / turns * np.sum((without - without.mean(axis=0))**2, axis=0))


def read_profile(slices: Slices, count: int, length: float = np.inf) -> Profile:
    """Profile, with `count` Gaussians, of the slices before z = length (m). RuntimeError if there is no fit
    (fit_gaussians), also without one of the turns."""
    chosen = slices.read(length)
    z = slices.z[chosen]

    def read(turns: np.ndarray) -> np.ndarray:
        height = slices.profile(turns)[chosen]
        return np.array([np.ptp(height), *known_distances(fit_gaussians(z, height, count), z)])

    turns = len(slices.holdup)
    values, errors = jackknife(read, turns)
    if turns > 1:
        values = np.where(np.isfinite(errors), values, np.nan)
    amplitude, *distances = (Mean(float(value), float(error), turns - 1) for value, error in zip(values, errors))
    height = slices.profile()[chosen]
    humps = fit_gaussians(z, height, count)
    error = float(np.sqrt(slices.height[:, chosen].var(axis=0, ddof=1).mean() / turns)) if turns > 1 else np.nan
    return Profile(z, height, error, humps, distances, amplitude)


def pressure_drop(slices: Slices, name: str, length: float) -> Mean:
    """Fall (Pa) of one of PRESSURES from the feed to the discharge end of a mill of `length` (m): of the straight line
    through the slices of its profile, over that length; NaN where fewer than three slices have it. The profile leaves
    out where slurry enters, and slices that are partly behind the grates: their pressures are hundreds of Pa apart."""
    chosen = slices.read(length)
    z, drops = slices.z[chosen], []
    for line in slices.pressures[name][:, chosen]:
        known = np.isfinite(line)
        drops.append(-length * np.polyfit(z[known], line[known], 1)[0] if known.sum() > 2 else np.nan)
    return block_mean(drops)
