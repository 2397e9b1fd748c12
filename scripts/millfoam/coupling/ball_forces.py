# SPDX-License-Identifier: GPL-3.0-or-later
"""Forces of the fluid on the balls from pass to pass: relaxed, written for millDem, compared."""
from dataclasses import replace
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from ..files.slurry_file import BallForces
from ..files.solids_file import open_hdf5
from ..readings.fluid_on_balls import force_density

# In /mean/balls
FIELDS = ("pressure_force", "exchange", "drag_force", "velocity", "fluid_density", "solidity", "diameter")


def relaxed(latest: BallForces, before: BallForces, share: float) -> BallForces:
    """BallForces with `share` of the latest ones and the rest of those before, voxel by voxel; what belongs
    to the balls is the latest. ValueError if their voxels differ."""
    if latest.solidity.shape != before.solidity.shape or not (
            np.allclose(latest.lower, before.lower) and np.allclose(latest.upper, before.upper)):
        raise ValueError(f"forces on {before.solidity.shape} voxels up to {before.upper} m and on "
                         f"{latest.solidity.shape} up to {latest.upper} m; expected the same voxels")
    mixed = {}
    for name in ("pressure_force", "drag_force", "exchange"):
        now, then = getattr(latest, name), getattr(before, name)
        # A voxel that the mesh did not reach has no forces to be mixed with
        known = (before.inside > 0).reshape(before.inside.shape + (1,) * (now.ndim - before.inside.ndim))
        mixed[name] = np.where(known, share * now + (1 - share) * then, now)
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


def disagreement(applied: BallForces, felt: BallForces) -> float:
    """Difference of two forces on the same balls over the second: sum of balls |applied - felt| over that of |felt|.
    The balls and their velocities are those that the flow of `felt` saw."""
    volume, density = felt.volumes(), force_density(felt, felt.velocity)
    apart = np.linalg.norm(force_density(applied, felt.velocity) - density, axis=-1)
    return float((volume * apart).sum() / (volume * np.linalg.norm(density, axis=-1)).sum())
