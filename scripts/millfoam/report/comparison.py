# SPDX-License-Identifier: GPL-3.0-or-later
"""Sections of the report that hold several cases against the first."""
import matplotlib.pyplot as plt
import numpy as np

from .. import axial, charge, compare
from ..slurry import SlurryMap
from . import checks, figures, page
from .sections import key_numbers


def sections(cases, readings):
    """(id, heading, [cards]) of cases and their Readings, the first being what the others are held against."""
    names = distinct(cases)
    return [("numbers", "Numbers", [numbers(cases, readings, names)]),
            ("checks", "Can they be believed?", [verdict_table(cases, names)]),
            ("charge", "Charge", charge_cards(cases, readings, names)),
            ("slurry", "Slurry", slurry_cards(cases, readings, names)),
            ("axis", "Along the axis", axial_cards(readings, names)),
            ("time", "Against time", time_cards(cases, names))]


def distinct(cases):
    """Names of the cases' folders, with their parents' where two are the same."""
    names = [case.name for case in cases]
    return [name if names.count(name) == 1 else f"{case.folder.resolve().parent.name}/{name}" for case, name in zip(cases, names)]


def numbers(cases, readings, names):
    """Key numbers, a column per case."""
    columns = [dict(key_numbers(case, reading)) for case, reading in zip(cases, readings)]
    keys = list(dict.fromkeys(key for column in columns for key in column))
    rows = [(key, *(column.get(key, "–") for column in columns)) for key in keys]
    rows.insert(0, ("run", *(case.summary() for case in cases)))
    return page.table(["", *names], rows, wide=True)


def verdict_table(cases, names):
    found = [{check.name: check for check in checks.all_checks(case)} for case in cases]
    keys = list(dict.fromkeys(key for one in found for key in one))
    rows = [(key, *(page.MARKS[one[key].state] if key in one else "–" for one in found)) for key in keys]
    return page.table(["", *names], rows, wide=True, note="What was found, and what to do, is in each case's own report.")


def maps_figure(panels, unit, colours, limits):
    """Maps (title, x edges, y edges, values) side by side with one scale."""
    figure, axes = plt.subplots(1, len(panels), figsize=(3.5 * len(panels) + 0.8, 3.7), constrained_layout=True, squeeze=False)
    for axis, (title, x, y, values) in zip(axes[0], panels):
        image = axis.pcolormesh(1e3 * x, 1e3 * y, values, cmap=colours, vmin=limits[0], vmax=limits[1])
        axis.set(aspect="equal", xlabel="x, mm")
        axis.set_title(title, fontsize=10)
    axes[0, 0].set_ylabel("y, mm")
    figure.colorbar(image, ax=axes[0], shrink=0.85, label=unit)
    return figure


def same_voxels(a, b):
    return len(a.x) == len(b.x) and len(a.y) == len(b.y) and np.allclose(a.x, b.x) and np.allclose(a.y, b.y)


