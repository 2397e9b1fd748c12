# SPDX-License-Identifier: GPL-3.0-or-later
"""How far two maps of a charge are apart."""
from dataclasses import dataclass

import numpy as np

CLOSEST = 0.634  # solidity that differences are normed by: random close packing


@dataclass
class Difference:
    """Of two maps on the same voxels: mean |solidity A - B| / 0.634 over the mill's inside; means of |vx A - B| and |vy A - B|
    weighted by both solidities' mean, over the mean of the two largest speeds."""
    solidity: float
    velocity_x: float
    velocity_y: float


def difference(a, b):
    """Difference of two SolidsMap on the same voxels; ValueError where these differ."""
    if a.solidity.shape != b.solidity.shape or not (np.allclose(a.x, b.x) and np.allclose(a.y, b.y)):
        raise ValueError(f"maps of {a.solidity.shape} and {b.solidity.shape} voxels; expected the same voxels")
    inside = (a.inside + b.inside) / 2
    solidity = np.sum(inside * np.abs(a.solidity - b.solidity)) / np.sum(inside) / CLOSEST
    weight = inside * (a.solidity + b.solidity) / 2
    norm = (np.nanmax(np.linalg.norm(a.velocity[..., :2], axis=-1)) + np.nanmax(np.linalg.norm(b.velocity[..., :2], axis=-1))) / 2
    apart = np.abs(np.nan_to_num(a.velocity) - np.nan_to_num(b.velocity))
    both = np.isfinite(a.velocity[..., 0]) & np.isfinite(b.velocity[..., 0])
    weight = np.where(both, weight, 0.0)
    mean = [np.sum(weight * apart[..., axis]) / np.sum(weight) / norm for axis in (0, 1)]
    return Difference(float(solidity), float(mean[0]), float(mean[1]))
