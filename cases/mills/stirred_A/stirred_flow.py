#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the slurry of a stirred mill does: flow.csv (torques, power, slip with its Froude and Reynolds numbers,
conservation), flow_maps.png (r-z plane) and vortex.png (a section with the balls of the last record)."""
import argparse
import csv
import sys
from dataclasses import dataclass
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from scipy.spatial import cKDTree

from millfoam.files import foam
from millfoam.files.data_files import read_json
from millfoam.files.dumps import numbered_dumps, read_timestep
from millfoam.files.mill import Mill, read_mill
from millfoam.files.tables import read_columns
from millfoam.plots.stirred_plots import draw_impeller
from millfoam.readings.stirred_power import mean_from

CONSERVED = 1e-8  # of the hold-up
DENSE = 0.05  # solidity above which slip counts
RADIAL, SECTORS, AXIAL = 40, 48, 80  # places of the map
SPECKS = 0.02  # share of slurry below which a bin of the map shows none


@dataclass
class Flow:
    """The written times of a flow from its averages' start on, in the impeller's frame. Of each cell: centre [n, 3]
    (m), volume [n] (m3), share of slurry, solidity [n], velocity of the slurry [n, 3] along r, theta, z (m/s): means
    over the times, the velocity weighted by the slurry; slips, reynolds: of each time, the median of the slip between
    slurry and balls (m/s) and of its Reynolds number over the cells, NaN where no balls are in slurry."""
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


def read_flow(case: Path, mill: Mill) -> Flow:
    mesh = foam.read_mesh(case)
    centre, volume = mesh.centres_and_volumes()
    omega = mill.derived("speed", "angular_velocity_rad_s")
    # At flow time 0 the mesh has turned with the impeller since DEM time 0
    begun = omega * read_json(case / "mesh.json", "mesh")["time0_s"]
    back = np.array([[np.cos(begun), -np.sin(begun), 0], [np.sin(begun), np.cos(begun), 0], [0, 0, 1]])
    at_zero = centre @ back
    density, viscosity = (mill.derived("slurry", key) for key in ("density_kg_m3", "plastic_viscosity_Pa_s"))
    diameter = mill.derived("charge", "sauter_diameter_m")
    start = mill.derived("flow", "averages_start_s")
    chosen = [(time, folder) for time, folder in foam.times(case) if time >= start and time > 0]
    if not chosen:
        sys.exit(f"stirred_flow: {case}: no written time from {start:g} s on (flow.averages.start); expected one")
    share, dense, moved, slips, numbers = np.zeros(len(volume)), np.zeros(len(volume)), np.zeros_like(centre), [], []
    for time, folder in chosen:
        alpha = foam.read_field(folder / "alpha.slurry", mesh.cells)
        velocity = along_cylinder(centre, foam.read_field(folder / "U", mesh.cells), omega * time)
        share += alpha
        moved += alpha[:, None] * velocity
        if not (folder / "solidity").is_file():
            continue
        solidity = foam.read_field(folder / "solidity", mesh.cells)
        balls = along_cylinder(centre, foam.read_field(folder / "solidsVelocity", mesh.cells), omega * time)
        dense += solidity
        wet = (alpha > 0.5) & (solidity > DENSE)
        slip, weight = np.linalg.norm(velocity - balls, axis=1)[wet], (volume * solidity)[wet]
        slips.append(median(slip, weight))
        numbers.append(median(density * slip * diameter * (1 - solidity[wet]) / viscosity, weight))
    mean = moved / np.maximum(share, 1e-9)[:, None]
    return Flow(at_zero, volume, share / len(chosen), dense / len(chosen), mean, slips or [np.nan], numbers or [np.nan],
                [time for time, _ in chosen])


def deviation(values: list[float]) -> float:
    """Standard deviation; NaN of a single value."""
    return float(np.std(values, ddof=1)) if len(values) > 1 else np.nan


def numbers_of(case: Path, mill: Mill, flow: Flow) -> dict[str, float]:
    """Key -> number, of the time from the averages' start on."""
    start = mill.derived("flow", "averages_start_s")
    columns = read_columns(case, "slurryBalance")
    time, step = columns["Time"], np.diff(columns["Time"], prepend=0)
    even = np.arange(start, time[-1], np.median(step))
    found: dict[str, float] = {"begin_s": start, "end_s": float(time[-1]), "turns": (time[-1] - start) / mill.turn}
    for part in ("impeller", "shell", "base", "lid", "all"):
        torque = mean_from(even, np.interp(even, time, columns[f"torque_{part}"]), start, mill.turn)
        found[f"torque_{part}_Nm"], found[f"torque_{part}_error_Nm"] = torque.value, torque.error
    # What walls do not give; it also has the error of the stress at curved walls
    found["torque_rest_Nm"] = found["torque_all_Nm"] - sum(
        found[f"torque_{part}_Nm"] for part in ("impeller", "shell", "base", "lid"))
    found["power_impeller_W"] = mill.derived("speed", "angular_velocity_rad_s") * found["torque_impeller_Nm"]
    results = case / "dumps" / "results.json"
    found["power_dry_charge_W"] = read_json(results, "charge")["power_W"] if results.is_file() else np.nan
    found["slurry_over_charge"] = found["power_impeller_W"] / found["power_dry_charge_W"]
    found["missing_over_hold_up"] = float(np.abs(columns["missing"]).max() / columns["holdUp"][0])
    found["centre_z_m"] = float(np.interp(even, time, columns["z"]).mean())
    balls = mill.derived("materials", "ball", "density_kg_m3")
    slurry = mill.derived("slurry", "density_kg_m3")
    buoyant = mill.derived("gravity_m_s2") * mill.derived("charge", "sauter_diameter_m") * (balls / slurry - 1)
    found["slip_m_s"], found["slip_deviation_m_s"] = float(np.mean(flow.slips)), deviation(flow.slips)
    found["froude"] = found["slip_m_s"] / float(np.sqrt(buoyant)) if buoyant > 0 else np.nan
    # As the thesis' code computes them: times the root, and with a tenfold viscosity
    found["froude_as_printed"] = found["slip_m_s"] * float(np.sqrt(buoyant)) if buoyant > 0 else np.nan
    found["reynolds_as_printed"] = float(np.mean(flow.reynolds)) / 10
    found["reynolds"], found["reynolds_deviation"] = float(np.mean(flow.reynolds)), deviation(flow.reynolds)
    return found


