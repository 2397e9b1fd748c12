# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads solids.h5, the averaged charge (layout: averaging/README.md)."""
from dataclasses import dataclass

import h5py
import numpy as np


@dataclass
class SolidsMap:
    """Charge averaged over the axis and over windows, on the box's x-y voxels.

    x, y: voxel edges [nx + 1], [ny + 1] (m); inside [ny, nx], the share of the column within the mill's walls (1 where
    they were not told); solidity [ny, nx], of that share; velocity [ny, nx, 3] (m/s), NaN where there are no balls;
    begin, end: DEM time covered (s)."""
    x: np.ndarray
    y: np.ndarray
    inside: np.ndarray
    solidity: np.ndarray
    velocity: np.ndarray
    begin: float
    end: float

    def centroid(self):
        """Centre (x, y) of the balls' volume, m."""
        x, y = (self.x[1:] + self.x[:-1]) / 2, (self.y[1:] + self.y[:-1]) / 2
        balls = self.solidity * self.inside
        return float((balls.sum(axis=0) * x).sum() / balls.sum()), float((balls.sum(axis=1) * y).sum() / balls.sum())


def read_map(path, begin=-np.inf, end=np.inf):
    """Mean over axis and time of the windows that touch [begin, end) of DEM time; velocity is weighted by solidity."""
    with h5py.File(path, "r") as file:
        if file.attrs.get("complete", 0) != 1:
            raise RuntimeError(f"{path}: not complete; average the dumps again")
        lower, upper, shape = (np.asarray(file["grid"].attrs[name]) for name in ("lower", "upper", "shape"))
        begins, ends = file["window/begin"][:], file["window/end"][:]
        # Times that should agree may differ by rounding
        tolerance = file.attrs["timestep"] / 2
        chosen = np.flatnonzero((ends > begin + tolerance) & (begins < end - tolerance))
        if len(chosen) == 0:
            raise RuntimeError(f"{path}: no window between {begin} and {end} s; there are {begins[0]} to {ends[-1]} s")
        inside, balls, flux = 0.0, 0.0, 0.0
        for window in chosen:
            phi = file["solidity"][window]
            room = file["grid/insideFraction"][window] if "insideFraction" in file["grid"] else np.ones_like(phi)
            inside = inside + room.mean(axis=0) / len(chosen)
            balls = balls + (room * phi).mean(axis=0) / len(chosen)
            flux = flux + ((room * phi)[..., None] * file["velocity"][window]).mean(axis=0) / len(chosen)
    with np.errstate(invalid="ignore", divide="ignore"):
        velocity = np.where(balls[..., None] > 1e-6, flux / balls[..., None], np.nan)
        solidity = np.where(inside > 0, balls / inside, 0.0)
    edges = [np.linspace(lower[axis], upper[axis], int(shape[axis]) + 1) for axis in (0, 1)]
    return SolidsMap(*edges, inside, solidity, velocity, float(begins[chosen[0]]), float(ends[chosen[-1]]))
