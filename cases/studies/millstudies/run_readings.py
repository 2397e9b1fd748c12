# SPDX-License-Identifier: GPL-3.0-or-later
"""Readings of a run's slurry for published statements: surface, profile and motion along the axis, particle Reynolds
numbers."""
from dataclasses import dataclass, field, replace

import numpy as np

from millfoam.readings import slurry_on_maps
from millfoam.readings.axial import AxialSeries
from millfoam.readings.batches import whole_turns
from millfoam.readings.free_surface import free_surface
from millfoam.readings.means import BLOCKS, Mean, block_mean, by_resolution
from millfoam.readings.slurry_in_cells import read_frame, reynolds
from millfoam.readings.slurry_over_time import read_series, ring_depth, slurry_blocks, slurry_way

OFF = 0.01  # of a turn: how much written times may be off their interval
# Of the published slurries: density, kg/m3 -> solids, % by mass
CONCENTRATIONS = {1148: 20, 1239: 30, 1346: 40, 1474: 50, 1628: 60}


@dataclass
class Surface:
    """Slurry's free surface across the mill: tilt (degrees, positive where the left side is higher) of the straight
    line through it, its deviation from that line (root mean square, m), both with the error of surface_resolution, and
    over the same width the tilt of the charge, if there is one."""
    tilt: Mean
    deviation: Mean
    charge_tilt: float = None


@dataclass
class ReynoldsNumbers:
    """Particle Reynolds numbers by the balls' diameter, of all cells at the averaged written times: values [n]; the
    slurry's volume at each, volumes [n] (m3); part of the time to which each belongs, parts [n]: a whole turn of the
    mill or a fifth of the time, 0 or more, or -1 before the first of them."""
    values: np.ndarray
    volumes: np.ndarray
    parts: np.ndarray

    def share_below(self, limit):
        """Share of the slurry at numbers below a limit, mean over the parts with its error (Mean). A cell is below it
        or not as a whole, so the share is known to one cell's share of the slurry, that of the largest
        (by_resolution)."""
        chosen = self.volumes[self.parts >= 0]
        return by_resolution(block_mean([
            np.average(self.values[part] < limit, weights=self.volumes[part])
            for part in (self.parts == number for number in range(self.parts.max() + 1)) if part.any()]),
            float(chosen.max() / chosen.sum() / np.sqrt(12)))

    @property
    def median(self):
        """The number up to which half of the slurry lies, at all times."""
        order = np.argsort(self.values)
        below = np.cumsum(self.volumes[order])
        return self.values[order][np.searchsorted(below, below[-1] / 2)]


@dataclass
class RunReadings:
    """A run: name, with its parent folder's; mill's diameter (m); speed (% of critical); law of the drag, None without
    balls; slurry's solids (% by mass, None for a slurry that is not published); last flow time (s); whether the mill
    has two ends; time of a turn (s); steady, the state of the report's check whether the flow is steady, None if it was
    not made; feed (m3/s, 0 of a closed mill) and first_slurry, that in the mill at the first step (m3), None where they
    are not known.

    Its readings, None where they failed: surface; series, AxialSeries of the averaged time; toe and shoulder, velocity
    along the axis of the slurry's halves there (m/s, to the discharge positive); reynolds,
    ReynoldsNumbers; failures, sentences of what could not be read."""
    name: str
    diameter: float
    speed: int
    law: str
    solids: int
    last: float
    ends: bool
    turn: float
    steady: str = None
    surface: Surface = None
    series: AxialSeries = None
    toe: Mean = None
    shoulder: Mean = None
    reynolds: ReynoldsNumbers = None
    failures: list = field(default_factory=list)
    feed: float = None
    first_slurry: float = None


def surface_line(slurry, inner):
    """Tilt (degrees, the left side up positive), RMSD (m) and range of x (m) of the straight line through the free
    surface of a slurry_on_maps.SlurryMap, read within `inner` (m) of the axis, without the slurry that lifters carry.
    RuntimeError if there is none.

    The surface is the highest pixel of the pool in each column; columns whose highest pixel is on the circle are
    left out."""
    centres_x, centres_y = slurry.centres()
    within = np.hypot(*np.meshgrid(centres_x, centres_y)) < inner
    pool = slurry_on_maps.pool(replace(slurry, share=np.where(within, slurry.share, 0.0)), np.zeros_like(slurry.share))
    columns = np.flatnonzero(pool.where.any(axis=0))
    tops = len(centres_y) - 1 - np.argmax(pool.where[::-1, columns], axis=0)
    step = slurry.y[1] - slurry.y[0]
    free = np.hypot(centres_x[columns], centres_y[tops] + step) < inner
    if free.sum() < 5:
        raise RuntimeError(f"no free surface of the slurry within {1e3 * inner:.0f} mm of the axis: {free.sum()} "
                           "columns have one; expected 5 or more")
    x, y = centres_x[columns][free], centres_y[tops][free] + step / 2
    slope, height = np.polyfit(x, y, 1)
    return float(-np.degrees(np.arctan(slope))), float(np.std(y - slope * x - height)), (x.min(), x.max())


