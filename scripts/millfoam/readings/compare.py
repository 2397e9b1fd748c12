# SPDX-License-Identifier: GPL-3.0-or-later
"""Differences of two maps of a charge: of two runs, or of a run and a measurement."""
from dataclasses import dataclass

import numpy as np

from ..files.solids_file import SolidsMap
from .free_surface import FreeSurface, free_surface

CLOSEST = 0.634  # solidity that differences are normed by: random close packing
BIN = 0.01  # of the histogram of solidity differences


@dataclass
class Difference:
    """Difference of two maps on the same voxels: mean |solidity A - B| / 0.634 over the mill's inside; means of |vx A -
    B| and |vy A - B| weighted by both solidities' mean, over the mean of the two largest speeds, NaN if no voxel has
    both velocities. `missing` voxels within the mill, without a solidity in one of the maps, are left out."""
    solidity: float
    velocity_x: float
    velocity_y: float
    missing: int = 0


@dataclass
class DifferenceMaps:
    """A - B, voxel by voxel: x, y: voxel edges (m); solidity [ny, nx]; velocity_x, velocity_y [ny, nx] (m/s), NaN where
    one of the maps has no balls; all are NaN outside the mill and where a map lacks a voxel.

    shares [bins]: share of the mill's known inside whose solidity difference is between edges [bins + 1]."""
    x: np.ndarray
    y: np.ndarray
    solidity: np.ndarray
    velocity_x: np.ndarray
    velocity_y: np.ndarray
    shares: np.ndarray
    edges: np.ndarray


@dataclass
class SurfaceDifference:
    """Difference y_A - y_B of the heights of two free surfaces, evenly over the x (m) from `begin` to `end` where both
    are known: mean and standard deviation (m)."""
    mean: float
    deviation: float
    begin: float
    end: float


@dataclass
class Comparison:
    """All differences of two maps."""
    difference: Difference
    surface: SurfaceDifference
    maps: DifferenceMaps


def _known(a: SolidsMap, b: SolidsMap) -> tuple[np.ndarray, int]:
    """Space within the mill that both SolidsMap know [ny, nx], and the number of voxels within it that one of them
    lacks."""
    if a.solidity.shape != b.solidity.shape or not (np.allclose(a.x, b.x) and np.allclose(a.y, b.y)):
        raise ValueError(f"maps of {a.solidity.shape} and {b.solidity.shape} voxels; expected the same voxels")
    inside = (a.inside + b.inside) / 2
    both = np.isfinite(a.solidity) & np.isfinite(b.solidity)
    return np.where(both, inside, 0.0), int(np.sum(~both & (np.maximum(a.inside, b.inside) > 0)))


def difference(a: SolidsMap, b: SolidsMap) -> Difference:
    """Difference of two SolidsMap on the same voxels; ValueError if the voxels differ."""
    inside, missing = _known(a, b)
    solidity = np.sum(inside * np.abs(np.nan_to_num(a.solidity - b.solidity))) / np.sum(inside) / CLOSEST
    both = np.isfinite(a.velocity[..., 0]) & np.isfinite(b.velocity[..., 0])
    weight = np.where(both, inside * np.nan_to_num(a.solidity + b.solidity) / 2, 0.0)
    if not np.sum(weight) > 0:
        return Difference(float(solidity), np.nan, np.nan, missing)
    norm = sum(np.nanmax(np.linalg.norm(one.velocity[..., :2], axis=-1)) for one in (a, b)) / 2
    apart = np.abs(np.nan_to_num(a.velocity) - np.nan_to_num(b.velocity))
    mean = [np.sum(weight * apart[..., axis]) / np.sum(weight) / norm for axis in (0, 1)]
    return Difference(float(solidity), float(mean[0]), float(mean[1]), missing)


def difference_maps(a: SolidsMap, b: SolidsMap, bin_width: float = BIN) -> DifferenceMaps:
    """DifferenceMaps of two SolidsMap on the same voxels; ValueError if the voxels differ. bin_width: of the histogram,
    in solidity."""
    inside, _ = _known(a, b)
    solidity, velocity_x, velocity_y = (np.where(inside > 0, values, np.nan) for values in (
        a.solidity - b.solidity, *np.moveaxis((a.velocity - b.velocity)[..., :2], -1, 0)))
    # The middle bin is about zero
    count = round(1 / bin_width)
    edges = bin_width * (np.arange(-count, count + 2) - 0.5)
    shares, _ = np.histogram(solidity[inside > 0], edges, weights=inside[inside > 0])
    return DifferenceMaps(a.x, a.y, solidity, velocity_x, velocity_y, shares / inside.sum(), edges)


def surface_difference(a: FreeSurface, b: FreeSurface, points: int = 200) -> SurfaceDifference:
    """SurfaceDifference of two FreeSurface; RuntimeError if they have no common range of x."""
    begin, end = max(np.nanmin(one.points[:, 0]) for one in (a, b)), min(np.nanmax(one.points[:, 0]) for one in (a, b))
    if begin >= end:
        raise RuntimeError(f"the free surfaces have no common range of x: one begins at x = {1e3 * begin:.1f} mm, the "
                           f"other ends at {1e3 * end:.1f} mm")
    x = np.linspace(begin, end, points + 2)[1:-1]
    apart = a.height(x) - b.height(x)
    apart = apart[np.isfinite(apart)]
    if len(apart) == 0:
        raise RuntimeError("free surface not known: no point is known on both maps")
    return SurfaceDifference(float(apart.mean()), float(apart.std()), float(begin), float(end))


def compare(a: SolidsMap, b: SolidsMap, radius: float, bin_width: float = BIN) -> Comparison:
    """Comparison of two SolidsMap on the same voxels of a mill of `radius` (m): ValueError if the voxels differ,
    RuntimeError if one of them has no free surface."""
    surface = surface_difference(free_surface(a, radius), free_surface(b, radius))
    return Comparison(difference(a, b), surface, difference_maps(a, b, bin_width))
