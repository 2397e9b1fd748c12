# SPDX-License-Identifier: GPL-3.0-or-later
"""Balls and slurry that move each other: the passes of a coupled mill, and whether they have settled."""
import numpy as np

from ..coupling.passes import AGREE, LIMIT, NOISE, QUANTITIES, forces_apart
from ..coupling.table import COLUMNS, error_column, passes_figure
from ..files.data_files import read_csv, read_json
from ..files.mill_case import MillCase
from ..readings.means import Mean
from . import page
from .case_readings import Readings
from .verdict import Check, judged
from .words import uncertain


def has_settled(case: MillCase) -> Check:
    """Whether the passes have settled."""
    name = "Balls and slurry have settled"
    content = read_json(case.coupled / "coupling.json", "coupling")
    count, most = content["passes"], content["most_passes"]
    if content["settled"]:
        return Check(name, "holds", f"after {count} passes: in the last two nothing changed by more than {LIMIT:g} "
                     f"standard errors, and the solidity by less than {NOISE:g} times its noise")
    return Check(name, "look" if count > 2 else "fails",
                 f"not after {count} passes: most of all changed the {content['largest_change']}",
                 f"Take more passes than {most} (flow.passes), or longer ones (dem.duration, flow.turns).")


def forces_agree(case: MillCase) -> Check:
    """Whether the forces that moved the balls are those that the flow then gave to them."""
    name = "The balls feel the slurry's force"
    apart = forces_apart(case.folder)
    if apart is None:
        return Check(name, "fails", "this is the dry pass: nothing moved the balls",
                     "Read the report of the last pass.")
    return judged(name, apart, AGREE, "the forces that moved the balls and those that the flow then gave to them "
                  f"differ by {100 * apart:.1f} % (limit {100 * AGREE:g} %)",
                  "Take more passes (flow.passes), or longer ones (dem.duration, flow.turns).", doubtful=0.25)


def coupling_section(case: MillCase, _readings: Readings) -> list[str]:
    """Table and curves of the passes; nothing of a case with one-way coupling."""
    if case.coupled is None:
        return []
    columns = read_csv(case.coupled / "coupling.csv")
    head = ["", *(f"pass {number:.0f}" for number in columns["pass"])]
    rows = [[f"{name}, {unit}", *(uncertain(scale * value, scale * error, "").strip() for value, error in zip(
        columns[COLUMNS[key]], columns[error_column(COLUMNS[key])]))]
        for key, (name, unit, scale) in QUANTITIES.items()]
    for key, name, form in (("solidity_change", "change of the solidity", ".3f"),
                            ("solidity_change_over_limit", "the same over its limit", ".2f"),
                            ("force_over_weight", "slurry's force over the balls' weight", ".3f"),
                            ("force_disagreement", "forces disagree by", ".1%")):
        rows.append([name, *("–" if np.isnan(value) else format(value, form) for value in columns[key])])
    means = {key: [Mean(*pair) for pair in zip(columns[column], columns[error_column(column)])]
             for key, column in COLUMNS.items()}
    note = ("Pass 1 is dry: nothing moves the balls but the mill. In each later pass they feel the force of the slurry "
            "of the pass before. ± is the standard error over time.")
    return [page.table(head, rows, title="Balls and slurry in turn", note=note, wide=True),
            page.picture(passes_figure([int(number) for number in columns["pass"]], means),
                         "Quantities over the passes, with standard errors over time.", title="Passes")]
