# SPDX-License-Identifier: GPL-3.0-or-later
"""Sections of the report about the slurry: its maps, its motion along the axis, its balance, and mechanistic models
to compare it with."""
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from ..files.mill_case import MillCase
from ..files.slurry_file import SlurryMap
from ..plots import mill_plots
from ..readings import axial, charge, models, slurry_on_maps
from ..readings.axial import humps_at_ends
from ..readings.batches import error_over_turns
from ..readings.means import block_mean, time_mean
from ..readings.mill_power import feels_slurry
from ..readings.slurry_over_time import RING, Way, ring_depth
from . import figures, maps, page
from .case_readings import Readings
from .residence_cards import residence_cards
from .words import millilitres, uncertain

AIR = "air between the balls where slurry is ¹"
AIR_OF_MESH = "Part of this air is the mesh's: a flow on finer cells shows how much."


def slurry_section(case: MillCase, readings: Readings) -> list[str]:
    """Cards of the slurry's maps and their readings; none without a flow."""
    if not case.flow:
        return []
    slurry = readings.slurry
    if isinstance(slurry, str):
        return [page.paragraph(f"Maps of the slurry cannot be shown: {slurry}.")]
    share = maps.map_figure(case, slurry.x, slurry.y, slurry.share, "share of the fluid, –", mill_plots.SLURRY, (0, 1))
    cards = [page.picture(share, f"Share of the fluid that is slurry, averaged over the axis and {slurry.source}.",
                          title="Slurry"),
             page.picture(maps.speed_figure(case, slurry.x, slurry.y, slurry.velocity, slurry.share > 0.05),
                          "Mean velocity of the slurry across the axis. Colour: its size; arrows: its direction.",
                          title="Speed of the slurry")]
    if case.length > 0.5 * case.radius and not case.is_slice:
        cards.append(page.picture(maps.z_velocity_figure(case, slurry), "Mean velocity along the axis where the share "
                                                                        "is over 0.5. Red: to the discharge.",
                                  title="Slurry along the axis"))
    if case.load:
        meaning = "the slurry carries the balls" if feels_slurry(case) else "one-way coupling does not hold"
        cards.append(page.picture(mill_plots.load_figure(case.flow, case.begin),
                                  "Force of the fluid on the balls over their weight. Where it is close to 1 (line), "
                                  f"{meaning}.", title="Force on the balls"))
    note = (f"Angles are counted from straight down, positive where the shell rises, on the circle {RING:g} lifter "
            f"heights ({1e3 * ring_depth(case.lifter_height):.3g} mm) from the shell. ±: standard errors of "
            f"{len(readings.blocks)} blocks of time.{readings.short_blocks()}")
    rows = slurry_rows(case, readings)
    if any(name == AIR for name, _ in rows):
        note += f" ¹ {AIR_OF_MESH}"
    return cards + [page.table(None, rows, title="Readings of the maps", note=note)]


def slurry_rows(case: MillCase, readings: Readings) -> list[tuple[str, str]]:
    """Rows (name, text) of toe, shoulder, pool and motion along the axis."""
    slurry, way = readings.slurry, readings.way
    if isinstance(way, Way):
        rows = [(f"{name} of the slurry", uncertain(angle.value, angle.error, "°"))
                for name, angle in (("shoulder", way.shoulder_angle), ("toe", way.toe_angle))]
    else:
        rows = [(f"{name} of the slurry", "none") for name in ("shoulder", "toe")]
    rows += still_rows(case, slurry, readings.blocks)
    if case.is_slice:
        return rows
    if not isinstance(way, Way):
        return rows + [("velocity along the axis", str(way))]
    halves = slurry_on_maps.axial_flow(slurry, way.toe_angle.value, way.shoulder_angle.value)
    rows += [(f"velocity along the axis at the {name}: mean (range of 90 %)",
              uncertain(1e3 * mean.value, 1e3 * mean.error, "mm/s")
              + f" ({1e3 * half.lowest:+.3g} to {1e3 * half.highest:+.3g})")
             for name, mean, half in (("toe", way.toe, halves.toe), ("shoulder", way.shoulder, halves.shoulder))]
    words = {"undecided": "undecided: a mean may be zero (95 % confidence), or its error is not known"}
    return rows + [("to the discharge at the toe and back at the shoulder", words.get(way.circulates, way.circulates))]


