#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the slurry of a stirred mill does: flow.csv (torques, power, slip with its Froude and Reynolds numbers,
conservation), flow_maps.png (r-z plane) and vortex.png (a section with the balls of the last record)."""
import argparse
import sys
from pathlib import Path

import matplotlib

from millfoam.files.stirred_case import StirredCase
from millfoam.plots.stirred_slurry_plots import maps_figure, vortex_figure
from millfoam.readings.slurry_conservation import CONSERVED
from millfoam.readings.stirred_flow import StirredFlowNumbers, read_stirred_flow
from millfoam.readings.stirred_slurry import dumps_of_last_turn, read_slurry_flow
from number_table import write_numbers

# Viscosity in the published tables over that of the text
PRINTED_VISCOSITY = 10.0


def numbers_of(found: StirredFlowNumbers) -> dict[str, float]:
    """Key -> number of flow.csv."""
    row = {"begin_s": found.begin, "end_s": found.end, "turns": found.turns}
    for part, torque in found.torques.items():
        row[f"torque_{part}_Nm"], row[f"torque_{part}_error_Nm"] = torque.value, torque.error
    if found.unbalanced:
        row["torque_unbalanced_Nm"], row["torque_unbalanced_error_Nm"] = found.unbalanced.value, found.unbalanced.error
    return {**row, "power_slurry_W": found.slurry_power.value, "power_slurry_error_W": found.slurry_power.error,
            "power_balls_W": found.ball_power.value, "power_balls_error_W": found.ball_power.error,
            "slurry_share": found.slurry_share.value, "missing_over_hold_up": found.missing,
            "centre_z_m": found.centre.value, "slip_m_s": found.slip.value, "slip_error_m_s": found.slip.error,
            "froude": found.froude.value, "reynolds": found.reynolds.value, "reynolds_error": found.reynolds.error,
            # The published tables multiply the slip by the root that it is divided by
            "froude_as_printed": found.slip.value**2 / found.froude.value,
            "reynolds_as_printed": found.reynolds.value / PRINTED_VISCOSITY}


def show(case: Path) -> None:
    """Writes and prints the numbers and draws the pictures of the flow in a case's folder."""
    run = StirredCase(case)
    mill = run.mill
    flow = read_slurry_flow(case, mill, run.begin)
    numbers = numbers_of(read_stirred_flow(run, flow))
    write_numbers(case / "flow.csv", numbers)
    records = dumps_of_last_turn(case, mill)
    vortex = vortex_figure(mill, flow, records[-1] if records else None)
    for name, figure in (("flow_maps", maps_figure(mill, flow)), ("vortex", vortex)):
        figure.suptitle(f"{mill.title}, {mill.derived('speed', 'tip_speed_m_s'):.2f} m/s at the tips, with slurry, "
                        f"flow time {flow.times[0]:.2f} to {flow.times[-1]:.2f} s", fontsize=10)
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
