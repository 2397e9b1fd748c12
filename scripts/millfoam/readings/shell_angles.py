# SPDX-License-Identifier: GPL-3.0-or-later
"""Angles along a mill's shell, and both ends of the slurry along a ring.

Angles are counted from straight down, in degrees, positive on the side where the shell rises: the shoulder's is
positive, the toe's usually negative."""
import numpy as np

BIN = 3.0  # of the ring along the lifters' tips, degrees
LEVEL = 0.5  # slurry's share of the fluid at its surface


def shell_angle(x: np.ndarray, y: np.ndarray, omega: float) -> np.ndarray:
    """Angle from straight down, degrees in [-180, 180), positive on the rising side of a mill of speed omega
    (rad/s)."""
    return (np.degrees(np.arctan2(np.sign(omega) * x, -y)) + 180) % 360 - 180


def bin_centres() -> np.ndarray:
    """Centres of the ring's bins, degrees."""
    return np.arange(-180 + BIN / 2, 180, BIN)


def crossing(angles: np.ndarray, share: np.ndarray, inside: int, outside: int) -> float:
    """Angle at which the share, interpolated linearly between the two bins, is LEVEL."""
    part = (share[inside] - LEVEL) / (share[inside] - share[outside])
    way = (angles[outside] - angles[inside] + 180) % 360 - 180
    return (angles[inside] + part * way + 180) % 360 - 180


def toe_and_shoulder(share: np.ndarray) -> tuple[float, float]:
    """Both ends of the slurry along the lifters' tips (degrees), from its share of the fluid in the ring's bins [bins].

    Arcs have a share of at least LEVEL; the one with most slurry counts. NaN if there is no end, because no bin or
    every bin has such a share."""
    angles, wet = bin_centres(), share >= LEVEL
    starts = np.flatnonzero(wet & ~np.roll(wet, 1))
    if len(starts) == 0:
        return np.nan, np.nan
    bins = len(share)
    arcs = [np.arange(start, start + np.argmin(np.roll(wet, -start))) % bins for start in starts]
    arc = max(arcs, key=lambda bins_of: share[bins_of].sum())
    return (crossing(angles, share, arc[0], arc[0] - 1),
            crossing(angles, share, arc[-1], (arc[-1] + 1) % bins))
