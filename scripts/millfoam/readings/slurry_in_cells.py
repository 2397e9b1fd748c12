# SPDX-License-Identifier: GPL-3.0-or-later
"""Place, torque and slip velocity of the slurry of a mill, from the cells of a flow's written times.

Angles: see shell_angles."""
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from ..files import foam
from ..files.flow_record import read_flow_record
from ..files.written_times import MillFlow
from .means import weighted_percentile
from .shell_angles import BIN, shell_angle, toe_and_shoulder

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


def place(flow: MillFlow, frame: Frame) -> np.ndarray:
    """x, y of the cells in the lab (m) at a frame's time."""
    return flow.turned(flow.centres[:, :2], frame.time).T


def centre(flow: MillFlow, frame: Frame) -> list[float]:
    """Centre (x, y) of the slurry's volume, m."""
    return [float((frame.slurry * at).sum() / frame.slurry.sum()) for at in place(flow, frame)]


def angular_momentum(flow: MillFlow, frame: Frame, density: float) -> float:
    """Angular momentum of the slurry about the mill's axis, kg m2/s."""
    x, y = place(flow, frame)
    return float(density * (frame.slurry * (x * frame.velocity[:, 1] - y * frame.velocity[:, 0])).sum())


def over_bins(flow: MillFlow, frame: Frame, points: np.ndarray, column: np.ndarray, keys: np.ndarray,
              bins: int) -> np.ndarray:
    """Volumes of slurry and fluid (m3) [2, bins] of a frame, shared between bins by its sample points; key -1: in
    none."""
    kept = keys >= 0
    per_point = [np.bincount(flow.column, volume)[column] / SAMPLES**2 for volume in (frame.slurry, frame.fluid)]
    return np.stack([np.bincount(keys[kept], volume[kept], minlength=bins) for volume in per_point])


def ring(flow: MillFlow, frame: Frame, points: np.ndarray, column: np.ndarray, height: float) -> np.ndarray:
    """Volumes of slurry and fluid [2, bins] of a ring inside the lifters' tips, as wide as the lifters' `height` (m).
    Between lifters, pockets of air and slurry carried over the top would blur both ends."""
    x, y = flow.turned(points, frame.time).T
    bins = round(360 / BIN)
    keys = np.floor((shell_angle(x, y, flow.omega) + 180) / BIN).astype(int) % bins
    within = np.abs(np.hypot(x, y) - (flow.radius - 1.5 * height)) <= height / 2
    return over_bins(flow, frame, points, column, np.where(within, keys, -1), bins)


def section(flow: MillFlow, frame: Frame, points: np.ndarray, column: np.ndarray, pixels: int) -> np.ndarray:
    """Volumes of slurry and fluid [2, pixels, pixels], row by row in y, over the mill's square."""
    x, y = (((at / flow.radius + 1) / 2 * pixels).astype(int).clip(0, pixels - 1)
            for at in flow.turned(points, frame.time).T)
    return over_bins(flow, frame, points, column, y * pixels + x, pixels**2).reshape(2, pixels, pixels)


def reynolds(frame: Frame, density: float, viscosity: float) -> tuple[np.ndarray, np.ndarray]:
    """Particle Reynolds numbers rho e |u_s - u| d/mu in the bed's cells with slurry, and the slurry's volume there
    (m3)."""
    bed = (frame.solidity >= BED) & (frame.slurry > 0)
    slip = np.linalg.norm(frame.balls[bed] - frame.velocity[bed], axis=1)
    number = density * (1 - frame.solidity[bed]) * slip * frame.diameter[bed] / viscosity
    return number, frame.slurry[bed]


@dataclass
class Shape:
    """Readings of the later part of a flow. Each of `numbers` is name -> (mean, half of the difference between the
    means over the two halves of that time): centre_x, centre_y (m), toe, shoulder (degrees), torque (N m), power
    (W/m)."""
    numbers: dict[str, tuple[float, float]]
    share: np.ndarray  # slurry's of the fluid [pixels, pixels] over the mill's square, NaN outside
    reynolds: np.ndarray
    weights: np.ndarray  # of the Reynolds numbers, m3
    steps: int
    columns: int  # of cells, in the mill's section

    def reynolds_percentiles(self, percents: ArrayLike) -> np.ndarray:
        """Reynolds numbers below which these percents of the slurry in the bed lie."""
        return weighted_percentile(self.reynolds, self.weights, percents)


def ratio(volumes: np.ndarray) -> np.ndarray:
    """Slurry over fluid, NaN where there is no fluid; volumes [2, …]."""
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(volumes[1] > 0, volumes[0] / volumes[1], np.nan)


def power_numbers(flow: MillFlow, frames: Sequence[Frame], centres: np.ndarray,
                  properties: dict[str, str]) -> dict[str, float]:
    """Torque (N m) on the slurry by walls and balls, and its power (W/m of the mill's length).

    Walls and balls balance the slurry's weight and change its angular momentum L: T = m g x_c + dL/dt. Only the mill
    drives the balls, so that the mill's power is omega T for the torque of walls and of balls."""
    density = float(properties["slurryDensity"])
    mass = density * np.mean([frame.slurry.sum() for frame in frames])
    gain = angular_momentum(flow, frames[-1], density) - angular_momentum(flow, frames[0], density)
    torque = mass * float(properties["gravity"]) * centres[:, 0].mean() + gain / (frames[-1].time - frames[0].time)
    return {"torque": torque, "power": torque * flow.omega / float(properties["length"])}


def numbers_of(flow: MillFlow, frames: Sequence[Frame], rings: np.ndarray,
               properties: dict[str, str]) -> dict[str, float]:
    """The numbers of Shape, as means over these frames with their rings [frames, 2, bins]."""
    centres = np.array([centre(flow, frame) for frame in frames])
    toe, shoulder = toe_and_shoulder(np.nan_to_num(ratio(rings.sum(axis=0))))
    return {"centre_x": centres[:, 0].mean(), "centre_y": centres[:, 1].mean(), "toe": toe, "shoulder": shoulder,
            **power_numbers(flow, frames, centres, properties)}


def read_shape(flow: MillFlow, begin: float, pixels: int = 60) -> Shape:
    """Shape of the slurry of a MillFlow over its written times from `begin` (s) on."""
    properties = foam.read_dictionary(flow.case / "constant" / "millProperties")
    frames = [read_frame(flow, time, path) for time, path in flow.frames if time >= begin - 1e-9]
    points, column = samples(flow)
    height = float(properties["lifterHeight"])
    rings = np.array([ring(flow, frame, points, column, height) for frame in frames])
    whole = numbers_of(flow, frames, rings, properties)
    half = len(frames) // 2 + 1  # both halves share the middle frame
    halves = [numbers_of(flow, frames[part], rings[part], properties) for part in (slice(half), slice(half - 1, None))]
    spread = {name: abs(halves[1][name] - halves[0][name]) / 2 for name in whole}
    pairs = [reynolds(frame, float(properties["slurryDensity"]), float(properties["slurryViscosity"]))
             for frame in frames]
    numbers, weights = (np.concatenate(part) for part in zip(*pairs))
    share = ratio(np.asarray(sum(section(flow, frame, points, column, pixels) for frame in frames)))
    return Shape({name: (whole[name], spread[name]) for name in whole}, share, numbers, weights,
                 count_steps(flow.case), len(flow.column_centres))


def count_steps(case: Path | str) -> int:
    """Number of time-steps of a case's flow with all restarts; 0 if slurryFoam wrote none."""
    steps = read_flow_record(case).steps
    return 0 if steps is None else len(steps["time_s"])
