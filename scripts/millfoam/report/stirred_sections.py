# SPDX-License-Identifier: GPL-3.0-or-later
"""Sections of the report of a stirred mill's dry run and flow, and of the comparison of several. Each function returns
cards, or none if the case lacks what it shows."""
from collections.abc import Sequence

import numpy as np

from ..files.stirred_case import StirredCase
from ..plots.stirred_plots import meridian_figure, slices_figure
from ..plots.stirred_slurry_plots import maps_figure, vortex_figure
from ..readings.partner_spectra import BALLS, PartnerSpectra, Peak, read_partner_spectra
from ..readings.stirred_flow import read_stirred_flow
from ..readings.stirred_power import StirredNumbers, averaged_span, read_stirred
from ..readings.stirred_slurry import dumps_of_last_turn, read_slurry_flow
from . import figures, page, stirred_figures
from .case_readings import Rows
from .comparison import verdict_table
from .sections import ball_cards, run_section
from .verdict import Check
from .words import uncertain

NUMBERS_NOTE = ("±: standard errors over whole turns; a mean over fewer than two turns has none. Power number: "
                "P/(ρ N³ D⁵), N in turns per second, D from tip to tip; torque coefficient: T/(ρ ω² R⁵), R = D/2. ρ is "
                "the bulk density of the resting balls. Torque over weight: T/(m g R), m the balls' mass.")


FRAMES = 12  # of the animation, at most
FLOW_NOTE = ("±: standard errors over whole turns; of slip, Froude and Reynolds number of blocks of written times. "
             "Torque that is not balanced: rate of the slurry's angular momentum, minus the torques of "
             "walls and balls; it is the error of mesh and time-step. Slip, Froude and Reynolds number: medians over "
             "the cells with balls in slurry, weighted by the volume of their balls. "
             "Fr = slip/√(g d (ρ_b/ρ − 1)), Re = ρ (1 − φ) slip d/μ.")


def key_numbers(case: StirredCase) -> Rows:
    """Rows (name, text) of the key numbers."""
    found = read_stirred(case)
    impeller = found.torques["impeller"]
    rows = [("power", uncertain(found.power.value, found.power.error, "W")),
            ("torque on the impeller", uncertain(impeller.value, impeller.error, "N m"))]
    rows += [(f"torque on the {part}", uncertain(mean.value, mean.error, "N m"))
             for part, mean in found.torques.items() if part != "impeller"]
    rows.append(("torque at rest over the impeller's", f"{found.balance:.4f}"))
    rows.append(("steady", f"from {case.result('steady_from_s'):.2f} s on" if case.results.get("steady") else "no"))
    if found.speed:
        rows += [("mean speed of the balls", uncertain(found.speed.value, found.speed.error, "m/s")),
                 ("mean speed over that of the tips", uncertain(found.speed.value / case.tip_speed,
                                                                found.speed.error / case.tip_speed, ""))]
    return rows + dimensionless(found) + specific(found)


def dimensionless(found: StirredNumbers) -> Rows:
    """Rows of the numbers without unit, and of the density in them."""
    rows = [(name, uncertain(mean.value, mean.error, "")) for name, mean in (
        ("power number", found.power_number), ("torque coefficient", found.torque_coefficient),
        ("torque over weight", found.torque_over_weight))]
    return rows + [("bulk density of the balls, in these", f"{found.density:.4g} kg/m³")]


def specific(found: StirredNumbers) -> Rows:
    """Rows of the power over the balls' mass and, if the mill has slurry, over its volume."""
    rows = [("power for each kilogram of balls", found.per_mass, 1.0, "W/kg")]
    if found.per_slurry:
        rows.append(("power for each cubic metre of slurry", found.per_slurry, 1e-3, "kW/m³"))
    return [(name, uncertain(scale * mean.value, scale * mean.error, unit)) for name, mean, scale, unit in rows]


def flow_numbers(case: StirredCase) -> Rows:
    """Rows (name, text) of the slurry's numbers; none without a flow."""
    if case.flow is None:
        return []
    found = read_stirred_flow(case, read_slurry_flow(case.folder, case.mill, case.begin))
    rows = [(f"torque on the slurry by {'the ' if part not in ('balls', 'all') else ''}{part}", mean, 1e3, "mN m")
            for part, mean in found.torques.items()]
    rows += [("torque on the slurry that is not balanced", found.unbalanced, 1e3, "mN m")] if found.unbalanced else []
    rows += [("power of the impeller to the slurry", found.slurry_power, 1.0, "W"),
             (f"power of the impeller to the {balls_words(case)}", found.ball_power, 1.0, "W"),
             ("height of the slurry's centre", found.centre, 1e3, "mm"),
             ("slurry's share of the power", found.slurry_share, 100.0, "%"),
             ("slip of slurry and balls", found.slip, 1.0, "m/s"),
             ("Froude number of the slip", found.froude, 1.0, ""),
             ("Reynolds number of the slip", found.reynolds, 1.0, "")]
    return [(name, uncertain(scale * mean.value, scale * mean.error, unit))
            for name, mean, scale, unit in rows]


