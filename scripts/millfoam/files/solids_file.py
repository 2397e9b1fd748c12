# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads solids.h5, the averaged charge (layout: FORMATS.md), whole or window by window."""
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np

# Sense of a mill, seen with x to the right and y up: the sign of its angular speed about z
CLOCKWISE, ANTICLOCKWISE = -1.0, 1.0
FAINT = 1e-6  # solidity up to which a mean over time has no velocity: only an edge of a ball was in the voxel
RARE = 0.02  # solidity, or share of slurry, up to which pictures show no velocity
MISSING = 0.02  # share of the averaged time that a record may miss at its end


def open_hdf5(path: Path | str) -> h5py.File:
    """An HDF5 file to read; RuntimeError names it if it is missing, cut short or not an HDF5 file."""
    try:
        return h5py.File(path, "r")
    except OSError:
        what = "cut short or not an HDF5 file" if Path(path).is_file() else "no such file"
        raise RuntimeError(f"{path}: {what}") from None


def has_voxels(path: Path | str) -> bool:
    """Whether the averages are on a box's voxels, as maps need; else they are on a cylinder or on a mesh's cells."""
    with open_hdf5(path) as file:
        return "lower" in file["grid"].attrs


@dataclass
class SolidsMap:
    """Charge averaged over the axis and over windows, on the box's x-y voxels.

    x, y: voxel edges [nx + 1], [ny + 1] (m); inside [ny, nx], the share of the column within the mill's walls (1 if the
    walls are not known); solidity [ny, nx], of that share, NaN where a measured map has none; velocity [ny, nx, 3]
    (m/s), NaN where there are no balls; begin, end: DEM time covered (s); sense: the mill's."""
    x: np.ndarray
    y: np.ndarray
    inside: np.ndarray
    solidity: np.ndarray
    velocity: np.ndarray
    begin: float
    end: float
    sense: float = field(default=CLOCKWISE, kw_only=True)

    def centres(self) -> tuple[np.ndarray, np.ndarray]:
        """Centres of the voxels: x [nx], y [ny] (m)."""
        return (self.x[1:] + self.x[:-1]) / 2, (self.y[1:] + self.y[:-1]) / 2

    def shown(self) -> np.ndarray:
        """Where balls are not so rare that pictures leave out their velocity [ny, nx]."""
        return self.solidity > RARE

    def balls(self) -> np.ndarray:
        """Share of each column's whole volume that balls fill [ny, nx]; 0 where it is not known."""
        return np.nan_to_num(self.solidity) * self.inside

    def flux(self) -> np.ndarray:
        """Balls' volume flux over the voxels' area [ny, nx, 3] (m/s); 0 where there are no balls."""
        return self.balls()[..., None] * np.nan_to_num(self.velocity)

    def centroid(self) -> tuple[float, float]:
        """Centre (x, y) of the balls' volume, m."""
        (x, y), balls = self.centres(), self.balls()
        return float((balls.sum(axis=0) * x).sum() / balls.sum()), float((balls.sum(axis=1) * y).sum() / balls.sum())


def _map(edges: Sequence[np.ndarray], inside: np.ndarray, balls: np.ndarray, flux: np.ndarray, begin: float, end: float,
         faint: float, sense: float) -> SolidsMap:
    """SolidsMap from means of the space within the walls, of the balls' volume in it [ny, nx], and of their flux [ny,
    nx, 3]; no velocity up to a solidity of `faint`."""
    with np.errstate(invalid="ignore", divide="ignore"):
        velocity = np.where(balls[..., None] > faint, flux / balls[..., None], np.nan)
        solidity = np.where(inside > 0, balls / inside, 0.0)
    return SolidsMap(edges[0], edges[1], inside, solidity, velocity, float(begin), float(end), sense=sense)


def read_windows(path: Path | str, begin: float = -np.inf, end: float = np.inf) -> list[SolidsMap]:
    """Mean over the axis of each window that overlaps [begin, end) of DEM time (s): a list of SolidsMap in order of
    time. Velocity is weighted by solidity. The sense is clockwise unless the file has another angular velocity.
    RuntimeError if the file is not complete or has no such window."""
    with open_hdf5(path) as file:
        if file.attrs.get("complete", 0) != 1:
            raise RuntimeError(f"{path}: not complete; average the dumps again")
        lower, upper, shape = (np.asarray(file["grid"].attrs[name]) for name in ("lower", "upper", "shape"))
        begins, ends = file["window/begin"][:], file["window/end"][:]
        # Times that should agree may differ by rounding
        tolerance = file.attrs["timestep"] / 2
        chosen = np.flatnonzero((ends > begin + tolerance) & (begins < end - tolerance))
        if len(chosen) == 0:
            raise RuntimeError(f"{path}: no window between {begin} and {end} s; the file has {begins[0]} to "
                               f"{ends[-1]} s")
        edges = [np.linspace(lower[axis], upper[axis], int(shape[axis]) + 1) for axis in (0, 1)]
        maps = []
        for window in chosen:
            phi = file["solidity"][window]
            room = file["grid/insideFraction"][window] if "insideFraction" in file["grid"] else np.ones_like(phi)
            flux = ((room * phi)[..., None] * file["velocity"][window]).mean(axis=0)
            maps.append(_map(edges, room.mean(axis=0), (room * phi).mean(axis=0), flux, begins[window], ends[window], 0,
                             ANTICLOCKWISE if file.attrs.get("angular_velocity", 0) > 0 else CLOCKWISE))
    return maps


def mean_map(maps: Sequence[SolidsMap]) -> SolidsMap:
    """Mean of SolidsMap of equally long windows on the same voxels; velocity is weighted by solidity."""
    inside, balls, flux = (np.asarray(sum(parts)) / len(maps) for parts in (
        [one.inside for one in maps], [one.balls() for one in maps], [one.flux() for one in maps]))
    return _map((maps[0].x, maps[0].y), inside, balls, flux, maps[0].begin, maps[-1].end, FAINT, maps[0].sense)


def span_of_flow(first: float, last: float, begin: float, end: float) -> tuple[float, float]:
    """DEM times (s) over which the charge of a flow from `begin` to `end` is averaged, for a record from `first` to
    `last`: the same times, as far as the record goes, which may lack a last window that was not full. If the flow is
    longer by more than MISSING, it holds or repeats the record, and it is averaged over the whole record."""
    within = begin >= first and end <= last + MISSING * (end - begin)
    return (begin, min(end, last)) if within else (first, last)


def recorded_span(path: Path | str) -> tuple[float, float]:
    """DEM times at which the first window of a solids.h5 begins and the last one ends, s."""
    with open_hdf5(path) as file:
        return float(file["window/begin"][0]), float(file["window/end"][-1])


def read_map(path: Path | str, begin: float = -np.inf, end: float = np.inf) -> SolidsMap:
    """Mean over axis and time of the windows that overlap [begin, end) of DEM time (s), see read_windows."""
    return mean_map(read_windows(path, begin, end))
