# SPDX-License-Identifier: GPL-3.0-or-later
"""The numbers of one pass of balls and slurry, and of the change from one pass to the next."""
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from ..files.data_files import read_csv
from ..files.mill import read_mill
from ..files.mill_case import MillCase
from ..files.slurry_file import read_ball_forces
from ..files.solids_file import SolidsMap, mean_map
from ..files.stirred_case import StirredCase
from ..readings.batches import mean_over_turns, turn_means
from ..readings.charge import circulation_centre
from ..readings.compare import difference
from ..readings.free_surface import WALL, toe_and_shoulder
from ..readings.means import Mean, time_mean, with_error
from ..readings.mill_power import (UNKNOWN, by_walls, charge_power, drive_power, known_balance, slurry_power,
                                   sum_over_turns, written_balance)
from . import ball_forces

FORCES = "forces.h5"  # in a pass's folder: what its balls felt
# Quantities that are compared from pass to pass: key -> name, unit, scale from SI
QUANTITIES = {"toe": ("toe of the charge", "°", 1.0), "shoulder": ("shoulder of the charge", "°", 1.0),
              "charge_x": ("centre of circulation, x", "mm", 1e3), "charge_y": ("centre of circulation, y", "mm", 1e3),
              "charge_power": ("power of the charge", "W", 1.0), "slurry_x": ("centre of the slurry, x", "mm", 1e3),
              "slurry_y": ("centre of the slurry, y", "mm", 1e3), "slurry_power": ("power for the slurry", "W", 1.0),
              "drive_power": ("power of the drive", "W", 1.0)}
MAY_LACK = ("toe", "shoulder", "charge_x", "charge_y")  # which a thin charge does not have
# Standard errors that a quantity may change by in a pass that has settled: of ten comparisons, made twice, one would
# exceed two errors by chance in most cases
LIMIT = 3.0
# Times the noise of two maps that their solidity may differ by: windows that follow each other share slow changes,
# which the noise does not have
NOISE = 1.5
AGREE = 0.1  # by which forces that moved the balls and forces of the flow may differ, over the latter
EXCHANGED = 0.01  # by which mean forces of balls and flow at the same time may differ, over the flow's
# Torque that makes up for voxels, over the drive's torque on the balls. In the 12 cm mill with 100 % of slurry, 5 %
# were added with voxels of 11 mm, and the drive's power was 1.9 ± 0.9 % above that with 6 mm. More was not measured
ADDED = 0.1
TORQUES = 0.02  # by which the torque between balls and slurry may differ by both, over the drive's torque
MOMENTUM = 0.02  # by which the flow's force on the balls may differ from that by its balance of momentum


@dataclass
class Pass:
    """A pass: number, from 1 on (the dry one); folder; its quantities, key of QUANTITIES -> Mean in SI units or
    degrees, NaN where it has no such reading; map of the charge and the noise of a difference of two such maps (as
    compare.Difference.solidity); force of the fluid on the balls over their weight; disagreement of the forces that
    moved the balls and those that the flow then gave to them, None for the dry pass."""
    number: int
    folder: Path
    quantities: dict[str, Mean]
    charge: SolidsMap
    noise: float
    load: float
    disagreement: float | None


@dataclass
class Change:
    """From one pass to the next: difference of the charges' solidity (compare.Difference), over NOISE times its noise;
    key of QUANTITIES -> difference, and over LIMIT standard errors, without those of MAY_LACK that neither pass has."""
    solidity: float
    solidity_over_limit: float
    quantities: dict[str, Mean]
    over_limit: dict[str, float]

    @property
    def within(self) -> bool:
        """Whether nothing changed by more than its statistical error. What is not known counts as a change."""
        return self.solidity_over_limit <= 1 and all(one <= 1 for one in self.over_limit.values())

    @property
    def largest(self) -> str:
        """Name of what changed most over its limit."""
        shares = {**{QUANTITIES[key][0]: one for key, one in self.over_limit.items()},
                  "solidity of the charge": self.solidity_over_limit}
        return max(shares, key=lambda name: np.inf if np.isnan(shares[name]) else shares[name])


def read_pass(number: int, folder: Path) -> Pass:
    """Pass of a folder in which dry run, averages and flow are complete. RuntimeError if one of them is not."""
    case = MillCase(folder)
    if case.charge is None or case.flow is None or case.results is None:
        missing = [name for name, part in (("the dry run's results", case.results), ("solids.h5", case.solids),
                                           ("the flow", case.flow)) if part is None]
        raise RuntimeError(f"{folder}: pass {number} lacks {', '.join(missing)}; run it to its end")
    load = case.load
    quantities = {**charge_quantities(case, case.charge), **slurry_quantities(case),
                  "slurry_power": slurry_power(case), "drive_power": drive_power(case)}
    return Pass(number, folder, quantities, case.charge,
                map_noise(case.charge_windows), load[0] if load else np.nan, forces_apart(folder))


