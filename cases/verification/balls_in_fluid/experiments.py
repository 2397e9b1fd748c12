# SPDX-License-Identifier: GPL-3.0-or-later
"""The experiments: what runs, and what of it is compared with a closed form."""
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.optimize import brentq

from column import WATER, Balls, Column, mixed, run_direct, run_iterated, scattered, settled
from laws import ergun_gradient, minimum_fluidisation, terminal_slip

DIAMETER = 2e-3  # m
FINE = 4e-3  # m, of a bed's cells
COARSE = 8e-3  # m, of a suspension's: a cell has 24 balls at solidity 0.05 and width 16 mm


@dataclass
class Finding:
    """A number and what it is compared with. It misses where it differs by more than `limit`, a share of `expected`, or
    where `limit` is None and it is not above `expected`."""
    experiment: str
    quantity: str
    found: float
    expected: float
    limit: float | None
    unit: str

    @property
    def off(self):
        return self.found / self.expected - 1

    @property
    def missed(self):
        return not (self.found > self.expected if self.limit is None else abs(self.off) <= self.limit)


@dataclass
class Curve:
    """A curve of the picture: panel (the experiment's name), label, x and y; expected: y of the closed form or None."""
    panel: str
    label: str
    x: np.ndarray
    y: np.ndarray
    expected: Any = None


def terminal(work, law, upflow, ways=("direct",), end=0.5):
    """One ball in a column that is one voxel, through which it falls again and again: still water, and water that
    rises. Its speed is U/e - w, with the slip w of the law's balance. In turn with the flow, it begins with nearly that
    speed: a dry ball does not stop to fall. The solidity, 1.1e-3, is that from which on the flow knows it."""
    column = Column(0.008, 0.06, 15, law, end=end, voxels=1, feed=((0.0, upflow),), periodic=True)
    ball = Balls(np.array([[0.004, 0.004, 0.03]]), np.array([DIAMETER]))
    solidity = ball.volume / (column.area * column.height)
    expected = upflow / (1 - solidity) - terminal_slip(law, solidity, DIAMETER)
    name = f"{law}_{'rising' if upflow else 'still'}"
    title = f"terminal velocity, {law}, {'rising' if upflow else 'still'} water"
    findings, curves = [], []
    motion, _ = run_direct(work / name, column, ball)
    findings.append(Finding(title, "direct", motion.velocity[-1, 0, 2], expected, 1e-3, "m/s"))
    curves.append(Curve("terminal velocity", name.replace("_", ", "), motion.time, motion.velocity[:, 0, 2], expected))
    if "iterated" in ways:
        begun = replace(ball, velocity=np.array([[0, 0, 0.8 * expected]]))
        passes = run_iterated(work / f"{name}_iterated", replace(column, averages=end - 0.1), begun, 6,
                              first=replace(column, end=0.001))
        findings.append(Finding(title, "iterated", passes[-1][0].velocity[-1, 0, 2], expected, 1e-3, "m/s"))
    return findings, curves


@dataclass
class Bed:
    """A bed under 0.06 m of water: column, without its feed and end, and the settled balls."""
    column: Column
    balls: Balls

    @property
    def carried(self):
        """Pressure that carries it, Pa."""
        return self.balls.buoyant_weight / self.column.area


def settled_bed(work, width, depth):
    """Bed of a width and depth (m), settled dry. It settles a little more when an experiment begins."""
    height = FINE * round((depth + 0.06) / FINE)
    column = Column(width, height, round(height / FINE), "Ergun", end=0.8, settle=0.1)
    return Bed(column, settled(work / "bed", column, scattered(column, 0.45, 1e-4, depth / 0.75, (DIAMETER,))))


def pool(work, bed, end=0.4):
    """A bed at rest in a pool presses on the floor with its buoyant weight; found in the later half of the run."""
    column = replace(bed.column, end=end, averages=end / 2)
    findings = []
    for name, motion in (("direct", run_direct(work / "pool", column, bed.balls)[0]),
                         ("iterated", run_iterated(work / "pool_iterated", column, bed.balls, 2)[-1][0])):
        force = motion.floor[motion.time > end / 2].mean()
        findings.append(Finding("bed in a pool", f"{name}: force on the floor", force, bed.balls.buoyant_weight, 1e-3,
                                "N"))
    return findings, []


