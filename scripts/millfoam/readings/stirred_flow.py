# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of the slurry's flow in a stirred mill: torques and their balance, power, slip with its Froude and Reynolds
numbers, conservation."""
from dataclasses import dataclass

import numpy as np

from ..files.data_files import read_csv
from ..files.stirred_case import StirredCase
from .means import Mean
from .stirred_power import mean_from
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
    their errors are standard deviations between these times. froude: slip over the root of g d (ball density over
    slurry's - 1), NaN for balls that float."""
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
    froude: float
    reynolds: Mean

    @property
    def slurry_share(self) -> float:
        """Of the impeller's power, that of the slurry."""
        return self.slurry_power.value / (self.slurry_power.value + self.ball_power.value)


def over_times(values: list[float]) -> Mean:
    """Mean and standard deviation, NaN of a single value."""
    return Mean(float(np.mean(values)), float(np.std(values, ddof=1)) if len(values) > 1 else np.nan)


def power_on_balls(case: StirredCase, begin: float, end: float) -> Mean:
    """Mean power from the impeller to the balls, W: between two flow times (s) if the balls moved in that time, else
    that of the dry run."""
    if case.mill.flow("coupling") != "direct":
        return Mean(case.result("power_W"), case.result("power_error_W"))
    assert case.flow is not None
    energy = read_csv(case.dumps / "energy.csv")
    within = energy["time_s"] <= case.flow.time0 + end * (1 + 1e-9)
    return mean_from(energy["time_s"][within], energy["power_W"][within], case.flow.time0 + begin, case.turn)


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
    ball_power = power_on_balls(case, case.begin, float(time[-1]))
    return FlowTorques(torques, unbalanced, ball_power, ball_power.value / case.mill.omega + torques["impeller"].value)


def read_stirred_flow(case: StirredCase, flow: SlurryFlow) -> StirredFlowNumbers:
    """StirredFlowNumbers of a case and its written fields. RuntimeError without slurryBalance or the dry run."""
    found, columns = read_flow_torques(case), balance_of(case)
    mill, begin, time = case.mill, case.begin, columns["Time"]
    balls, slurry = mill.ball_density, mill.slurry("density_kg_m3")
    buoyant = mill.derived("gravity_m_s2") * mill.derived("charge", "sauter_diameter_m") * (balls / slurry - 1)
    root = float(np.sqrt(buoyant)) if buoyant > 0 else np.nan
    slip, reynolds = over_times(flow.slips), over_times(flow.reynolds)
    return StirredFlowNumbers(
        begin, float(time[-1]), (time[-1] - begin) / case.turn, found.torques, found.unbalanced,
        averaged(case, time, columns["power"]), found.ball_power,
        float(np.abs(columns["missing"]).max() / columns["holdUp"][0]),
        averaged(case, time, columns["z"]), slip, slip.value / root, reynolds)
