# SPDX-License-Identifier: GPL-3.0-or-later
"""Readings of a steady flow of a mill turn by turn, and their means with errors over time.

Each whole turn of the averaged time is one batch: a mean is that of the turns, its error the turns' standard deviation
over the root of their number. Angles: see shell_angles."""
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.stats import f as f_distribution

from millfoam.files.mill_case import MillCase
from millfoam.files.slurry_file import SlurryMap
from millfoam.readings import batches
from millfoam.readings.batches import batch_means
from millfoam.readings.means import Mean, angle_mean, block_mean, weighted_percentile
from millfoam.readings.shell_angles import LEVEL, toe_and_shoulder
from millfoam.readings.slurry_in_cells import BED, count_steps, ratio, read_frame, reynolds, ring, samples, section
from millfoam.readings.slurry_on_maps import pool
from millfoam.report.steadiness import flow_steadiness

from .axial_slices import jackknife

PIXELS = 60  # across the mill
OFF = 0.01  # of a turn: how much written times may be off their interval, 1/24 of a turn
PART = 0.01  # chance of layers that are alike to be found apart


class Number(NamedTuple):
    """A number of TurnReadings as tables show it: its unit, and the factor to it."""
    unit: str
    factor: float


NUMBERS = {"height": Number("mm", 1e3), "x": Number("mm", 1e3), "toe": Number("deg", 1), "shoulder": Number("deg", 1),
           "power": Number("W/m", 1), "pool": Number("%", 100), "cell air": Number("%", 100),
           "map air": Number("%", 100)}
ANGLES = ("toe", "shoulder")


@dataclass
class TurnReadings:
    """Readings of a flow over the whole turns of its averaged time.

    turns: number of NUMBERS -> its value in each turn: height and x of the centre of the slurry's volume (m); toe and
    shoulder (degrees); power (W per m of the mill's length); pool, share of the slurry in the pool clear of the charge
    (slurry_on_maps.pool); cell air and map air, shares of air in the wet bed (wet_cells, wet_pixels).
    drift: the report's finding where the flow is not steady, otherwise an empty text.
    share: slurry's of the fluid [PIXELS, PIXELS] over the mill's square, NaN outside; reynolds, weights (m3): of all
    cells in the bed; steps; time: wall time of the flow, s; columns: of cells, in the mill's section."""
    turns: dict[str, np.ndarray]
    drift: str
    share: np.ndarray
    reynolds: np.ndarray
    weights: np.ndarray
    steps: int
    time: float
    columns: int

    @property
    def steady(self):
        """`yes` or `no`, as tables have it."""
        return "no" if self.drift else "yes"

    def mean(self, name):
        """Mean of one of NUMBERS in its table's unit."""
        values = NUMBERS[name].factor * self.turns[name]
        return angle_mean(values) if name in ANGLES else block_mean(values)

    def reynolds_percentiles(self, percents):
        """Reynolds numbers below which these percents of the slurry in the bed lie."""
        return weighted_percentile(self.reynolds, self.weights, percents)


def whole_turns(case):
    """Flow time at which a MillCase's last whole averaged turns begin (s), and their number. RuntimeError for fewer
    than two."""
    turns = batches.whole_turns(case.last - case.begin, case.turn)
    if turns < 2:
        raise RuntimeError(f"{case.folder}: averages over {case.last - case.begin:.3g} s; expected two turns of "
                           f"{case.turn:.3g} s or more")
    return case.last - turns * case.turn, turns


def frames_by_turn(case):
    """The written times [(s, Path)] in each of a MillCase's whole turns; the first moment of a turn belongs to the one
    before."""
    begin, turns = whole_turns(case)
    found = [[] for _ in range(turns)]
    for time, path in case.flow.frames:
        turn = int(np.ceil((time - begin) / case.turn - OFF)) - 1
        if 0 <= turn < turns:
            found[turn].append((time, path))
    return found


def of_tables(case):
    """height, x and power of a MillCase in each turn, from slurryBalance. RuntimeError without this table."""
    columns = case.balance
    if columns is None:
        raise RuntimeError(f"{case.folder}: no table of slurryBalance")
    begin, turns = whole_turns(case)
    height, x, power = (batch_means(columns["Time"], columns[key], begin, case.turn, turns)
                        for key in ("y", "x", "power"))
    return {"height": height, "x": x, "power": power / case.length}


def wet_cells(frame):
    """Volumes (m3) of air and of fluid in a Frame's wet cells of the bed: of a solidity above BED, with a share of
    slurry above one half. Pockets that are larger than the cells are not in them."""
    share = frame.slurry / frame.fluid
    wet = (frame.solidity > BED) & (share > LEVEL)
    return np.array([(frame.fluid - frame.slurry)[wet].sum(), frame.fluid[wet].sum()])


def wet_pixels(slurry, fluid, solids):
    """Share of air in the fluid of the wet bed on a map averaged over axis and time: on pixels with a mean solidity
    above BED and a mean share of slurry above one half. Volumes [ny, nx]. It has pockets of all sizes on every mesh."""
    wet = (solids > BED * (solids + fluid)) & (slurry > LEVEL * fluid)
    return 1 - slurry[wet].sum() / fluid[wet].sum() if wet.any() else np.nan


def share_in_pool(case, slurry, fluid, solids):
    """Share of the slurry that is in the pool clear of the charge, on a map: volumes [PIXELS, PIXELS]."""
    edges = np.linspace(-case.radius, case.radius, PIXELS + 1)
    velocity = np.zeros((PIXELS, PIXELS, 3))
    shown = SlurryMap(edges, edges, ratio(np.stack([slurry, fluid])), velocity, source="written times",
                      sense=np.sign(case.omega))
    where = pool(shown, ratio(np.stack([solids, solids + fluid]))).where
    return slurry[where].sum() / slurry.sum()


