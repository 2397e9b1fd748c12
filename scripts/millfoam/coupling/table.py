# SPDX-License-Identifier: GPL-3.0-or-later
"""Table, file of results and picture of the passes of a coupled mill."""
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from ..files import data_files
from ..files.mill import Mill
from ..readings.means import Mean
from .passes import LIMIT, NOISE, QUANTITIES, Change, Exchanged, Pass

COLUMNS = {"toe": "toe_deg", "shoulder": "shoulder_deg", "charge_x": "charge_x_m", "charge_y": "charge_y_m",
           "charge_power": "charge_power_W", "slurry_x": "slurry_x_m", "slurry_y": "slurry_y_m",
           "slurry_power": "slurry_power_W", "drive_power": "drive_power_W"}


def known(value: float | None) -> float | None:
    """A number for JSON: null if it is not known."""
    return None if value is None or not np.isfinite(value) else float(value)


def write_csv(path: Path, passes: Sequence[Pass], changes: Sequence[Change]) -> None:
    """A row per pass: coupling.csv (FORMATS.md)."""
    rows = []
    for index, one in enumerate(passes):
        row: dict[str, float] = {"pass": one.number}
        for key, column in COLUMNS.items():
            row |= {column: one.quantities[key].value, error_column(column): one.quantities[key].error}
        step = changes[index - 1] if index else None
        rows.append(row | {"solidity_change": step.solidity if step else np.nan,
                           "solidity_change_over_limit": step.solidity_over_limit if step else np.nan,
                           "force_over_weight": one.load,
                           "force_disagreement": np.nan if one.disagreement is None else one.disagreement})
    data_files.write_csv(path, rows, digits=8)


def error_column(column: str) -> str:
    """Name of the column with the standard error of another: toe_error_deg of toe_deg."""
    name, _, unit = column.rpartition("_")
    return f"{name}_error_{unit}"


def result(mill: Mill, passes: Sequence[Pass], changes: Sequence[Change], settled: bool, most: int) -> dict[str, Any]:
    """Content of coupling.json (FORMATS.md)."""
    return {"format": "millfoam-coupling", "program": mill.content.get("program"), "mill": mill.fingerprint,
            "coupling": "iterated", "passes": len(passes), "most_passes": most, "settled": settled,
            "limit_standard_errors": LIMIT, "limit_noise": NOISE,
            "force_over_weight": known(passes[-1].load), "force_disagreement": known(passes[-1].disagreement),
            "largest_change": changes[-1].largest if changes else None,
            "folders": [one.folder.name if one.number > 1 else "." for one in passes]}


def direct_result(mill: Mill, folder: str, load: float | None, exchanged: Exchanged) -> dict[str, Any]:
    """Content of coupling.json (FORMATS.md) of balls and flow that ran at the same time, in a folder of the case; load:
    force of the fluid on the balls over their weight, None if it is not known."""
    return {"format": "millfoam-coupling", "program": mill.content.get("program"), "mill": mill.fingerprint,
            "coupling": "direct", "folders": [".", folder], "force_over_weight": known(load),
            "force_by_flow_N": known(exchanged.given), "force_by_balls_N": known(exchanged.taken),
            "force_disagreement": known(exchanged.disagreement),
            "torque_by_flow_Nm": known(exchanged.given_torque), "torque_by_balls_Nm": known(exchanged.taken_torque),
            "torque_added": known(exchanged.added),
            "torque_disagreement": known(exchanged.torque_disagreement),
            **with_error("torque_unbalanced", exchanged.unbalanced),
            **with_error("force_unbalanced", exchanged.force_unbalanced)}


def with_error(name: str, mean: Mean | None) -> dict[str, float | None]:
    """A mean for JSON with its error and reach, null where they are not known."""
    return {name: known(mean.value) if mean else None, f"{name}_error": known(mean.error) if mean else None,
            f"{name}_reach": known(mean.reach) if mean else None}


def cell(mean: Mean, scale: float) -> str:
    """A mean times `scale` with its error, as far as they are known."""
    if np.isnan(mean.value):
        return "–"
    return f"{scale * mean.value:.4g}" + ("" if np.isnan(mean.error) else f" ± {scale * mean.error:.2g}")


def lines(passes: Sequence[Pass], changes: Sequence[Change]) -> list[str]:
    """The passes as text, a line for each quantity."""
    found = ["pass".ljust(28) + "".join(f"{one.number:>21d}" for one in passes)]
    for key, (name, unit, scale) in QUANTITIES.items():
        cells = [cell(one.quantities[key], scale) for one in passes]
        found.append(f"{name}, {unit}".ljust(28) + "".join(one.rjust(21) for one in cells))
    apart = ["–", *(f"{one.solidity:.3f} ({one.solidity_over_limit:.2g})" for one in changes)]
    found.append("solidity's change (÷ limit)".ljust(28) + "".join(one.rjust(21) for one in apart))
    found.append("force over weight".ljust(28) + "".join(f"{one.load:21.3f}" for one in passes))
    found.append("forces disagree by".ljust(28) + "".join(
        ("–" if one.disagreement is None else f"{one.disagreement:.1%}").rjust(21) for one in passes))
    return found


def passes_figure(numbers: Sequence[int], quantities: Mapping[str, Sequence[Mean]]) -> Figure:
    """Figure of all quantities (key of QUANTITIES -> Mean of each pass) over the passes' numbers, with their standard
    errors."""
    figure, axes = plt.subplots(3, 3, figsize=(9, 6.4), layout="constrained", sharex=True)
    for axis, (key, (name, unit, scale)) in zip(axes.flat, QUANTITIES.items()):
        means = quantities[key]
        errors = np.nan_to_num([scale * one.error for one in means])  # no bar where it is not known
        axis.errorbar(numbers, [scale * one.value for one in means], yerr=errors,
                      marker="o", markersize=4, linewidth=1, capsize=3, color="#0072B2")
        axis.set_title(f"{name}, {unit}", fontsize=9)
        axis.set_xticks(numbers)
        axis.margins(x=0.15)
    for axis in axes[-1]:
        axis.set_xlabel("pass")
    return figure