def charge_quantities(case: MillCase, charge: SolidsMap) -> dict[str, Mean]:
    """Readings of the charge of a MillCase; charge: its map. A thin charge has no centre of circulation: NaN."""
    windows = case.charge_windows

    def read(reading: Callable[[SolidsMap], ArrayLike]) -> list[Mean]:
        try:
            values = reading(charge)
            found = with_error(reading, windows) if len(windows) >= 4 else None
        except RuntimeError:
            return [UNKNOWN, UNKNOWN]
        if found is None:
            return [Mean(float(value), np.nan) for value in np.asarray(values)]
        return [Mean(float(value), float(error), found.blocks - 1) for value, error in zip(
            np.asarray(values), found.error)]
    toe, shoulder = read(lambda one: toe_and_shoulder(one, case.radius, WALL))
    centre_x, centre_y = read(lambda one: circulation_centre(one, case.radius))
    return {"toe": toe, "shoulder": shoulder, "charge_x": centre_x, "charge_y": centre_y,
            "charge_power": charge_power(case)}


def slurry_quantities(case: MillCase) -> dict[str, Mean]:
    """Centre of the slurry of a MillCase, with errors over whole turns; NaN for fewer than TURNS."""
    columns = known_balance(case)
    found = {key: columns and mean_over_turns(columns["Time"], columns[name], case.begin, case.turn)
             for key, name in (("slurry_x", "x"), ("slurry_y", "y"))}
    return {key: mean or UNKNOWN for key, mean in found.items()}


def map_noise(windows: Sequence[SolidsMap]) -> float:
    """Expected difference (compare.Difference.solidity) of two maps of the same charge over as much time as these
    successive SolidsMap; NaN for fewer than four. Found from the maps of every other window: each has half of the
    time, so that their difference is the square root of 2 larger."""
    if len(windows) < 4:
        return np.nan
    return difference(mean_map(windows[::2]), mean_map(windows[1::2])).solidity / np.sqrt(2)


def forces_apart(folder: Path) -> float | None:
    """ball_forces.disagreement of the forces that moved the balls of a pass and those that its flow gave to them; None
    if nothing moved them."""
    if not (folder / FORCES).is_file():
        return None
    applied, felt = (read_ball_forces(folder / name) for name in (FORCES, "slurry.h5"))
    return ball_forces.disagreement(applied, felt)


@dataclass(frozen=True)
class Exchanged:
    """Means over a flow's averaged time of what it gives to all balls, by the flow (steps.csv) and by the balls
    (fluid.csv): sizes of the force, N, and of their difference over that of the flow's; torques about +z, N m, and size
    of their difference over that of the drive's torque on the balls. Runs of version 0.2.0 have no torques: None.

    added: mean over the records of the size of the torque that the balls got because voxels spread them (TorqueBalance
    of millDem), over that of the drive's on the balls. None of a run without it: there, the torques by the flow and by
    the balls may differ by as much.

    unbalanced: torque that the balls of a tumbling mill take from the slurry, plus the one that the slurry takes from
    them by its own balance (slurryBalance), over the drive's torque. It is 0 without errors of voxels and mesh, and an
    error of the drive's power. Its error is over whole turns, NaN for fewer than two. None of a stirred mill, and
    without torques.

    force_unbalanced: size of the difference between the force that the flow gives and the one that its own balance of
    momentum leaves for the balls (force_balance of slurryBalance), over the former. The error is that of the difference
    along its own direction, as above. None where slurryBalance has no such force."""
    given: float
    taken: float
    disagreement: float
    given_torque: float | None = None
    taken_torque: float | None = None
    added: float | None = None
    torque_disagreement: float | None = None
    unbalanced: Mean | None = None
    force_unbalanced: Mean | None = None


def given(case: MillCase) -> tuple[np.ndarray, float | None]:
    """Means over the averaged time of a MillCase of what the flow gave to balls that moved at the same time: force [3],
    N, and torque about +z, N m, if steps.csv has it. RuntimeError without steps.csv."""
    steps = case.record.steps
    if steps is None:
        raise RuntimeError(f"{case.folder}: no postProcessing/flow/*/steps.csv, which slurryFoam writes")
    begin, end = steps["time_s"], np.append(steps["time_s"][1:], case.last)
    length = np.clip(np.minimum(end, case.last) - np.maximum(begin, case.begin), 0, None)
    force = np.array([np.average(steps[f"given_force_{axis}_N"], weights=length) for axis in "xyz"])
    torque = steps.get("given_torque_Nm")
    return force, None if torque is None else float(np.average(torque, weights=length))


def direct_case(folder: Path) -> MillCase:
    """The case of balls and flow that ran at the same time, of either machine. RuntimeError if it is not complete."""
    case = StirredCase(folder) if read_mill(folder, None).machine == StirredCase.machine else MillCase(folder)
    if case.flow is None or case.results is None:
        raise RuntimeError(f"{folder}: the flow or the results of the balls are missing; run it to its end")
    return case


