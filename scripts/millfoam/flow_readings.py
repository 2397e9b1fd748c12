# SPDX-License-Identifier: GPL-3.0-or-later
"""What a mill's run says about its slurry, as numbers with standard errors over time: surface, height and pressure along the
axis, way along the axis, particle Reynolds numbers. From the tables and slurry.h5 of function objects, else from the written
times."""
import copy
from dataclasses import dataclass, field, replace

import h5py
import numpy as np

from . import slurry_maps
from .axial import AxialSeries, axial_series
from .free_surface import free_surface
from .mill_plots import TimesMap, mean_flow, mean_of_times
from .slurry import read_slurry_map
from .slurry_shape import read_frame, reynolds

BLOCKS = 5  # of the averaged time, for errors
RING = 1.5  # heights of a lifter from the shell to the circle on which the slurry is read: what lifters carry is beyond
# Of the published slurries: density, kg/m3 -> solids, % by mass
CONCENTRATIONS = {1148: 20, 1239: 30, 1346: 40, 1474: 50, 1628: 60}


@dataclass(frozen=True)
class Mean:
    """A mean over time and its standard error; NaN where there are no two blocks."""
    value: float
    error: float = 0.0

    def __sub__(self, other):
        return Mean(self.value - other.value, float(np.hypot(self.error, other.error)))

    def told(self, unit, scale=1.0, form=".1f"):
        return f"{scale * self.value:{form}} ± {scale * self.error:{form}} {unit}"


def block_mean(values):
    """Mean of readings [n] of successive blocks of time."""
    values = np.asarray(values, dtype=float)
    return Mean(float(values.mean()), float(values.std(ddof=1) / np.sqrt(len(values))) if len(values) > 1 else np.nan)


def series_mean(values, blocks=BLOCKS):
    """Mean of a series [times, …] by as many blocks of successive times: value [...] and standard error [...]."""
    split = np.array_split(np.asarray(values, dtype=float), min(blocks, len(values)))
    parts = np.array([np.mean(part, axis=0) for part in split])
    error = parts.std(axis=0, ddof=1) / np.sqrt(len(parts)) if len(parts) > 1 else np.full(parts.shape[1:], np.nan)
    return np.mean(values, axis=0), error


@dataclass(frozen=True)
class Way:
    """Of the slurry by blocks of time: angles of its toe and shoulder (degrees, from straight down) on the circle of
    ring_depth, and velocity along the axis of its halves there (m/s, to the discharge positive)."""
    toe_angle: Mean
    shoulder_angle: Mean
    toe: Mean
    shoulder: Mean

    @property
    def circulates(self):
        """Whether slurry goes to the discharge at the toe and back at the shoulder: `yes`, `no`, or `undecided` where that is
        within two standard errors."""
        signs = [0 if not abs(half.value) > 2 * half.error else int(np.sign(half.value)) for half in (self.toe, self.shoulder)]
        return "yes" if signs == [1, -1] else "no" if signs[0] < 0 or signs[1] > 0 else "undecided"


@dataclass
class Surface:
    """Slurry's free surface across the mill: tilt (degrees, positive where the left side is higher) of the straight line
    through it, what it deviates from that line (root mean square, m), and over the same width the tilt of the charge, if there
    is one."""
    tilt: Mean
    deviation: Mean
    charge_tilt: float = None


@dataclass
class RunReadings:
    """A run: name, with its parent folder's; mill's diameter (m); speed (% of critical); law of the drag, None without balls;
    slurry's solids (% by mass, None for a slurry that is not published); last flow time (s); whether the mill has two ends.

    What it says, None where it does not: surface; series, AxialSeries of the averaged time; toe and shoulder, velocity along the
    axis of the slurry's halves there (m/s, to the discharge positive); reynolds, numbers and the slurry's volume at each (m3);
    failures, sentences of what could not be read."""
    name: str
    diameter: float
    speed: int
    law: str
    solids: int
    last: float
    ends: bool
    surface: Surface = None
    series: AxialSeries = None
    toe: Mean = None
    shoulder: Mean = None
    reynolds: tuple = None
    failures: list = field(default_factory=list)


def surface_line(slurry, radius, inner):
    """Tilt (degrees, the left side up positive), RMSD (m) and range of x (m) of the straight line through the free surface of a
    slurry_maps.SlurryMap, read within `inner` (m) of the axis: what lifters carry is beyond. RuntimeError if there is none.

    The surface is the highest pixel of the pool in each column; columns whose highest pixel is the circle's say nothing of it."""
    centres_x, centres_y = slurry.centres()
    within = np.hypot(*np.meshgrid(centres_x, centres_y)) < inner
    pool = slurry_maps.pool(replace(slurry, share=np.where(within, slurry.share, 0.0)), np.zeros_like(slurry.share))
    columns = np.flatnonzero(pool.where.any(axis=0))
    tops = len(centres_y) - 1 - np.argmax(pool.where[::-1, columns], axis=0)
    step = slurry.y[1] - slurry.y[0]
    free = np.hypot(centres_x[columns], centres_y[tops] + step) < inner
    if free.sum() < 5:
        raise RuntimeError(f"no free surface of the slurry within {1e3 * inner:.0f} mm of the axis: {free.sum()} columns have "
                           "one; expected 5 or more")
    x, y = centres_x[columns][free], centres_y[tops][free] + step / 2
    slope, height = np.polyfit(x, y, 1)
    return float(-np.degrees(np.arctan(slope))), float(np.std(y - slope * x - height)), (x.min(), x.max())


