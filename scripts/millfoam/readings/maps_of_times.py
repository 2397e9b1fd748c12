# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps of a flow's written times: means over axis and time on the pixels of a box about the mill, in the lab frame."""
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..files import solids_file
from ..files.slurry_file import SlurryMap
from ..files.written_times import MillFlow

PIXELS = 130


@dataclass
class TimesMap(SlurryMap):
    """SlurryMap of written times; seen [ny, nx], at how many of them a pixel was in the mill; holdup [ny, nx], the mean
    share of slurry in the mill's space at these."""
    seen: np.ndarray
    holdup: np.ndarray
    times: int

    def filled(self) -> np.ndarray:
        """As SlurryMap.filled; where balls displace slurry, it fills only a part of their pores."""
        return self.holdup * self.room()


def mean_of_times(maps: Sequence[TimesMap]) -> TimesMap:
    """TimesMap of the times of several, on the same pixels."""
    seen = np.asarray(sum(one.seen for one in maps))
    shares, held = ([values * one.seen for values, one in zip(part, maps)] for part in (
        [np.nan_to_num(one.share) for one in maps], [one.holdup for one in maps]))
    known = [np.where(np.isfinite(one.velocity), part[..., None], 0) for one, part in zip(maps, held)]
    with np.errstate(invalid="ignore", divide="ignore"):
        share = np.where(seen > 0, sum(shares) / seen, np.nan)
        velocity = sum(np.nan_to_num(one.velocity) * part for one, part in zip(maps, known)) / sum(known)
    times = sum(one.times for one in maps)
    velocity = np.where((share > solids_file.RARE)[..., None], velocity, np.nan)
    return TimesMap(maps[0].x, maps[0].y, share, velocity, seen, sum(held) / np.maximum(seen, 1), times,
                    source=f"the {times} written times", sense=maps[0].sense)


def mean_flow(flow: MillFlow, begin: float) -> TimesMap:
    """TimesMap of a flow, averaged over axis and time from `begin` (s) on a lab-frame grid, at the written times at
    which the volume of slurry is known; velocity weighted by this volume."""
    x = y = (np.arange(PIXELS) + 0.5) / PIXELS * 2 * flow.radius - flow.radius
    chosen = flow.frames_with_slurry(begin)
    seen, share, held = (np.zeros((PIXELS, PIXELS)) for _ in range(3))
    momentum = np.zeros((PIXELS, PIXELS, 3))
    for time, path in chosen:
        alpha = np.clip(flow.field("alpha.slurry", path), 0, 1)
        slurry = flow.slurry(path) / flow.volumes
        velocity = flow.field("U", path)
        column = flow.over_axis(alpha)
        flux = np.stack([flow.over_axis(slurry * velocity[:, i]) for i in range(3)], axis=-1)
        frame = flow.on_grid(column, time, x, y)
        inside = np.isfinite(frame)
        # A pixel that a lifter sweeps counts only while it is inside the mill
        seen = seen + inside
        share = share + np.where(inside, frame, 0)
        held = held + np.where(inside, flow.on_grid(flow.over_axis(slurry), time, x, y), 0)
        momentum = momentum + np.stack(
            [np.where(inside, flow.on_grid(flux[:, i], time, x, y), 0) for i in range(3)], axis=-1)
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = np.where(seen > 0, share / seen, np.nan)
        velocity = np.where((mean > solids_file.RARE)[..., None], momentum / held[..., None], np.nan)
    edges = np.linspace(-flow.radius, flow.radius, PIXELS + 1)
    return TimesMap(edges, edges, mean, velocity, seen, held / np.maximum(seen, 1), len(chosen),
                    source=f"the {len(chosen)} written times", sense=np.sign(flow.omega))


def mean_load(flow: MillFlow, begin: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Force of the fluid on the balls over their weight, weighted by the balls' volume over axis and time from `begin`
    (s), on a lab-frame grid: x, y, ratio [ny, nx]; NaN where balls are rare."""
    x = y = (np.arange(PIXELS) + 0.5) / PIXELS * 2 * flow.radius - flow.radius
    weighted, solidity, frames = np.zeros((PIXELS, PIXELS)), np.zeros((PIXELS, PIXELS)), 0
    for time, path in flow.frames_with_slurry(begin):
        phi = flow.field("solidity", path)
        ratio = flow.field("forceOverWeight", path)
        weighted = weighted + np.nan_to_num(flow.on_grid(flow.over_axis(phi * ratio), time, x, y))
        solidity = solidity + np.nan_to_num(flow.on_grid(flow.over_axis(phi), time, x, y))
        frames += 1
    with np.errstate(invalid="ignore", divide="ignore"):
        return x, y, np.where(solidity > solids_file.RARE * frames, weighted / solidity, np.nan)
