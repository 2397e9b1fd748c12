# SPDX-License-Identifier: GPL-3.0-or-later
"""Sections of the report of one case. Each function returns cards, or none if the case lacks what it shows."""
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from ..files import solids_file
from ..files.data_files import read_text
from ..files.mill_case import MillCase
from ..plots import charge_plots, mill_plots
from ..readings.means import CORRELATED, Mean
from ..readings.mill_power import power_begin
from . import figures, maps, page
from .case_readings import FRAME, Readings, key_numbers, slurry_turns
from .contact_cards import contact_section
from .coupling_section import coupling_of, coupling_section
from .flow_checks import beyond_law
from .power_section import power_section
from .slurry_sections import axial_section, balance_section, models_section, slurry_section
from .stages import programs
from .words import Name, quantity, span_of_time

FRAMES = 40  # of the animation, at most
CHARGE_STAGES = ("walls", "charge", "average")  # that a case may have from another one


def overview(case: MillCase, readings: Readings) -> list[str]:
    """Cards of the animation and the key numbers."""
    cards = [page.table(None, key_numbers(case, readings), title="Key numbers", note=spans(case, readings))]
    return [animation(case)] + cards if case.flow or case.solids else cards


def spans(case: MillCase, readings: Readings) -> str:
    """In words, the times over which the key numbers are averaged."""
    power = f"power from DEM time {power_begin(case):.3g} s on" if case.results else ""
    if not (case.solids or case.flow):
        return f"Averages: {power}. ±: standard errors of batch means over time."
    words = [power] if power else []
    if case.solids:
        words.append(f"charge averaged over DEM time {case.charge_span[0]:.3g} to {case.charge_span[1]:.3g} s")
    if case.flow:
        words.append(f"flow from {case.begin:.3g} to {case.last:.3g} s")
    text = "Averages: " + ", ".join(words) + "."
    if case.solids or case.results:
        text += " ±: standard errors of batch means over time."
    if case.flow:
        text += errors_of_flow(slurry_turns(case))
    if case.solids or case.results:
        text += " Angles are counted from straight down, positive where the shell rises."
    return f"{text} {FRAME}{readings.short_blocks(slurry=False)}"


def errors_of_flow(turns: int) -> str:
    """In words, what ± is of the slurry's means over so many whole turns."""
    if turns < 2:
        return (f" The slurry's means have no ±: it needs two whole turns of the flow, and this one was averaged over "
                f"{turns}.")
    words = f" ± of the slurry: standard errors of the means of {turns} whole turns."
    if turns >= CORRELATED:
        return (f"{words} Neighbouring turns may be alike (correlated). An error is then known less well. Where the "
                "95 % interval is wider than 2.3 errors, the table has it.")
    return (f"{words} With 95 % confidence a mean is known within {Mean(0.0, 1.0, turns - 1).reach:.1f} of them (two "
            "turns: 12.7, three: 4.3, many: 2.0).")


def animation(case: MillCase) -> str:
    """Charge and slurry over the last turn of the mill, or over the part of it that exists."""
    if case.flow:
        frames = [frame for frame in case.flow.frames if frame[0] >= max(case.last - case.turn, 1e-9)]
        shown = case.last - max([time for time, _ in case.flow.frames if time < frames[0][0]], default=0)
        frames = [frames[k] for k in np.unique(np.linspace(0, len(frames) - 1, FRAMES).astype(int))]
        edge = " and edge of the charge (orange, solidity 0.2)" if case.has_balls else ""
        return page.player(mill_plots.frame_figures(case.flow, frames),
                           f"Share of slurry over the axis (blue){edge}, flow time {frames[0][0]:.2f} to "
                           f"{frames[-1][0]:.2f} s.", title=last_turn(shown, case.turn))
    windows = solids_file.read_windows(case.solids, case.charge_span[1] - case.turn, case.charge_span[1])
    shown = windows[-1].end - windows[0].begin
    windows = [windows[k] for k in np.unique(np.linspace(0, len(windows) - 1, FRAMES).astype(int))]
    return page.player(mill_plots.charge_figures(windows, case.radius, case.omega, case.outline_at),
                       f"Solidity over the axis, window by window, DEM time {windows[0].begin:.2f} to "
                       f"{windows[-1].end:.2f} s. The outline is that at the end of each window.",
                       title=last_turn(shown, case.turn))


def last_turn(seconds: float, turn: float) -> str:
    """Title of an animation of so many seconds, of a mill whose turn takes `turn` s."""
    return "The last turn" if seconds > 0.99 * turn else f"The last {seconds / turn:.2f} of a turn"


