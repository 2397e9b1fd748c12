# SPDX-License-Identifier: GPL-3.0-or-later
"""Readings of a stirred mill's balls: torques on its parts, power, speed of the balls, dimensionless numbers."""
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..files.data_files import read_csv
from ..files.dumps import numbered_dumps, read_balls, read_timestep
from ..files.stirred_case import StirredCase
from .batches import batch_means, whole_turns
from .means import Mean, turns_mean
from .mill_power import flow_span
from .power_models import bulk_density

DUMPS = 400  # of which the mean speed is taken, at most, at equal distances


def mean_from(times: np.ndarray, values: np.ndarray, begin: float, turn: float) -> Mean:
    """Mean of values [n] at equally spaced times [n] (s) from `begin` (s) on, over the last whole turns of `turn` s
    with their error; if fewer than two fit, over all of that time, with the error NaN. A value is that of the time
    since the one before: that of a record at `begin` is not read."""
    turns = turns_of_records(times, begin, turn)
    if turns > 1:
        return turns_mean(batch_means(times, values, times[-1] - turns * turn, turn, turns))
    late = times > begin + interval_of(times) / 2 - 1e-6 * turn
    return Mean(float(values[late].mean() if late.any() else values[-1]), np.nan)


def turns_of_records(times: np.ndarray, begin: float, turn: float) -> int:
    """Whole turns of `turn` s in equally spaced times [n] (s) from `begin` (s) on. Records do not meet begin and end:
    the turns may begin up to a record before."""
    first = times[times >= begin - 1e-6 * turn][:1]
    return whole_turns(times[-1] - first[0] + interval_of(times), turn) if len(first) else 0


def interval_of(times: np.ndarray) -> float:
    """Between equally spaced times [n], s."""
    return float(np.ptp(times) / max(len(times) - 1, 1))


def mean_speed(dumps: Path | str, begin: float, turn: float, end: float = np.inf) -> Mean:
    """Mean speed of all balls in the dumps of a folder from a DEM time on (s), m/s, and its error over whole turns of
    `turn` s; end: of the last of these dumps, s. RuntimeError without such dumps."""
    timestep = read_timestep(dumps)
    late = [(step * timestep, path) for step, path in numbered_dumps(dumps)
            if begin - timestep / 2 <= step * timestep <= end + timestep / 2]
    if not late:
        raise RuntimeError(f"{dumps}: no dump from {begin:g} s on")
    late = late[::-(-len(late) // DUMPS)]
    return mean_from(np.array([time for time, _ in late]), np.array([speed_in(path) for _, path in late]), begin, turn)


def speed_in(path: Path) -> float:
    """Mean speed of the balls in a dump, m/s."""
    return float(np.linalg.norm(read_balls(path, "vx", "vy", "vz"), axis=1).mean())


def power_number(power: float, density: float, omega: float, diameter: float) -> float:
    """P / (rho N^3 D^5) of a power P (W), a density rho (kg/m3), an impeller's angular speed (rad/s; N is in turns per
    second) and its diameter D from tip to tip (m)."""
    return power / (density * (abs(omega) / (2 * np.pi))**3 * diameter**5)


def torque_coefficient(torque: float, density: float, omega: float, diameter: float) -> float:
    """|T| / (rho omega^2 R^5) of a torque T (N m), a density rho (kg/m3), an angular speed (rad/s) and a radius R =
    diameter / 2 (m)."""
    return abs(torque) / (density * omega**2 * (diameter / 2)**5)


@dataclass(frozen=True)
class StirredNumbers:
    """Of the averaged time of the balls (balls_span). power: W; torques: {part: N m} about +z; balance: torque on the
    parts at rest over that on the impeller, 1 if no angular momentum is missing; speed: of the balls, m/s, None without
    dumps; density: bulk density of the resting balls, kg/m3; power_number, torque_coefficient: with this density;
    torque_over_weight: impeller's torque over the balls' weight times the tips' radius, a coefficient of friction;
    per_mass: W/kg of balls; per_slurry: W/m3 of slurry, None without slurry."""
    power: Mean
    torques: dict[str, Mean]
    balance: float
    speed: Mean | None
    density: float
    power_number: Mean
    torque_coefficient: Mean
    torque_over_weight: Mean
    per_mass: Mean
    per_slurry: Mean | None


def scaled(mean: Mean, factor: float) -> Mean:
    """A mean and its error times a factor above 0."""
    return Mean(mean.value * factor, mean.error * factor, mean.freedom)


def balls_span(case: StirredCase) -> tuple[float, float]:
    """DEM times (s) between which power, torques and speed of the balls are averaged: mill_power.flow_span of balls
    that moved at the same time as the flow; of others from the time on that is asked for, or from that on at which the
    charge is steady, to the end of the run. Where two turns fit, their means are of the last whole ones
    (averaged_span)."""
    span = flow_span(case)
    if span:
        return span
    # With a flow, the time that is asked for is one of the flow
    asked = case.asked_begin if case.flow is None else None
    return (case.result("steady_from_s") if asked is None else asked,
            case.result("begin_s") + case.result("duration_s"))


def averaged_span(case: StirredCase) -> tuple[float, float]:
    """DEM times (s) that balls_power is a mean of: the last whole turns of balls_span if two fit, otherwise all of
    it."""
    begin, end = balls_span(case)
    if not case.energy:
        return begin, end
    times = case.energy["time_s"]
    times = times[times <= end * (1 + 1e-9)]
    turns = turns_of_records(times, begin, case.turn) if len(times) else 0
    return (float(times[-1]) - turns * case.turn, float(times[-1])) if turns > 1 else (begin, end)


def mean_in_span(case: StirredCase, table: str, name: str) -> Mean:
    """Mean of a column of a table of the balls over balls_span, by mean_from."""
    columns, (begin, end) = read_csv(case.dumps / table), balls_span(case)
    times = columns["time_s"]
    if begin >= times[-1]:
        raise RuntimeError(f"{case.folder}: averages from {begin:g} s on; expected less than the end of the balls' "
                           f"run, {times[-1]:g} s")
    within = times <= end * (1 + 1e-9)
    return mean_from(times[within], columns[name][within], begin, case.turn)


def balls_power(case: StirredCase) -> Mean:
    """Power that the impeller gives to the balls over balls_span, W."""
    return mean_in_span(case, "energy.csv", "power_W")


def read_stirred(case: StirredCase) -> StirredNumbers:
    """StirredNumbers of a case. RuntimeError for a file that is missing or cannot be read."""
    power = balls_power(case)
    found = {part: mean_in_span(case, "torques.csv", f"{part}_Nm") for part in case.parts}
    impeller = found["impeller"]
    at_rest = sum(mean.value for part, mean in found.items() if part != "impeller")
    mill, mass, diameter = case.mill, case.mill.derived("charge", "mass_kg"), 2 * case.tip_radius
    density = bulk_density(mill.ball_density, mill.derived("charge", "resting_solidity"))
    gravity = mill.derived("gravity_m_s2")
    try:
        begin, end = balls_span(case)
        speed = mean_speed(case.dumps, begin, case.turn, end)
    except RuntimeError:
        speed = None
    volume = case.slurry_volume
    return StirredNumbers(
        power, found, -at_rest / impeller.value, speed, density,
        scaled(power, power_number(1.0, density, case.omega, diameter)),
        scaled(Mean(abs(impeller.value), impeller.error), torque_coefficient(1.0, density, case.omega, diameter)),
        scaled(Mean(abs(impeller.value), impeller.error), 1 / (mass * gravity * case.tip_radius)),
        scaled(power, 1 / mass), scaled(power, 1 / volume) if volume else None)
