# SPDX-License-Identifier: GPL-3.0-or-later
"""Sections of the report of one case: each function returns cards, none where the case does not have what it shows."""
import re

import h5py
import numpy as np

from .. import charge, charge_plots, mill_plots, solids
from . import figures, maps, page
from .contact_cards import contact_section
from .readings import key_numbers
from .slurry_sections import axial_section, balance_section, models_section, slurry_section
from .words import short_shares, span_of_time

FRAMES = 40  # of the animation, at most


def overview(case, readings):
    cards = [page.table(None, key_numbers(case, readings), title="Key numbers", note=spans(case, readings))]
    return [animation(case)] + cards if case.flow or case.solids else cards


def spans(case, readings):
    words = []
    if not (case.solids or case.flow):
        return "Power: mean of the dry run since it is steady, with the standard error of batch means."
    if case.solids:
        words.append(f"charge averaged over DEM time {case.charge_span[0]:.3g} to {case.charge_span[1]:.3g} s")
    if case.flow:
        words.append(f"flow from {case.begin:.3g} to {case.last:.3g} s")
    told = "Averages: " + ", ".join(words) + "."
    if case.solids or case.results:
        told += (" ±: standard errors of batch means over time. Angles are counted from straight down, positive where the "
                 "shell rises.")
    return told + readings.short_blocks(slurry=False)


def animation(case):
    """Charge and slurry over the last turn of the mill, or what there is of it."""
    if case.flow:
        frames = [frame for frame in case.flow.frames if frame[0] >= max(case.last - case.turn, 1e-9)]
        shown = case.last - max([time for time, _ in case.flow.frames if time < frames[0][0]], default=0)
        frames = [frames[k] for k in np.unique(np.linspace(0, len(frames) - 1, FRAMES).astype(int))]
        ends = case.flow.end_wall()
        edge = " and edge of the charge (orange, solidity 0.2)" if case.has_balls else ""
        return page.player((mill_plots.frame_figure(case.flow, *frame, ends) for frame in frames),
                           f"Share of slurry over the axis (blue){edge}, flow time {frames[0][0]:.2f} to "
                           f"{frames[-1][0]:.2f} s.", title=last_turn(shown, case.turn))
    windows = solids.read_windows(case.solids, case.charge_span[1] - case.turn, case.charge_span[1])
    shown = windows[-1].end - windows[0].begin
    windows = [windows[k] for k in np.unique(np.linspace(0, len(windows) - 1, FRAMES).astype(int))]
    return page.player((mill_plots.charge_figure(one, case.radius, case.omega, case.outline_at(one.end)) for one in windows),
                       f"Solidity over the axis, window by window, DEM time {windows[0].begin:.2f} to {windows[-1].end:.2f} s; "
                       "the mill's outline at the end of each.", title=last_turn(shown, case.turn))


def last_turn(seconds, turn):
    """Title of a time (s) that is shown, of a mill whose turn takes `turn` s."""
    return "The last turn" if seconds > 0.99 * turn else f"The last {seconds / turn:.2f} of a turn"


def charge_section(case, readings):
    cards = charge_maps(case, readings) if case.solids else []
    if case.energy:
        cards.append(page.picture(figures.energy(case), "Power from the torque on the walls, and the charge's energies. Dashed: "
                                  "steady from there on.", title="Dry run"))
    if case.overlaps is not None:
        cards.append(page.picture(figures.overlaps(case), "Overlaps of all contacts at all records: how soft the balls are. Few "
                                  "contacts are far to the right.", title="Overlaps"))
    return cards


def charge_maps(case, readings):
    found, mean = readings.charge, case.charge
    if isinstance(found, str):
        words = f"Solidity averaged over axis and time. Not read: {found.rstrip('?')}."
        return [page.picture(maps.solidity_figure(case, mean), words, title="Charge")]
    return [page.picture(charge_plots.charge_figure(mean, found, case.radius, case.outline),
                         "Solidity and velocity (arrows) averaged over axis and time. The free surface goes from the shoulder on "
                         "the rising side to the toe; the charge turns about the centre of circulation.", title="Charge"),
            page.picture(charge_plots.tangential_figure(found.tangential),
                         "Along the line from the mill's centre through the centre of circulation: the charge falls near the "
                         "surface (below 0) and rises with the shell. Below: what the cubic leaves, and its slope.",
                         title="Tangential velocity"),
            page.picture(maps.speed_figure(case, mean.x, mean.y, mean.velocity, mean.solidity > 0.02),
                         "Mean velocity of the balls across the axis: colour for its size, arrows for its direction.",
                         title="Speed of the balls")]