class TurnSums:
    """Sums over the written times of one turn, from which its numbers are read."""

    def __init__(self, case):
        self.case = case
        self.points, self.column = samples(case.flow)
        self.ring, self.air = 0, np.zeros(2)
        self.volumes = np.zeros((3, PIXELS, PIXELS))  # slurry, fluid, solids
        self.reynolds = []

    def add(self, time, path):
        flow, mill = self.case.flow, self.case.mill
        frame = read_frame(flow, time, path)
        self.ring = self.ring + ring(flow, frame, self.points, self.column, self.case.lifter_height)
        self.air += wet_cells(frame)
        self.volumes += section(flow, frame, self.points, self.column, PIXELS)
        self.reynolds.append(reynolds(frame, mill.slurry("density_kg_m3"), mill.slurry("plastic_viscosity_Pa_s")))

    def numbers(self):
        """NUMBERS of this turn that are read of fields."""
        toe, shoulder = toe_and_shoulder(np.nan_to_num(ratio(self.ring)))
        air = self.air[0] / self.air[1] if self.air[1] > 0 else np.nan
        return {"toe": toe, "shoulder": shoulder, "pool": share_in_pool(self.case, *self.volumes), "cell air": air,
                "map air": wet_pixels(*self.volumes)}


def read_turns(folder):
    """TurnReadings of the flow in a case's folder. RuntimeError if it has fewer than two turns, or a turn without
    written times."""
    case = MillCase(folder)
    if case.flow is None:
        raise RuntimeError("; ".join([f"{folder}: no flow", *case.unusable]))
    sums = []
    for number, frames in enumerate(frames_by_turn(case), start=1):
        if not frames:
            raise RuntimeError(f"{folder}: no written time in turn {number} of the averages")
        sums.append(TurnSums(case))
        for time, path in frames:
            sums[-1].add(time, path)
    of_fields = [one.numbers() for one in sums]
    turns = of_tables(case) | {name: np.array([one[name] for one in of_fields]) for name in of_fields[0]}
    check = flow_steadiness(case)
    slurry, fluid, _ = sum(one.volumes for one in sums)
    numbers, weights = (np.concatenate(part) for part in zip(*(pair for one in sums for pair in one.reynolds)))
    return TurnReadings(turns, "" if check.state == "holds" else check.found, ratio(np.stack([slurry, fluid])),
                        numbers, weights, count_steps(case.folder), case.record.last.get("wall_s", np.nan),
                        len(case.flow.column_centres))


def read_all(cases, failures):
    """name -> TurnReadings of cases (name -> folder). A case that cannot be read is added to the messages
    `failures`."""
    readings = {}
    for name, folder in cases.items():
        try:
            readings[name] = read_turns(folder)
        except RuntimeError as error:
            failures.append(f"{name}: {error}")
    return readings


@dataclass
class Layers:
    """Heights of the slurry's centre in the slices of axialProfiles, one for each layer of cells.

    heights [layers]: means over time (m); spread: their standard deviation (m), with its jackknife error over the
    turns; by_chance: the standard deviation of such means if all layers were alike (m), from the layers' differences
    from turn to turn; momentary: mean over time of the standard deviation at a time (m); apart: whether the spread is
    more than chance gives (F-test over layers and turns, PART)."""
    heights: np.ndarray
    spread: Mean
    by_chance: float
    momentary: float
    apart: bool


def spread_of(heights):
    """Standard deviation between the layers' means over the turns (m) of heights [turns, layers] (m), with its
    jackknife error, NaN for two turns."""
    spread, error = jackknife(lambda turns: heights[turns].mean(axis=0).std(ddof=1), len(heights))
    return Mean(float(spread), float(error) if len(heights) > 2 else np.nan)


def chance_of(heights):
    """Spread (m) that heights [turns, layers] (m) of equal layers would have, and the largest that is not apart."""
    turns, layers = heights.shape
    left = heights - heights.mean(axis=1, keepdims=True)  # all layers may move together
    freedom = (layers - 1) * (turns - 1)
    by_chance = np.sqrt(np.sum((left - left.mean(axis=0))**2) / freedom / turns)
    return float(by_chance), float(by_chance * np.sqrt(f_distribution.ppf(1 - PART, layers - 1, freedom)))


def read_layers(folder):
    """Layers of the flow in a case's folder. RuntimeError without axialProfiles, with a single slice, or with fewer
    than two turns."""
    case = MillCase(folder)
    table = case.axial("height")
    if table is None or table[2].shape[1] < 2:
        raise RuntimeError(f"{folder}: expected heights of two layers or more in axialProfiles")
    begin, turns = whole_turns(case)
    _, times, values = table
    by_turn = np.stack([batch_means(times, column, begin, case.turn, turns) for column in values.T], axis=1)
    spread, (by_chance, limit) = spread_of(by_turn), chance_of(by_turn)
    momentary = values[times >= begin].std(axis=1, ddof=1).mean()
    return Layers(by_turn.mean(axis=0), spread, by_chance, float(momentary), spread.value > limit)


def title_of(folder):
    """In words: cells and averaged time of the flow in a case's folder."""
    case = MillCase(folder)
    begin, turns = whole_turns(case)
    return f"{case.flow.mesh.cells} cells; {turns} turns, flow time {begin:.3g} to {case.last:.3g} s"
