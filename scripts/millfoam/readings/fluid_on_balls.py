# SPDX-License-Identifier: GPL-3.0-or-later
"""The force of a flow's fluid on the balls, from slurry.h5: what the fluid gives, the balls take."""
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..files.slurry_file import BallForces, read_ball_forces


@dataclass(frozen=True)
class FluidOnBalls:
    """Force on all balls: pressure, with the buoyancy, and drag [3] (N); torque about the mill's axis (N m); volume of
    the balls that the flow saw (m3); weight: of these balls (N)."""
    pressure: np.ndarray
    drag: np.ndarray
    torque: float
    volume: float
    weight: float

    @property
    def force(self) -> np.ndarray:
        """Pressure and drag together [3], N."""
        return self.pressure + self.drag

    @property
    def over_weight(self) -> float:
        """Size of the force over the balls' weight."""
        return float(np.linalg.norm(self.force)) / self.weight


def drag_density(forces: BallForces, velocity: np.ndarray) -> np.ndarray:
    """Drag on balls of this velocity [nz, ny, nx, 3] (m/s) over their volume [nz, ny, nx, 3], N/m3."""
    return forces.drag_force - forces.exchange[..., None] * velocity


def force_density(forces: BallForces, velocity: np.ndarray) -> np.ndarray:
    """Force on balls of this velocity [nz, ny, nx, 3] (m/s) over their volume [nz, ny, nx, 3], N/m3."""
    return forces.pressure_force + drag_density(forces, velocity)


def force_on_charge(forces: BallForces, ball_density: float) -> FluidOnBalls:
    """FluidOnBalls of BallForces, on the balls that the flow saw; ball_density: theirs (kg/m3)."""
    volumes = forces.volumes()[..., None]
    volume = float(volumes.sum())
    pressure, drag = volumes * forces.pressure_force, volumes * drag_density(forces, forces.velocity)
    y, x = (low + (high - low) * (np.arange(count) + 0.5) / count for low, high, count in zip(
        forces.lower[1::-1], forces.upper[1::-1], forces.inside.shape[1:]))
    force = (pressure + drag).sum(axis=0)
    torque = float((x * force[..., 1] - y[:, None] * force[..., 0]).sum())
    return FluidOnBalls(pressure.sum(axis=(0, 1, 2)), drag.sum(axis=(0, 1, 2)), torque, volume,
                        float(ball_density * np.linalg.norm(forces.gravity) * volume))


def fluid_on_balls(slurry: Path | str, ball_density: float, begin: float | None = None,
                   end: float | None = None) -> FluidOnBalls:
    """FluidOnBalls of a slurry.h5, with the balls' density (kg/m3): of the windows in [begin, end) of DEM time (s), or
    without times of the mean over the run. RuntimeError if slurry.h5 has no forces on balls, or no such time."""
    return force_on_charge(read_ball_forces(slurry, begin, end), ball_density)