def charge_cards(cases, readings, names):
    """Solidity maps, their differences with numbers, free surfaces and tangential velocities."""
    with_charge = [(case, reading, name) for case, reading, name in zip(cases, readings, names) if case.solids]
    if len(with_charge) < 2 or len({case.solids for case, _, _ in with_charge}) == 1:
        return [page.paragraph("These flows move through one and the same dry charge.")] if with_charge else []
    cards = [page.picture(maps_figure([(name, case.charge.x, case.charge.y, np.where(case.charge.inside > 0.01, case.charge.solidity,
                                                                                      np.nan)) for case, _, name in with_charge],
                                      "solidity, –", "YlOrBr", (0, 0.65)), "Averaged over axis and time.", title="Solidity", wide=True)]
    first = with_charge[0]
    rows, panels = [], []
    for case, _, name in with_charge[1:]:
        if case.solids == first[0].solids or not same_voxels(case.charge, first[0].charge):
            continue
        found = compare.compare(case.charge, first[0].charge, case.radius)
        rows.append((name, (found.difference.solidity, ".4f"), (found.difference.velocity_x, ".4f"),
                     (found.difference.velocity_y, ".4f"), f"{1e3 * found.surface.mean:+.2f} ± {1e3 * found.surface.deviation:.2f} mm"))
        panels.append((f"{name} less {first[2]}", found.maps.x, found.maps.y, found.maps.solidity))
    if panels:
        cards.append(page.picture(maps_figure(panels, "difference of solidity, –", "RdBu_r", (-0.15, 0.15)),
                                  "Red: denser than the first.", title="Differences", wide=True))
        cards.append(page.table(["", "solidity", "velocity x", "velocity y", "free surface, mean ± deviation"], rows, wide=True,
                                note="Mean |difference| of solidity over 0.634; of velocities, weighted by the solidity, over the mean of "
                                     "both largest speeds; height of the free surface less the first's.",
                                title=f"Held against {first[2]}"))
    read = [(name, reading.charge) for _, reading, name in with_charge if isinstance(reading.charge, charge.Charge)]
    if read:
        cards.append(page.picture(figures.surfaces([(name, one.surface.points) for name, one in read], first[0].radius),
                                  "From the shoulder to the toe.", title="Free surfaces"))
        cards.append(page.picture(figures.lines_against([(name, 1e3 * one.tangential.distance, one.tangential.velocity)
                                                         for name, one in read], "distance from the mill's centre, mm",
                                                        "tangential velocity, m/s"), "Along the line through the centre of circulation.",
                                  title="Tangential velocity"))
    return cards


def slurry_cards(cases, readings, names):
    with_slurry = [(case, reading.slurry, name) for case, reading, name in zip(cases, readings, names)
                   if isinstance(reading.slurry, SlurryMap)]
    if not with_slurry:
        return []
    cards = [page.picture(maps_figure([(name, one.x, one.y, one.share) for _, one, name in with_slurry], "share of the fluid, –",
                                      "Blues", (0, 1)), "Averaged over axis and time.", title="Slurry", wide=True)]
    first = with_slurry[0]
    panels = [(f"{name} less {first[2]}", one.x, one.y, one.share - first[1].share) for _, one, name in with_slurry[1:]
              if same_voxels(one, first[1])]
    if panels:
        cards.append(page.picture(maps_figure(panels, "difference of the share, –", "RdBu_r", (-1, 1)), "Red: more slurry than the first.",
                                  title="Differences", wide=True))
    return cards


def axial_cards(readings, names):
    found = [(name, reading.profile) for name, reading in zip(names, readings)
             if isinstance(reading.profile, axial.AxialProfile) and len(reading.profile.z) > 2]
    if not found:
        return []
    z = "z from the feed end, mm"
    return [page.picture(figures.lines_against([(name, 1e3 * one.z, 1e3 * one.height) for name, one in found], z,
                                               "height of the centre, mm"), "Mean over time.", title="Height of the slurry's centre"),
            page.picture(figures.lines_against([(name, 1e3 * one.z, one.pressure) for name, one in found], z, "p_rgh, Pa"),
                         "Pressure in the slurry without what the depth makes, mean over time.", title="Head")]


def time_cards(cases, names):
    told = [(name, case) for name, case in zip(names, cases) if case.balance is not None]
    if not told:
        return []
    curves = {key: [(name, case.balance["Time"], scale * case.balance[key]) for name, case in told]
              for key, scale in (("holdUp", 1e6), ("y", 1e3))}
    power = [(name, case.balance["Time"][1:], figures.running_mean(case.balance["Time"], case.balance["power"],
                                                                   np.pi / 2 / abs(case.omega))[1:]) for name, case in told]
    return [page.picture(figures.lines_against(curves["holdUp"], "flow time, s", "hold-up, ml"), "Slurry in the mill.", title="Hold-up"),
            page.picture(figures.lines_against(curves["y"], "flow time, s", "y, mm"), "Of the slurry's volume.",
                         title="Height of the centre"),
            page.picture(figures.lines_against(power, "flow time, s", "W, mean over a quarter of a turn"), "What walls and balls give.",
                         title="Power for the slurry")]
