# SPDX-License-Identifier: GPL-3.0-or-later
"""Readings of the slurry between the balls of a stirred mill: its written fields in the impeller's frame, their means
in the r-z plane, and the dumps of the last turn."""
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from ..files import foam
from ..files.data_files import read_json
from ..files.dumps import numbered_dumps, read_timestep
from ..files.mill import Mill

DENSE = 0.05  # solidity above which slip counts
SECTORS = 48  # places around the axis at which a mean over the azimuth is taken


@dataclass
class SlurryFlow:
    """The written times of a flow from its averages' start on, in the impeller's frame. Of each cell: centre [n, 3]
    (m), volume [n] (m3), share of slurry, solidity [n], velocity of the slurry [n, 3] along r, theta, z (m/s): means
    over the times, the velocity weighted by the slurry; slips, reynolds: of each time, the median of the slip between
    slurry and balls (m/s) and of its Reynolds number over the cells by the volume of their balls, NaN where no balls
    are in slurry."""
    centre: np.ndarray
    volume: np.ndarray
    share: np.ndarray
    solidity: np.ndarray
    velocity: np.ndarray
    slips: list[float]
    reynolds: list[float]
    times: list[float]


def along_cylinder(centre: np.ndarray, velocity: np.ndarray, angle: float) -> np.ndarray:
    """Components along r, theta, z of velocities in the lab [n, 3] at cells that have turned by an angle (rad) since
    they were at `centre`."""
    azimuth = np.arctan2(centre[:, 1], centre[:, 0]) + angle
    cosine, sine = np.cos(azimuth), np.sin(azimuth)
    x, y, z = velocity.T
    return np.stack([x * cosine + y * sine, -x * sine + y * cosine, z], axis=1)


def median(values: np.ndarray, weights: np.ndarray) -> float:
    """Value that half of the weight lies below; NaN without values."""
    if not len(values):
        return np.nan
    order = np.argsort(values)
    return float(values[order][np.searchsorted(np.cumsum(weights[order]), weights.sum() / 2)])


def read_slurry_flow(case: Path, mill: Mill, begin: float) -> SlurryFlow:
    """The flow in a case's folder: means of its written times from flow time `begin` (s) on, or the last one if there
    is none. RuntimeError without a written time after 0."""
    mesh = foam.read_mesh(case)
    centre, volume = mesh.centres_and_volumes()
    omega = mill.derived("speed", "angular_velocity_rad_s")
    # At flow time 0 the mesh has turned with the impeller since DEM time 0
    begun = omega * read_json(case / "mesh.json", "mesh")["time0_s"]
    back = np.array([[np.cos(begun), -np.sin(begun), 0], [np.sin(begun), np.cos(begun), 0], [0, 0, 1]])
    at_zero = centre @ back
    density, viscosity = (mill.derived("slurry", key) for key in ("density_kg_m3", "plastic_viscosity_Pa_s"))
    diameter = mill.derived("charge", "sauter_diameter_m")
    written = [(time, folder) for time, folder in foam.times(case) if time > 0]
    if not written:
        raise RuntimeError(f"{case}: no written time after 0; expected one (flow.write_interval)")
    chosen = [(time, folder) for time, folder in written if time >= begin] or written[-1:]
    share, dense, moved, slips, numbers = np.zeros(len(volume)), np.zeros(len(volume)), np.zeros_like(centre), [], []
    for time, folder in chosen:
        alpha = foam.read_field(folder / "alpha.slurry", mesh.cells)
        velocity = along_cylinder(centre, foam.read_field(folder / "U", mesh.cells), omega * time)
        share += alpha
        moved += alpha[:, None] * velocity
        if not foam.is_there(folder / "solidity"):
            continue
        solidity = foam.read_field(folder / "solidity", mesh.cells)
        balls = along_cylinder(centre, foam.read_field(folder / "solidsVelocity", mesh.cells), omega * time)
        dense += solidity
        wet = (alpha > 0.5) & (solidity > DENSE)
        slip, weight = np.linalg.norm(velocity - balls, axis=1)[wet], (volume * solidity)[wet]
        slips.append(median(slip, weight))
        numbers.append(median(density * slip * diameter * (1 - solidity[wet]) / viscosity, weight))
    mean = moved / np.maximum(share, 1e-9)[:, None]
    return SlurryFlow(at_zero, volume, share / len(chosen), dense / len(chosen), mean, slips or [np.nan],
                      numbers or [np.nan], [time for time, _ in chosen])


def in_impeller(mill: Mill, points: np.ndarray) -> np.ndarray:
    """Whether points [.., 3] (m) in the impeller's frame lie in its shaft, a pin or a disc -> [..]."""
    x, y, z = np.moveaxis(points, -1, 0)
    away = np.hypot(x, y)
    inside = (away < mill.impeller["shaft_diameter_m"] / 2) & (z > mill.impeller["shaft_end_m"])
    for pins in mill.impeller["pins"]:
        for arm in range(int(pins["arms"])):
            angle = np.radians(pins["angle_deg"]) + 2 * np.pi * arm / pins["arms"]
            along, across = x * np.cos(angle) + y * np.sin(angle), y * np.cos(angle) - x * np.sin(angle)
            inside |= ((np.hypot(across, z - pins["height_m"]) < pins["thickness_m"] / 2)
                       & (along > 0) & (along < pins["length_m"] / 2))
    for disc in mill.impeller["discs"]:
        inside |= (away < disc["diameter_m"] / 2) & (np.abs(z - disc["height_m"]) < disc["thickness_m"] / 2)
    return inside


def meridian_means(mill: Mill, flow: SlurryFlow, middle: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Means over the azimuth at radii and heights: share of slurry and solidity [nr, nz], velocity [nr, nz, 3]."""
    radius, azimuth, height = np.meshgrid(middle[0], 2 * np.pi * (np.arange(SECTORS) + 0.5) / SECTORS, middle[1],
                                          indexing="ij")
    points = np.stack([radius * np.cos(azimuth), radius * np.sin(azimuth), height], axis=-1)
    near = cKDTree(flow.centre).query(points.reshape(-1, 3))[1]
    free = ~in_impeller(mill, points)
    share, solidity = (np.where(free, values[near].reshape(radius.shape), 0) for values in (flow.share, flow.solidity))
    room = np.maximum(free.sum(axis=1), 1)
    flux = (share[..., None] * flow.velocity[near].reshape(*radius.shape, 3)).sum(axis=1)
    return share.sum(axis=1) / room, solidity.sum(axis=1) / room, flux / np.maximum(share.sum(axis=1), 1e-9)[..., None]


def dumps_of_last_turn(case: Path, mill: Mill) -> list[tuple[float, Path]]:
    """(DEM time in s, path) of each dump of the last turn; empty without dumps."""
    if not any((case / "dumps").glob("dump.*")):
        return []
    timestep = read_timestep(case / "dumps")
    dumps = [(step * timestep, path) for step, path in numbered_dumps(case / "dumps")]
    return [(time, path) for time, path in dumps if time > dumps[-1][0] - (1 - 1e-6) * mill.turn]
