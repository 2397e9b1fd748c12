# SPDX-License-Identifier: GPL-3.0-or-later
"""Sections of the report of one case: each function returns cards, none where the case does not have what it shows."""
import re

import h5py
import numpy as np

from .. import axial, charge, charge_plots, mill_plots, models, slurry_maps, solids
from ..free_surface import at_points
from ..slurry import read_slurry_map
from . import figures, page

FRAMES = 40  # of the animation, at most


class Readings:
    """What is read off a case's maps, once for all sections and comparisons; a reading that failed is its error's text."""

    def __init__(self, case):
        self.case = case
        self.charge = self.attempt(lambda: charge.read_charge(case.charge, case.radius)) if case.solids else None
        self.errors = self.attempt(self._errors) if case.solids and not isinstance(self.charge, str) else None
        length = case.length
        self.slurry = self.attempt(lambda: read_slurry_map(case.slurry, case.flow.time0 + case.begin, case.flow.time0 + case.last,
                                                        length)) if case.flow and case.slurry else None
        self.profile = self.attempt(self._profile) if case.flow else None
        self.humps = {}
        if isinstance(self.profile, axial.AxialProfile):
            for count in (2, 3):
                if len(self.profile.z) >= 3 * count + 3:
                    self.humps[count] = self.attempt(lambda: axial.fit_gaussians(self.profile.z, self.profile.height, count))

    @staticmethod
    def attempt(read):
        """What read() gives, or the text of the error that it raises."""
        try:
            return read()
        except (RuntimeError, ValueError) as error:
            return str(error)

    def _errors(self):
        maps = solids.read_windows(self.case.solids, *self.case.charge_span)
        return charge.charge_with_errors(maps, self.case.radius) if len(maps) >= 4 else None

    def _profile(self):
        """AxialProfile by the function object's tables, or else by the written times."""
        case = self.case
        tables = {name: case.axial(name) for name in ("holdUp", "height", "p_rgh")}
        if any(table is None for table in tables.values()):
            return axial.axial_profile(case.flow, case.begin)
        z, times, holdup = tables["holdUp"]
        late = times >= case.begin
        known = {name: np.where(holdup[late] > 0, tables[name][2][late], np.nan) for name in ("height", "p_rgh")}
        return axial.AxialProfile(z, np.nanmean(known["height"], axis=0), np.nanstd(known["height"], axis=0),
                                  holdup[late].mean(axis=0), np.nanmean(known["p_rgh"], axis=0))


def told(value, error, form):
    """A value with its standard error as text."""
    return f"{value:{form}} ± {error:{form}}" if np.isfinite(error) else f"{value:{form}}"


def key_numbers(case, readings):
    """Rows (name, text) of the numbers that are asked for first."""
    rows = []
    if case.results:
        rows.append(("power of the dry charge", told(float(case.results["power"]), float(case.results["power_error"]), ".3g") + " W"))
    if isinstance(readings.charge, charge.Charge):
        found, errors = readings.charge, readings.errors or {}

        def error(name, k=0):
            return np.atleast_1d(errors[name].error)[k] if name in errors else np.nan

        rows += [("centre of circulation, x", told(1e3 * found.centre[0], 1e3 * error("centre", 0), ".2f") + " mm"),
                 ("centre of circulation, y", told(1e3 * found.centre[1], 1e3 * error("centre", 1), ".2f") + " mm"),
                 ("shoulder of the charge", told(found.shoulder, error("ends", 1), ".1f") + "°"),
                 ("toe of the charge", told(found.toe, error("ends", 0), ".1f") + "°"),
                 ("free surface, RMSD of the logistic", told(1e3 * found.surface.rmsd, 1e3 * error("surface_rmsd"), ".2f") + " mm"),
                 ("tangential velocity, RMSD of the cubic", told(found.tangential.rmsd, error("tangential_rmsd"), ".4f") + " m/s")]
    if case.balance is not None:
        told_by, late = case.balance, case.balance["Time"] >= case.begin
        rows += [("hold-up of slurry", f"{1e6 * told_by['holdUp'][late].mean():.1f} ml"),
                 ("centre of the slurry", f"{1e3 * told_by['x'][late].mean():.1f}, {1e3 * told_by['y'][late].mean():.1f} mm"),
                 ("power for the slurry", f"{told_by['power'][late].mean():.3g} W")]
        if told_by["feed"].max() > 0:
            feed, out = (1e6 * told_by[name][late].mean() for name in ("feed", "discharge"))
            rows += [("feed, discharge, net", f"{feed:.1f}, {out:.1f}, {feed - out:+.1f} ml/s")]
        if "Re_mean" in told_by:
            rows.append(("particle Reynolds number, mean, 95 % below",
                         f"{told_by['Re_mean'][late].mean():.0f}, {told_by['Re_95'][late].mean():.0f}"))
    if isinstance(readings.profile, axial.AxialProfile) and len(readings.profile.z) > 2:
        drop = readings.profile.pressure[0] - readings.profile.pressure[-1]
        rows.append(("axial drop of p_rgh in the slurry", f"{drop:.0f} Pa"))
    for count, fit in readings.humps.items():
        if isinstance(fit, axial.Humps):
            apart = ", ".join(f"{1e3 * d:.0f}" for d in fit.distances)
            rows.append((f"axial profile, {count} Gaussians", f"{apart} mm apart, RMSD {1e3 * fit.rmsd:.2g} mm"))
    return rows