def still_rows(case: MillCase, slurry: SlurryMap, blocks: Sequence[SlurryMap]) -> list[tuple[str, str]]:
    """Rows of the pool and of the air in the charge: of the mean map, with errors of the maps of blocks of time."""
    def solidity(one: SlurryMap) -> np.ndarray:
        return (slurry_on_maps.solidity_at_pixels(case.charge, one) if case.solids and case.law
                else np.zeros_like(one.share))

    def error(reading: Callable[[SlurryMap], float]) -> float:
        return block_mean([reading(one) for one in blocks]).error

    pool, words = slurry_on_maps.pool(slurry, solidity(slurry)), "none"
    if pool.area > 0:
        volume = error(lambda one: slurry_on_maps.pool(one, solidity(one)).area * case.length)
        level = error(lambda one: 1e3 * slurry_on_maps.pool(one, solidity(one)).level)
        words = (f"{millilitres(pool.area * case.length, error=volume)}, surface at y = "
                 f"{uncertain(1e3 * pool.level, level, 'mm', '.1f')}")
    rows = [("pool clear of the charge" if case.has_balls else "pool", words)]
    air = slurry_on_maps.entrained_air(slurry, solidity(slurry))
    if np.isfinite(air):
        spread = error(lambda one: 100 * slurry_on_maps.entrained_air(one, solidity(one)))
        rows.append((AIR, f"{uncertain(100 * air, spread, '%', '.0f')} of the fluid"))
    return rows


def axial_section(case: MillCase, readings: Readings) -> list[str]:
    """Cards of the profile along the axis; none for fewer than three slices."""
    if not case.flow or len(getattr(readings.profile, "z", ())) < 3:
        return []
    fits = []
    for count, fit in readings.humps.items():
        if isinstance(fit, axial.Humps):
            at = np.linspace(readings.profile.z[0], readings.profile.z[-1], 300)
            ended = " (at the profile's end)" if humps_at_ends(fit, readings.profile.z) else ""
            fits.append((f"{count} Gaussians, RMSD {1e3 * fit.rmsd:.2g} mm{ended}", at, fit.fitted(at)))
    at_end = any("end)" in label for label, _, _ in fits)
    ended = " For Gaussians at the profile's end, the distance is only the profile's span." if at_end else ""
    cards = [page.picture(figures.axial(readings.profile, fits, along(case)), "By slices along the axis, averaged over "
                          f"time. p_rgh is the pressure without the hydrostatic part.{ended}",
                          title="Profile along the axis")]
    heights = case.axial("height")
    if heights:
        cards.append(page.picture(figures.axial_against_time(*heights, along(case)),
                                  "Height of the slurry's centre of mass by slices against time.",
                                  title="Profile against time"))
    return cards


def along(case: MillCase) -> str:
    """Label of the axis along the mill."""
    return "z, mm" if case.is_slice else "z from the feed end, mm"


def balance_section(case: MillCase, _readings: Readings) -> list[str]:
    """Cards of slurryBalance's tables; none without them."""
    if case.balance is None or len(case.balance["Time"]) < 2:
        return []
    through = ", and its flow through the openings" if case.is_open and not case.is_slice else ""
    sources = "walls and balls" if case.has_balls else "walls"
    cards = [page.picture(figures.holdup(case), f"Slurry in the mill{through}.", title="Hold-up"),
             page.picture(figures.centre_and_power(case), "Centre of the slurry's volume, and the power that "
                          f"{sources} give to it (torque from the balance of angular momentum, times the mill's "
                          "speed).",
                          title="Centre and power")]
    if case.met_balls:
        cards.append(page.picture(figures.reynolds(case), "Of balls in slurry, weighted by their volume.",
                                  title="Particle Reynolds numbers"))
    head, rows = wall_table(case)
    if rows:
        cards.append(page.table(head, rows, title="Torque and power",
                                note=f"About +z on the slurry, means from {case.begin:.3g} s on. Walls: from pressure "
                                     "and friction there. All: from the balance of angular momentum. ±: standard "
                                     "errors over whole turns; a mean over fewer than two turns has none."))
    return cards + slip_card(case) + residence_cards(case)


def slip_card(case: MillCase) -> list[str]:
    """Card of slurryBalance's largest slip in the averaged time; none without it."""
    slip, late = case.balance.get("slip_max"), case.balance["Time"] >= case.begin
    if slip is None or not case.met_balls or not late.any():
        return []
    return [page.table(None, [(f"largest slip since {case.begin:.3g} s", f"{slip[late].max():.3g} m/s")],
                       title="Slip past the balls")]


