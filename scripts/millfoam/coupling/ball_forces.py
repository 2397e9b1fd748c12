# SPDX-License-Identifier: GPL-3.0-or-later
"""What the fluid does to the balls, on voxels: the mean over a run in slurry.h5, and the file of forces that the balls
feel in the next pass (layout: FORMATS.md)."""
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from ..files.solids_file import open_hdf5

FIELDS = ("pressure_force", "exchange", "drag_force", "fluid_density", "solidity", "diameter")


@dataclass
class BallForces:
    """Mean over a run of what balls feel: a ball of volume V (m3) and velocity v feels
    V (pressure_force + drag_force - exchange v).

    voxel: a voxel's volume, m3; inside [nz, ny, nx], its share in the flow's mesh; solidity [nz, ny, nx] that the flow
    saw; pressure_force and drag_force [nz, ny, nx, 3], N/m3; exchange [nz, ny, nx], kg/(m3 s); fluid_density, kg/m3;
    diameter, Sauter mean, m; polydispersity: whether the drag has the factor of a mixture of sizes."""
    voxel: float
    inside: np.ndarray
    solidity: np.ndarray
    pressure_force: np.ndarray
    drag_force: np.ndarray
    exchange: np.ndarray
    fluid_density: np.ndarray
    diameter: np.ndarray
    polydispersity: bool = False

    def balls(self) -> np.ndarray:
        """Volume of the balls in each voxel [nz, ny, nx], m3."""
        return self.voxel * self.inside * self.solidity

    def density(self, velocity: np.ndarray) -> np.ndarray:
        """Force on the balls over their volume [nz, ny, nx, 3], N/m3; velocity: theirs [nz, ny, nx, 3], m/s."""
        return self.pressure_force + self.drag_force - self.exchange[..., None] * velocity


def read_ball_forces(path: Path | str) -> BallForces:
    """BallForces of the mean over the run in a slurry.h5 or in a file of forces. RuntimeError if the file is not
    complete, or was written by a version that did not know the forces, or by a flow that ended before its averages."""
    with open_hdf5(path) as file:
        if file.attrs.get("complete", 0) != 1:
            raise RuntimeError(f"{path}: not complete; let the flow run to its end")
        if "mean" not in file:
            raise RuntimeError(f"{path}: no mean over the run: the flow ended before its averages' start")
        if "balls" not in file["mean"]:
            raise RuntimeError(f"{path}: no forces on the balls (/mean/balls): run the flow again, with slurryFoam and "
                               "balls")
        grid, balls = file["grid"].attrs, file["mean/balls"]
        sides = (np.asarray(grid["upper"]) - np.asarray(grid["lower"])) / np.asarray(grid["shape"])
        fields = {name: balls[name][()] for name in FIELDS}
        _refuse_unknown(path, fields)
        attributes = {**(file["balls"].attrs if "balls" in file else {}), **balls.attrs}
        return BallForces(float(np.prod(sides)), file["mean/insideFraction"][()],
                          polydispersity=bool(attributes.get("polydispersity", 0)), **fields)


def _refuse_unknown(path: Path | str, fields: dict[str, np.ndarray]) -> None:
    for name, values in fields.items():
        bad = np.argwhere(~np.isfinite(values))
        if len(bad):
            raise RuntimeError(f"{path}: /mean/balls/{name} is not finite in the voxel z, y, x = "
                               f"{', '.join(map(str, bad[0][:3]))}; run the flow again")


def relaxed(latest: BallForces, before: BallForces, share: float) -> BallForces:
    """BallForces with `share` of the latest ones and the rest of those before, voxel by voxel; solidity, density and
    diameter are the latest. ValueError if their voxels differ."""
    if latest.solidity.shape != before.solidity.shape or not np.isclose(latest.voxel, before.voxel):
        raise ValueError(f"forces on {before.solidity.shape} voxels of {before.voxel:g} m3 and on "
                         f"{latest.solidity.shape} of {latest.voxel:g} m3; expected the same voxels")
    mixed = {name: share * getattr(latest, name) + (1 - share) * getattr(before, name)
             for name in ("pressure_force", "drag_force", "exchange")}
    return replace(latest, **mixed)


