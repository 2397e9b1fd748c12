# SPDX-License-Identifier: GPL-3.0-or-later
"""Cards of a dry run that followed each contact in every step: spectra, powers, and the load of the liner."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from ..files.data_files import entry
from ..files.mill_case import MillCase
from ..files.outline import lifter_outline
from ..files.wall_forces import WallForces, read_wall_forces
from ..readings.contact_statistics import read_statistics, section_means
from . import page
from .contact_figures import power_table, spectra_figure

# Fields of the wall cells, their colour bars' labels and colours
LOADS = {"normal_stress_Pa": ("normal force,\nPa", "viridis"),
         "impact_power_W_m2": ("impacts,\nW/m$^2$", "inferno"),
         "sliding_power_W_m2": ("sliding,\nW/m$^2$", "inferno")}


def statistics_cards(case: MillCase) -> list[str]:
    """Cards of the contacts."""
    begin, end = case.result("contacts", "begin_s"), case.result("contacts", "end_s")
    spectra = read_statistics(case.dry, begin, end)
    span = f"All contacts of every step, DEM time {begin:.3g} to {end:.3g} s."
    cards = [page.picture(spectra_figure(spectra), "Top: collisions per second by their energy at first touch. Bottom: "
                          "dissipated power by the energy that the whole collision dissipates, from first touch to "
                          "separation. Colour: the larger ball of a pair; grey: contacts with the wall. " + span,
                          title="Spectra of energy"),
             page.table(*power_table(spectra), title="Power that contacts dissipate, mW",
                        note="Between balls of two diameters, and between balls and the wall. From the collisions that "
                             "ended in this time."),
             page.table(*part_table(case), title="Where the drive's power goes",
                        note=f"{span} Sliding includes the tangential damper. The contacts must dissipate what "
                             "the drive gives, minus the gain of the charge's kinetic and potential energy.")]
    path = case.dry / "wall_forces.vtp"
    if path.is_file() and case.mill.lifters[0]:
        walls = read_wall_forces(path)
        cards.append(page.picture(liner_figure(case, walls), "The liner around one lifter, over the axis and over all "
                                  f"{case.mill.lifters[0]} lifters. The arrow shows where it moves to. Means over time "
                                  "and area: force of the balls along the contacts' normals; work of impacts, which "
                                  "the normal force dissipates; work of sliding, which wears the liner. DEM time "
                                  f"{walls.begin:.3g} to {walls.end:.3g} s.", title="Load of the liner"))
    return cards


def part_table(case: MillCase) -> tuple[list[str], list[tuple]]:
    """Head and rows: power of each part of the contacts by force, mW; and the drive's."""
    rows: list[tuple] = []
    powers = entry(case.results, case.dry / "results.json", "contacts", "power")
    parts = ("normal_W", "tangential_W", "rolling_W")
    for name in sorted(powers, key=lambda name: (name != "balls", name)):
        values = [1e3 * case.result("contacts", "power", name, part) for part in parts]
        where = "between balls" if name == "balls" else f"at the wall {name}"
        rows.append((where, *((value, ".3g") for value in (*values, sum(values)))))
    total, drive, gain = (1e3 * case.result("contacts", key) for key in ("dissipated_W", "drive_W", "gain_W"))
    rows += [("all contacts", "", "", "", (total, ".4g")),
             ("drive, minus the gain of the charge's energy", "", "", "", (drive - gain, ".4g")),
             ("contacts over drive", "", "", "", (case.result("contacts", "dissipated_over_drive"), ".4f")),
             ("collisions per second", "", "", "", (case.result("contacts", "collisions_per_s"), ".3g"))]
    return ["mW", "normal", "sliding", "rolling", "sum"], rows


def sector_outline(radius: float, lifters: tuple[int, float, float, float]) -> np.ndarray:
    """Outline [n, 2] (m) of shell and lifter from half a pitch before the angle 0 to half a pitch behind it; lifters:
    count, height, width and top width (m)."""
    count = lifters[0]
    # The outline begins with the first lifter, so that half of the points before it are those of the last arc
    points = np.roll(lifter_outline(radius, *lifters, 0.0)[:-1], 180, axis=0)
    angle = np.arctan2(points[:, 1], points[:, 0])
    near = points[np.abs(angle) < np.pi / count * (1 - 1e-9)]
    half = radius * np.array([np.cos(np.pi / count), np.sin(np.pi / count)])
    return np.vstack([half * [1, -1], near, half])


def liner_figure(case: MillCase, walls: WallForces) -> Figure:
    """The section of the liner around one lifter, which points upwards, coloured by its load."""
    outline = sector_outline(case.radius, case.mill.lifters)
    pieces, means = section_means(walls, outline, case.mill.lifters[0], tuple(LOADS), case.lifter_height / 6)
    figure, axes = plt.subplots(len(LOADS), 1, figsize=(5.4, 1.9 * len(LOADS)), sharex=True, constrained_layout=True)
    # Turned so that the angle 0 is straight down
    drawn = 1e3 * np.stack([pieces[..., 1], case.radius - pieces[..., 0]], axis=-1)
    for axis, (name, (label, colours)) in zip(axes, LOADS.items()):
        known = np.isfinite(means[name])
        lines = LineCollection(list(drawn[known]), cmap=colours, linewidths=6, capstyle="butt")
        lines.set_array(means[name][known])
        lines.set_clim(0, np.percentile(means[name][known], 99) or 1)
        axis.add_collection(lines)
        axis.set(aspect="equal", ylabel="mm")
        axis.margins(0.05, 0.15)
        axis.autoscale()
        axis.spines[["top", "right"]].set_visible(False)
        figure.colorbar(lines, ax=axis, label=label)
    to = np.sign(case.omega) * drawn[..., 0].max()
    for axis in axes:
        axis.annotate("", xy=(0.6 * to, 0.95 * drawn[..., 1].max()), xytext=(0.3 * to, 0.95 * drawn[..., 1].max()),
                      arrowprops={"arrowstyle": "->", "color": "0.3"})
    axes[-1].set_xlabel("mm along the shell")
    return figure