def wall_table(case: MillCase) -> tuple[list[str] | None, list[tuple]]:
    """Head and rows of slurryBalance's torque and power by wall, if it has these columns."""
    columns = case.balance
    if not (columns["Time"] >= case.begin).any():
        return None, []
    walls = list(dict.fromkeys(name.split("_", 1)[1] for name in columns
                               if name.startswith(("torque_", "power_")) and name != "torque_all"))

    def cell(name: str) -> str:
        if name not in columns:
            return "–"
        error = error_over_turns(columns["Time"], columns[name], case.begin, case.turn)
        return uncertain(time_mean(columns["Time"], columns[name], case.begin), error, "")

    rows: list[tuple] = [(wall, cell(f"torque_{wall}"), cell(f"power_{wall}")) for wall in walls]
    if "torque_all" in columns:
        rows.append(("all", cell("torque_all"), cell("power")))
    return ["", "torque, N m", "power, W"], rows


def models_section(case: MillCase, readings: Readings) -> list[str]:
    """Mechanistic models compared with the simulation."""
    cards = []
    # The model's wall friction is that of end walls; a slice has none
    if isinstance(readings.charge, charge.Charge) and not case.is_slice:
        x, y = readings.charge.surface.points.T / case.radius
        number = models.surface_number(abs(case.omega), case.mill.sauter_diameter, case.radius,
                                       case.mill.whole_length)
        found = readings.attempt(lambda: models.fit_free_surface(x, y, number, clockwise=case.omega < 0))
        if not isinstance(found, str):
            model, rmsd = found
            why = (f"the fit leaves more than {100 * models.POOR:.0f} % of the radius" if rmsd > models.POOR else
                   "the fit needs a negative friction")
            poor = "" if models.describes(model, rmsd) else f" The model does not describe this surface: {why}."
            cards.append(page.picture(
                figures.surfaces([("simulation", readings.charge.surface.points),
                                  ("Taberlet", case.radius * np.column_stack([model.x, model.y]))], case.radius,
                                 case.omega),
                f"dy/dx = μi + μw Λ √(1 − x² − y²) with Λ = {number:.3g}; fitted: μi {model.internal:.3f}, μw "
                f"{model.wall:.3f}"
                f"; RMSD {1e3 * case.radius * rmsd:.2g} mm; the model's filling is {100 * model.filling:.1f} %.{poor}",
                title="Free surface by Taberlet, Richard & Hinch"))
    lip = case.mill.discharge_radius
    if case.solids and case.flow and case.law and case.feed and case.balance is not None and lip:
        cards += moys(case, readings.profile)
    return cards


def moys(case: MillCase, profile: Any) -> list[str]:
    """Moys' hold-up compared with the simulated one, for a mill with feed, balls and a discharge over a lip; along the
    axis if `profile` is an AxialProfile of three slices or more."""
    dense = case.charge.solidity[case.charge.solidity > 0.3]
    porosity = float(1 - dense.mean())
    bed = models.Charge(case.radius, case.length, porosity, case.mill.sauter_diameter)
    lip = case.radius - case.mill.discharge_radius
    fluid = case.mill.slurry("plastic_viscosity_Pa_s"), case.mill.slurry("density_kg_m3")
    held = time_mean(case.balance["Time"], case.balance["holdUp"], case.begin)
    rows = [("porosity of the dense charge (solidity over 0.3)", f"{porosity:.3f}"),
            ("depth at the discharge's lip", f"{1e3 * lip:.1f} mm"),
            ("depth at the feed end by the model",
             f"{1e3 * float(models.slurry_depth(bed, 0, case.feed, lip, *fluid)):.1f} mm"),
            ("hold-up by the model", f"{1e6 * models.slurry_hold_up(bed, case.feed, lip, *fluid):.0f} ml"),
            ("simulated hold-up, with the pulp lifters", millilitres(held, error=error_over_turns(
                case.balance["Time"], case.balance["holdUp"], case.begin, case.turn)))]
    cards = [page.table(None, rows, title="Hold-up by Moys' model",
                        note="Darcy flow through the resting charge to the discharge's lip, without the slurry that "
                             "the mill lifts.")]
    if len(getattr(profile, "z", ())) >= 3:
        z = np.linspace(0, case.length, 200)
        model = porosity * bed.cross_section(models.slurry_depth(bed, z, case.feed, lip, *fluid))
        cards.append(page.picture(figures.holdup_along(profile, z, model),
                                  "By slices along the axis. Model: slurry in the pores of a resting charge. "
                                  "Simulation: all slurry.",
                                  title="Moys' hold-up profile"))
    return cards