def balls_words(case: StirredCase) -> str:
    """The balls whose power stands beside the slurry's, in words."""
    return "balls" if case.mill.flow("coupling") == "direct" else "balls of the dry run"


def summary(case: StirredCase) -> str:
    """One line on a case: what was run."""
    mill = case.mill
    return ", ".join([f"stirred mill, {2e3 * mill.radius:.4g} × {1e3 * mill.length:.4g} mm",
                      f"impeller of {2e3 * case.tip_radius:.4g} mm, {mill.sense} at {case.tip_speed:.4g} m/s at its "
                      f"tips ({abs(mill.omega):.2f} rad/s)", f"{int(case.result('balls'))} balls",
                      *([f"slurry {mill.slurry('density_kg_m3'):.4g} kg/m³, drag: {case.law}"] if case.law else [])])


def overview(case: StirredCase) -> list[str]:
    """Card of the key numbers."""
    begin, end = averaged_span(case)
    turns = (end - begin) / case.turn
    return [page.table(None, key_numbers(case), title="Key numbers",
                       note=f"Means of DEM time {begin:.3g} to {end:.3g} s, {turns:.3g} turns. {NUMBERS_NOTE}")]


def time_section(case: StirredCase) -> list[str]:
    """Cards of torques, power and energies against time, and of the overlaps."""
    cards = []
    if case.torques:
        cards.append(page.picture(stirred_figures.torques(case), "Thin: records; thick: mean over the turn before. "
                                  "The balls resist the impeller and pass its torque on to the walls at rest. Dashed: "
                                  "begin of the averages.", title="Torque on each part"))
    return cards + ball_cards(case, "impeller", averaged_span(case)[0])


def charge_section(case: StirredCase) -> list[str]:
    """Cards of the maps of the balls' averages."""
    rings = case.rings
    if rings is None:
        return []
    frame = "the impeller's frame" if rings.angular_velocity else "the lab's frame"
    words = f"Averages of DEM time {rings.begin:.3g} to {rings.end:.3g} s in {frame}."
    cards = [page.picture(meridian_figure(case.mill, rings, ("solidity", "tangential")),
                          f"In the r-z plane, r over the shell's radius. {words}", title="Solidity and velocity")]
    if case.mill.impeller.get("pins"):
        cards.append(page.picture(slices_figure(case.mill, rings, ("solidity", "axial")),
                                  f"At the pins, seen from above. {words}", title="Around the pins"))
    return cards


def flow_section(case: StirredCase) -> list[str]:
    """Cards of the slurry's numbers, torques and pictures; none without a flow."""
    if case.flow is None:
        return []
    flow = read_slurry_flow(case.folder, case.mill, case.begin)
    times = f"flow time {flow.times[0]:.3g} to {flow.times[-1]:.3g} s"
    records = dumps_of_last_turn(case.folder, case.mill)
    chosen = [records[k] for k in np.unique(np.linspace(0, len(records) - 1, FRAMES).astype(int))] if records else []
    cards = [page.table(None, flow_numbers(case), title="Numbers of the slurry",
                        note=f"Means from flow time {case.begin:.3g} s on. {FLOW_NOTE}"),
             page.picture(vortex_figure(case.mill, flow, records[-1] if records else None),
                          "Section through the first pins, with the "
                          f"slurry's speed, mean of {times}, and the balls of the last record.", title="Vortex"),
             page.picture(maps_figure(case.mill, flow), f"Means over the azimuth and {times}.",
                          title="Slurry in the r-z plane")]
    if len(chosen) > 1:
        cards.append(page.player((vortex_figure(case.mill, flow, record) for record in chosen),
                                 f"The same section, record by record, DEM time {chosen[0][0]:.3f} to "
                                 f"{chosen[-1][0]:.3f} s: the {balls_words(case)} in the impeller's frame, in which "
                                 "the pins stand still. The slurry is the mean over time.", title="The last turn"))
    if case.balance is not None:
        cards.append(page.picture(stirred_figures.slurry_torques(case), "Means over the quarter turn before. Dashed: "
                                  "begin of the averages.", title="Torque on the slurry"))
    return cards


def contact_section(case: StirredCase) -> list[str]:
    """Cards of the contacts by partner; none if the run did not follow them."""
    if not (case.results or {}).get("contacts"):
        return []
    try:
        found = read_partner_spectra(case.dumps, case.parts)
        head, rows = partner_table(case, found)
    except (RuntimeError, OSError, ValueError) as error:
        return [page.paragraph(f"Contacts cannot be shown: {error}.")]
    begin, end = case.result("contacts", "begin_s"), case.result("contacts", "end_s")
    span = f"All contacts of every step, DEM time {begin:.3g} to {end:.3g} s."
    return [page.picture(stirred_figures.spectra(found, case.turn), "Top: collisions per turn by their energy at "
                         "first touch. Middle and bottom: dissipated power by the energy that the whole collision "
                         "dissipates, by partner, and its normal and tangential part. Grey: the modal peak. " + span,
                         title="Spectra of energy"),
            page.table(head, rows, wide=True, title="Where the drive's power goes",
                       note=f"{span} Tangential: sliding and the tangential damper. Modal peak: the bin with the "
                            "largest dissipated power, the middle of its energies and its power. The contacts must "
                            "dissipate what the drive gives, minus the gain of the balls' energy.")]


