# SPDX-License-Identifier: GPL-3.0-or-later
"""Slurry averaged over axis and time on the pixels of a map, and the reader of slurry.h5, a flow's slurry and what its
balls feel on voxels (layout: FORMATS.md)."""
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from .solids_file import CLOCKWISE, open_hdf5

VERSIONS = (1, 2)  # of the layout: the first one has no /balls
FEW_BALLS = 1e-6  # added to the solidity in the weights of what balls feel


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

    def room(self) -> np.ndarray:
        """Share of each pixel [ny, nx] that is within the mill: here 1, or 0 of pixels outside."""
        return np.isfinite(self.share).astype(float)

    def filled(self) -> np.ndarray:
        """Share of each pixel [ny, nx] that slurry fills: here its share of the fluid, as without balls."""
        return np.nan_to_num(self.share) * self.room()


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

    def room(self) -> np.ndarray:
        """As SlurryMap.room; voxels that the shell cuts have a part."""
        return self.inside

    def filled(self) -> np.ndarray:
        """As SlurryMap.filled; where balls are, slurry fills only a part of its pores."""
        return self.holdup * self.inside

    def centroid(self) -> tuple[float, float]:
        """Centre (x, y) of the slurry's volume, m."""
        x, y = self.centres()
        volume = self.filled()
        along, up = ((volume.sum(axis=axis) * at).sum() / volume.sum() for axis, at in ((0, x), (1, y)))
        return float(along), float(up)


@dataclass
class BallForces:
    """What a ball feels on the voxels of a slurry.h5, mean over time: a ball of volume V and velocity v feels
    V (pressure_force + drag_force - exchange v).

    lower, upper [3]: corners of the box (m); inside [nz, ny, nx]: share of the voxel in the mesh; solidity, of that
    share; pressure_force, drag_force [nz, ny, nx, 3] (N/m3); velocity [nz, ny, nx, 3] of the balls that the flow saw
    (m/s); exchange (kg/(m3 s)), without the factor of a mixture of sizes; fluid_density (kg/m3); diameter (m) [nz, ny,
    nx]; begin, end: DEM time (s); law: of the drag; polydispersity: whether the flow's drag had that factor;
    gravity [3] (m/s2)."""
    lower: np.ndarray
    upper: np.ndarray
    inside: np.ndarray
    solidity: np.ndarray
    pressure_force: np.ndarray
    exchange: np.ndarray
    drag_force: np.ndarray
    velocity: np.ndarray
    fluid_density: np.ndarray
    diameter: np.ndarray
    begin: float
    end: float
    law: str
    polydispersity: bool
    gravity: np.ndarray

    def volumes(self) -> np.ndarray:
        """Volume of the balls that the flow saw in each voxel [nz, ny, nx], m3."""
        return np.prod((self.upper - self.lower) / self.inside.shape[::-1]) * self.inside * self.solidity


@contextmanager
def _open_slurry(path: Path | str) -> Iterator[h5py.File]:
    """A complete slurry.h5 of a known version; otherwise RuntimeError."""
    with open_hdf5(path) as file:
        if file.attrs.get("complete", 0) != 1:
            raise RuntimeError(f"{path}: not complete; let the flow run to its end")
        if file.attrs.get("version", 1) not in VERSIONS:
            raise RuntimeError(f"{path}: version {file.attrs['version']}; expected one of {VERSIONS}: it is of a newer "
                               "millFoam")
        yield file


def _means(path: Path | str, file: h5py.File, begin: float | None, end: float | None) -> tuple[
        list[tuple[Any, Any]], Iterable[np.ndarray], np.ndarray, tuple[float, float]]:
    """The means over time to take from an open slurry.h5, of the windows in [begin, end) of DEM time, or without times
    of the whole run: (group, row) pairs, their insideFraction, lengths (s), and the first and last time (s).
    RuntimeError if there are none."""
    if begin is None and end is None:
        if "mean" not in file:
            raise RuntimeError(f"{path}: no mean over the run: the flow ended before its averages' start")
        span = float(file["mean"].attrs["begin"]), float(file["mean"].attrs["end"])
        return [(file["mean"], ())], [file["mean/insideFraction"][()]], np.ones(1), span
    begins, ends = file["window/begin"][:], file["window/end"][:]
    slack, last = 1e-6 * file.attrs["window"], np.inf if end is None else end
    chosen = np.flatnonzero((begins >= (begin or -np.inf) - slack) & (ends <= last + slack))
    if len(chosen) == 0:
        raise RuntimeError(f"{path}: no window between {begin} and {end} s; the file has {begins[0]} to {ends[-1]} s")
    return ([(file, window) for window in chosen], (file["grid/insideFraction"][window] for window in chosen),
            (ends - begins)[chosen], (float(begins[chosen[0]]), float(ends[chosen[-1]])))