def charge_tilt(charge, radius, span):
    """Tilt (degrees, the left side up positive) of the straight line through a SolidsMap's free surface over a span of x (m)."""
    x, y = free_surface(charge, radius).points.T
    chosen = (x >= span[0]) & (x <= span[1])
    if chosen.sum() < 5:
        raise RuntimeError(f"the charge's surface does not stand over x = {1e3 * span[0]:.0f} to {1e3 * span[1]:.0f} mm")
    return float(-np.degrees(np.arctan(np.polyfit(x[chosen], y[chosen], 1)[0])))


def ring_depth(lifter_height):
    """From the shell to the circle on which the slurry's toe and shoulder are read, m."""
    return RING * lifter_height


def angle_mean(angles):
    """block_mean of angles [n] (degrees), which may stand on either side of 180; from -180 to 180."""
    about = np.degrees(np.angle(np.mean(np.exp(1j * np.radians(angles)))))
    found = block_mean((np.asarray(angles) - about + 180) % 360 - 180)
    return Mean(float((found.value + about + 180) % 360 - 180), found.error)


def slurry_way(maps, radius, lifter_height):
    """Way of slurry_maps.SlurryMap of successive blocks of time. RuntimeError where slurry has no ends on the circle."""
    ends = [slurry_maps.slurry_ends(one, radius, ring_depth(lifter_height)) for one in maps]
    ways = [slurry_maps.axial_flow(one, *both) for one, both in zip(maps, ends)]
    angles = [angle_mean(one) for one in zip(*ends)]
    return Way(*angles, *(block_mean([getattr(way, half).mean for way in ways]) for half in ("toe", "shoulder")))


def mean_slurry(case, maps):
    """SlurryMap of the averaged time of a report.sources.MillCase, of whose blocks there are `maps`."""
    if all(isinstance(one, TimesMap) for one in maps):
        return mean_of_times(maps)
    return read_slurry_map(case.slurry, case.flow.time0 + case.begin, case.flow.time0 + case.last, case.length,
                           np.sign(case.omega))


def humps_at_ends(humps, z):
    """How many axial.Humps stand at an end of the slices z [n] (m): the profile has no hump there that it tells."""
    slack = 0.1 * (z[1] - z[0])
    return sum(place < z[0] + slack or place > z[-1] - slack for place in humps.places)


def blocks_of(count):
    """Numbers of `count` windows or times in a row, in BLOCKS parts as equal as can be, or fewer of one each."""
    return np.array_split(np.arange(count), min(BLOCKS, count))


def slurry_blocks(case):
    """slurry_maps.SlurryMap of successive parts of the averaged time of a report.sources.MillCase: of slurry.h5's windows that
    lie in it, or of the written times. RuntimeError where there are none."""
    begin, end = case.flow.time0 + case.begin, case.flow.time0 + case.last
    if case.slurry:
        with h5py.File(case.slurry) as file:
            begins, ends = file["window/begin"][:], file["window/end"][:]
        late = np.flatnonzero((begins >= begin - 1e-6) & (ends <= end + 1e-6))
        if len(late) == 0:
            raise RuntimeError(f"{case.slurry}: no window from DEM time {begin:g} to {end:g} s; there are {begins[0]:g} to "
                               f"{ends[-1]:g} s")
        for part in blocks_of(len(late)):
            yield read_slurry_map(case.slurry, begins[late[part[0]]], ends[late[part[-1]]], case.length, np.sign(case.omega))
        return
    frames = [frame for frame in case.flow.frames if frame[0] >= max(case.begin, 1e-9) - 1e-9]
    for part in blocks_of(len(frames)):
        some = copy.copy(case.flow)
        some.frames = [frames[index] for index in part]
        yield mean_flow(some, some.frames[0][0])


def read_series(case):
    """AxialSeries of a MillCase: axialProfiles' tables where they are, else the written times."""
    tables = [case.axial(name) for name in ("height", "holdUp", "p_rgh")]
    if any(table is None for table in tables):
        return axial_series(case.flow, case.begin)
    # A flow that was killed may have written one table farther than another
    rows = min(len(table[1]) for table in tables)
    z, times, holdup = tables[1][0], tables[1][1][:rows], tables[1][2][:rows]
    late = times >= case.begin
    height, pressure = (np.where(holdup[late] > 0, table[2][:rows][late], np.nan) for table in (tables[0], tables[2]))
    return AxialSeries(z, times[late], height, holdup[late], pressure)


def read_maps(case, found):
    """Surface and way along the axis, into RunReadings."""
    inner = case.radius - ring_depth(case.lifter_height)
    maps = list(slurry_blocks(case))
    lines = [surface_line(one, case.radius, inner) for one in maps]
    tilt, deviation = (block_mean([line[k] for line in lines]) for k in (0, 1))
    span = max(line[2][0] for line in lines), min(line[2][1] for line in lines)
    found.surface = Surface(tilt, deviation, charge_tilt(case.charge, case.radius, span) if found.law else None)
    if found.ends:
        way = slurry_way(maps, case.radius, case.lifter_height)
        found.toe, found.shoulder = way.toe, way.shoulder


def read_reynolds(case):
    """Particle Reynolds numbers of all cells at the averaged written times, and the slurry's volume at each (m3)."""
    fluid = case.mill.slurry("density_kg_m3"), case.mill.slurry("plastic_viscosity_Pa_s")
    pairs = [reynolds(read_frame(case.flow, *frame), *fluid)
             for frame in case.flow.frames if frame[0] >= case.begin - 1e-9]
    return tuple(np.concatenate(part) for part in zip(*pairs))


def read_run(case):
    """RunReadings of a report.sources.MillCase with a flow; what cannot be read stands in `failures`."""
    name = f"{case.folder.resolve().parent.name}/{case.name}"
    found = RunReadings(name, 2 * case.radius, round(100 * case.mill.critical_share), case.law,
                        CONCENTRATIONS.get(round(case.mill.slurry("density_kg_m3"))), case.last, not case.is_slice)

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
