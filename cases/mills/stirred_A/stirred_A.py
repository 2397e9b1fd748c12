#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the balls of a dry run of a stirred mill do: rings.h5 (their averages on rings about the axis), stirred.csv
(numbers) and stirred.png (tangential speed, motion in the r-z plane, radial profiles, torques against time)."""
import argparse
import csv
import sys
from dataclasses import dataclass
from pathlib import Path

import h5py
import matplotlib
import matplotlib.pyplot as plt
import numpy as np

from millfoam.files.data_files import read_csv, read_json
from millfoam.files.mill import Mill, read_mill
from millfoam.readings.batches import error_over_turns
from millfoam.run import run

RING, AROUND = 0.005, 48  # m, about the size of rings along r and z; sectors, in which components are turned

BALANCED = 0.03  # of the impeller's torque, which may be missing on the walls at rest
LEAST_TURNS = 3  # of the averaged time, to judge that


@dataclass(frozen=True)
class Rings:
    """Means over time and around the axis: edges r [nr + 1], z [nz + 1] (m); volume of balls [nz, nr] (m3); solidity
    [nz, nr]; velocity [nz, nr, 3] (m/s) along r, around the axis (positive anticlockwise seen from above) and along
    z, NaN without balls."""
    r: np.ndarray
    z: np.ndarray
    balls: np.ndarray
    solidity: np.ndarray
    velocity: np.ndarray


def make_rings(case: Path, mill: Mill, begin: float, end: float) -> None:
    """rings.h5 of the dumps between two DEM times (s)."""
    shape = [round(mill.radius / RING), AROUND, round(mill.length / RING)]
    run(case, "millAverage", "--dumps", "dumps/dump.*.txt", "--cylinder", 0, mill.radius, 0, mill.length, "--shape",
        *shape, "--inside", "walls/*.stl", "--start", begin, "--window", f"{end - begin:.6g}", "-o", "rings.h5")


def read_rings(path: Path) -> Rings:
    """Rings of a rings.h5 with a single window."""
    with h5py.File(path) as file:
        grid = file["grid"]
        radii, ends, shape = (np.asarray(grid.attrs[name]) for name in ("radii", "ends", "shape"))
        solidity, inside = np.nan_to_num(file["solidity"][0]), grid["insideFraction"][0]
        velocity = np.nan_to_num(file["velocity"][0])
    edges = [np.linspace(*span, int(count) + 1) for span, count in zip((radii, (0, 2 * np.pi), ends), shape)]
    theta = (edges[1][1:] + edges[1][:-1])[:, None] / 2
    turned = np.stack([velocity[..., 0] * np.cos(theta) + velocity[..., 1] * np.sin(theta),
                       velocity[..., 1] * np.cos(theta) - velocity[..., 0] * np.sin(theta), velocity[..., 2]], axis=-1)
    room = inside * np.diff(edges[0]**2) / 2 * np.diff(edges[1])[:, None] * np.diff(edges[2])[:, None, None]
    balls = solidity * room
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = (balls[..., None] * turned).sum(axis=1) / balls.sum(axis=1)[..., None]
        return Rings(edges[0], edges[2], balls.sum(axis=1), balls.sum(axis=1) / room.sum(axis=1), mean)


def mean_speed(case: Path, begin: float) -> tuple[float, float]:
    """Mean speed of all balls from a DEM time on (s) and its standard deviation over the dumps, m/s."""
    about = read_json(case / "dumps" / "run.json", "dumps")
    speeds = []
    for path in (case / "dumps").glob("dump.*.txt"):
        if int(path.name.split(".")[1]) * about["timestep_s"] >= begin:
            names = path.read_text().split("ITEM: ATOMS", 1)[1].split("\n", 1)[0].split()
            columns = [names.index(name) for name in ("vx", "vy", "vz")]
            speeds.append(np.linalg.norm(np.loadtxt(path, skiprows=9, usecols=columns), axis=1).mean())
    return float(np.mean(speeds)), float(np.std(speeds))


def numbers_of(case: Path, mill: Mill, results: dict, begin: float) -> dict[str, float]:
    """Key -> number, of the time from `begin` (s) on."""
    torques, energy = (read_csv(case / "dumps" / name) for name in ("torques.csv", "energy.csv"))
    late = torques["time_s"] >= begin
    found = {"tip_speed_m_s": mill.derived("speed", "tip_speed_m_s"), "balls": results["balls"],
             "steady_from_s": results["steady_from_s"], "power_W": float(energy["power_W"][late].mean()),
             "power_error_W": error_over_turns(energy["time_s"], energy["power_W"], begin, mill.turn)}
    for part in results["part_torques_Nm"]:
        values = torques[f"{part}_Nm"]
        found[f"torque_{part}_Nm"] = float(values[late].mean())
        found[f"torque_{part}_error_Nm"] = error_over_turns(torques["time_s"], values, begin, mill.turn)
    at_rest = sum(found[f"torque_{part}_Nm"] for part in results["part_torques_Nm"] if part != "impeller")
    found["at_rest_over_impeller"] = -at_rest / found["torque_impeller_Nm"]
    found["mean_speed_m_s"], found["mean_speed_deviation_m_s"] = mean_speed(case, begin)
    return found


def draw(case: Path, mill: Mill, rings: Rings, begin: float) -> plt.Figure:
    figure, axes = plt.subplots(1, 4, figsize=(17, 5.6), layout="constrained")
    r, z = ((edges[1:] + edges[:-1]) / 2 for edges in (rings.r, rings.z))
    filled = rings.solidity > 0.01
    top = 1.15 * rings.z[1:][filled.any(axis=1)].max()
    for axis, values, label in ((axes[0], rings.solidity, "solidity, –"),
                                (axes[1], rings.velocity[..., 1], "tangential velocity, m/s")):
        image = axis.pcolormesh(1e3 * rings.r, 1e3 * rings.z, np.where(filled, values, np.nan), cmap="viridis")
        figure.colorbar(image, ax=axis, label=label)
        draw_impeller(axis, mill)
        axis.set(xlabel="r, mm", ylabel="z, mm", ylim=(0, 1e3 * top), aspect="equal")
    radial, axial = (np.where(filled, rings.velocity[..., k], np.nan) for k in (0, 2))
    axes[1].quiver(1e3 * r, 1e3 * z, radial, axial, color="w", angles="xy", width=0.006)
    axes[1].set_title("arrows: radial and axial velocity", fontsize=9)
    pins = mill.content["derived"]["geometry"]["impeller"]["pins"]
    low = min((one["height_m"] - one["thickness_m"] / 2 for one in pins), default=0.0)
    high = mill.derived("geometry", "impeller", "top_m")
    for name, chosen in ((f"below {1e3 * low:.0f} mm", z < low), ("at the pins", (z >= low) & (z <= high)),
                         (f"above {1e3 * high:.0f} mm", z > high)):
        weight = rings.balls[chosen]
        with np.errstate(invalid="ignore", divide="ignore"):
            line = (weight * np.nan_to_num(rings.velocity[chosen][..., 1])).sum(axis=0) / weight.sum(axis=0)
        axes[2].plot(r / mill.radius, line, "o-", ms=3, label=name)
    axes[2].set(xlabel="r / R", ylabel="tangential velocity, m/s")
    axes[2].legend(fontsize=8)
    torques = read_csv(case / "dumps" / "torques.csv")
    for name in (column for column in torques if column != "time_s"):
        axes[3].plot(torques["time_s"], torques[name], lw=1, label=name.removesuffix("_Nm"))
    axes[3].axvspan(begin, torques["time_s"][-1], color="0.93", zorder=0)
    axes[3].set(xlabel="DEM time, s", ylabel="torque of the balls about +z, N m\n(grey: averaged time)")
    axes[3].legend(fontsize=8)
    for axis in axes[2:]:
        axis.grid(alpha=0.3)
    figure.suptitle(f"{mill.title}, {mill.derived('speed', 'tip_speed_m_s'):.2f} m/s at the tips")
    return figure


def draw_impeller(axis, mill: Mill) -> None:
    """Outline of shaft and pins in the r-z plane."""
    impeller = mill.content["derived"]["geometry"]["impeller"]
    radius, end = impeller["shaft_diameter_m"] / 2, impeller["shaft_end_m"]
    axis.add_patch(plt.Rectangle((0, 1e3 * end), 1e3 * radius, 1e3 * (mill.length - end), fill=False, ec="k", lw=0.8))
    for pins in impeller["pins"]:
        axis.add_patch(plt.Rectangle((1e3 * radius, 1e3 * (pins["height_m"] - pins["thickness_m"] / 2)),
                                     1e3 * (pins["length_m"] / 2 - radius), 1e3 * pins["thickness_m"], fill=False,
                                     ec="k", lw=0.8))


def main() -> None:
    matplotlib.use("Agg")
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("case", type=Path)
    case = parser.parse_args().case
    mill, results = read_mill(case, "stirred"), read_json(case / "dumps" / "results.json", "charge")
    start = mill.asked("averages", "start")
    begin, end = results["steady_from_s"] if start == "steady" else float(start), results["duration_s"]
    make_rings(case, mill, begin, end)
    numbers = numbers_of(case, mill, results, begin)
    with open(case / "stirred.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, list(numbers))
        writer.writeheader()
        writer.writerow(numbers)
    for name, value in numbers.items():
        # Of less than two turns the error is not known
        print(f"{name:<28}" + ("–" if np.isnan(value) else f"{value:.5g}"))
    draw(case, mill, read_rings(case / "rings.h5"), begin).savefig(case / "stirred.png", dpi=110)
    print("stirred.png")
    missing = abs(1 - numbers["at_rest_over_impeller"])
    if end - begin >= LEAST_TURNS * mill.turn and missing > BALANCED:
        sys.exit(f"stirred_A: the torque on shell and base differs from the impeller's by {100 * missing:.1f} %; "
                 f"expected {100 * BALANCED:g} % or less")


if __name__ == "__main__":
    main()
