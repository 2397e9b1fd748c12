# SPDX-License-Identifier: GPL-3.0-or-later
"""Sections of the report about the slurry: its maps, its way along the axis, its balance, mechanistic models beside it."""
import numpy as np

from .. import axial, charge, mill_plots, models, slurry_maps
from ..free_surface import at_points
from ..tables import time_mean
from . import figures, maps, page


def slurry_section(case, readings):
    if not case.flow:
        return []
    slurry = readings.slurry
    if isinstance(slurry, str):
        return [page.paragraph(f"Maps of the slurry cannot be shown: {slurry}.")]
    share = maps.map_figure(case, slurry.x, slurry.y, slurry.share, "share of the fluid, –", mill_plots.SLURRY, (0, 1))
    cards = [page.picture(share, f"Share of the fluid that is slurry, averaged over the axis and {slurry.source}.",
                          title="Slurry"),
             page.picture(maps.speed_figure(case, slurry.x, slurry.y, slurry.velocity, slurry.share > 0.05),
                          "Mean velocity of the slurry across the axis: colour for its size, arrows for its direction.",
                          title="Speed of the slurry")]
    if case.length > 0.5 * case.radius:
        cards.append(page.picture(maps.z_velocity_figure(case, slurry), "Mean velocity along the axis where the share is over a "
                                  "half. Red: to the discharge.", title="Slurry along the axis"))
    if case.load:
        cards.append(page.picture(mill_plots.load_figure(case.flow, case.begin),
                                  "Force of the fluid on the balls over their weight: where it nears 1 (line) the coupling in "
                                  "one direction does not hold.", title="Force on the balls"))
    return cards + [page.table(None, slurry_rows(case, slurry), title="Read off the maps", note="Angles from straight down, "
                               "positive where the shell rises.")]


def slurry_rows(case, slurry):
    """Rows (name, text) of toe, shoulder, pool and way along the axis."""
    wall = case.mill["geometry"].get("lifters", {}).get("height", 0.0)
    toe, shoulder = slurry_maps.slurry_ends(slurry, case.radius, wall)
    rows = [(f"{name} of the slurry at the lifters' tips", f"{angle:.0f}°" if np.isfinite(angle) else "none")
            for name, angle in (("shoulder", shoulder), ("toe", toe))]
    solidity = np.zeros_like(slurry.share)
    if case.solids and case.law:
        points = np.stack(np.meshgrid(*slurry.centres()), axis=-1).reshape(-1, 2)
        solidity = at_points(case.charge, case.charge.solidity, points).reshape(slurry.share.shape)
    pool = slurry_maps.pool(slurry, solidity)
    rows.append(("pool clear of the charge", f"{1e6 * pool.area * case.length:.3g} ml, surface at y = {1e3 * pool.level:.1f} mm"
                 if pool.area > 0 else "none"))
    try:
        way = slurry_maps.axial_flow(slurry, toe, shoulder)
        rows += [(f"along the axis at the {name}: mean (90 % of it)",
                  f"{1e3 * half.mean:+.3g} mm/s ({1e3 * half.lowest:+.3g} to {1e3 * half.highest:+.3g})")
                 for name, half in (("toe", way.toe), ("shoulder", way.shoulder))]
        rows.append(("to the discharge at the toe and back at the shoulder", "yes" if way.circulates else "no"))
    except RuntimeError as error:
        rows.append(("along the axis", str(error)))
    return rows


def axial_section(case, readings):
    if not case.flow or len(getattr(readings.profile, "z", ())) < 3:
        return []
    fits = []
    for count, fit in readings.humps.items():
        if isinstance(fit, axial.Humps):
            at = np.linspace(readings.profile.z[0], readings.profile.z[-1], 300)
            fits.append((f"{count} Gaussians, RMSD {1e3 * fit.rmsd:.2g} mm", at, fit.fitted(at)))
    cards = [page.picture(figures.axial(readings.profile, fits), "By slices along the axis, averaged over time; p_rgh is the "
                          "pressure without what the depth makes.", title="Profile along the axis")]
    heights = case.axial("height")
    if heights:
        cards.append(page.picture(figures.axial_against_time(*heights),
                                  "Height of the slurry's centre of mass by slices against time.", title="Profile against time"))
    return cards