def overview(case, readings):
    cards = [page.table(None, key_numbers(case, readings), title="Key numbers", note=spans(case))]
    return [animation(case)] + cards if case.flow or case.solids else cards


def spans(case):
    words = []
    if case.solids:
        words.append(f"charge averaged over DEM time {case.charge_span[0]:.3g} to {case.charge_span[1]:.3g} s")
    if case.flow:
        words.append(f"flow from {case.begin:.3g} to {case.last:.3g} s")
    return ("Averages: " + ", ".join(words) + ". Errors: standard errors of batch means over time. Angles are counted from straight "
            "down, positive where the shell rises.")


def animation(case):
    """Charge and slurry over the last turn."""
    turn = 2 * np.pi / abs(case.omega)
    if case.flow:
        frames = [frame for frame in case.flow.frames if frame[0] >= max(case.last - turn, 1e-9)]
        frames = [frames[k] for k in np.unique(np.linspace(0, len(frames) - 1, FRAMES).astype(int))]
        return page.player((mill_plots.frame_figure(case.flow, *frame) for frame in frames),
                           f"Share of slurry over the axis (blue) and edge of the charge (orange, solidity 0.2), flow time "
                           f"{frames[0][0]:.2f} to {frames[-1][0]:.2f} s: the last turn of the mill.", title="One turn")
    maps = solids.read_windows(case.solids, case.charge_span[1] - turn, case.charge_span[1])
    return page.player((mill_plots.charge_figure(one, case.radius, case.omega) for one in maps),
                       f"Solidity over the axis, window by window, DEM time {maps[0].begin:.2f} to {maps[-1].end:.2f} s.",
                       title="One turn")


def charge_section(case, readings):
    if not case.solids:
        return []
    cards = []
    if isinstance(readings.charge, str):
        cards.append(page.picture(mill_plots.charge_figure(case.charge, case.radius, case.omega),
                                  f"Solidity averaged over axis and time. Not read: {readings.charge}.", title="Charge"))
    else:
        cards.append(page.picture(charge_plots.charge_figure(case.charge, readings.charge, case.radius),
                                  "Solidity and velocity averaged over axis and time, with the free surface, its logistic fit, toe, "
                                  "shoulder and centre of circulation.", title="Charge"))
        cards.append(page.picture(charge_plots.tangential_figure(readings.charge.tangential),
                                  "Along the line from the mill's centre through the centre of circulation, with the cubic fit.",
                                  title="Tangential velocity"))
    if case.energy:
        cards.append(page.picture(figures.energy(case), "Power from the torque on the walls, and the charge's energies. Dashed: "
                                  "steady from there on.", title="Dry run"))
    if case.overlaps is not None:
        cards.append(page.picture(figures.overlaps(case), "Overlaps of all contacts at all records.", title="Overlaps"))
    return cards


def slurry_section(case, readings):
    if not case.flow:
        return []
    if not case.slurry:
        return [page.paragraph("There is no whole slurry.h5: the flow was not run to its end, or without the function object "
                               "voxelAverages (see voxelAverages.H).")]
    if isinstance(readings.slurry, str):
        return [page.paragraph(f"Maps of the slurry cannot be shown: {readings.slurry}.")]
    slurry = readings.slurry
    cards = [page.picture(figures.slurry_maps(slurry, case), "Share of the fluid that is slurry, and its speed, averaged over axis "
                          "and time.", title="Slurry", wide=True)]
    if case.length > 0.5 * case.radius:
        cards.append(page.picture(figures.z_velocity(slurry, case), "Velocity of the slurry along the axis where its share is over "
                                  "a half.", title="Along the axis"))
    cards.append(page.table(None, slurry_rows(case, slurry), title="Read off the maps"))
    if case.flow.load(case.begin):
        cards.append(page.picture(mill_plots.load_figure(case.flow, case.begin),
                                  "Force of the fluid on the balls over their weight: where it nears 1 the coupling in one direction "
                                  "does not hold.", title="Force on the balls"))
    return cards


