# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads a solids.h5 on a cylinder about the axis (layout: FORMATS.md), as of a stirred mill: means over time, with
velocities along r, theta and z."""
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from .solids_file import open_hdf5


@dataclass(frozen=True)
class Rings:
    """Charge on the voxels of a cylinder, averaged over windows.

    r [nr + 1], z [nz + 1] (m), theta [ntheta + 1] (rad): edges of the voxels; inside [nz, ntheta, nr], the share of the
    voxel within the mill's walls (1 if the walls are not known); solidity [nz, ntheta, nr], of that share; velocity
    [nz, ntheta, nr, 3] (m/s) along r, theta and z, NaN where there are no balls; speed [nz, ntheta, nr] (m/s), the root
    mean square of the balls' velocities, NaN where there are none; begin, end: DEM time covered (s); angular_velocity:
    of the cylinder, which is in its place at DEM time 0 (rad/s; 0 if it is at rest in the lab)."""
    r: np.ndarray
    theta: np.ndarray
    z: np.ndarray
    inside: np.ndarray
    solidity: np.ndarray
    velocity: np.ndarray
    speed: np.ndarray
    begin: float
    end: float
    angular_velocity: float

    @cached_property
    def room(self) -> np.ndarray:
        """Volume of the voxels within the walls [nz, ntheta, nr], m3."""
        return (self.inside * np.diff(self.r**2) / 2 * np.diff(self.theta)[:, None]
                * np.diff(self.z)[:, None, None])

    @cached_property
    def balls(self) -> np.ndarray:
        """Volume of the balls in the voxels [nz, ntheta, nr], m3."""
        return self.solidity * self.room

    def middles(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Middles of the voxels: r [nr], theta [ntheta], z [nz]."""
        r, theta, z = ((edges[1:] + edges[:-1]) / 2 for edges in (self.r, self.theta, self.z))
        return r, theta, z


def _cylindrical(velocity: np.ndarray, theta: np.ndarray) -> np.ndarray:
    """Velocities [.., ntheta, nr, 3] along x, y, z as those along r, theta, z in the middles of their sectors."""
    cosine, sine = np.cos(theta)[:, None], np.sin(theta)[:, None]
    return np.stack([velocity[..., 0] * cosine + velocity[..., 1] * sine,
                     velocity[..., 1] * cosine - velocity[..., 0] * sine, velocity[..., 2]], axis=-1)


def read_rings(path: Path | str, begin: float = -np.inf, end: float = np.inf) -> Rings:
    """Mean of the windows that overlap [begin, end) of DEM time (s), each with the weight of its length; velocities are
    weighted with the balls' volume. RuntimeError if the file is not complete or not on a cylinder, or has no such
    window."""
    with open_hdf5(path) as file:
        if file.attrs.get("complete", 0) != 1:
            raise RuntimeError(f"{path}: not complete; average the dumps again")
        grid = file["grid"]
        if "radii" not in grid.attrs:
            raise RuntimeError(f"{path}: not on a cylinder; expected the averages of a stirred mill, or of millAverage "
                               "--cylinder")
        radii, ends, shape = (np.asarray(grid.attrs[name]) for name in ("radii", "ends", "shape"))
        begins, last = file["window/begin"][:], file["window/end"][:]
        # Times that should agree may differ by rounding
        tolerance = file.attrs["timestep"] / 2
        chosen = np.flatnonzero((last > begin + tolerance) & (begins < end - tolerance))
        if len(chosen) == 0:
            raise RuntimeError(f"{path}: no window between {begin} and {end} s; the file has {begins[0]} to "
                               f"{last[-1]} s")
        r = np.linspace(radii[0], radii[1], int(shape[0]) + 1)
        theta, z = np.linspace(0, 2 * np.pi, int(shape[1]) + 1), np.linspace(ends[0], ends[1], int(shape[2]) + 1)
        size = tuple(int(count) for count in reversed(shape))
        inside, balls, square, flux = np.zeros(size), np.zeros(size), np.zeros(size), np.zeros((*size, 3))
        lengths = (last - begins)[chosen] / (last - begins)[chosen].sum()
        for window, length in zip(chosen, lengths):
            share = grid["insideFraction"][window] if "insideFraction" in grid else np.ones(size)
            part, velocity = length * share * file["solidity"][window], file["velocity"][window]
            inside += length * share
            balls += part
            flux += part[..., None] * velocity
            square += part * ((velocity**2).sum(axis=-1) + 3 * file["granular_temperature"][window])
        components = np.bytes_(grid.attrs.get("components", "cartesian")).decode()
        angular_velocity = float(grid.attrs.get("angular_velocity", 0))
    with np.errstate(invalid="ignore", divide="ignore"):
        velocity = np.where(balls[..., None] > 0, flux / balls[..., None], np.nan)
        speed = np.where(balls > 0, np.sqrt(square / balls), np.nan)
        solidity = np.where(inside > 0, balls / inside, 0)
    if components != "cylindrical":
        velocity = _cylindrical(velocity, (theta[1:] + theta[:-1]) / 2)
    return Rings(r, theta, z, inside, solidity, velocity, speed, float(begins[chosen[0]]), float(last[chosen[-1]]),
                 angular_velocity)