def write_ball_forces(path: Path, forces: BallForces, slurry: Path | str, notes: dict[str, Any]) -> None:
    """Writes a file of forces: laid out as the slurry.h5 at `slurry`, of which it takes grid and head, with these
    forces as the mean over the run and without windows. notes: attributes of the file. It is written under another name
    and renamed."""
    part = path.with_name(path.name + ".part")
    with open_hdf5(slurry) as source, h5py.File(part, "w") as file:
        _copy_attributes(source, file)
        file.attrs.update(notes)
        _copy_attributes(source["grid"], file.create_group("grid"))
        _copy_attributes(source["balls"], file.create_group("balls"))
        mean = file.create_group("mean")
        _copy_attributes(source["mean"], mean)
        mean["insideFraction"] = forces.inside
        group = mean.create_group("balls")
        _copy_attributes(source["mean/balls"], group)
        for name in FIELDS:
            group[name] = getattr(forces, name)
            _copy_attributes(source[f"mean/balls/{name}"], group[name])
    part.replace(path)


def _copy_attributes(source: Any, target: Any) -> None:
    for name, value in source.attrs.items():
        target.attrs[name] = value


def total_force(forces: BallForces, velocity: np.ndarray) -> np.ndarray:
    """Force of the fluid on all balls [3], N; velocity: theirs [nz, ny, nx, 3], m/s."""
    return (forces.balls()[..., None] * forces.density(velocity)).sum(axis=(0, 1, 2))


def disagreement(applied: BallForces, felt: BallForces, velocity: np.ndarray) -> float:
    """Difference of two forces on the same balls over the second: sum of balls |applied - felt| over that of |felt|;
    velocity: the balls' [nz, ny, nx, 3], m/s. The balls are those of `felt`."""
    volume = felt.balls()
    felt_density = felt.density(velocity)
    apart = np.linalg.norm(applied.density(velocity) - felt_density, axis=-1)
    return float((volume * apart).sum() / (volume * np.linalg.norm(felt_density, axis=-1)).sum())


def sampled_velocity(path: Path | str, centres: Sequence[np.ndarray]) -> np.ndarray:
    """The balls' mean velocity over a solids.h5 on other voxels [nz, ny, nx, 3], m/s: each takes that of the voxel of
    solids.h5 that holds its centre, 0 where there are no balls. centres: x [nx], y [ny], z [nz], m."""
    with open_hdf5(path) as file:
        grid = file["grid"].attrs
        lower, upper, shape = (np.asarray(grid[name]) for name in ("lower", "upper", "shape"))
        solidity, velocity = file["solidity"], file["velocity"]
        balls, flux = np.zeros(solidity.shape[1:]), np.zeros(velocity.shape[1:])
        for window in range(len(solidity)):
            phi = solidity[window]
            balls += phi
            flux += phi[..., None] * velocity[window]
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = np.where(balls[..., None] > 0, flux / balls[..., None], 0.0)
    places = []
    for at, low, high, count in zip(centres, lower, upper, shape):
        found = np.floor((np.asarray(at) - low) / (high - low) * count).astype(int)
        places.append(np.clip(found, 0, int(count) - 1))
    return mean[np.ix_(places[2], places[1], places[0])]


def voxel_centres(path: Path | str) -> list[np.ndarray]:
    """Centres of the voxels of a slurry.h5 along x, y and z, m."""
    with open_hdf5(path) as file:
        grid = file["grid"].attrs
        return [low + (np.arange(int(count)) + 0.5) * (high - low) / int(count)
                for low, high, count in zip(grid["lower"], grid["upper"], grid["shape"])]
