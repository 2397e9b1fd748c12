# SPDX-License-Identifier: GPL-3.0-or-later
"""The numbers of one pass of balls and slurry, and of the change from one pass to the next."""
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from ..files.data_files import read_csv
from ..files.mill import read_mill
from ..files.mill_case import MillCase
from ..files.slurry_file import read_ball_forces
from ..files.solids_file import SolidsMap, mean_map
from ..files.stirred_case import StirredCase
from ..readings.batches import error_over_turns
from ..readings.charge import circulation_centre
from ..readings.compare import difference
from ..readings.free_surface import WALL, toe_and_shoulder
from ..readings.means import Mean, time_mean, with_error
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
TURNS = 3  # of the averaged flow, at least: the error of fewer turns is not known


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
    quantities = {**charge_quantities(case, case.charge), **slurry_quantities(case)}
    quantities["drive_power"] = drive_power(case, quantities)
    return Pass(number, folder, quantities, case.charge,
                map_noise(case.charge_windows), load[0] if load else np.nan, forces_apart(folder))


def charge_quantities(case: MillCase, charge: SolidsMap) -> dict[str, Mean]:
    """Readings of the charge of a MillCase; charge: its map. A thin charge has no centre of circulation: NaN."""
    windows = case.charge_windows

    def read(reading: Callable[[SolidsMap], ArrayLike]) -> list[Mean]:
        try:
            values = reading(charge)
            errors = with_error(reading, windows).error if len(windows) >= 4 else (np.nan, np.nan)
        except RuntimeError:
            values = errors = np.nan, np.nan
        return [Mean(float(value), float(error)) for value, error in zip(np.asarray(values), np.asarray(errors))]
    toe, shoulder = read(lambda one: toe_and_shoulder(one, case.radius, WALL))
    centre_x, centre_y = read(lambda one: circulation_centre(one, case.radius))
    return {"toe": toe, "shoulder": shoulder, "charge_x": centre_x, "charge_y": centre_y,
            "charge_power": Mean(case.result("power_W"), case.result("power_error_W"))}


def slurry_quantities(case: MillCase) -> dict[str, Mean]:
    """Centre and power of the slurry of a MillCase, with errors over whole turns; NaN for fewer than TURNS."""
    columns = known_balance(case)
    names = {"slurry_x": "x", "slurry_y": "y", "slurry_power": "power"}
    if columns is None:
        return {key: Mean(np.nan, np.nan) for key in names}
    return {key: Mean(time_mean(columns["Time"], columns[name], case.begin),
                      error_over_turns(columns["Time"], columns[name], case.begin, case.turn))
            for key, name in names.items()}


def feels_slurry(case: MillCase) -> bool:
    """Whether the balls of a MillCase felt a flow, and not only a pool's buoyancy."""
    fluid = (case.results or {}).get("fluid") or {}
    return fluid.get("kind") in ("slurry", "flow")


def known_balance(case: MillCase) -> dict[str, np.ndarray] | None:
    """Columns of slurryBalance; None without it, or if fewer turns than TURNS are averaged."""
    columns = case.balance
    # Times are rounded
    return columns if columns and columns["Time"][-1] - case.begin > (TURNS - 0.005) * case.turn else None


def drive_power(case: MillCase, quantities: dict[str, Mean]) -> Mean:
    """Power that the drive gives to balls and slurry together, W; NaN for fewer turns than TURNS.

    Balls that feel the slurry pass on to it what they take from the walls: the drive gives the power of the charge and
    that of the walls on the slurry. Balls that do not feel it give it power of their own, which is added."""
    columns = known_balance(case)
    if columns is None:
        return Mean(np.nan, np.nan)
    given = columns["power"]
    if feels_slurry(case):
        given = np.sum([values for name, values in columns.items() if name.startswith("power_")], axis=0)
    charge = quantities["charge_power"]
    error = error_over_turns(columns["Time"], given, case.begin, case.turn)
    return Mean(charge.value + time_mean(columns["Time"], given, case.begin), float(np.hypot(charge.error, error)))


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
    """Mean force of a flow on all balls over its averaged time, N: size by the flow (steps.csv) and by the balls
    (fluid.csv), and size of the difference over that of the flow's."""
    given: float
    taken: float
    disagreement: float


def given_force(case: MillCase) -> np.ndarray:
    """Mean force [3], N, that the flow of a MillCase gave to balls that moved at the same time, over its averaged time.
    RuntimeError without steps.csv."""
    steps = case.record.steps
    if steps is None:
        raise RuntimeError(f"{case.folder}: no postProcessing/flow/*/steps.csv, which slurryFoam writes")
    begin, end = steps["time_s"], np.append(steps["time_s"][1:], case.last)
    length = np.clip(np.minimum(end, case.last) - np.maximum(begin, case.begin), 0, None)
    return np.array([np.average(steps[f"given_force_{axis}_N"], weights=length) for axis in "xyz"])


def direct_case(folder: Path) -> MillCase:
    """The case of balls and flow that ran at the same time, of either machine. RuntimeError if it is not complete."""
    case = StirredCase(folder) if read_mill(folder, None).machine == StirredCase.machine else MillCase(folder)
    if case.flow is None or case.results is None:
        raise RuntimeError(f"{folder}: the flow or the results of the balls are missing; run it to its end")
    return case


def exchanged_forces(folder: Path) -> Exchanged:
    """Exchanged of a case whose balls and flow ran at the same time. RuntimeError without steps.csv or fluid.csv.

    Both forces are means over all time-steps: one of the flow acts on the balls until the next one."""
    case = direct_case(folder)
    assert case.flow is not None
    given = given_force(case)
    rows = read_csv(folder / "dumps" / "fluid.csv")
    begin, end = (case.flow.time0 + at for at in (case.begin, case.last))
    within = (rows["time_s"] > begin) & (rows["time_s"] <= end)
    taken = np.array([np.mean(rows[f"force_{axis}_N"][within]) for axis in "xyz"])
    sizes = [float(np.linalg.norm(force)) for force in (given, taken, given - taken)]
    return Exchanged(sizes[0], sizes[1], sizes[2] / sizes[0])


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
