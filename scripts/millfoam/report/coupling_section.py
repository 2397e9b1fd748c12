# SPDX-License-Identifier: GPL-3.0-or-later
"""Balls and slurry that move each other: the passes of a coupled mill, and whether they have settled."""
from collections.abc import Callable
from typing import Any

import numpy as np

from ..coupling.passes import ADDED, AGREE, EXCHANGED, LIMIT, MOMENTUM, NOISE, QUANTITIES, TORQUES, forces_apart
from ..coupling.table import COLUMNS, error_column, passes_figure
from ..files.data_files import read_csv, read_json
from ..files.mill_case import MillCase
from ..readings.means import Mean
from . import page
from .case_readings import Readings
from .verdict import Check, judged
from .words import uncertain


def coupling_of(case: MillCase) -> dict[str, Any]:
    """Content of a coupled case's coupling.json."""
    assert case.coupled is not None
    return read_json(case.coupled / "coupling.json", "coupling")


def coupling_checks(case: MillCase) -> list[Callable[..., Check]]:
    """The checks of a coupled case."""
    content = coupling_of(case)
    if content["coupling"] != "direct":
        return [has_settled, forces_agree]
    return [forces_exchanged,
            *([momentum_balances] if content.get("force_unbalanced") is not None else []),
            *([torques_balance] if content.get("torque_disagreement") is not None else []),
            *([voxels_are_small] if content.get("torque_added") is not None else [])]


def forces_exchanged(case: MillCase) -> Check:
    """Whether balls and flow that ran at the same time gave the same force to each other."""
    name = "The balls feel the force that the flow gives"
    apart = coupling_of(case)["force_disagreement"]
    if apart is None:
        return Check(name, "unknown", "the mean force of the flow on the balls is 0 or not known")
    return judged(name, apart, EXCHANGED, "balls and flow ran at the same time; the "
                  f"mean force on all balls by the flow and by the balls differ by {100 * apart:.2f} % (limit "
                  f"{100 * EXCHANGED:g} %)", "Average over more turns (flow.turns).", doubtful=5 * EXCHANGED)


def momentum_balances(case: MillCase) -> Check:
    """Whether the flow gives the force to the balls that its own momentum lacks."""
    name, content = "The flow's momentum balances", coupling_of(case)
    found = ("the flow's mean force on all balls differs from what its own balance of momentum leaves for them by "
             f"{unbalanced_words(content, '.1f', 'force')} (limit {100 * MOMENTUM:g} %): "
             "the slurry's force on the balls has an error of this size")
    check = judged(name, content["force_unbalanced"], MOMENTUM, found,
                   "Take smaller cells (resolution.cell_size).", doubtful=5 * MOMENTUM)
    return undecided_by(content.get("force_unbalanced_reach"), MOMENTUM, check, found)


def torques_balance(case: MillCase) -> Check:
    """Whether balls and slurry have the same torque on each other, so that the drive's power is what both take."""
    name, content = "The torque between balls and slurry balances", coupling_of(case)
    apart, whole = content["torque_disagreement"], content.get("torque_unbalanced")
    found = f"by the flow and by the balls it differs by {100 * apart:.1f} % of the drive's torque on the balls"
    if whole is not None:
        found += ("; by the balls and by the slurry's own balance by "
                  f"{unbalanced_words(content, '+.1f')} of the drive's torque")
    advice = "Take smaller cells (resolution.cell_size)."
    if apart > abs(whole or 0):
        advice = ("Take shorter time-steps (flow.max_courant)." if content.get("torque_added") is not None else
                  "Compute it again: balls of this version get the torque that voxels take from them.")
    words = f"{found} (limit {100 * TORQUES:g} %): the drive's power has an error of this size"
    check = judged(name, max(apart, abs(whole or 0)), TORQUES, words, advice, doubtful=5 * TORQUES)
    return undecided_by(content.get("torque_unbalanced_reach"), TORQUES, check, words)


