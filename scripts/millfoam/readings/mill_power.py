# SPDX-License-Identifier: GPL-3.0-or-later
"""Power of a tumbling mill: what its walls give to balls and slurry, and what the drive gives."""
import numpy as np

from ..files.mill_case import MillCase
from .batches import mean_over_turns, turn_means, whole_turns
from .means import Mean, turns_mean

TURNS = 3  # of the averaged flow, at least: the error of two has one degree of freedom, and is hardly known
# Degrees of freedom of results.json's power_error_W of a tumbling mill: ten batches about a straight line, as millDem
# makes it (dem_driver/steady_state.cpp)
DRY_FREEDOM = 8
UNKNOWN = Mean(np.nan, np.nan)


def feels_slurry(case: MillCase) -> bool:
    """Whether the balls of a MillCase felt a flow, and not only a pool's buoyancy."""
    return fluid_kind(case) in ("slurry", "flow")


def lies_in_pool(case: MillCase) -> bool:
    """Whether the balls of a MillCase felt the buoyancy of a pool at rest, and no flow."""
    return fluid_kind(case) == "buoyancy"


def moved_with_flow(case: MillCase) -> bool:
    """Whether the balls of a MillCase moved at the same time as its flow."""
    return case.flow is not None and fluid_kind(case) == "flow"


def fluid_kind(case: MillCase) -> str | None:
    """What the balls of a MillCase felt, as in results.json: buoyancy, slurry or flow; None of a dry run."""
    return ((case.results or {}).get("fluid") or {}).get("kind")


def written_balance(case: MillCase) -> dict[str, np.ndarray] | None:
    """Columns of slurryBalance up to the flow's last written time, at which the averages of the balls end, too; None
    without a row up to then."""
    if case.balance is None:
        return None
    until = int(np.searchsorted(case.balance["Time"], case.last * (1 + 1e-9), side="right"))
    return {name: values[:until] for name, values in case.balance.items()} if until > 0 else None


def known_balance(case: MillCase, fewest: int = TURNS) -> dict[str, np.ndarray] | None:
    """written_balance; None, too, if fewer turns than `fewest` are averaged."""
    columns = written_balance(case)
    return columns if columns and whole_turns(columns["Time"][-1] - case.begin, case.turn) >= fewest else None


def during_flow(case: MillCase, table: dict[str, np.ndarray] | None) -> tuple[np.ndarray, np.ndarray] | None:
    """Flow times (s) and power (W) [n] of a table of balls that moved at the same time as the flow, up to the flow's
    end; None for other balls, or without the table."""
    if table is None or case.flow is None or not moved_with_flow(case):
        return None
    times = table["time_s"] - case.flow.time0
    within = times <= case.last * (1 + 1e-9)
    return times[within], table["power_W"][within]


def flow_span(case: MillCase) -> tuple[float, float] | None:
    """DEM times (s) between which power, torques and speed of balls that moved at the same time as the flow are
    averaged: those of the flow's averages. None of other balls."""
    if case.flow is None or not moved_with_flow(case):
        return None
    return case.flow.time0 + case.begin, case.flow.time0 + case.last


def result_power(case: MillCase) -> Mean:
    """Power that the walls give to the balls by results.json, W, from power_from_s on; its error is NaN where millDem
    does not know it."""
    return Mean(case.result("power_W"), case.result("power_error_W"), DRY_FREEDOM)


def charge_power(case: MillCase) -> Mean:
    """Power that the walls give to the balls, W. Of balls that moved at the same time as the flow it is that of the
    flow's last whole averaged turns, if there are two or more; otherwise result_power."""
    series = during_flow(case, case.energy)
    found = mean_over_turns(*series, case.begin, case.turn) if series else None
    return found or result_power(case)


def power_begin(case: MillCase) -> float:
    """DEM time (s) from which charge_power is averaged: the begin of the flow's last whole averaged turns, or
    power_from_s of results.json. Results of millFoam 0.2.0 and before have no power_from_s: their power is that of the
    steady time."""
    series = during_flow(case, case.energy)
    if case.flow and series:
        end = float(series[0][-1])
        turns = whole_turns(end - case.begin, case.turn)
        if turns > 1:
            return case.flow.time0 + end - turns * case.turn
    return case.result("power_from_s" if "power_from_s" in (case.results or {}) else "steady_from_s")


def slurry_power(case: MillCase, fewest: int = TURNS) -> Mean:
    """Torque that walls and balls give to the slurry, times the mill's speed, W; NaN for fewer turns than `fewest`, two
    or more."""
    columns = known_balance(case, fewest)
    found = columns and mean_over_turns(columns["Time"], columns["power"], case.begin, case.turn)
    return found or UNKNOWN


def given_power(case: MillCase) -> Mean:
    """Power that walls and balls give to the slurry, W: by the walls, torque on each that turns times the mill's speed;
    by balls that moved at the same time as the flow, their force times their velocity. NaN for other balls, and for
    fewer turns than TURNS."""
    columns, series = known_balance(case), during_flow(case, case.fluid_on_balls)
    if columns is None or series is None:
        return UNKNOWN
    return sum_over_turns(turn_means(columns["Time"], by_walls(columns), case.begin, case.turn),
                          -turn_means(*series, case.begin, case.turn))


def drive_power(case: MillCase, fewest: int = TURNS) -> Mean:
    """Power that the drive gives to balls and slurry together, W; NaN for fewer turns than `fewest`, two or more.

    Balls that feel the slurry pass on to it what they take from the walls: the drive gives the power of the charge and
    that of the walls on the slurry. If they moved at the same time as the flow, both are of the same turns, and the
    error is that of their sums. Balls that do not feel the slurry give it power of their own, which is added. A flow
    without balls has the slurry's power alone. NaN, too, for balls in a pool at rest: what moves it is not known."""
    if not case.has_balls:
        return slurry_power(case, fewest)
    columns = known_balance(case, fewest)
    if columns is None or lies_in_pool(case):
        return UNKNOWN
    given = by_walls(columns) if feels_slurry(case) else columns["power"]
    to_slurry = turn_means(columns["Time"], given, case.begin, case.turn)
    series = during_flow(case, case.energy)
    if series:
        return sum_over_turns(to_slurry, turn_means(*series, case.begin, case.turn), fewest)
    return charge_power(case) + turns_mean(to_slurry)


def by_walls(columns: dict[str, np.ndarray]) -> np.ndarray:
    """Power (W) [n] that all walls give to the slurry, of the columns of slurryBalance."""
    return np.sum([values for name, values in columns.items() if name.startswith("power_")], axis=0)


def sum_over_turns(first: np.ndarray, second: np.ndarray, fewest: int = TURNS) -> Mean:
    """Mean of the sums of two readings of successive turns [n], which end at the same time. They may scatter alike: the
    error is that of their sum in each turn. NaN if both have fewer turns in common than `fewest`, two or more."""
    count = min(len(first), len(second))
    return turns_mean(first[-count:] + second[-count:]) if count >= fewest else UNKNOWN