def balance_section(case, _readings):
    if case.balance is None or len(case.balance["Time"]) < 2:
        return []
    cards = [page.picture(figures.holdup(case), "Slurry in the mill and through its openings.", title="Hold-up"),
             page.picture(figures.centre_and_power(case), "Centre of the slurry's volume, and the power that walls and balls "
                          "give to it (torque by the balance of angular momentum, times the mill's speed).",
                          title="Centre and power")]
    if case.met_balls:
        cards.append(page.picture(figures.reynolds(case), "Of balls in slurry, by their volume.",
                                  title="Particle Reynolds numbers"))
    return cards


def models_section(case, readings):
    """Mechanistic models beside what was found."""
    cards = []
    # The model's wall friction is that of end walls, which a slice does not have
    if isinstance(readings.charge, charge.Charge) and not case.is_slice:
        points = readings.charge.surface.points / case.radius
        number = models.surface_number(abs(case.omega), mean_diameter(case), case.radius, case.mill["geometry"]["length"])
        found = readings.attempt(lambda: models.fit_free_surface(*points.T, number, clockwise=case.omega < 0))
        if not isinstance(found, str):
            model, rmsd = found
            cards.append(page.picture(
                figures.surfaces([("simulation", readings.charge.surface.points),
                                  ("Taberlet", case.radius * np.column_stack([model.x, model.y]))], case.radius, case.omega),
                f"dy/dx = μi + μw Λ √(1 − x² − y²) with Λ = {number:.3g}; fitted: μi {model.internal:.3g}, μw {model.wall:.3g}; "
                f"RMSD {1e3 * case.radius * rmsd:.2g} mm; the model's filling is {100 * model.filling:.1f} %.",
                title="Free surface by Taberlet, Richard & Hinch"))
    rows = moys(case)
    if rows:
        cards.append(page.table(None, rows, title="Hold-up by Moys' model",
                                note="Darcy flow through the resting charge to the discharge's lip. It knows nothing of the "
                                     "slurry that the mill lifts."))
    return cards


def moys(case):
    """Rows (name, text) of Moys' hold-up beside the simulated one, of a mill with feed, balls and a discharge."""
    pulp = case.mill["geometry"].get("pulp_lifters")
    if not (case.solids and case.flow and case.law and case.feed and case.balance is not None and pulp):
        return []
    dense = case.charge.solidity[case.charge.solidity > 0.3]
    porosity = float(1 - dense.mean())
    bed = models.Charge(case.radius, case.length, porosity, mean_diameter(case))
    slurry = case.mill["slurry"]
    lip = case.radius - pulp["discharge_radius"]
    fluid = (slurry["plastic_viscosity"], slurry["density"])
    held = time_mean(case.balance["Time"], case.balance["holdUp"], case.begin)
    return [("porosity of the dense charge (solidity over 0.3)", f"{porosity:.3f}"),
            ("depth at the discharge's lip", f"{1e3 * lip:.1f} mm"),
            ("depth at the feed end by the model", f"{1e3 * float(models.slurry_depth(bed, 0, case.feed, lip, *fluid)):.1f} mm"),
            ("hold-up by the model", f"{1e6 * models.slurry_hold_up(bed, case.feed, lip, *fluid):.0f} ml"),
            ("simulated hold-up, with the pulp lifters", f"{1e6 * held:.0f} ml")]


def mean_diameter(case):
    """Sauter mean of the charge's classes, m."""
    classes = case.mill["charge"]["classes"]
    return sum(c["mass"] for c in classes) / sum(c["mass"] / c["diameter"] for c in classes)
