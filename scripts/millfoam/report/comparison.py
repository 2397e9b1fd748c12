# SPDX-License-Identifier: GPL-3.0-or-later
"""Sections of the report that compare several cases with the first."""
from collections.abc import Sequence

import numpy as np

from ..files.mill_case import MillCase
from ..files.slurry_file import SlurryMap
from ..files.solids_file import SolidsMap
from ..plots import mill_plots
from ..readings import axial, charge, compare
from ..readings.free_surface import free_surface
from . import figures, maps, page
from .case_readings import FRAME, Readings, key_numbers
from .headline import summary
from .verdict import Check
from .words import Name

Compared = tuple[MillCase, Readings, str]  # a case, its readings, its name


def sections(cases: Sequence[MillCase], readings: Sequence[Readings], names: Sequence[str],
             found: Sequence[list[Check]]) -> list[page.Section]:
    """(id, heading, [cards]) of cases, their Readings, names and lists of checks. The first case is the reference."""
    numbers_card = numbers(cases, readings, names)
    return [("numbers", "Numbers", [numbers_card]),
            ("checks", "Can they be believed?", [verdict_table(found, names)]),
            ("charge", "Charge", charge_cards(cases, readings, names)),
            ("slurry", "Slurry", slurry_cards(cases, readings, names)),
            ("axis", "Along the axis", axial_cards(cases, readings, names)),
            ("time", "Against time", time_cards(cases, names))]


def distinct(cases: Sequence[MillCase]) -> list[str]:
    """Names of the cases' folders, with as many parent folders as make them different."""
    parts = [case.folder.resolve().parts for case in cases]
    for depth in range(1, max(map(len, parts)) + 1):
        names = ["/".join(one[-depth:]) for one in parts]
        if len(set(names)) == len(names):
            return names
    return [f"{'/'.join(one[-1:])} ({number})" for number, one in enumerate(parts, 1)]


def numbers(cases: Sequence[MillCase], readings: Sequence[Readings], names: Sequence[str]) -> str:
    """Key numbers, a column per case."""
    columns = [dict(key_numbers(case, reading)) for case, reading in zip(cases, readings)]
    keys = list(dict.fromkeys(key for column in columns for key in column))
    rows = [(key, *(column.get(key, "–") for column in columns)) for key in keys]
    rows.insert(0, ("run", *(summary(case) for case in cases)))
    short = [f" {name}:{words}" for name, words in zip(names, [one.short_blocks(slurry=False) for one in readings])
             if words]
    return page.table(["", *names], rows, wide=True, note="±: standard errors of batch means over time. Angles are "
                                                          "counted from straight down, positive where the shell "
                                                          "rises. " + FRAME
                      + "".join(short))


def verdict_table(found: Sequence[list[Check]], names: Sequence[str]) -> str:
    """The states of lists of checks, a column per case."""
    by_name = [{check.name: check for check in checks} for checks in found]
    keys = list(dict.fromkeys(key for one in by_name for key in one))
    rows = [(key, *(page.MARKS[one[key].state] if key in one else "–" for one in by_name)) for key in keys]
    return page.table(["", *names], rows, wide=True, note="Each case's own report has the findings and what to do.")


def same_pixels(a: SolidsMap | SlurryMap, b: SolidsMap | SlurryMap) -> bool:
    """Whether two maps are on the same pixels."""
    return len(a.x) == len(b.x) and len(a.y) == len(b.y) and np.allclose(a.x, b.x) and np.allclose(a.y, b.y)


def not_compared(case: MillCase, first: MillCase, one: SolidsMap | SlurryMap,
                 other: SolidsMap | SlurryMap) -> str | None:
    """Why maps of a case are not compared with those of the first; None if they are."""
    if not np.isclose(case.radius, first.radius):
        return f"another diameter, {2e3 * case.radius:.4g} mm instead of {2e3 * first.radius:.4g} mm"
    if case.omega * first.omega < 0:
        return "turns the other way"
    return None if same_pixels(one, other) else "different voxels"


def charge_cards(cases: Sequence[MillCase], readings: Sequence[Readings], names: Sequence[str]) -> list[str]:
    """Solidity maps, their differences with numbers, free surfaces and tangential velocities."""
    compared = [(case, reading, name) for case, reading, name in zip(cases, readings, names) if case.solids]
    if len(compared) < 2:
        return []
    if len({case.solids for case, _, _ in compared}) == 1:
        return [page.paragraph("These flows have the same dry charge.")]
    cards = [page.picture(maps.solidity_figure(case, case.charge), "Solidity averaged over axis and time.", title=name)
             for case, _, name in compared]
    return cards + charge_differences(compared) + charge_curves(compared)


