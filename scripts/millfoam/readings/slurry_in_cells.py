# SPDX-License-Identifier: GPL-3.0-or-later
"""Place and slip velocity of the slurry of a mill, from the cells of a flow's written times.

Angles: see shell_angles."""
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..files.flow_record import read_flow_record
from ..files.written_times import MillFlow
from .shell_angles import BIN, shell_angle

SAMPLES = 4  # along each side of a column's quad
BED = 0.2  # lowest solidity of the bed


def samples(flow: MillFlow) -> tuple[np.ndarray, np.ndarray]:
    """Points (m, at flow time 0) spread evenly over every column's section, [SAMPLES^2 columns, 2], and their
    columns."""
    quads, column = flow.end_wall()
    at = (np.arange(SAMPLES) + 0.5) / SAMPLES
    u, v = (grid.ravel() for grid in np.meshgrid(at, at))
    weights = np.stack([(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v])
    points = np.einsum("qcx,cs->qsx", quads, weights)
    return points.reshape(-1, 2), np.repeat(column, SAMPLES**2)


@dataclass
class Frame:
    """The flow at a written time (s), cell by cell: slurry and fluid (m3), solidity, velocities (m/s) of fluid and
    balls, and the balls' diameter (m)."""
    time: float
    slurry: np.ndarray
    fluid: np.ndarray
    solidity: np.ndarray
    velocity: np.ndarray
    balls: np.ndarray
    diameter: np.ndarray


def read_frame(flow: MillFlow, time: float, path: Path) -> Frame:
    """A written time of a flow whose balls displace slurry."""
    alpha, solidity, velocity, balls, diameter = (
        flow.field(name, path) for name in ("alpha.slurry", "solidity", "U", "solidsVelocity", "solidsDiameter"))
    fluid = flow.volumes * (1 - solidity)
    return Frame(time, alpha * fluid, fluid, solidity, velocity, balls, diameter)


def over_bins(flow: MillFlow, volumes: Sequence[np.ndarray], column: np.ndarray, keys: np.ndarray,
              bins: int) -> np.ndarray:
    """Volumes of cells (m3), each [cells], shared between bins by sample points: [volumes, bins]; key -1: in none."""
    kept = keys >= 0
    per_point = [np.bincount(flow.column, volume)[column] / SAMPLES**2 for volume in volumes]
    return np.stack([np.bincount(keys[kept], volume[kept], minlength=bins) for volume in per_point])


def ring(flow: MillFlow, frame: Frame, points: np.ndarray, column: np.ndarray, height: float) -> np.ndarray:
    """Volumes of slurry and fluid [2, bins] of a ring inside the lifters' tips, as wide as the lifters' `height` (m).
    Between lifters, pockets of air and slurry carried over the top would blur both ends."""
    x, y = flow.turned(points, frame.time).T
    bins = round(360 / BIN)
    keys = np.floor((shell_angle(x, y, flow.omega) + 180) / BIN).astype(int) % bins
    within = np.abs(np.hypot(x, y) - (flow.radius - 1.5 * height)) <= height / 2
    return over_bins(flow, (frame.slurry, frame.fluid), column, np.where(within, keys, -1), bins)


def section(flow: MillFlow, frame: Frame, points: np.ndarray, column: np.ndarray, pixels: int) -> np.ndarray:
    """Volumes of slurry, fluid and solids [3, pixels, pixels] (m3), row by row in y, over the mill's square."""
    x, y = (((at / flow.radius + 1) / 2 * pixels).astype(int).clip(0, pixels - 1)
            for at in flow.turned(points, frame.time).T)
    volumes = frame.slurry, frame.fluid, flow.volumes - frame.fluid
    return over_bins(flow, volumes, column, y * pixels + x, pixels**2).reshape(3, pixels, pixels)


def reynolds(frame: Frame, density: float, viscosity: float) -> tuple[np.ndarray, np.ndarray]:
    """Particle Reynolds numbers rho e |u_s - u| d/mu in the bed's cells with slurry, and the slurry's volume there
    (m3)."""
    bed = (frame.solidity >= BED) & (frame.slurry > 0)
    slip = np.linalg.norm(frame.balls[bed] - frame.velocity[bed], axis=1)
    number = density * (1 - frame.solidity[bed]) * slip * frame.diameter[bed] / viscosity
    return number, frame.slurry[bed]


def ratio(volumes: np.ndarray) -> np.ndarray:
    """Slurry over fluid, NaN where there is no fluid; volumes [2, …]."""
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(volumes[1] > 0, volumes[0] / volumes[1], np.nan)


def count_steps(case: Path | str) -> int:
    """Number of time-steps of a case's flow with all restarts; 0 if slurryFoam wrote none."""
    steps = read_flow_record(case).steps
    return 0 if steps is None else len(steps["time_s"])
