# SPDX-License-Identifier: GPL-3.0-or-later
"""Readings of the charge of a stirred mill: maps in the r-z plane and around the axis, radial profiles in bands of
height, and numbers of box plots. Velocities are along r, theta and z."""
from dataclasses import dataclass

import numpy as np

from ..files.mill import Mill
from ..files.rings_file import Rings

FAINT = 1e-3  # solidity below which a mean has no velocity: only an edge of a few balls was there
WHISKER = 1.5  # of the distance between the quartiles (J. W. Tukey, Exploratory Data Analysis, 1977)


@dataclass(frozen=True)
class Means:
    """Means of the charge over one or two directions of its voxels: room and balls [..], volumes within the walls and
    of the balls, m3; solidity [..]; velocity [.., 3] and speed [..] (root mean square of the balls' velocities), m/s,
    NaN where the solidity is below FAINT."""
    room: np.ndarray
    balls: np.ndarray
    solidity: np.ndarray
    velocity: np.ndarray
    speed: np.ndarray


def _means(rings: Rings, weights: np.ndarray, axis: int | tuple[int, ...]) -> Means:
    """Means over axes of [nz, ntheta, nr], of voxels with weights of that shape or one that broadcasts to it."""
    room, balls = (weights * rings.room).sum(axis=axis), (weights * rings.balls).sum(axis=axis)
    known = weights * rings.balls
    flux = (known[..., None] * np.nan_to_num(rings.velocity)).sum(axis=axis)
    square = (known * np.nan_to_num(rings.speed)**2).sum(axis=axis)
    with np.errstate(invalid="ignore", divide="ignore"):
        solidity = np.where(room > 0, balls / room, 0)
        clear = (solidity > FAINT) & (balls > 0)
        return Means(room, balls, solidity, np.where(clear[..., None], flux / balls[..., None], np.nan),
                     np.where(clear, np.sqrt(square / balls), np.nan))


def near_arms(theta: np.ndarray, angle: float, arms: int) -> np.ndarray:
    """Whether azimuths (rad) are in the half of the azimuth that is nearest to equally spaced arms, the first at
    `angle` (rad)."""
    return np.cos(arms * (theta - angle)) > 0


def meridian(rings: Rings, sectors: np.ndarray | None = None) -> Means:
    """Means over the azimuth, [nz, nr]; sectors: bool [ntheta], those that are averaged, or all."""
    count = len(rings.theta) - 1
    weights = np.ones(count) if sectors is None else np.asarray(sectors, float)
    return _means(rings, weights[:, None], 1)


def _within(edges: np.ndarray, low: float, high: float) -> np.ndarray:
    """Shares of steps that lie between two places."""
    return np.clip(np.minimum(edges[1:], high) - np.maximum(edges[:-1], low), 0, None) / np.diff(edges)


def slice_around(rings: Rings, low: float, high: float) -> Means:
    """Means over the height between `low` and `high` (m), [ntheta, nr]; layers that are cut count by their share."""
    return _means(rings, _within(rings.z, low, high)[:, None, None], 0)


def radial_profile(rings: Rings, low: float, high: float) -> Means:
    """Means over the azimuth and over the height between `low` and `high` (m), [nr]."""
    return _means(rings, _within(rings.z, low, high)[:, None, None], (0, 1))


def bands(mill: Mill, rings: Rings) -> dict[str, Means]:
    """Radial profiles below the lowest edge of the pins and discs (of the shaft, without these), from there to the
    highest one, and above: `below`, `impeller`, `above`."""
    low = min((one["height_m"] - one["thickness_m"] / 2 for one in mill.impeller["pins"] + mill.impeller["discs"]),
              default=mill.impeller["shaft_end_m"])
    high = mill.impeller["top_m"]
    return {name: radial_profile(rings, *span) for name, span in (
        ("below", (rings.z[0], low)), ("impeller", (low, high)), ("above", (high, rings.z[-1])))}


@dataclass(frozen=True)
class Box:
    """Numbers of a box plot: quartiles and median; whiskers, the least and the largest value within WHISKER times the
    distance of the quartiles from the box; mean and standard deviation."""
    low: float
    first: float
    median: float
    third: float
    high: float
    mean: float
    deviation: float

    def drawn(self, label: str) -> dict[str, object]:
        """What matplotlib's Axes.bxp draws."""
        return {"label": label, "whislo": self.low, "q1": self.first, "med": self.median, "q3": self.third,
                "whishi": self.high, "mean": self.mean, "fliers": []}


def box_numbers(values: np.ndarray, weights: np.ndarray | None = None) -> Box:
    """Box of values with weights (all the same unless given); values that are NaN or have no weight are left out.
    A quartile is the least value up to which its share of the weights lies. ValueError without values."""
    given = np.ravel(values)
    counts = np.ones(len(given)) if weights is None else np.ravel(weights)
    chosen = np.isfinite(given) & (counts > 0)
    if not chosen.any():
        raise ValueError("no values; expected at least one that has a weight")
    order = np.argsort(given[chosen], kind="stable")
    known, part = given[chosen][order], counts[chosen][order]
    share = np.cumsum(part) / part.sum()
    first, median, third = (float(known[min(int(np.searchsorted(share, up_to - 1e-12)), len(known) - 1)])
                            for up_to in (0.25, 0.5, 0.75))
    reach = WHISKER * (third - first)
    mean = float(np.average(known, weights=part))
    return Box(float(known[known >= first - reach].min()), first, median, third,
               float(known[known <= third + reach].max()), mean,
               float(np.sqrt(np.average((known - mean)**2, weights=part))))


NAMES = ("speed", "radial", "tangential", "axial", "solidity")  # of the boxes of a charge


def charge_boxes(rings: Rings) -> dict[str, Box]:
    """Boxes of the voxels' means: speed, radial, tangential and axial velocity (m/s) by the balls' volume; solidity by
    the volume within the walls, where it is above FAINT. The spread of the balls within a voxel is not in them."""
    clear = rings.solidity > FAINT
    balls, room = np.where(clear, rings.balls, 0), np.where(clear, rings.room, 0)
    values = (rings.speed, *np.moveaxis(rings.velocity, -1, 0))
    return {**{name: box_numbers(value, balls) for name, value in zip(NAMES, values)},
            "solidity": box_numbers(rings.solidity, room)}


def ball_boxes(positions: np.ndarray, velocities: np.ndarray) -> dict[str, Box]:
    """Boxes of single balls, of one or several records together: positions and velocities [n, 3] along x, y and z (m,
    m/s) -> speed, radial, tangential and axial velocity, m/s."""
    away = np.hypot(*positions[:, :2].T)
    x, y = positions[:, :2].T / np.where(away > 0, away, 1)
    values = (np.linalg.norm(velocities, axis=1), velocities[:, 0] * x + velocities[:, 1] * y,
              velocities[:, 1] * x - velocities[:, 0] * y, velocities[:, 2])
    return {name: box_numbers(value) for name, value in zip(NAMES, values)}


def filled_height(mean: Means, z: np.ndarray, share: float = 0.01) -> float:
    """z (m) of the highest layer of a `meridian` in which the solidity is above `share` in some ring; the lowest edge
    of z without any."""
    layers = np.flatnonzero((mean.solidity > share).any(axis=1))
    return float(z[layers[-1] + 1] if len(layers) else z[0])
