# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes solids.h5 as averaging's README describes it, independently of averaging's own writer."""
import h5py
import numpy as np

DIAMETER = 0.005


def write(path, lower, upper, solidity, *, velocity=(0, 0, 0), diameter=DIAMETER, time0=0.0, window=0.01, timestep=1e-5,
          whole_run=False, periodic=(0, 0, 0)):
    """One window of `window` seconds after another from `time0` on, without gaps.

    solidity: [window][z][y][x]; velocity and diameter are the same everywhere, or full arrays."""
    solidity = np.asarray(solidity, dtype=float)
    windows = len(solidity)
    with h5py.File(path, "w") as file:
        file.attrs.update(format="millfoam-solids", version=np.int32(1), complete=np.int32(1), time0=time0,
                          timestep=timestep, whole_run=np.int32(whole_run))
        grid = file.create_group("grid")
        grid.attrs.update(kind="box", lower=np.array(lower, dtype=float), upper=np.array(upper, dtype=float),
                          shape=np.array(solidity.shape[:0:-1], dtype=np.int32),
                          periodic=np.array(periodic, dtype=np.int32))
        begin = time0 + window * np.arange(windows)
        times = {"begin": (begin, "s"), "end": (begin + window, "s"), "records": (np.full(windows, 5), "1")}
        for name, (values, units) in times.items():
            _data(file, f"window/{name}", values, units)
        scalar, vector = np.ones_like(solidity), np.ones((*solidity.shape, 3))
        for name, values, units in (
                ("solidity", solidity, "1"), ("velocity", vector * velocity, "m/s"),
                ("diameter", scalar * diameter, "m"), ("diameter43", scalar * diameter, "m"),
                ("solidity_deviation", 0 * scalar, "1"), ("velocity_deviation", 0 * vector, "m/s"),
                ("granular_temperature", 0 * scalar, "m2/s2")):
            _data(file, name, values, units)
        voxel = np.prod((np.array(upper) - lower) / solidity.shape[:0:-1])
        volume = solidity.sum(axis=(1, 2, 3)) * voxel
        for name, values in (("volume_in", volume), ("deposited", volume), ("outside", 0 * volume),
                             ("clipped", 0 * volume)):
            _data(file, f"ledger/{name}", values, "m3")


def _data(file, name, values, units):
    file.create_dataset(name, data=values).attrs["units"] = units


def uniform(*solidities, shape=(1, 1, 1)):
    """Solidity [window][z][y][x], uniform in each window."""
    return np.array([np.full(shape, value) for value in solidities])


def centres(lower, upper, shape):
    """Coordinates x, y, z of the voxels' centres, each [z][y][x]; shape as nx, ny, nz."""
    axes = [low + (high - low) * (np.arange(n) + 0.5) / n for low, high, n in zip(lower, upper, shape)]
    z, y, x = np.meshgrid(*axes[::-1], indexing="ij")
    return x, y, z