def exchanged_forces(folder: Path) -> Exchanged:
    """Exchanged of a case whose balls and flow ran at the same time. RuntimeError without steps.csv, fluid.csv or
    energy.csv.

    Force and torque are means over all time-steps: one of the flow acts on the balls until the next one. Both are the
    same for flow and balls when they meet; then the balls move on."""
    case = direct_case(folder)
    assert case.flow is not None
    force, torque = given(case)
    rows, drive = (read_csv(folder / "dumps" / name) for name in ("fluid.csv", "energy.csv"))
    begin, end = (case.flow.time0 + at for at in (case.begin, case.last))
    within, driven = ((table["time_s"] > begin) & (table["time_s"] <= end) for table in (rows, drive))
    taken = np.array([np.mean(rows[f"force_{axis}_N"][within]) for axis in "xyz"])
    sizes = [float(np.linalg.norm(one)) for one in (force, taken, force - taken)]
    exchanged = Exchanged(sizes[0], sizes[1], sizes[2] / sizes[0] if sizes[0] > 0 else np.nan,
                          force_unbalanced=unbalanced_force(case, force))
    if torque is None or "torque_Nm" not in rows:
        return exchanged
    felt, driving = float(np.mean(rows["torque_Nm"][within])), float(np.mean(drive["torque_Nm"][driven]))
    balance = rows.get("balance_torque_Nm")
    return replace(exchanged, given_torque=torque, taken_torque=felt,
                   added=None if balance is None else float(np.mean(np.abs(balance[within]))) / abs(driving),
                   torque_disagreement=abs((torque - felt) / driving),
                   unbalanced=unbalanced(case, (rows["time_s"][within], rows["torque_Nm"][within]),
                                         float(np.mean(drive["power_W"][driven]))))


def unbalanced(case: MillCase, felt: tuple[np.ndarray, np.ndarray], charge: float) -> Mean | None:
    """Exchanged.unbalanced of a case; felt: DEM times (s) and torque of the slurry on the balls about +z (N m) [n];
    charge: mean power of the drive on the balls, W, both over the averaged time."""
    columns = written_balance(case) if case.machine == MillCase.machine else None
    if columns is None:
        return None
    assert case.flow is not None
    times, walls = columns["Time"], by_walls(columns)
    lacking, taken = columns["power"] - walls, felt[1] * case.omega
    drive = charge + time_mean(times, walls, case.begin)
    of_turns = sum_over_turns(turn_means(times, lacking, case.begin, case.turn),
                              turn_means(felt[0] - case.flow.time0, taken, case.begin, case.turn), fewest=2)
    return Mean((time_mean(times, lacking, case.begin) + float(np.mean(taken))) / drive, of_turns.error / abs(drive),
                of_turns.freedom)


def unbalanced_force(case: MillCase, force: np.ndarray) -> Mean | None:
    """Exchanged.force_unbalanced of a case; force [3]: mean that the flow gives to the balls, N."""
    columns, steps, size = written_balance(case), case.record.steps, float(np.linalg.norm(force))
    if columns is None or steps is None or "force_balance_x" not in columns or size == 0:
        return None
    times = columns["Time"]
    apart = np.array([time_mean(times, columns[f"force_balance_{axis}"], case.begin) for axis in "xyz"]) - force
    way = apart / (np.linalg.norm(apart) or 1.0)

    def along(name: str, table: dict[str, np.ndarray]) -> np.ndarray:
        return np.sum([part * table[name.format(axis)] for part, axis in zip(way, "xyz")], axis=0)
    of_turns = sum_over_turns(
        turn_means(times, along("force_balance_{}", columns), case.begin, case.turn),
        turn_means(steps["time_s"], -along("given_force_{}_N", steps), case.begin, case.turn), fewest=2)
    return Mean(float(np.linalg.norm(apart)) / size, of_turns.error / size, of_turns.freedom)


def change(before: Pass, after: Pass) -> Change:
    """Change from one Pass to the next."""
    apart = difference(after.charge, before.charge).solidity
    noise = float(np.hypot(before.noise, after.noise) / np.sqrt(2))
    quantities = {key: after.quantities[key] - before.quantities[key] for key in QUANTITIES}
    over = {key: abs(one.value) / (LIMIT * one.error) if one.error > 0 else np.nan for key, one in quantities.items()
            if not (key in MAY_LACK and all(np.isnan(step.quantities[key].value) for step in (before, after)))}
    return Change(apart, apart / (NOISE * noise), quantities, over)


def settled(changes: Sequence[Change], last: Pass) -> bool:
    """Whether nothing changed in the last two of the passes' changes, and the forces that moved the balls of the last
    pass are those of its flow: with strong relaxation alone, nothing would change either."""
    return (len(changes) >= 2 and all(one.within for one in changes[-2:]) and last.disagreement is not None
            and last.disagreement <= AGREE)