def uncovered_share(path: Path | str) -> float | None:
    """Share of the time of a slurry.h5's mean over the run that no sample covers, as segments were lost; None if the
    file has no such mean, or is of a millFoam that did not write this. RuntimeError if it is not complete."""
    with _open_slurry(path) as file:
        about = file["mean"].attrs if "mean" in file else {}
        if "duration" not in about:
            return None
        return max(1 - float(about["duration"] / (about["end"] - about["begin"])), 0.0)


def read_ball_forces(path: Path | str, begin: float | None = None, end: float | None = None) -> BallForces:
    """BallForces of a slurry.h5: mean over the windows in [begin, end) of DEM time (s), or without times the file's own
    mean over the run. RuntimeError if the file is not complete, has no window in these times, or was written by a flow
    without balls or by millFoam before version 2 of the file."""
    with _open_slurry(path) as file:
        if "balls" not in file:
            raise RuntimeError(f"{path}: no group /balls: it is of version {file.attrs.get('version', 1)}, of "
                               f"{'a flow without balls' if file.attrs.get('version', 1) > 1 else 'an older millFoam'};"
                               " run slurryFoam with constant/bedProperties")
        means, inside_of, lengths, span = _means(path, file, begin, end)
        names = ("pressure_force", "exchange", "drag_force", "velocity", "fluid_density", "diameter")
        sums: dict[str, Any] = dict.fromkeys(names, 0.0)
        room = balls = weight = np.zeros(())
        for (group, row), inside, seconds in zip(means, inside_of, lengths):
            part, phi = seconds * inside, group["balls/solidity"][row]
            room, balls, weight = room + part, balls + part * phi, weight + part * (phi + FEW_BALLS)
            for name in names:
                values = group[f"balls/{name}"][row]
                if name == "drag_force":  # on the balls as they moved
                    values = values - group["balls/exchange"][row][..., None] * group["balls/velocity"][row]
                sums[name] = sums[name] + (values.T * (part * (phi + FEW_BALLS)).T).T
        filled = room > 0
        fields = {name: np.divide(total.T, weight.T, where=filled.T, out=np.zeros_like(total.T)).T
                  for name, total in sums.items()}
        fields["drag_force"] += fields["exchange"][..., None] * fields["velocity"]
        facts = file["balls"].attrs
        law = facts["law"]
        _refuse_unknown(path, fields)
        return BallForces(
            np.asarray(file["grid"].attrs["lower"]), np.asarray(file["grid"].attrs["upper"]),
            room / np.sum(lengths), np.divide(balls, room, where=filled, out=np.zeros_like(balls)), **fields,
            begin=span[0], end=span[1], law=law.decode() if isinstance(law, bytes) else str(law),
            polydispersity=bool(facts["polydispersity"]), gravity=np.asarray(facts["gravity"]))


def _refuse_unknown(path: Path | str, fields: dict[str, np.ndarray]) -> None:
    for name, values in fields.items():
        bad = np.argwhere(~np.isfinite(values))
        if len(bad):
            raise RuntimeError(f"{path}: balls/{name} is not finite in the voxel z, y, x = "
                               f"{', '.join(map(str, bad[0][:3]))}; run the flow again")


def read_slurry_map(path: Path | str, begin: float | None = None, end: float | None = None, length: float = np.inf,
                    sense: float = CLOCKWISE) -> VoxelMap:
    """VoxelMap of a slurry.h5: mean over the axis (the layers of voxels with their middle before z = length, m), and
    over the windows in [begin, end) of DEM time. Without times, it is the file's own mean over the run. sense: the
    mill's. RuntimeError if the file is not complete or has no window in these times."""
    with _open_slurry(path) as file:
        lower, upper, shape = (np.asarray(file["grid"].attrs[name]) for name in ("lower", "upper", "shape"))
        means, inside_of, lengths, span = _means(path, file, begin, end)
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
