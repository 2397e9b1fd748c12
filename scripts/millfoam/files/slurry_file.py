# SPDX-License-Identifier: GPL-3.0-or-later
"""Slurry averaged over axis and time on the pixels of a map, and the reader of slurry.h5, a flow's slurry on voxels
(layout: FORMATS.md)."""
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from .solids_file import CLOCKWISE, open_hdf5


@dataclass
class SlurryMap:
    """Slurry averaged over axis and time on the pixels of a box about the mill.

    x, y: edges of the pixels [nx + 1], [ny + 1] (m), equally spaced; share [ny, nx] of slurry in the fluid (the space
    without balls), NaN outside the mill; velocity [ny, nx, 3] (m/s), NaN where there is no slurry; source: what was
    averaged over time, in words; sense: the mill's."""
    x: np.ndarray
    y: np.ndarray
    share: np.ndarray
    velocity: np.ndarray
    source: str = field(kw_only=True)
    sense: float = field(default=CLOCKWISE, kw_only=True)

    def centres(self) -> tuple[np.ndarray, np.ndarray]:
        """Centres of the pixels: x [nx], y [ny] (m)."""
        return (self.x[1:] + self.x[:-1]) / 2, (self.y[1:] + self.y[:-1]) / 2

    def pixel(self) -> float:
        """A pixel's area, m2."""
        return float((self.x[1] - self.x[0]) * (self.y[1] - self.y[0]))


@dataclass
class VoxelMap(SlurryMap):
    """SlurryMap on the box's x-y voxels.

    inside [ny, nx], the share of the column within the mill; holdup [ny, nx], the share of slurry in the mill's space;
    pressure [ny, nx] (Pa) of the slurry, NaN where there is none; begin, end: DEM time (s)."""
    inside: np.ndarray
    holdup: np.ndarray
    pressure: np.ndarray
    begin: float
    end: float

    def centroid(self) -> tuple[float, float]:
        """Centre (x, y) of the slurry's volume, m."""
        x, y = self.centres()
        volume = self.holdup * self.inside
        along, up = ((volume.sum(axis=axis) * at).sum() / volume.sum() for axis, at in ((0, x), (1, y)))
        return float(along), float(up)


def read_slurry_map(path: Path | str, begin: float | None = None, end: float | None = None, length: float = np.inf,
                    sense: float = CLOCKWISE) -> VoxelMap:
    """VoxelMap of a slurry.h5: mean over the axis (the layers of voxels with their middle before z = length, m), and
    over the windows in [begin, end) of DEM time. Without times, it is the file's own mean over the run. sense: the
    mill's. RuntimeError if the file is not complete or has no window in these times."""
    with open_hdf5(path) as file:
        if file.attrs.get("complete", 0) != 1:
            raise RuntimeError(f"{path}: not complete; let the flow run to its end")
        grid = file["grid"]
        lower, upper, shape = (np.asarray(grid.attrs[name]) for name in ("lower", "upper", "shape"))
        if begin is None and end is None:
            if "mean" not in file:
                raise RuntimeError(f"{path}: no mean over the run: the flow ended before its averages' start")
            means: list[tuple[Any, Any]] = [(file["mean"], ())]
            inside_of: Iterable[np.ndarray] = [file["mean/insideFraction"][()]]
            lengths = np.ones(1)
            span = float(file["mean"].attrs["begin"]), float(file["mean"].attrs["end"])
        else:
            begins, ends = file["window/begin"][:], file["window/end"][:]
            slack, last = 1e-6 * file.attrs["window"], np.inf if end is None else end
            chosen = np.flatnonzero((begins >= (begin or -np.inf) - slack) & (ends <= last + slack))
            if len(chosen) == 0:
                raise RuntimeError(f"{path}: no window between {begin} and {end} s; the file has {begins[0]} to "
                                   f"{ends[-1]} s")
            means = [(file, window) for window in chosen]
            inside_of = (grid["insideFraction"][window] for window in chosen)
            lengths = (ends - begins)[chosen]
            span = float(begins[chosen[0]]), float(ends[chosen[-1]])
        z = lower[2] + (np.arange(shape[2]) + 0.5) * (upper[2] - lower[2]) / shape[2]
        edges = [np.linspace(lower[k], upper[k], int(shape[k]) + 1) for k in (0, 1)]
        return _over_axis(means, inside_of, lengths, z < length, edges, span, sense)


def _over_axis(means: Iterable[tuple[Any, Any]], inside_of: Iterable[np.ndarray], lengths: np.ndarray,
               layers: np.ndarray, edges: Sequence[np.ndarray], span: tuple[float, float], sense: float) -> VoxelMap:
    """The VoxelMap of sums over the chosen layers of (group, row) pairs of an open file, weighted by their lengths
    (s)."""
    room = slurry = fluid = flux = head = np.zeros(())
    for (group, row), inside, seconds in zip(means, inside_of, lengths):
        part = seconds * inside[layers]
        held = part * group["slurry"][row][layers]
        room = room + part.sum(axis=0)
        slurry = slurry + held.sum(axis=0)
        fluid = fluid + (part * group["voidage"][row][layers]).sum(axis=0)
        flux = flux + (held[..., None] * group["velocity"][row][layers]).sum(axis=0)
        head = head + (held * group["pressure"][row][layers]).sum(axis=0)
    with np.errstate(invalid="ignore", divide="ignore"):
        enough = slurry > 1e-6 * room.max()
        return VoxelMap(edges[0], edges[1], np.where(room > 0.01 * room.max(), slurry / fluid, np.nan),
                        np.where(enough[..., None], flux / slurry[..., None], np.nan),
                        room / (layers.sum() * np.sum(lengths)), np.where(room > 0, slurry / room, 0.0),
                        np.where(enough, head / slurry, np.nan), span[0], span[1],
                        source="the flow's samples on voxels (slurry.h5)", sense=sense)