def lost_by_law(fields):
    """Ergun's loss over the column, Pa, at each time: of the cells' solidities and the water's superficial velocity
    past their balls. A bed of soft balls that is relieved expands, and its balls rise by up to 2 % of that."""
    past = (1 - fields.solidity) * (fields.u - fields.balls)
    return fields.cell * ergun_gradient(fields.solidity, DIAMETER, past).sum(axis=1)


def lost_at_rest(fields, at, superficial):
    """Ergun's loss, Pa, if balls of the solidities of time number `at` rested, at each superficial velocity (m/s)."""
    return fields.cell * ergun_gradient(fields.solidity[at], DIAMETER, np.reshape(superficial, (-1, 1))).sum(axis=1)


def pressure_of_acceleration(fields, rate):
    """Pressure, Pa, at each time, that speeds up the water in the column: rate of the superficial velocity, m/s2."""
    return WATER * rate * fields.cell * (1 / (1 - fields.solidity)).sum(axis=1)


def fluidisation(work, bed, rise, begin=0.0):
    """The superficial velocity rises from the share `begin` of minimum fluidisation's to twice that over so many
    seconds: the pressure that the bed takes, and the velocity at which it is carried. Ergun's is that of the bed's
    solidity shortly before. The lowest layer, where balls lie less densely, leaves the floor last: until then the floor
    carries the rest."""
    least = minimum_fluidisation(0.62, DIAMETER)
    most = 2 * least
    column = replace(bed.column, end=rise, feed=((0.0, begin * least), (rise, most)))
    motion, fields = run_direct(work / "fluidisation", column, bed.balls)
    feed = column.feed_at(fields.time)
    drop = fields.drop - pressure_of_acceleration(fields, (most - begin * least) / rise)
    packed = (feed > 0.4 * least) & (feed < 0.8 * least)
    before = np.flatnonzero(packed)[-1]
    expected = brentq(lambda u: lost_at_rest(fields, before, u)[0] - bed.carried, 0.1 * most, 2 * most)
    by_floor = np.interp(fields.time, motion.time[1:], motion.floor[1:]) / column.area
    together = (drop + by_floor)[feed > 1.1 * expected].mean()
    plateau = drop[feed > 1.5 * expected].mean()
    linear, square = np.linalg.lstsq(np.column_stack([feed[packed], feed[packed]**2]), drop[packed], rcond=None)[0]
    found = (-linear + np.sqrt(linear**2 + 4 * square * plateau)) / (2 * square)
    lost = (drop / lost_by_law(fields))[packed].mean()
    name = "fluidisation"
    findings = [Finding(name, "packed: loss over the law's", lost, 1, 0.01, ""),
                Finding(name, "pressure of the bed and of the floor", together, bed.carried, 0.02, "Pa"),
                Finding(name, "carried: pressure of the bed", plateau, bed.carried, 0.02, "Pa"),
                Finding(name, "minimum fluidisation", found, expected, 0.05, "m/s")]
    law = np.minimum(lost_at_rest(fields, before, feed), bed.carried)
    return findings, [Curve("fluidisation", "slurryFoam", feed, drop, law)]


def upflow(work, bed, end=0.4):
    """A bed that stays, at half of the velocity of minimum fluidisation: the floor carries what the flow does not."""
    speed = 0.5 * minimum_fluidisation(0.6, DIAMETER)
    column = replace(bed.column, end=end, feed=((0.0, speed),), averages=end / 2)
    findings = []
    for name, (motion, fields) in (("direct", run_direct(work / "upflow", column, bed.balls)),
                                   ("iterated", run_iterated(work / "upflow_iterated", column, bed.balls, 3)[-1])):
        late = fields.time > end / 2
        lost = lost_by_law(fields)[late].mean()
        carried = bed.balls.buoyant_weight - lost * column.area
        force = motion.floor[motion.time > end / 2].mean()
        findings += [Finding("upflow, bed at rest", f"{name}: loss of pressure", fields.drop[late].mean(), lost, 0.01,
                             "Pa"),
                     Finding("upflow, bed at rest", f"{name}: force on the floor", force, carried, 0.01, "N")]
    return findings, []