def in_pins(mill: Mill, points: np.ndarray) -> np.ndarray:
    """Whether points [n, 3] (m) in the impeller's frame lie in a pin."""
    inside = np.zeros(len(points), bool)
    for pins in mill.impeller["pins"]:
        for arm in range(int(pins["arms"])):
            angle = np.radians(pins["angle_deg"]) + 2 * np.pi * arm / pins["arms"]
            along = points[:, 0] * np.cos(angle) + points[:, 1] * np.sin(angle)
            across = points[:, 1] * np.cos(angle) - points[:, 0] * np.sin(angle)
            inside |= ((np.hypot(across, points[:, 2] - pins["height_m"]) < pins["thickness_m"] / 2)
                       & (along > 0) & (along < pins["length_m"] / 2))
    return inside


def meridian_means(mill: Mill, flow: Flow, middle: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Means over the azimuth at radii and heights: share of slurry and solidity [nr, nz], velocity [nr, nz, 3]."""
    radius, azimuth, height = np.meshgrid(middle[0], 2 * np.pi * (np.arange(SECTORS) + 0.5) / SECTORS, middle[1],
                                          indexing="ij")
    points = np.stack([radius * np.cos(azimuth), radius * np.sin(azimuth), height], axis=-1).reshape(-1, 3)
    near = cKDTree(flow.centre).query(points)[1]
    free = (~in_pins(mill, points)).reshape(radius.shape)
    share, solidity = (np.where(free, values[near].reshape(radius.shape), 0) for values in (flow.share, flow.solidity))
    room = np.maximum(free.sum(axis=1), 1)
    flux = (share[..., None] * flow.velocity[near].reshape(*radius.shape, 3)).sum(axis=1)
    return share.sum(axis=1) / room, solidity.sum(axis=1) / room, flux / np.maximum(share.sum(axis=1), 1e-9)[..., None]


def maps_figure(mill: Mill, flow: Flow) -> plt.Figure:
    """r-z maps, means over the azimuth: share of slurry between the balls, tangential velocity with arrows."""
    top = min(mill.length, 1.3 * float(flow.centre[flow.share > SPECKS, 2].max()))
    edges = np.linspace(0, mill.radius, RADIAL + 1), np.linspace(0, top, AXIAL + 1)
    middle = [(edge[1:] + edge[:-1]) / 2 for edge in edges]
    share, solidity, mean = meridian_means(mill, flow, middle)
    velocity = np.moveaxis(mean, -1, 0)
    hidden = ~(share > 0.3)
    figure, axes = plt.subplots(1, 2, figsize=(9.5, 4.8), layout="constrained")
    both = np.concatenate([-edges[0][::-1], edges[0][1:]]) / mill.radius
    tangential = np.where(hidden, np.nan, velocity[1])
    for axis, values, name, colours in ((axes[0], share, "share of slurry between the balls", "Blues"),
                                        (axes[1], tangential, "tangential velocity, m/s", "viridis")):
        mirrored = np.concatenate([values[::-1], values]).T
        image = axis.pcolormesh(both, 1e3 * edges[1], mirrored, cmap=colours,
                                vmin=0, vmax=1 if name.startswith("share") else None)
        figure.colorbar(image, ax=axis, label=name)
        draw_impeller(axis, mill, False)
        for side in (-1, 1):
            axis.contour(side * middle[0] / mill.radius, 1e3 * middle[1], solidity.T, [0.1, 0.4],
                         colors="tab:orange", linewidths=(0.6, 1.2))
        axis.set(xlim=(-1, 1), ylim=(0, 1e3 * top), xlabel="r / R", ylabel="z, mm", aspect=1 / (1e3 * mill.radius))
        axis.set_facecolor("0.93")
    step = (slice(1, None, 4), slice(2, None, 5))
    at = np.meshgrid(*middle, indexing="ij")
    arrows = [np.where(hidden, np.nan, part)[step] for part in (velocity[0], velocity[2])]
    for side in (-1, 1):
        axes[1].quiver(side * at[0][step] / mill.radius, 1e3 * at[1][step], side * arrows[0], arrows[1], color="w",
                       width=0.004, scale=4)
    axes[0].set_title("orange: balls' solidity 0.1 and 0.4", fontsize=9)
    axes[1].set_title("arrows: radial and axial velocity", fontsize=9)
    return figure


def last_balls(case: Path, mill: Mill) -> np.ndarray:
    """Positions of the balls [n, 3] of the last dump, turned back into the impeller's frame, m."""
    step, path = sorted(numbered_dumps(case / "dumps"))[-1]
    names = path.read_text().split("ITEM: ATOMS", 1)[1].split("\n", 1)[0].split()
    place = np.loadtxt(path, skiprows=9, usecols=[names.index(name) for name in "xyz"])
    angle = -mill.derived("speed", "angular_velocity_rad_s") * step * read_timestep(case / "dumps")
    cosine, sine = np.cos(angle), np.sin(angle)
    return place @ np.array([[cosine, sine, 0], [-sine, cosine, 0], [0, 0, 1]])


def vortex_figure(case: Path, mill: Mill, flow: Flow) -> plt.Figure:
    """A vertical section through the first pins, in the impeller's frame: speed of the slurry, the balls that the
    section cuts in the last record, and the impeller."""
    angle = np.radians(mill.impeller["pins"][0]["angle_deg"]) if mill.impeller["pins"] else 0.0
    along = np.array([np.cos(angle), np.sin(angle), 0])
    across = np.array([-np.sin(angle), np.cos(angle), 0])
    top = min(mill.length, 1.3 * float(flow.centre[flow.share > SPECKS, 2].max()))
    x, z = np.linspace(-mill.radius, mill.radius, 320), np.linspace(0, top, 320)
    points = x[None, :, None] * along + z[:, None, None] * np.array([0, 0, 1])
    _, near = cKDTree(flow.centre).query(points.reshape(-1, 3))
    share = flow.share[near].reshape(len(z), len(x))
    speed = np.linalg.norm(flow.velocity, axis=1)[near].reshape(share.shape)
    figure, axis = plt.subplots(figsize=(6.4, 5), layout="constrained")
    axis.set_facecolor("0.95")
    image = axis.pcolormesh(1e3 * x, 1e3 * z, np.where(share > 0.5, speed, np.nan), cmap="viridis", vmin=0)
    figure.colorbar(image, ax=axis, label="speed of the slurry, m/s (mean over time)")
    axis.contour(1e3 * x, 1e3 * z, share, [0.5], colors="tab:blue", linewidths=1.2)
    if any((case / "dumps").glob("dump.*")):
        balls = last_balls(case, mill)
        half = mill.derived("charge", "largest_diameter_m") / 2
        away = balls @ across
        for ball, distance in zip(balls[np.abs(away) < half], away[np.abs(away) < half]):
            axis.add_patch(plt.Circle((1e3 * ball @ along, 1e3 * ball[2]), 1e3 * np.sqrt(half**2 - distance**2),
                                      fc="0.8", ec="0.3", lw=0.4, alpha=0.75))
    shaft = mill.impeller["shaft_diameter_m"] / 2
    boxes = [(-shaft, mill.impeller["shaft_end_m"], 2 * shaft, mill.length)]
    for pins in mill.impeller["pins"]:
        turned = abs(np.sin(np.radians(pins["angle_deg"]) - angle))
        low, thick = pins["height_m"] - pins["thickness_m"] / 2, pins["thickness_m"]
        reach = pins["length_m"] / 2
        if turned < 0.1:
            boxes.append((-reach, low, 2 * reach, thick))
        else:
            axis.add_patch(plt.Circle((0, 1e3 * pins["height_m"]), 5e2 * thick, fc="0.35", ec="w", lw=0.5, zorder=4))
    for left, low, width, height in boxes:
        axis.add_patch(plt.Rectangle((1e3 * left, 1e3 * low), 1e3 * width, 1e3 * height, fc="0.2", ec="none", zorder=3))
    axis.set(xlim=(-1e3 * mill.radius, 1e3 * mill.radius), ylim=(0, 1e3 * top), xlabel="along the lower pins, mm",
             ylabel="z, mm", aspect="equal")
    return figure


def main() -> None:
    matplotlib.use("Agg")
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("case", type=Path)
    case = parser.parse_args().case
    mill = read_mill(case, "stirred")
    flow = read_flow(case, mill)
    numbers = numbers_of(case, mill, flow)
    with open(case / "flow.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, list(numbers))
        writer.writeheader()
        writer.writerow(numbers)
    for name, value in numbers.items():
        print(f"{name:<28}" + ("–" if np.isnan(value) else f"{value:.5g}"))
    for name, figure in (("flow_maps", maps_figure(mill, flow)), ("vortex", vortex_figure(case, mill, flow))):
        figure.suptitle(f"{mill.title}, {mill.derived('speed', 'tip_speed_m_s'):.2f} m/s at the tips, with slurry, "
                        f"{flow.times[0]:.2f} to {flow.times[-1]:.2f} s", fontsize=10)
        figure.savefig(case / f"{name}.png", dpi=110)
        print(f"{name}.png")
    if not numbers["missing_over_hold_up"] <= CONSERVED:
        sys.exit(f"stirred_flow: {numbers['missing_over_hold_up']:.1e} of the slurry is missing; "
                 f"expected {CONSERVED:g} or less")


if __name__ == "__main__":
    main()