def surface_resolution(step, width):
    """Standard deviations of a surface_line's tilt (degrees) and RMSD (m) of a surface over `width` (m) that pixels of
    a height `step` (m) round.

    Each point of the surface is off by up to step/2, evenly distributed: by step/sqrt(12) in the root mean square.
    Errors of neighbours may be alike. By the triangle inequality, the RMSD is off by no more than that root mean
    square, and by Cauchy's, the slope by no more than it over that of the points' x about their mean, which is
    width/sqrt(12) or more. Of what may be anywhere within ± a, the standard deviation is a/sqrt(3)."""
    return float(np.degrees(step / width / np.sqrt(3))), step / 6


def charge_tilt(charge, radius, span):
    """Tilt (degrees, the left side up positive) of the straight line through a SolidsMap's free surface over a span of
    x (m)."""
    x, y = free_surface(charge, radius).points.T
    chosen = (x >= span[0]) & (x <= span[1])
    if chosen.sum() < 5:
        raise RuntimeError(f"the charge's surface does not cover x = {1e3 * span[0]:.0f} to {1e3 * span[1]:.0f} "
                           "mm")
    return float(-np.degrees(np.arctan(np.polyfit(x[chosen], y[chosen], 1)[0])))


def read_maps(case, found):
    """Surface and way along the axis, into RunReadings."""
    inner = case.radius - ring_depth(case.lifter_height)
    maps = list(slurry_blocks(case))
    lines = [surface_line(one, inner) for one in maps]
    span = max(line[2][0] for line in lines), min(line[2][1] for line in lines)
    resolution = surface_resolution(maps[0].y[1] - maps[0].y[0], span[1] - span[0])
    tilt, deviation = (by_resolution(block_mean([line[k] for line in lines]), resolution[k]) for k in (0, 1))
    found.surface = Surface(tilt, deviation, charge_tilt(case.charge, case.radius, span) if found.law else None)
    if found.ends:
        way = slurry_way(maps, case.radius, case.lifter_height)
        found.toe, found.shoulder = way.toe, way.shoulder


def read_reynolds(case):
    """ReynoldsNumbers of a MillCase: parts are the last whole turns of the averages if two fit, and otherwise fifths of
    their time. RuntimeError if no time of the averages was written."""
    fluid = case.mill.slurry("density_kg_m3"), case.mill.slurry("plastic_viscosity_Pa_s")
    frames = [frame for frame in case.flow.frames if frame[0] >= case.begin - 1e-9]
    if not frames:
        raise RuntimeError(f"no time from {case.begin:g} s on was written")
    turns = whole_turns(case.last - case.begin, case.turn)
    if turns < 2:
        parts = np.arange(len(frames)) * BLOCKS // len(frames)
    else:  # the first moment of a turn belongs to the one before
        parts = [max(int(np.ceil((time - case.last) / case.turn - OFF)) + turns - 1, -1) for time, _ in frames]
    pairs = [reynolds(read_frame(case.flow, *frame), *fluid) for frame in frames]
    return ReynoldsNumbers(*(np.concatenate(part) for part in zip(*pairs)),
                           np.repeat(parts, [len(values) for values, _ in pairs]))


def read_run(case):
    """RunReadings of a MillCase with a flow; what cannot be read is in `failures`."""
    name = f"{case.folder.resolve().parent.name}/{case.name}"
    found = RunReadings(name, 2 * case.radius, round(100 * case.mill.critical_share), case.law,
                        CONCENTRATIONS.get(round(case.mill.slurry("density_kg_m3"))), case.last, not case.is_slice,
                        case.turn, feed=case.feed or 0.0,
                        first_slurry=None if case.balance is None else float(case.balance["holdUp"][0]))

    def attempt(what, read):
        try:
            return read()
        except (RuntimeError, OSError) as error:
            found.failures.append(f"{case.name}: {what} not read: {error}")
            return None

    attempt("surface and way along the axis", lambda: read_maps(case, found))
    if found.ends:
        found.series = attempt("profile along the axis", lambda: read_series(case))
    if found.law:
        found.reynolds = attempt("Reynolds numbers", lambda: read_reynolds(case))
    return found
