# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of the slurry's flow in a stirred mill: torques and their balance, power, slip with its Froude and Reynolds
numbers, conservation."""
from dataclasses import dataclass

import numpy as np

from ..files.stirred_case import StirredCase
from .means import Mean, mean_of_series
from .slurry_conservation import missing_share
from .stirred_power import balls_power, mean_from, scaled
from .stirred_slurry import SlurryFlow

WALLS = ("impeller", "shell", "base", "lid")


@dataclass(frozen=True)
class StirredFlowNumbers:
    """Of the averaged time of a flow, from begin to end (s), `turns` of the impeller. torques: {impeller, shell, base,
    lid, balls, all: N m} on the slurry about +z; balls is missing in flows of millFoam 0.2.0 and before. unbalanced:
    torque of all minus those of walls and balls, N m, None without that of the balls; it is the error of the mesh and
    of the time-step. slurry_power: of the impeller on the slurry, ball_power: on the balls, W; of balls that feel the
    slurry in the same time, else of the dry run. missing: slurry over the hold-up. centre: height of its centre, m.
    slip (m/s), froude, reynolds: medians over the cells by the volume of their balls, means over the written times;
    their errors are of blocks of these times. froude: slip over the root of g d (ball density over slurry's - 1), NaN
    for balls that float."""
    begin: float
    end: float
    turns: float
    torques: dict[str, Mean]
    unbalanced: Mean | None
    slurry_power: Mean
    ball_power: Mean
    missing: float
    centre: Mean
    slip: Mean
    froude: Mean
    reynolds: Mean

    @property
    def slurry_share(self) -> Mean:
        """Of the impeller's power, that of the slurry; its error takes those of both powers as independent."""
        slurry, balls = self.slurry_power, self.ball_power
        whole = slurry.value + balls.value
        error = np.hypot(balls.value * slurry.error, slurry.value * balls.error) / whole**2
        return Mean(slurry.value / whole, float(error), min(slurry.freedom, balls.freedom))


def averaged(case: StirredCase, time: np.ndarray, values: np.ndarray) -> Mean:
    """Mean of values at the times (s) of time-steps, from the begin of the averages on."""
    even = np.arange(case.begin, time[-1], np.median(np.diff(time)))
    return mean_from(even, np.interp(even, time, values), case.begin, case.turn)


def balance_of(case: StirredCase) -> dict[str, np.ndarray]:
    """Columns of slurryBalance; RuntimeError without them."""
    if case.balance is None:
        raise RuntimeError(f"{case.folder}: no table of slurryBalance; add it to controlDict")
    return case.balance


@dataclass(frozen=True)
class FlowTorques:
    """Means over the averaged time: torques and unbalanced as in StirredFlowNumbers, N m about +z; ball_power as there,
    W; impeller: torque of the impeller on balls and slurry together, N m."""
    torques: dict[str, Mean]
    unbalanced: Mean | None
    ball_power: Mean
    impeller: float


def read_flow_torques(case: StirredCase) -> FlowTorques:
    """FlowTorques of a case. RuntimeError without slurryBalance or the dry run."""
    columns = balance_of(case)
    time = columns["Time"]
    parts = [*WALLS, "balls", "all"] if "torque_balls" in columns else [*WALLS, "all"]
    torques = {part: averaged(case, time, columns[f"torque_{part}"]) for part in parts}
    given = np.sum([columns[f"torque_{part}"] for part in parts if part != "all"], axis=0)
    unbalanced = averaged(case, time, columns["torque_all"] - given) if "balls" in torques else None
    ball_power = balls_power(case)
    return FlowTorques(torques, unbalanced, ball_power, ball_power.value / case.mill.omega + torques["impeller"].value)


def read_stirred_flow(case: StirredCase, flow: SlurryFlow) -> StirredFlowNumbers:
    """StirredFlowNumbers of a case and its written fields. RuntimeError without slurryBalance or the dry run."""
    found, columns = read_flow_torques(case), balance_of(case)
    mill, begin, time = case.mill, case.begin, columns["Time"]
    balls, slurry = mill.ball_density, mill.slurry("density_kg_m3")
    buoyant = mill.derived("gravity_m_s2") * mill.derived("charge", "sauter_diameter_m") * (balls / slurry - 1)
    root = float(np.sqrt(buoyant)) if buoyant > 0 else np.nan
    slip, reynolds = mean_of_series(flow.slips), mean_of_series(flow.reynolds)
    return StirredFlowNumbers(
        begin, float(time[-1]), (time[-1] - begin) / case.turn, found.torques, found.unbalanced,
        averaged(case, time, columns["power"]), found.ball_power,
        missing_share(columns),
        averaged(case, time, columns["z"]), slip, scaled(slip, 1 / root), reynolds)
