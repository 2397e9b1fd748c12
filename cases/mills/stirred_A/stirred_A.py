#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the balls of a dry run of a stirred mill do: stirred.csv (numbers), and pictures of their averages in the
impeller's frame: maps.png (r-z plane), slices.png (around the pins), profiles.png (radial, in three bands), boxes.png
(speeds and solidity); torques.png (torques against time)."""
import argparse
import sys
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

from millfoam.files.data_files import read_csv, read_json
from millfoam.files.dumps import numbered_dumps, read_balls, read_timestep
from millfoam.files.mill import Mill, read_mill
from millfoam.files.rings_file import read_rings
from millfoam.plots.stirred_plots import boxes_figure, meridian_figure, profiles_figure, slices_figure
from millfoam.readings.stirred import Box, ball_boxes, charge_boxes
from millfoam.readings.stirred_power import mean_from, mean_speed
from number_table import write_numbers

BALANCED = 0.03  # of the impeller's torque, which may be missing on the walls at rest
LEAST_TURNS = 3  # of the averaged time, to judge that


def late_balls(case: Path, begin: float) -> list[tuple[np.ndarray, np.ndarray]]:
    """Positions and velocities [balls, 3] (m, m/s) of each dump from a DEM time on (s)."""
    timestep, records = read_timestep(case / "dumps"), []
    for step, path in numbered_dumps(case / "dumps"):
        if step * timestep >= begin:
            balls = read_balls(path, "x", "y", "z", "vx", "vy", "vz")
            records.append((balls[:, :3], balls[:, 3:]))
    return records


def numbers_of(case: Path, mill: Mill, results: dict, begin: float) -> dict[str, float]:
    """Key -> number, of the time from `begin` (s) on."""
    torques, energy = (read_csv(case / "dumps" / name) for name in ("torques.csv", "energy.csv"))
    power = mean_from(energy["time_s"], energy["power_W"], begin, mill.turn)
    found = {"tip_speed_m_s": mill.derived("speed", "tip_speed_m_s"), "balls": results["balls"],
             "steady_from_s": results["steady_from_s"], "power_W": power.value, "power_error_W": power.error}
    for part in results["part_torques_Nm"]:
        torque = mean_from(torques["time_s"], torques[f"{part}_Nm"], begin, mill.turn)
        found[f"torque_{part}_Nm"], found[f"torque_{part}_error_Nm"] = torque.value, torque.error
    at_rest = sum(found[f"torque_{part}_Nm"] for part in results["part_torques_Nm"] if part != "impeller")
    found["at_rest_over_impeller"] = -at_rest / found["torque_impeller_Nm"]
    speed = mean_speed(case / "dumps", begin, mill.turn)
    found["mean_speed_m_s"], found["mean_speed_error_m_s"] = speed.value, speed.error
    return found


def speeds_of(boxes: dict[str, Box]) -> dict[str, float]:
    """Key -> number: quartiles of the boxes, m/s."""
    return {f"{name}_{part}_m_s": getattr(box, part) for name, box in boxes.items()
            for part in ("first", "median", "third")}


def torques_figure(case: Path, begin: float) -> plt.Figure:
    figure, axis = plt.subplots(figsize=(6, 3.6), layout="constrained")
    torques = read_csv(case / "dumps" / "torques.csv")
    for name in (column for column in torques if column != "time_s"):
        axis.plot(torques["time_s"], torques[name], lw=1, label=name.removesuffix("_Nm"))
    axis.axvspan(begin, torques["time_s"][-1], color="0.93", zorder=0)
    axis.set(xlabel="DEM time, s", ylabel="torque of the balls about +z, N m\n(grey: averaged time)")
    axis.legend(fontsize=8)
    axis.grid(alpha=0.3)
    return figure


def averaged_time(case: Path, mill: Mill, results: dict) -> tuple[float, float]:
    """DEM times between which the balls are read, s; of balls that feel the slurry the time of its averages."""
    end = results["begin_s"] + results["duration_s"]
    if results["fluid"]:
        return read_json(case / "mesh.json", "mesh")["time0_s"] + mill.derived("flow", "averages_start_s"), end
    start = mill.asked("averages", "start")
    return results["steady_from_s"] if start == "steady" else float(start), end


def main() -> None:
    matplotlib.use("Agg")
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("case", type=Path)
    case = parser.parse_args().case
    mill, results = read_mill(case, "stirred"), read_json(case / "dumps" / "results.json", "charge")
    begin, end = averaged_time(case, mill, results)
    records = late_balls(case, begin)
    boxes = ball_boxes(*(np.concatenate(parts) for parts in zip(*records)))
    numbers = numbers_of(case, mill, results, begin) | speeds_of(boxes)
    # Of less than two turns an error is not known
    write_numbers(case / "stirred.csv", numbers)
    rings = read_rings(case / "solids.h5")
    boxes["solidity"] = charge_boxes(rings)["solidity"]
    for name, figure in (("maps", meridian_figure(mill, rings)), ("slices", slices_figure(mill, rings)),
                         ("profiles", profiles_figure(mill, rings)), ("boxes", boxes_figure(boxes)),
                         ("torques", torques_figure(case, begin))):
        figure.suptitle(f"{mill.title}, {mill.derived('speed', 'tip_speed_m_s'):.2f} m/s at the tips", fontsize=10)
        figure.savefig(case / f"{name}.png", dpi=110)
        print(f"{name}.png")
    # Slurry that the balls feel takes a part of it
    missing = 0 if results["fluid"] else abs(1 - numbers["at_rest_over_impeller"])
    if end - begin >= LEAST_TURNS * mill.turn and missing > BALANCED:
        sys.exit(f"stirred_A: the torque on shell and base differs from the impeller's by {100 * missing:.1f} %; "
                 f"expected {100 * BALANCED:g} % or less")


if __name__ == "__main__":
    main()