def ledger_section(case, _readings):
    cards = []
    if case.solids:
        with h5py.File(case.solids) as file:
            into, outside, clipped = (file[f"ledger/{name}"][:] for name in ("volume_in", "outside", "clipped"))
            lengths = file["window/end"][:] - file["window/begin"][:]
            rows = [("windows", str(len(into))), ("length of a window", f"{np.median(lengths):.4g} s"),
                    ("records in a window", f"{np.median(file['window/records'][:]):.0f}"),
                    ("volume of the balls", f"{1e6 * into.mean():.2f} ml"),
                    ("of it outside, at most", f"{100 * (outside / into).max():.2g} %"),
                    ("moved to neighbours, at most", f"{100 * (clipped / into).max():.2g} %"),
                    ("balls per occupied cell", f"{file['window/balls_per_cell'][:].mean():.1f}")]
            shape = " × ".join(str(n) for n in np.atleast_1d(file["grid"].attrs.get("shape", file["grid"].attrs.get("cells", 0))))
            rows.insert(0, ("voxels", shape))
        cards.append(page.table(None, rows, title="Averaging of the balls"))
    if case.slurry:
        with h5py.File(case.slurry) as file:
            into, outside = file["ledger/volume_in"][:], file["ledger/outside"][:]
        cards.append(page.table(None, [("windows", str(len(into))), ("slurry in the mesh, mean", f"{1e6 * into.mean():.2f} ml"),
                                       ("of it beyond the voxels, at most", f"{100 * np.abs(outside / into).max():.2g} %")],
                                title="Averaging of the slurry"))
    values = re.findall(r"^(cells|faces|volume|volume error|max [\w-]+(?: ratio)?)\s{2,}(\S.*)", case.log("mesh"), re.M)
    if values:
        cards.append(page.table(None, values, title="Mesh of the flow"))
    ranges = re.findall(r"^bed: beyond .*$", case.log("flow"), re.M)
    if ranges:
        cards.append(page.table(None, [(short_shares(ranges[-1].removeprefix("bed: ")),)], title="Drag law"))
    return cards


def run_section(case, _readings):
    """Versions and cost, and the mill's description."""
    rows = [(name, found) for name, found in versions(case)]
    costs = [(name, span_of_time(seconds)) for name, seconds in stage_costs(case)]
    cards = [page.table(None, rows, title="Programs")] if rows else []
    if costs:
        cards.append(page.table(None, costs, title="Cost by stage",
                                note="Wall time of stages that ended or failed, every time that they ran; not of those that "
                                     "were killed."))
    return cards + [page.folded("mill.yaml", case.mill_text)]


def cost_folders(case):
    """Folders in which stages of the case were run: the charge's, and its own."""
    return list(dict.fromkeys(([case.solids.parent] if case.solids else []) + [case.folder.resolve()]))


def versions(case):
    """(program, version) by the logs."""
    ran = dict(line.rsplit(",", 1) for path in cost_folders(case) if (path / "log.version").is_file()
               for line in (path / "log.version").read_text().splitlines())
    for stage in ("charge", "flow"):
        if stage in ran:
            yield f"millFoam, of the {stage}", ran[stage]
    found = re.findall(r"^Build\s*:\s*(\S+)", case.log("flow"), re.M)
    if found:
        yield "OpenFOAM", found[-1].replace("OPENFOAM=", "")
    found = re.findall(r"^Exec\s*:\s*(\S+)", case.log("flow"), re.M)
    if found:
        yield "flow solver", found[-1]
    log = case.dry.parent / "dem" / "log.liggghts" if case.dry else None
    if log and log.is_file():
        with open(log, errors="replace") as file:
            yield "LIGGGHTS", file.readline().strip().strip("()")


def stage_costs(case):
    """(stage, wall time in s) by log.costs of the charge's and the case's folder, all times that a stage was run added up."""
    costs = {}
    for path in (folder / "log.costs" for folder in cost_folders(case)):
        for line in path.read_text().splitlines() if path.is_file() else ():
            name, seconds = line.rsplit(",", 1)
            costs[name] = costs.get(name, 0) + float(seconds)
    if not costs and case.results and "wall_time" in case.results:
        costs["dry run"] = float(case.results["wall_time"])
    return costs.items()


SECTIONS = (("overview", "Overview", overview), ("charge", "Charge", charge_section),
            ("contacts", "Contacts", contact_section), ("slurry", "Slurry", slurry_section),
            ("axis", "Along the axis", axial_section), ("balance", "Balance", balance_section),
            ("models", "Models", models_section), ("ledger", "Ledger and mesh", ledger_section),
            ("run", "How it was run", run_section))