def charge_section(case: MillCase, readings: Readings) -> list[str]:
    """Cards of the charge: its maps and readings, energies and overlaps of the dry run."""
    begin = power_begin(case) if case.results else np.nan
    return (charge_maps(case, readings) if case.solids else []) + ball_cards(case, "walls", begin)


def ball_cards(case: MillCase, driven: str, begin: float) -> list[str]:
    """Cards of the energies and the overlaps of the balls; driven: what the drive turns, in words; begin: DEM time (s)
    from which their power is averaged."""
    cards = []
    if case.energy:
        steady = " In the lower panel: begin of the steady time." if case.results.get("steady") else ""
        cards.append(page.picture(figures.energy(case, begin), f"Power from the torque on the {driven}, and the balls' "
                                  "energies. Dashed line in the upper panel: begin of the time over which the power is "
                                  f"averaged.{steady}", title="Power and energies of the balls"))
    if case.overlaps is not None:
        cards.append(page.picture(figures.overlaps(case), "Overlaps of all contacts, at about every tenth "
                                                          "record. Balls are stiff enough if few contacts are far to "
                                                          "the right.",
                                  title="Overlaps"))
    return cards


def charge_maps(case: MillCase, readings: Readings) -> list[str]:
    """Cards of the charge's map and its readings, if it has them."""
    found, mean = readings.charge, case.charge
    if isinstance(found, str):
        words = f"Solidity averaged over axis and time. There are no readings: {found}."
        return [page.picture(maps.solidity_figure(case, mean), words, title="Charge")]
    return [page.picture(charge_plots.charge_figure(mean, found, case.radius, case.outline),
                         "Solidity and velocity (arrows) averaged over axis and time. The free surface reaches from "
                         "the shoulder on the rising side to the toe. The charge turns about the centre of "
                         "circulation.", title="Charge"),
            page.picture(charge_plots.tangential_figure(found.tangential),
                         "Along the line from the mill's centre through the centre of circulation. The charge falls "
                         "near the surface (below 0) and rises with the shell. Lower panels: map minus cubic, and the "
                         "cubic's slope.",
                         title="Tangential velocity"),
            page.picture(maps.speed_figure(case, mean.x, mean.y, mean.velocity, mean.shown()),
                         "Mean velocity of the balls across the axis. Colour: its size; arrows: its direction.",
                         title="Speed of the balls")]


def ledger_section(case: MillCase, _readings: Readings) -> list[str]:
    """Cards of the ledgers of both averages, the mesh, and the range of the drag law."""
    cards = []
    if case.solids:
        with h5py.File(case.solids) as file:
            into, outside, clipped = (file[f"ledger/{name}"][:] for name in ("volume_in", "outside", "clipped"))
            lengths = file["window/end"][:] - file["window/begin"][:]
            rows = [("windows", str(len(into))), ("length of a window", f"{np.median(lengths):.4g} s"),
                    ("records in a window", f"{np.median(file['window/records'][:]):.0f}"),
                    ("volume of the balls", f"{1e6 * into.mean():.2f} ml"),
                    ("share outside, at most", f"{100 * (outside / into).max():.2g} %"),
                    ("share moved to neighbours, at most", f"{100 * (clipped / into).max():.2g} %"),
                    ("balls per occupied cell", f"{file['window/balls_per_cell'][:].mean():.1f}")]
            shape = " × ".join(str(n) for n in np.atleast_1d(file["grid"].attrs.get("shape",
                                                                                    file["grid"].attrs.get("cells",
                                                                                                           0))))
            rows.insert(0, ("voxels", shape))
        cards.append(page.table(None, rows, title="Averaging of the balls"))
    if case.slurry:
        with h5py.File(case.slurry) as file:
            into, outside = file["ledger/volume_in"][:], file["ledger/outside"][:]
        cards.append(page.table(None, [("windows", str(len(into))), ("slurry in the mesh, mean",
                                                                     f"{1e6 * into.mean():.2f} ml"),
                                       ("share beyond the voxels, at most",
                                        f"{100 * np.abs(outside / into).max():.2g} %")],
                                title="Averaging of the slurry"))
    mesh = case.json(case.folder / "mesh.json", "mesh")
    if mesh:
        rows = [(quantity(key, one.get("value"))[0] + ", at most", f"{quantity(key, one.get('value'))[1]} (limit "
                                                                   f"{one.get('limit')})")
                for key, one in (mesh.get("quality") or {}).items()]
        cards.append(page.table(None, numbers_of(mesh) + rows, title="Mesh of the flow"))
    drag, beyond = (case.record.last.get(key) if case.law else None for key in ("drag", "beyond_law"))
    if drag and beyond:
        # flow.json has means since the last start of slurryFoam
        whole = beyond_law(case)
        beyond = {**beyond, **(dict(zip(("mean", "largest"), whole)) if whole else {})}
        cards.append(page.table(None, drag_rows(drag, beyond), title="Drag law",
                                note="Shares by bound are means since the last start of the flow."))
    return cards


