# SPDX-License-Identifier: GPL-3.0-or-later
"""A plane's section through balls of a dump, spheres or superquadrics, as a picture of points."""
from pathlib import Path

import numpy as np

from ..files.dumps import columns_of, read_columns

SIZES = ("shapex", "shapey", "shapez", "blockiness1", "blockiness2")
PLACES = ("x", "y", "z", "vx", "vy", "vz", "radius")


def rotations(quaternions: np.ndarray) -> np.ndarray:
    """Matrices [n, 3, 3] that turn from a body's axes to those of space, of unit quaternions [n, 4] with the real part
    first (H. Goldstein, Classical Mechanics, section 4.5)."""
    w, x, y, z = quaternions.T
    return np.stack([np.stack([1 - 2 * (y**2 + z**2), 2 * (x * y - w * z), 2 * (x * z + w * y)], -1),
                     np.stack([2 * (x * y + w * z), 1 - 2 * (x**2 + z**2), 2 * (y * z - w * x)], -1),
                     np.stack([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x**2 + y**2)], -1)], axis=1)


def inside(points: np.ndarray, half_axes: np.ndarray, blockiness: tuple[float, float]) -> np.ndarray:
    """Whether points [.., 3] (m, in the body's axes) are in the superquadric (|x/a|^n2 + |y/b|^n2)^(n1/n2) + |z/c|^n1 =
    1 of half axes a, b, c (m) and blockiness n1, n2 (A. H. Barr, IEEE Computer Graphics and Applications 1981)."""
    one, two = blockiness
    x, y, z = np.moveaxis(np.abs(points / half_axes), -1, 0)
    return (x**two + y**two)**(one / two) + z**one <= 1


def section(dump: Path, along: np.ndarray, across: np.ndarray, up: np.ndarray) -> np.ndarray:
    """Speed of the ball at each point of a vertical plane through the z axis, m/s, NaN between the balls: [up, across].

    dump: of LIGGGHTS, with `radius`, and for superquadrics with their half axes, blockiness and quaternions; a dump
    without blockiness has ellipsoids. along: unit vector [3] of the plane's horizontal direction; across, up: equally
    spaced places along it and along z, m. RuntimeError if the dump cannot be read."""
    read = read_columns(dump)
    balls = columns_of(read, dump, *PLACES)
    shapes = _shapes(read, dump)
    normal = np.array([-along[1], along[0], 0.0])
    speeds = np.linalg.norm(balls[:, 3:6], axis=1)
    found = np.full((len(up), len(across)), np.nan)
    for k in np.flatnonzero(np.abs(balls[:, :3] @ normal) < balls[:, 6]):
        centre, radius = balls[k, :3], balls[k, 6]
        columns = slice(*np.searchsorted(across, centre @ along + np.array([-radius, radius])))
        rows = slice(*np.searchsorted(up, centre[2] + np.array([-radius, radius])))
        offset = (across[columns][None, :, None] * along + up[rows][:, None, None] * np.array([0.0, 0.0, 1.0])) - centre
        if shapes is None:
            hit = np.linalg.norm(offset, axis=-1) <= radius
        else:
            sizes, turned = shapes
            hit = inside(offset @ turned[k], sizes[k, :3], (sizes[k, 3], sizes[k, 4]))
        found[rows, columns][hit] = speeds[k]
    return found


def _shapes(read: dict[str, np.ndarray], dump: Path) -> tuple[np.ndarray, np.ndarray] | None:
    """SIZES [n, 5] and rotations [n, 3, 3] of superquadrics; of spheres None."""
    if "shapex" not in read:
        return None
    sizes = columns_of({"blockiness1": np.full(len(read["shapex"]), 2.0),
                        "blockiness2": np.full(len(read["shapex"]), 2.0), **read}, dump, *SIZES)
    return sizes, rotations(columns_of(read, dump, "quat1", "quat2", "quat3", "quat4"))