def slurry_rows(case, slurry):
    """Rows (name, text) of toe, shoulder, pool and way along the axis."""
    pixels = slurry.pixels()
    wall = case.mill["geometry"]["lifters"]["height"]
    toe, shoulder = slurry_maps.slurry_ends(pixels, case.radius, wall)
    rows = [("shoulder of the slurry at the lifters' tips", f"{shoulder:.0f}°"), ("toe of the slurry", f"{toe:.0f}°")]
    solidity = np.zeros_like(pixels.share)
    if case.solids and case.law:
        points = np.stack(np.meshgrid(pixels.x, pixels.y), axis=-1).reshape(-1, 2)
        solidity = at_points(case.charge, case.charge.solidity, points).reshape(pixels.share.shape)
    pool = slurry_maps.pool(pixels, solidity)
    rows.append(("pool clear of the charge", f"{1e6 * pool.area * case.length:.1f} ml, level {1e3 * pool.level:.1f} mm"
                 if pool.area > 0 else "none"))
    try:
        way = slurry_maps.axial_flow(pixels, toe, shoulder)
        rows.append(("along the axis at the toe; at the shoulder (mean, 90 % of it)",
                     "; ".join(f"{1e3 * half.mean:+.1f} mm/s ({1e3 * half.lowest:+.0f} to {1e3 * half.highest:+.0f})"
                               for half in (way.toe, way.shoulder))))
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
    cards = [page.picture(figures.axial(readings.profile, fits), "By slices along the axis, averaged over time; p_rgh is the pressure "
                          "without what the depth makes.", title="Profile along the axis")]
    heights = case.axial("height")
    if heights:
        cards.append(page.picture(figures.axial_against_time(*heights), "Height of the slurry's centre of mass by slices against time.",
                                  title="Profile against time"))
    return cards


def balance_section(case, _readings):
    if case.balance is None:
        return []
    cards = [page.picture(figures.holdup(case), "Slurry in the mill and through its openings.", title="Hold-up"),
             page.picture(figures.centre_and_power(case), "Centre of the slurry's volume, and the power that walls and balls give to "
                          "it (torque by the balance of angular momentum, times the mill's speed).", title="Centre and power")]
    if "Re_mean" in case.balance:
        cards.append(page.picture(figures.reynolds(case), "Of balls in slurry, by their volume.", title="Particle Reynolds numbers"))
    return cards


def models_section(case, readings):
    """Mechanistic models beside what was found."""
    cards = []
    if isinstance(readings.charge, charge.Charge):
        points = readings.charge.surface.points / case.radius
        number = models.surface_number(abs(case.omega), mean_diameter(case), case.radius, case.mill["geometry"]["length"])
        found = readings.attempt(lambda: models.fit_free_surface(*points.T, number, clockwise=case.omega < 0))
        if not isinstance(found, str):
            model, rmsd = found
            cards.append(page.picture(
                figures.surfaces([("simulation", readings.charge.surface.points),
                                  ("Taberlet", case.radius * np.column_stack([model.x, model.y]))], case.radius),
                f"dy/dx = μi + μw Λ √(1 − x² − y²) with Λ = {number:.3g}; fitted: μi {model.internal:.3g}, μw {model.wall:.3g}; RMSD "
                f"{1e3 * case.radius * rmsd:.2g} mm; the model's filling is {100 * model.filling:.1f} %.",
                title="Free surface by Taberlet, Richard & Hinch"))
    rows = moys(case)
    if rows:
        cards.append(page.table(None, rows, title="Hold-up by Moys' model",
                                note="Darcy flow through the resting charge to the discharge's lip. It knows nothing of the slurry that "
                                     "the mill lifts."))
    return cards


