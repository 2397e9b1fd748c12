# SPDX-License-Identifier: GPL-3.0-or-later
"""The force of a flow's fluid on the balls, from slurry.h5 and solids.h5: what the fluid gives, the balls take."""
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..files.slurry_file import BallForces, read_ball_forces
from ..files.solids_file import VoxelCharge, read_voxels, recorded_span, span_of_flow


@dataclass(frozen=True)
class FluidOnBalls:
    """Force on all balls: pressure, with the buoyancy, and drag [3] (N); volume of the balls that the flow saw (m3);
    weight: of these balls (N)."""
    pressure: np.ndarray
    drag: np.ndarray
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


def drag_density(forces: BallForces, charge: VoxelCharge) -> np.ndarray:
    """Drag on the balls of a VoxelCharge over their volume [nz, ny, nx, 3], N/m3."""
    axes = [low + (high - low) * (np.arange(count) + 0.5) / count
            for low, high, count in zip(forces.lower, forces.upper, forces.inside.shape[::-1])]
    z, y, x = np.meshgrid(*axes[::-1], indexing="ij")
    velocity = charge.velocity_at(np.stack([x, y, z], axis=-1))
    return forces.drag_force - forces.exchange[..., None] * velocity


def force_on_charge(forces: BallForces, charge: VoxelCharge, ball_density: float) -> FluidOnBalls:
    """FluidOnBalls of BallForces, with the velocities of a VoxelCharge and the balls' density (kg/m3). The exchange
    coefficient and the balls' velocity are means over time each: what they have in common over time is left out."""
    volumes = forces.volumes()[..., None]
    volume = float(volumes.sum())
    pressure = (volumes * forces.pressure_force).sum(axis=(0, 1, 2))
    return FluidOnBalls(pressure, (volumes * drag_density(forces, charge)).sum(axis=(0, 1, 2)), volume,
                        float(ball_density * np.linalg.norm(forces.gravity) * volume))


def fluid_on_balls(slurry: Path | str, solids: Path | str, ball_density: float, begin: float | None = None,
                   end: float | None = None) -> FluidOnBalls:
    """FluidOnBalls of a slurry.h5 and the solids.h5 of its flow, with the balls' density (kg/m3): of the windows in
    [begin, end) of DEM time (s), or without times of the mean over the run. A flow longer than solids.h5 takes the
    velocities of all of it. RuntimeError if slurry.h5 has no forces on balls, or a file has no such time."""
    forces = read_ball_forces(slurry, begin, end)
    span = span_of_flow(*recorded_span(solids), forces.begin, forces.end)
    return force_on_charge(forces, read_voxels(solids, *span), ball_density)
