#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the slurry of a stirred mill does: flow.csv (torques, power, slip with its Froude and Reynolds numbers,
conservation), flow_maps.png (r-z plane) and vortex.png (a section with the balls of the last record)."""
import argparse
import sys
from pathlib import Path

import matplotlib
import numpy as np

from millfoam.files.data_files import read_json
from millfoam.files.mill import Mill, read_mill
from millfoam.files.tables import read_columns
from millfoam.plots.stirred_slurry_plots import maps_figure, vortex_figure
from millfoam.readings.stirred_power import mean_from
from millfoam.readings.stirred_slurry import SlurryFlow, read_slurry_flow
from number_table import write_numbers

CONSERVED = 1e-8  # of the hold-up


def deviation(values: list[float]) -> float:
    """Standard deviation; NaN of a single value."""
    return float(np.std(values, ddof=1)) if len(values) > 1 else np.nan


def numbers_of(case: Path, mill: Mill, flow: SlurryFlow) -> dict[str, float]:
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


def show(case: Path) -> None:
    """Writes and prints the numbers and draws the pictures of the flow in a case's folder."""
    mill = read_mill(case, "stirred")
    flow = read_slurry_flow(case, mill)
    numbers = numbers_of(case, mill, flow)
    write_numbers(case / "flow.csv", numbers)
    for name, figure in (("flow_maps", maps_figure(mill, flow)), ("vortex", vortex_figure(case, mill, flow))):
        figure.suptitle(f"{mill.title}, {mill.derived('speed', 'tip_speed_m_s'):.2f} m/s at the tips, with slurry, "
                        f"{flow.times[0]:.2f} to {flow.times[-1]:.2f} s", fontsize=10)
        figure.savefig(case / f"{name}.png", dpi=110)
        print(f"{name}.png")
    if not numbers["missing_over_hold_up"] <= CONSERVED:
        raise RuntimeError(f"{case}: {numbers['missing_over_hold_up']:.1e} of the slurry is missing; "
                           f"expected {CONSERVED:g} or less")


def main() -> None:
    matplotlib.use("Agg")
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("case", type=Path)
    try:
        show(parser.parse_args().case)
    except RuntimeError as error:
        sys.exit(f"stirred_flow: {error}")


if __name__ == "__main__":
    main()