def settling(work, width, solidity, top=0.16, end=0.5):
    """A suspension settles in a closed column: speed of its balls before the sediment reaches them, against e w of the
    law's balance, in the mean over the balls with the solidity of their cells."""
    height = top + 0.04
    column = Column(width, height, round(height / COARSE), "DiFelice", end=end, write_interval=0.01)
    balls = mixed(work / f"mixing_{solidity:g}", column, scattered(column, solidity, 0, top, (DIAMETER,)), top)
    motion, fields = run_direct(work / f"settling_{solidity:g}", column, balls)

    def law(phi):
        return -(1 - phi) * terminal_slip("DiFelice", phi, DIAMETER)
    # From the sediment the denser waves rise; from the top the surface sinks
    wave = max(0.0, (law(solidity + 0.01) * (solidity + 0.01) - law(solidity) * solidity) / -0.01)
    front = -law(solidity) * solidity / (0.58 - solidity)
    band = np.array([0.45, 0.65]) * top
    last = min(band[0] / max(front, wave), (top - band[1]) / -law(solidity)) * 0.9
    begin = min(0.12, last / 2)
    inside = (motion.place[..., 2] > band[0]) & (motion.place[..., 2] < band[1])
    during = (motion.time > begin) & (motion.time < last)
    found = motion.velocity[..., 2][inside & during[:, None]].mean()
    cells = (fields.height > band[0]) & (fields.height < band[1])
    seen = fields.solidity[np.ix_((fields.time > begin) & (fields.time < last), np.flatnonzero(cells))]
    # Of all balls: denser cells are slower, and have more of them
    expected = np.average([[law(phi) for phi in row] for row in seen], weights=seen)
    findings = [Finding(f"settling of {solidity:g}", "speed", found, expected, 0.05, "m/s")]
    mean = np.array([speed[one].mean() if one.any() else np.nan
                     for speed, one in zip(motion.velocity[..., 2], inside)])
    shown = motion.time < last
    return findings, [Curve("settling", f"solidity {solidity:g}", motion.time[shown], mean[shown], expected)]


def segregation(work, width, depth, end, compared):
    """Two sizes with little friction, so that they can pass each other, under an upflow that carries both: the smaller
    ones rise above the larger ones. Without the drag of their own sizes both have the same force per volume. depth: of
    the balls before they fall, m; compared: whether a run without that drag is drawn, which has no limit."""
    small, large = DIAMETER, 1.5 * DIAMETER
    speed = 2.2 * minimum_fluidisation(0.6, large)
    findings, curves = [], []
    for own in (True, False) if compared else (True,):
        column = Column(width, 0.161, 23, "ErgunWenYu", end, feed=((0.0, 0.0), (0.3, speed)), settle=3 * depth,
                        polydispersity=own, friction=0.05)
        balls = scattered(column, 0.18, 1e-4, depth, (small,) * 3 + (large,))
        motion, _ = run_direct(work / f"segregation{'' if own else '_mean_size'}", column, balls)
        is_large = balls.diameter > small
        apart = motion.place[:, ~is_large, 2].mean(axis=1) - motion.place[:, is_large, 2].mean(axis=1)
        # Three times what random places would give
        chance = motion.place[-1, :, 2].std() * np.sqrt(1 / is_large.sum() + 1 / (~is_large).sum())
        late = apart[motion.time > 0.8 * end].mean()
        if own:
            findings.append(Finding("two sizes", "smaller above larger balls by", late, 3 * chance, None, "m"))
        curves.append(Curve("two sizes", "drag of each size" if own else "drag of the mean size", motion.time,
                            1e3 * apart))
    return findings, curves