def undecided_by(reach: float | None, limit: float, check: Check, words: str) -> Check:
    """A check; if it holds, and the number that `words` name last is not known to its limit, an undecided one."""
    if check.state != "holds" or (reach or 0.0) <= limit:
        return check
    return Check(check.name, "look", f"{words}; undecided: with 95 % confidence the last is known only to ± "
                 f"{100 * (reach or 0.0):.1f} %", "Average over more turns (flow.turns).", undecided=True)


def unbalanced_words(content: dict[str, Any], form: str, kind: str = "torque") -> str:
    """KIND_unbalanced of a coupling.json in per cent, with its error if this is known; without, in a format."""
    error = content.get(f"{kind}_unbalanced_error")
    return uncertain(100 * content[f"{kind}_unbalanced"], np.nan if error is None else 100 * error, "%", form)


def voxels_are_small(case: MillCase) -> Check:
    """Whether the torque of the slurry on the balls is that of the voxels' forces, but for a small part."""
    added = coupling_of(case)["torque_added"]
    return judged("The voxels are small enough for the balls' torque", added, ADDED, "voxels spread the balls; what "
                  f"their torque lacked was added to it: {100 * added:.1f} % of the drive's torque on the balls (limit "
                  f"{100 * ADDED:g} %)", "Take smaller voxels (averages.voxel_size, of a stirred mill "
                  "flow.exchange.voxel_size).", doubtful=3 * ADDED,
                  meaning="the torque as a whole is right, but not where in the charge it acts")


def has_settled(case: MillCase) -> Check:
    """Whether the passes have settled."""
    name = "Balls and slurry have settled"
    content = coupling_of(case)
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


def exchanged_table(case: MillCase) -> str:
    """Table of what balls and flow that ran at the same time gave to each other."""
    content = coupling_of(case)

    def shown(key: str, form: str, unit: str = "") -> str:
        return "–" if content[key] is None else format(content[key], form) + unit
    rows = [["mean force of the flow on all balls, by the flow", shown("force_by_flow_N", ".4g", " N")],
            ["the same, by the balls", shown("force_by_balls_N", ".4g", " N")],
            ["size of their difference", shown("force_disagreement", ".2%")]]
    if content.get("force_unbalanced") is not None:
        rows.append(["size of the difference to the flow's balance of momentum",
                     unbalanced_words(content, ".2f", "force")])
    if content.get("torque_disagreement") is not None:
        rows += [["torque of this force about the axis, by the flow", shown("torque_by_flow_Nm", ".4g", " N m")],
                 ["the same, by the balls", shown("torque_by_balls_Nm", ".4g", " N m")],
                 ["their difference over the drive's torque on the balls", shown("torque_disagreement", ".2%")]]
        if content.get("torque_added") is not None:
            rows.append(["torque that was added to the balls', because voxels spread them, over the drive's",
                         shown("torque_added", ".2%")])
        if content.get("torque_unbalanced") is not None:
            rows.append(["difference to the slurry's own balance, over the drive's torque",
                         unbalanced_words(content, "+.2f")])
    rows.append(["slurry's force over the balls' weight", shown("force_over_weight", ".3f")])
    return page.table(["", ""], rows, title="Balls and slurry at the same time",
                      note="Means over the flow's averaged time. Balls and flow meet at every time-step of the flow.")


def coupling_section(case: MillCase, _readings: Readings) -> list[str]:
    """Table and curves of the passes; nothing of a case with one-way coupling."""
    if case.coupled is None:
        return []
    if coupling_of(case)["coupling"] == "direct":
        return [exchanged_table(case)]
    columns = read_csv(case.coupled / "coupling.csv")
    head = ["", *(f"pass {number:.0f}" for number in columns["pass"])]
    rows = [[f"{name}, {unit}", *(uncertain(scale * value, scale * error, "") for value, error in zip(
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
