# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes solids.h5 as averaging's README describes it, independently of averaging's own writer."""
import h5py
import numpy as np

DIAMETER = 0.005


def write(path, lower, upper, solidity, *, periodic=(0, 0, 0), **options):
    """Solids on a box.

    solidity: [window][z][y][x]; options: see `_write`."""
    solidity = np.asarray(solidity, dtype=float)
    shape = np.array(solidity.shape[:0:-1], dtype=np.int32)
    voxel = np.prod((np.array(upper) - lower) / shape)
    grid = {"kind": "box", "lower": np.array(lower, dtype=float), "upper": np.array(upper, dtype=float),
            "shape": shape, "periodic": np.array(periodic, dtype=np.int32)}
    _write(path, grid, solidity, voxel, **options)


def write_cylinder(path, radii, ends, solidity, **options):
    """Solids on a cylinder about z; solidity: [window][z][theta][r]."""
    solidity = np.asarray(solidity, dtype=float)
    shape = np.array(solidity.shape[:0:-1], dtype=np.int32)
    edges = np.linspace(*radii, shape[0] + 1)
    voxel = np.diff(edges**2) * np.pi / shape[1] * (ends[1] - ends[0]) / shape[2]
    grid = {"kind": "cylinder", "radii": np.array(radii, dtype=float), "ends": np.array(ends, dtype=float),
            "shape": shape, "periodic": np.int32(0)}
    _write(path, grid, solidity, voxel, **options)


def write_cells(path, volumes, solidity, *, mesh_time=0.0, motion="rotation speed -20", **options):
    """Solids on the cells of a mesh; volumes: [cell], m^3, solidity: [window][cell]."""
    solidity, volumes = np.asarray(solidity, dtype=float), np.asarray(volumes, dtype=float)
    grid = {"kind": "cells", "cells": np.int32(len(volumes)), "mesh": "mesh.h5", "motion": motion,
            "mesh_time": mesh_time}
    _write(path, grid, solidity, volumes, **options)
    with h5py.File(path, "r+") as file:
        _data(file, "grid/volume", volumes, "m3")


def _write(path, grid, solidity, volumes, *, velocity=(0, 0, 0), diameter=DIAMETER, time0=0.0, window=0.01,
           timestep=1e-5, whole_run=False, deposited=None, **attributes):
    """One window of `window` seconds after another from `time0` on, without gaps.

    velocity and diameter are the same everywhere, or full arrays like solidity; deposited: what the ledger says, m^3
    per window, unless it is the solids' volume; attributes: of the root, such as angular_velocity (rad/s),
    mill_averages."""
    windows = len(solidity)
    with h5py.File(path, "w") as file:
        file.attrs.update(format="millfoam-solids", version=np.int32(2), complete=np.int32(1), time0=time0,
                          timestep=timestep, whole_run=np.int32(whole_run), method="written by a test", smoothing=0.0,
                          **attributes)
        file.create_group("grid").attrs.update(grid)
        begin = time0 + window * np.arange(windows)
        none = np.zeros(windows, dtype=np.int64)
        for name, values, units in (
                ("begin", begin, "s"), ("end", begin + window, "s"), ("records", none + 5, "1"),
                ("starts_late", none, "1"), ("ends_short", none, "1"), ("balls_per_cell", 0.0 * none, "1")):
            _data(file, f"window/{name}", values, units)
        scalar, vector = np.ones_like(solidity), np.ones((*solidity.shape, 3))
        for name, values, units in (
                ("solidity", solidity, "1"), ("velocity", vector * velocity, "m/s"),
                ("diameter", scalar * diameter, "m"), ("diameter43", scalar * diameter, "m"),
                ("number", 0 * scalar, "1"), ("solidity_deviation", 0 * scalar, "1"),
                ("velocity_deviation", 0 * vector, "m/s"), ("granular_temperature", 0 * scalar, "m2/s2")):
            _data(file, name, values, units)
        volume = (solidity * volumes).reshape(windows, -1).sum(axis=1) if deposited is None else deposited
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