def partner_table(case: StirredCase, found: PartnerSpectra) -> tuple[list[str], list[tuple]]:
    """Head and rows: collisions per turn, dissipated power and modal peak of each partner, of all, and the drive."""
    dissipated = case.result("contacts", "dissipated_W")
    head = ["partner", "collisions per turn", "normal, W", "tangential, W", "rolling, W", "share, %", "modal peak, J",
            "its power, W"]
    rows, sums = [], np.zeros(3)
    for k, partner in enumerate(found.partners):
        powers = np.array([case.result("contacts", "power", partner, part)
                           for part in ("normal_W", "tangential_W", "rolling_W")])
        sums += powers
        if found.collisions[k].any():
            rows.append(partner_row("ball on ball" if partner == BALLS else f"ball on {partner}",
                                    case.turn * found.collisions[k].sum(), powers, dissipated, found.peak(partner)))
    rows.append(partner_row("all", case.turn * found.collisions.sum(), sums, dissipated, found.peak()))
    drive, gain = case.result("contacts", "drive_W"), case.result("contacts", "gain_W")
    blank = ("", "", "")
    rows += [("drive, minus the gain", *blank, (drive - gain, ".4g"), *blank),
             ("all contacts over it", *blank, (case.result("contacts", "dissipated_over_drive"), ".4f"), *blank)]
    return head, rows


def partner_row(name: str, collisions: float, powers: np.ndarray, whole: float,
                peak: Peak | None) -> tuple:
    """Row of a partner; powers: normal, tangential, rolling (W); whole: of all partners (W); peak: Peak or None."""
    end = ((peak.energy, ".3g"), (peak.power, ".3g")) if peak else ("–", "–")
    # Without rolling friction, round-off is left of it
    shown = np.where(np.abs(powers) < 1e-9 * whole, 0.0, powers)
    return (name, (collisions, ".3g"), *((value, ".4g") for value in shown), (100 * powers.sum() / whole, ".1f"), *end)


SECTIONS = (("overview", "Overview", overview), ("charge", "Balls", charge_section),
            ("flow", "Slurry", flow_section), ("time", "Against time", time_section),
            ("contacts", "Contacts", contact_section),
            ("run", "How it was run", lambda case: run_section(case, None)))


def compared(cases: Sequence[StirredCase], names: Sequence[str], found: Sequence[list[Check]]) -> list[page.Section]:
    """(id, heading, [cards]) of a comparison of cases, their names and lists of checks."""
    columns = [dict([*key_numbers(case), *flow_numbers(case)]) for case in cases]
    keys = list(dict.fromkeys(key for column in columns for key in column))
    rows = [("run", *(summary(case) for case in cases))]
    rows += [(key, *(column.get(key, "–") for column in columns)) for key in keys]
    note = f"{NUMBERS_NOTE} {FLOW_NOTE}" if any(case.flow for case in cases) else NUMBERS_NOTE
    cards = [page.table(["", *names], rows, wide=True, note=note)]
    return [("numbers", "Numbers", cards),
            ("checks", "Can they be believed?", [verdict_table(found, names)]),
            ("time", "Against time", compared_torques(cases, names)),
            ("contacts", "Contacts", compared_contacts(cases, names))]


def compared_torques(cases: Sequence[StirredCase], names: Sequence[str]) -> list[str]:
    """Card of the impellers' torques against turns."""
    curves = []
    for case, name in zip(cases, names):
        if case.torques:
            times, mean = figures.running_mean(case.torques["time_s"], case.torques["impeller_Nm"], case.turn)
            curves.append((name, times / case.turn, -mean))
    if not curves:
        return []
    return [page.picture(figures.lines_against(curves, "turns", "torque of the impeller, N m\n(mean over a turn)"),
                         "What the impeller gives to the balls.", title="Torque")]


def compared_contacts(cases: Sequence[StirredCase], names: Sequence[str]) -> list[str]:
    """Cards of the spectra of the cases that followed their contacts."""
    found = [(name, case, read_partner_spectra(case.dumps, case.parts)) for case, name in zip(cases, names)
             if case.results.get("contacts")]
    found = [one for one in found if one[2].peak()]
    if not found:
        return []
    rows = []
    for name, case, spectra in found:
        peak = spectra.peak()
        rows.append((name, (case.turn * spectra.collisions.sum(), ".3g"),
                     (case.result("contacts", "dissipated_W"), ".4g"),
                     (case.result("contacts", "dissipated_over_drive"), ".4f"),
                     (peak.energy, ".3g"), (peak.power, ".3g")))
    return [page.picture(stirred_figures.compared_spectra([(name, spectra) for name, _, spectra in found]),
                         "Dissipated power of all contacts by the energy that a collision dissipates.",
                         title="Spectra of energy"),
            page.table(["", "collisions per turn", "dissipated, W", "over the drive's", "modal peak, J",
                        "its power, W"], rows, wide=True, title="Contacts")]