def drag_rows(drag: dict[str, Any], beyond: dict[str, float]) -> list[tuple[str, str]]:
    """Rows (name, text) of the law of flow.json, and of the share of the slurry in the bed beyond its range: `mean` and
    `largest`, and means by the bound."""
    names = {"mean": "slurry of the bed beyond the range, mean over time",
             "largest": "slurry of the bed beyond the range, at most",
             "solidity_below": "solidity below the range", "solidity_above": "solidity above the range",
             "reynolds_below": "Reynolds number below the range", "reynolds_above": "Reynolds number above the range"}
    rows = [("law", drag["law"]), ("reference", drag.get("reference", "not known"))]
    rows += [(f"range of the {name}", "{} to {}".format(*("any" if one is None else f"{one:.3g}" for one in drag[key])))
             for key, name in (("solidity_range", "solidity"), ("reynolds_range", "Reynolds number")) if key in drag]
    return rows + [(name, f"{100 * beyond[key]:.3g} %") for key, name in names.items() if beyond.get(key) is not None]


def numbers_of(content: dict[str, Any]) -> list[tuple[str, str]]:
    """Rows (name, text) of the single values of a JSON result, without its head."""
    head = ("format", "version", "program", "mill")
    return [quantity(key, value) for key, value in content.items()
            if key not in head and not isinstance(value, (dict, list))]


def run_section(case: MillCase, _readings: Readings) -> list[str]:
    """Versions and cost, and the resolved mill."""
    cards = [page.table(None, programs(case), title="Programs", note="From the files that they wrote.")]
    costs = [(name, span_of_time(seconds)) for name, seconds in stage_costs(case).items()]
    if costs:
        others = (" Before a colon: another folder, in which the stage was run."
                  if any(isinstance(name, Name) for name, _ in costs) else "")
        cards.append(page.table(None, costs, title="Cost by stage",
                                note="Wall time, the sum of all runs of a stage that ended or failed. Killed runs are "
                                     f"not counted.{others}"))
    mill = case.mill
    rows: list[tuple[str, str]] = [(f"fingerprint: {part}", Name(found))
                                   for part, found in mill.fingerprint.items() if found]
    rows += [("changed by --set", Name(setting)) for setting in mill.settings]
    if mill.changed_since():
        rows.append((Name(mill.file_name), f"{mill.file_name} was changed after this run; the report shows the run's "
                                           "mill"))
    if rows:
        cards.append(page.table(None, rows, title="The mill", note="Files with another fingerprint belong to another "
                                                                   "mill."))
    return cards + [page.folded("The resolved mill (mill.json): every key with its default, every derived number",
                                mill.text())]


def stage_costs(case: MillCase) -> dict[str, float]:
    """Stage -> wall time, s, summed over all runs of it, in the order of the runs: of the case, and of a coupled case's
    other passes; of a case that has its charge from another one, also CHARGE_STAGES of that. Stages of other folders
    than the case's are a Name `FOLDER: STAGE`."""
    own = case.folder.resolve()
    passes = [own] if case.coupled is None else [(case.coupled / name).resolve() for name in
                                                 coupling_of(case)["folders"]]
    costs: dict[str, float] = {}
    for folder in [other for other in case.charge_folders if other not in passes] + passes:
        for stage, seconds in costs_of(folder).items():
            if folder in passes or stage in CHARGE_STAGES:
                costs[stage if folder == own else Name(f"{folder.name}: {stage}")] = seconds
    if not costs and case.results and "wall_time_s" in case.results:
        costs["balls"] = case.result("wall_time_s")
    return costs


def costs_of(folder: Path) -> dict[str, float]:
    """Stage -> wall time, s, summed over all runs of it, from log.costs in a folder; empty without this file."""
    path = folder / "log.costs"
    costs: dict[str, float] = {}
    for line in read_text(path).splitlines() if path.is_file() else ():
        name, _, seconds = line.rpartition(",")
        if name.startswith("~"):
            continue  # of a stage that is being made again
        try:
            costs[name] = costs.get(name, 0.0) + float(seconds)
        except ValueError:
            continue  # half a line of a killed step
    return costs


SECTIONS = (("overview", "Overview", overview), ("charge", "Charge", charge_section),
            ("coupling", "Coupling of balls and slurry", coupling_section),
            ("contacts", "Contacts", contact_section), ("slurry", "Slurry", slurry_section),
            ("axis", "Along the axis", axial_section), ("balance", "Balance", balance_section),
            ("power", "Power", power_section), ("models", "Models", models_section),
            ("ledger", "Ledger and mesh", ledger_section), ("run", "How it was run", run_section))
