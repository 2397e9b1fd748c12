# SPDX-License-Identifier: GPL-3.0-or-later
"""Readings of maps of the slurry, averaged over axis and time (SlurryMap): toe and shoulder, the pool in front of the
charge, the motion along the axis.

x to the right, y up, the mill's axis at x = y = 0; the mill turns by the map's sense. z runs from the feed end to the
discharge end. Angles are counted from straight down, in degrees, positive on the rising side."""
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import label, map_coordinates

from ..files.slurry_file import SlurryMap
from ..files.solids_file import SolidsMap
from .free_surface import at_points
from .means import weighted_percentile
from .shell_angles import LEVEL, bin_centres, shell_angle, toe_and_shoulder
from .slurry_in_cells import BED as PACKED

SPLASH = 1e-3  # share of the slurry below which a region clear of the charge is no pool
BED = 0.1  # solidity above which a pixel belongs to the charge
RANGE = (5, 95)  # per cent of the slurry that bound an axial velocity's range


def pixel_angles(slurry: SlurryMap) -> np.ndarray:
    """Angles of a SlurryMap's pixels [ny, nx], degrees."""
    x, y = np.meshgrid(*slurry.centres())
    return shell_angle(x, y, slurry.sense)


def slurry_ends(slurry: SlurryMap, radius: float, wall: float) -> tuple[float, ...]:
    """Toe and shoulder of a SlurryMap's slurry (degrees): where its share passes 0.5 on the circle `wall` (m) from the
    shell, at both ends of the arc with most slurry; NaN if there is none or no end. With a `wall` at the lifters' tips,
    slurry that they carry over the top has no effect."""
    angle, (x, y) = np.radians(bin_centres()), slurry.centres()
    place = [(-(radius - wall) * np.cos(angle) - y[0]) / (y[1] - y[0]),
             (slurry.sense * (radius - wall) * np.sin(angle) - x[0]) / (x[1] - x[0])]
    # Next to pixels outside the mill, the mean is over those inside
    known = np.isfinite(slurry.share).astype(float)
    share, weight = (map_coordinates(values, place, order=1, mode="nearest")
                     for values in (np.nan_to_num(slurry.share), known))
    return tuple(float(end) for end in toe_and_shoulder(np.where(weight > 0, share / np.maximum(weight, 1e-9), 0)))


def solidity_at_pixels(charge: SolidsMap, slurry: SlurryMap) -> np.ndarray:
    """Solidity of a charge at the pixels of a SlurryMap [ny, nx]."""
    points = np.stack(np.meshgrid(*slurry.centres()), axis=-1).reshape(-1, 2)
    return at_points(charge, charge.solidity, points).reshape(slurry.share.shape)


@dataclass
class Pool:
    """Slurry in front of the charge: where [ny, nx], its pixels; area (m2), the slurry's volume per length; level (m),
    the height of its surface: the median over its columns of pixels of their upper edges; deviation (m) of these edges
    from their mean, small where the surface is flat. Without a pool area is 0 and level and deviation are NaN."""
    where: np.ndarray
    area: float
    level: float
    deviation: float


def pool(slurry: SlurryMap, solidity: np.ndarray) -> Pool:
    """Pool of a SlurryMap with a charge of `solidity` [ny, nx] on the same pixels.

    It is the largest (by volume) of the regions of pixels, joined by their sides, with a share of slurry above 0.5 and
    a solidity of at most 0.1: slurry clear of the charge, not in its pores. Without balls it is all slurry. Films with
    a mean thickness below half a pixel do not appear. Of pixels that the shell cuts, the part within it counts
    (SlurryMap.room). A region with less than SPLASH of the slurry is no pool. ValueError if the shapes differ."""
    if solidity.shape != slurry.share.shape:
        raise ValueError(f"solidity of {solidity.shape} pixels, slurry of {slurry.share.shape}; expected the same")
    share = np.nan_to_num(slurry.share)
    solidity = np.nan_to_num(solidity)
    regions, _ = label((share > LEVEL) & ~(solidity > BED))
    volume = share * slurry.room() * (1 - solidity)
    volumes = np.bincount(regions.ravel(), volume.ravel())[1:]
    least = SPLASH * volume.sum()
    if volumes.max(initial=0.0) <= least:
        return Pool(np.zeros_like(share, bool), 0.0, np.nan, np.nan)
    where = regions == 1 + np.argmax(volumes)
    columns = np.flatnonzero(where.any(axis=0))
    tops = slurry.y[len(slurry.y) - 1 - np.argmax(where[::-1, columns], axis=0)]
    return Pool(where, float(volumes.max() * slurry.pixel()), float(np.median(tops)), float(tops.std()))


def entrained_air(slurry: SlurryMap, solidity: np.ndarray) -> float:
    """Share of air in the fluid of the wet charge: of the pixels of a SlurryMap with a share of slurry above 0.5 and a
    `solidity` [ny, nx] above 0.2. Of pixels that the shell cuts, the part within it counts. NaN if there are none.
    Pockets of all sizes count; a part of them is the mesh's."""
    share = np.nan_to_num(slurry.share)
    wet = (share > LEVEL) & (np.nan_to_num(solidity) > PACKED)
    pores = (1 - solidity[wet]) * slurry.room()[wet]
    return float(1 - np.average(share[wet], weights=pores)) if wet.any() else np.nan


@dataclass
class HalfFlow:
    """Velocity along the axis (m/s, towards the discharge positive) of half of the slurry: mean, and lowest and highest
    of 90 % of it, weighted by its volume (SlurryMap.filled)."""
    mean: float
    lowest: float
    highest: float


@dataclass
class AxialFlow:
    """The slurry's motion along the axis: velocity [ny, nx] (m/s), NaN where its share is at most 0.5; toe, shoulder:
    of its halves on both sides of the line from the mill's centre at `middle` degrees."""
    velocity: np.ndarray
    middle: float
    toe: HalfFlow
    shoulder: HalfFlow

    @property
    def circulates(self) -> bool:
        """Whether slurry flows to the discharge at the toe and back at the shoulder, in the mean."""
        return self.toe.mean > 0 > self.shoulder.mean


def axial_velocity(slurry: SlurryMap) -> np.ndarray:
    """A SlurryMap's velocity along the axis [ny, nx] (m/s) where its share is above 0.5, NaN elsewhere."""
    return np.where(np.nan_to_num(slurry.share) > LEVEL, slurry.velocity[..., 2], np.nan)


def axial_flow(slurry: SlurryMap, toe: float, shoulder: float) -> AxialFlow:
    """AxialFlow of a SlurryMap whose slurry reaches from `toe` to `shoulder` (degrees, as slurry_ends gives them):
    halves are on either side of the direction midway between both. RuntimeError if there is no slurry on one of
    them."""
    velocity = axial_velocity(slurry)
    middle = toe + (shoulder - toe) % 360 / 2
    rising = (pixel_angles(slurry) - middle + 180) % 360 - 180 > 0
    halves = []
    for name, half in (("toe", ~rising), ("shoulder", rising)):
        chosen = half & np.isfinite(velocity)
        if not chosen.any():
            raise RuntimeError(f"no slurry on the half of the {name}: it reaches from {toe:.0f} to {shoulder:.0f} "
                               "degrees")
        values, weights = velocity[chosen], slurry.filled()[chosen]
        lowest, highest = map(float, weighted_percentile(values, weights, RANGE))
        halves.append(HalfFlow(float(np.average(values, weights=weights)), lowest, highest))
    return AxialFlow(velocity, float((middle + 180) % 360 - 180), *halves)
