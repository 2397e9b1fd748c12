# SPDX-License-Identifier: GPL-3.0-or-later
"""The slurry of a mill's run by successive blocks of time: maps, toe and shoulder, motion along the axis, with standard
errors. From the tables and slurry.h5 of function objects, or otherwise from the written times."""
import copy
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import h5py
import numpy as np

from ..files.mill_case import MillCase
from ..files.slurry_file import SlurryMap, VoxelMap, read_slurry_map
from . import slurry_on_maps
from .axial import AxialSeries, axial_series
from .batches import whole_turns
from .maps_of_times import TimesMap, mean_flow, mean_of_times
from .means import BLOCKS, Mean, angle_mean, block_mean

RING = 1.5  # lifter heights from the shell to the circle on which the slurry is read; lifters carry slurry outside it


@dataclass(frozen=True)
class Way:
    """The slurry's readings by blocks of time: angles of its toe and shoulder (degrees, from straight down) on the
    circle of ring_depth, and velocity along the axis of its halves there (m/s, to the discharge positive)."""
    toe_angle: Mean
    shoulder_angle: Mean
    toe: Mean
    shoulder: Mean

    @property
    def circulates(self) -> str:
        """circulation of its halves."""
        return circulation(self.toe, self.shoulder)


def circulation(toe: Mean, shoulder: Mean) -> str:
    """Whether slurry flows to the discharge at the toe and back at the shoulder, by the velocities of its halves along
    the axis (m/s, to the discharge positive): `yes`, `no`, or `undecided` if that is not clear with 95 % confidence
    (Mean.sign)."""
    signs = toe.sign, shoulder.sign
    return "yes" if signs == (1, -1) else "no" if signs[0] < 0 or signs[1] > 0 else "undecided"


def ring_depth(lifter_height: float) -> float:
    """Distance from the shell to the circle on which the slurry's toe and shoulder are read, m."""
    return RING * lifter_height


def slurry_way(maps: Sequence[SlurryMap], radius: float, lifter_height: float) -> Way:
    """Way of SlurryMap of successive blocks of time. RuntimeError if slurry has no ends on the circle."""
    ends = [slurry_on_maps.slurry_ends(one, radius, ring_depth(lifter_height)) for one in maps]
    ways = [slurry_on_maps.axial_flow(one, *both) for one, both in zip(maps, ends)]
    angles = [angle_mean(one) for one in zip(*ends)]
    return Way(*angles, *(block_mean([getattr(way, half).mean for way in ways]) for half in ("toe", "shoulder")))


def mean_slurry(case: MillCase, maps: Sequence[SlurryMap]) -> SlurryMap:
    """SlurryMap of the averaged time of a MillCase; maps: of the blocks of this time."""
    of_times = [one for one in maps if isinstance(one, TimesMap)]
    if len(of_times) == len(maps):
        return mean_of_times(of_times)
    spans = [(one.begin, one.end) for one in maps if isinstance(one, VoxelMap)]
    return read_slurry_map(case.slurry, spans[0][0], spans[-1][1], case.length, np.sign(case.omega))


def parts_of(case: MillCase, times: np.ndarray) -> list[np.ndarray]:
    """Numbers of flow times [n] (s) in the averages of a MillCase, in at most BLOCKS successive parts: of its last
    whole turns, if two fit, and otherwise of nearly equal size."""
    turns = whole_turns(case.last - case.begin, case.turn)
    if turns < 2:
        return np.array_split(np.arange(len(times)), min(BLOCKS, len(times)))
    turn_of = np.floor((times - case.last) / case.turn) + turns
    parts = np.array_split(np.arange(turns), min(BLOCKS, turns))
    return [part for part in (np.flatnonzero(np.isin(turn_of, some)) for some in parts) if len(part)]


def slurry_blocks(case: MillCase) -> Iterator[SlurryMap]:
    """SlurryMap of successive parts (parts_of) of the averaged time of a MillCase: of slurry.h5's windows that lie in
    it, or of the written times. RuntimeError if there are none."""
    begin, end = case.flow.time0 + case.begin, case.flow.time0 + case.last
    if case.slurry:
        with h5py.File(case.slurry) as file:
            begins, ends = file["window/begin"][:], file["window/end"][:]
        late = np.flatnonzero((begins >= begin - 1e-6) & (ends <= end + 1e-6))
        if len(late) == 0:
            raise RuntimeError(f"{case.slurry}: no window from DEM time {begin:g} to {end:g} s; the file has "
                               f"{begins[0]:g} to {ends[-1]:g} s")
        for part in parts_of(case, (begins + ends)[late] / 2 - case.flow.time0):
            yield read_slurry_map(case.slurry, begins[late[part[0]]], ends[late[part[-1]]], case.length,
                                  np.sign(case.omega))
        return
    frames = [frame for frame in case.flow.frames if frame[0] >= max(case.begin, 1e-9) - 1e-9]
    # A written time stands for the time before it
    for part in parts_of(case, np.array([time for time, _ in frames]) - 1e-6):
        some = copy.copy(case.flow)
        some.frames = [frames[index] for index in part]
        yield mean_flow(some, some.frames[0][0])


def read_series(case: MillCase) -> AxialSeries:
    """AxialSeries of a MillCase, from axialProfiles' tables, or otherwise from the written times."""
    tables = [case.axial(name) for name in ("height", "holdUp", "p_rgh")]
    if any(table is None for table in tables):
        return axial_series(case.flow, case.begin)
    # A flow that was killed may have written more rows to one table than to another
    rows = min(len(table[1]) for table in tables)
    z, times, holdup = tables[1][0], tables[1][1][:rows], tables[1][2][:rows]
    late = times >= case.begin
    height, pressure = (np.where(holdup[late] > 0, table[2][:rows][late], np.nan) for table in (tables[0], tables[2]))
    return AxialSeries(z, times[late], height, holdup[late], pressure)