def moys(case):
    """Rows (name, text) of Moys' hold-up beside the simulated one, of a mill with feed, balls and a discharge."""
    pulp = case.mill["geometry"].get("pulp_lifters")
    if not (case.flow and case.law and case.feed and case.balance is not None and pulp):
        return []
    dense = case.charge.solidity[case.charge.solidity > 0.3]
    porosity = float(1 - dense.mean())
    bed = models.Charge(case.radius, case.length, porosity, mean_diameter(case))
    slurry = case.mill["slurry"]
    lip = case.radius - pulp["discharge_radius"]
    fluid = (slurry["plastic_viscosity"], slurry["density"])
    late = case.balance["Time"] >= case.begin
    return [("porosity of the dense charge (solidity over 0.3)", f"{porosity:.3f}"),
            ("depth at the discharge's lip", f"{1e3 * lip:.1f} mm"),
            ("depth at the feed end by the model", f"{1e3 * float(models.slurry_depth(bed, 0, case.feed, lip, *fluid)):.1f} mm"),
            ("hold-up by the model", f"{1e6 * models.slurry_hold_up(bed, case.feed, lip, *fluid):.0f} ml"),
            ("simulated hold-up, with the pulp lifters", f"{1e6 * case.balance['holdUp'][late].mean():.0f} ml")]


def mean_diameter(case):
    """Sauter mean of the charge's classes, m."""
    classes = case.mill["charge"]["classes"]
    return sum(c["mass"] for c in classes) / sum(c["mass"] / c["diameter"] for c in classes)


def ledger_section(case, _readings):
    cards = []
    if case.solids:
        with h5py.File(case.solids) as file:
            into, outside, clipped = (file[f"ledger/{name}"][:] for name in ("volume_in", "outside", "clipped"))
            rows = [("windows", len(into)), ("length of a window", f"{np.median(file['window/end'][:] - file['window/begin'][:]):.4g} s"),
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
        cards.append(page.table(None, [("windows", len(into)), ("slurry in the mesh, mean", f"{1e6 * into.mean():.2f} ml"),
                                       ("of it beyond the voxels, at most", f"{100 * np.abs(outside / into).max():.2g} %")],
                                title="Averaging of the slurry"))
    values = re.findall(r"^(cells|faces|volume|volume error|max [\w-]+(?: ratio)?)\s{2,}(\S.*)", case.log("mesh"), re.M)
    if values:
        cards.append(page.table(None, values, title="Mesh of the flow"))
    ranges = re.findall(r"^bed: beyond .*$", case.log("flow"), re.M)
    if ranges:
        cards.append(page.table(None, [(ranges[-1].removeprefix("bed: "),)], title="Drag law"))
    return cards


def run_section(case, _readings):
    """Versions and cost, and the mill's description."""
    rows = [(name, found) for name, found in versions(case)]
    costs = [(name, f"{seconds / 60:.1f} min") for name, seconds in stage_costs(case)]
    cards = [page.table(None, rows, title="Programs")] if rows else []
    if costs:
        cards.append(page.table(None, costs, title="Cost by stage", note="Wall time, also of parts that were broken off."))
    return cards + [page.folded("mill.yaml", case.mill_text)]


def versions(case):
    """(program, version) by the logs."""
    own = case.log("version").strip()
    if own:
        yield "millFoam", own
    found = re.findall(r"^Build\s*:\s*(\S+)", case.log("flow"), re.M)
    if found:
        yield "OpenFOAM", found[-1]
    found = re.findall(r"^Exec\s*:\s*(\S+)", case.log("flow"), re.M)
    if found:
        yield "flow solver", found[-1]
    log = case.dry.parent / "dem" / "log.liggghts" if case.dry else None
    if log and log.is_file():
        with open(log, errors="replace") as file:
            yield "LIGGGHTS", file.readline().strip().strip("()")


def stage_costs(case):
    """(stage, wall time in s) by log.costs of the charge's and the case's folder, parts that were broken off added up."""
    folders = dict.fromkeys(([case.solids.parent] if case.solids else []) + [case.folder.resolve()])
    costs = {}
    for path in (folder / "log.costs" for folder in folders):
        for line in path.read_text().splitlines() if path.is_file() else ():
            name, seconds = line.rsplit(",", 1)
            costs[name] = costs.get(name, 0) + float(seconds)
    if not costs and case.results and "wall_time" in case.results:
        costs["dry run"] = float(case.results["wall_time"])
    return costs.items()


SECTIONS = (("overview", "Overview", overview), ("charge", "Charge", charge_section), ("slurry", "Slurry", slurry_section),
            ("axis", "Along the axis", axial_section), ("balance", "Balance", balance_section), ("models", "Models", models_section),
            ("ledger", "Ledger and mesh", ledger_section), ("run", "How it was run", run_section))