def charge_differences(compared: Sequence[Compared]) -> list[str]:
    """Maps of the differences from the first case, and a table of their numbers."""
    (first, _, first_name), cards = compared[0], []
    rows: list[tuple] = []
    for case, _, name in compared[1:]:
        reason = not_compared(case, first, case.charge, first.charge)
        if reason or case.solids == first.solids:
            rows.append((name, "–", "–", "–", f"not compared: {reason or 'the same dry charge'}"))
            continue
        apart = compare.difference_maps(case.charge, first.charge)
        figure = maps.difference_figure(case, apart.x, apart.y, apart.solidity, "difference of solidity, –", 0.05)
        cards.append(page.picture(figure, Name(f"Solidity of {name} minus that of {first_name}. Red: denser."),
                                  title=Name(f"{name} − {first_name}")))
        found = compare.difference(case.charge, first.charge)
        try:
            ours, theirs = (free_surface(one.charge, one.radius) for one in (case, first))
            surface = compare.surface_difference(ours, theirs)
            height = f"{1e3 * surface.mean:+.2g} mm, standard deviation {1e3 * surface.deviation:.2g} mm"
        except RuntimeError:
            height = "–"
        rows.append((name, *((100 * value, ".3g") for value in (found.solidity, found.velocity_x, found.velocity_y)),
                     height))
    if rows:
        cards.append(page.table(["", "solidity, %", "velocity x, %", "velocity y, %", "free surface"], rows, wide=True,
                                note="Solidity: mean |difference| over 0.634. Velocities: mean |difference|, weighted "
                                     "by the solidity, over the mean of both largest speeds. Free surface: its height "
                                     "minus that of the first.",
                                title=Name(f"Charge compared with {first_name}")))
    return cards


def charge_curves(compared: Sequence[Compared]) -> list[str]:
    """Free surfaces and tangential velocities of the cases with the first one's radius and sense of rotation that have
    these readings."""
    first = compared[0][0]
    radius = first.radius
    read = [(case, name, reading.charge) for case, reading, name in compared
            if isinstance(reading.charge, charge.Charge) and np.isclose(case.radius, radius)
            and case.omega * first.omega > 0]
    if len(read) < 2:
        return []
    case = read[0][0]
    curves = [(name, 1e3 * one.tangential.distance, one.tangential.velocity) for _, name, one in read]
    return [page.picture(figures.surfaces([(name, one.surface.points) for _, name, one in read], radius, case.omega),
                         "From the shoulder on the rising side to the toe.", title="Free surfaces"),
            page.picture(figures.lines_against(curves, "distance from the mill's centre, mm",
                                               "tangential velocity, m/s\n(positive as the mill turns)"),
                         "Along the line through the centre of circulation, from the free surface to 8 mm from the "
                         "shell.", title="Tangential velocity")]


def slurry_cards(cases: Sequence[MillCase], readings: Sequence[Readings], names: Sequence[str]) -> list[str]:
    """Maps of the slurry's share, and their differences from the first case's."""
    compared = [(case, reading.slurry, name) for case, reading, name in zip(cases, readings, names)
                if isinstance(reading.slurry, SlurryMap)]
    if not compared:
        return []
    cards = [page.picture(maps.map_figure(case, one.x, one.y, one.share, "share of the fluid, –", mill_plots.SLURRY,
                                          (0, 1)),
                          f"Share of the fluid that is slurry, averaged over the axis and {one.source}.", title=name)
             for case, one, name in compared]
    first_case, first, first_name = compared[0]
    for case, one, name in compared[1:]:
        reason = not_compared(case, first_case, one, first)
        if reason:
            cards.append(page.paragraph(Name(f"The slurry of {name} is not compared with that of {first_name}: "
                                             f"{reason}.")))
        else:
            figure = maps.difference_figure(case, one.x, one.y, one.share - first.share, "difference of the share, –",
                                            0.1)
            cards.append(page.picture(figure, Name(f"Share of slurry of {name} minus that of {first_name}. Red: more "
                                                   "slurry."), title=Name(f"{name} − {first_name}")))
    return cards


def axial_cards(cases: Sequence[MillCase], readings: Sequence[Readings], names: Sequence[str]) -> list[str]:
    """Profiles along the axis of all cases that have one."""
    found = [(name, reading.profile) for name, reading in zip(names, readings)
             if isinstance(reading.profile, axial.AxialProfile) and len(reading.profile.z) > 2]
    if not found:
        return []
    z = "z, mm" if any(case.is_slice for case in cases) else "z from the feed end, mm"
    return [page.picture(figures.lines_against([(name, 1e3 * one.z, 1e3 * one.height) for name, one in found], z,
                                               "height of the centre, mm"), "Mean over time.",
                         title="Height of the slurry's centre"),
            page.picture(figures.lines_against([(name, 1e3 * one.z, one.pressure) for name, one in found], z,
                                               "p_rgh, Pa"),
                         "Pressure in the slurry without the hydrostatic part, mean over time.", title="p_rgh")]


def time_cards(cases: Sequence[MillCase], names: Sequence[str]) -> list[str]:
    """Hold-up, height of the centre and power against time of all cases that have a balance."""
    balanced = [(name, case) for name, case in zip(names, cases) if case.balance is not None
                and len(case.balance["Time"]) > 1]
    if not balanced:
        return []
    curves = {key: [(name, case.balance["Time"], scale * case.balance[key]) for name, case in balanced]
              for key, scale in (("holdUp", 1e6), ("y", 1e3))}
    power = [(name, *figures.quarter_turns(case, "power")) for name, case in balanced]
    limits = np.array([figures.late_limits(times, values) for _, times, values in power])
    return [page.picture(figures.lines_against(curves["holdUp"], "flow time, s", "hold-up, ml"), "Slurry in the mill.",
                         title="Hold-up"),
            page.picture(figures.lines_against(curves["y"], "flow time, s", "y, mm"), "Of the slurry's volume.",
                         title="Height of the centre"),
            page.picture(figures.lines_against(power, "flow time, s", "power, W\n(mean over a quarter turn)",
                                               (limits[:, 0].min(), limits[:, 1].max())),
                         "Power that walls and balls give to the slurry. The start-up may be beyond the axis.",
                         title="Power for the slurry")]
