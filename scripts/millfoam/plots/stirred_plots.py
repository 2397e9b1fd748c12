# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of a stirred mill's charge: maps in the r-z plane and around the axis with the impeller, radial profiles and
box plots. Lengths are over the shell's radius or in mm."""
from collections.abc import Iterable

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Polygon, Rectangle

from ..files.mill import Mill
from ..files.rings_file import Rings
from ..readings.stirred import Box, Means, bands, filled_height, meridian, near_arms, slice_around

DARK, EMPTY = "0.2", "0.93"  # impeller; space without balls
BANDS = {"below": ("below the impeller", "#0072B2"), "impeller": ("at the impeller", "#D55E00"),
         "above": ("above the impeller", "#009E73")}  # Okabe and Ito's colours
COMPONENTS = ("radial", "tangential", "axial")
PIN_SLICE = 1.5  # height of a slice through pins, in their thickness
ARROWS = 16  # across the mill
CLEAR = 0.01  # solidity below which nothing is drawn: single balls that were thrown up


def _pins(mill: Mill) -> list[dict]:
    """The impeller's levels of pins from below; of a bare shaft none."""
    return sorted(mill.impeller.get("pins", []), key=lambda pins: float(pins["height_m"]))


def _discs(mill: Mill) -> list[dict]:
    """The impeller's discs."""
    return list(mill.impeller.get("discs", []))


def _near_lowest(mill: Mill, angle: np.ndarray) -> np.ndarray:
    """Whether azimuths (rad) are in the half of the azimuth near the arms of the lowest level of pins."""
    lowest = _pins(mill)[0]
    return near_arms(angle, np.radians(lowest["angle_deg"]), int(lowest["arms"]))


def halves(mill: Mill, rings: Rings) -> tuple[np.ndarray, np.ndarray]:
    """Sectors [ntheta] of the left and the right half of a map in the r-z plane: those near the arms of the lowest
    level of pins, and the others. In averages of the lab's frame, or without pins, both have all sectors."""
    theta = rings.middles()[1]
    if rings.angular_velocity == 0 or not _pins(mill):
        return (np.ones(len(theta), bool),) * 2
    near = _near_lowest(mill, theta)
    return near, ~near


def draw_impeller(axis: Axes, mill: Mill, turning: bool) -> None:
    """Shaft, discs and pins in the r-z plane; r over R, z in mm. turning: each level of pins is on its half of
    `halves`; otherwise on both sides."""
    radius, end = mill.impeller["shaft_diameter_m"] / 2 / mill.radius, 1e3 * mill.impeller["shaft_end_m"]
    axis.add_patch(Rectangle((-radius, end), 2 * radius, 1e3 * mill.length - end, fc=DARK, ec="none", zorder=3))
    for disc in _discs(mill):
        low, reach = 1e3 * (disc["height_m"] - disc["thickness_m"] / 2), disc["diameter_m"] / 2 / mill.radius
        axis.add_patch(Rectangle((-reach, low), 2 * reach, 1e3 * disc["thickness_m"], fc=DARK, ec="none", zorder=3))
    for pins in _pins(mill):
        low, thickness = 1e3 * (pins["height_m"] - pins["thickness_m"] / 2), 1e3 * pins["thickness_m"]
        left = bool(_near_lowest(mill, np.radians(pins["angle_deg"])))
        for side in ((-1,) if left else (1,)) if turning else (-1, 1):
            axis.add_patch(Rectangle((0, low), side * pins["length_m"] / 2 / mill.radius, thickness, fc=DARK, ec="none",
                                     zorder=3))


def draw_meridian(axis: Axes, mill: Mill, rings: Rings, quantity: str, largest: float | None = None) -> QuadMesh:
    """A map in the r-z plane on an axis, r over R to both sides of the mill's axis, with arrows of radial and axial
    velocity; returns its image. The halves are those of `halves`, each with the pins that it has.
    quantity: `solidity`, `speed`, or `radial`, `tangential` or `axial` velocity; largest: of the colours."""
    left, right = (meridian(rings, sectors) for sectors in halves(mill, rings))
    values = np.concatenate([_values(left, quantity)[:, ::-1], _values(right, quantity)], axis=1)
    edges = rings.r / mill.radius
    both = np.concatenate([-edges[::-1], edges[1:] if edges[0] == 0 else edges])
    if edges[0] > 0:
        values = np.insert(values, len(edges) - 1, np.nan, axis=1)
    axis.set_facecolor(EMPTY)
    image = axis.pcolormesh(both, 1e3 * rings.z, values, **_colours(values, quantity, largest))
    _meridian_arrows(axis, mill, rings, (left, right), "w" if image.get_cmap().name == "viridis" else "k")
    draw_impeller(axis, mill, rings.angular_velocity != 0)
    axis.set(xlim=(-1, 1), ylim=(0, 1e3 * _shown_height(mill, rings)), xlabel="r / R", ylabel="z, mm",
             aspect=1 / (1e3 * mill.radius))
    axis.set_xticks([-1, -0.5, 0, 0.5, 1], ["1", "0.5", "0", "0.5", "1"])
    return image


def _shown_height(mill: Mill, rings: Rings) -> float:
    """Height up to which a map in the r-z plane shows the mill, m: a little above balls and impeller."""
    filled = filled_height(meridian(rings), rings.z)
    return float(min(1.12 * max(filled, mill.impeller["top_m"]), mill.length))


def _values(mean: Means, quantity: str) -> np.ndarray:
    """A quantity's values; NaN where there are hardly any balls."""
    values = mean.velocity[..., COMPONENTS.index(quantity)] if quantity in COMPONENTS else (
        mean.speed if quantity == "speed" else mean.solidity)
    return np.where(mean.solidity > CLEAR, values, np.nan)


def _colours(values: np.ndarray, quantity: str, largest: float | None = None) -> dict[str, object]:
    """Colour map and limits: of signed velocities the same on both sides of 0."""
    known = values[np.isfinite(values)]
    if largest is None:
        largest = float(np.percentile(np.abs(known), 99.5)) if known.size else 1.0
    if quantity == "solidity":
        return {"cmap": "YlOrBr", "vmin": 0, "vmax": largest}
    if quantity in ("radial", "axial"):
        return {"cmap": "RdBu_r", "vmin": -largest, "vmax": largest}
    least = float(np.percentile(known, 0.5)) if known.size else 0.0
    return {"cmap": "viridis", "vmin": min(0.0, least), "vmax": largest}


def label_of(quantity: str) -> str:
    """Name and unit of a quantity, for a colour bar or an axis."""
    return "solidity, –" if quantity == "solidity" else (
        "speed, m/s" if quantity == "speed" else f"{quantity} velocity, m/s")


def _meridian_arrows(axis: Axes, mill: Mill, rings: Rings, both: tuple[Means, Means], colour: str) -> None:
    """Radial and axial velocity of both halves where the balls are, at most ARROWS across, with a key."""
    r, _, z = rings.middles()
    step_r, step_z = (max(1, round(2 * mill.radius / ARROWS / np.diff(edges)[0])) for edges in (rings.r, rings.z))
    thin = (slice(step_z // 2, None, step_z), slice(step_r // 2, None, step_r))
    places, arrows = [], []
    for mean, side in zip(both, (-1, 1)):
        x, y = np.meshgrid(side * r / mill.radius, 1e3 * z)
        shown = np.zeros(mean.solidity.shape, bool)
        shown[thin] = True
        shown &= mean.solidity > CLEAR
        places.append(np.stack([x[shown], y[shown]]))
        arrows.append(np.stack([side * mean.velocity[shown][:, 0], mean.velocity[shown][:, 2]]))
    draw_arrows(axis, np.concatenate(places, axis=1), np.concatenate(arrows, axis=1), colour)


def draw_arrows(axis: Axes, where: np.ndarray, velocity: np.ndarray, colour: str) -> None:
    """Arrows of velocities [2, n] (m/s) at places [2, n] of an axis, as long as their size, with a key; none if nothing
    moves."""
    usual = float(np.percentile(np.hypot(*velocity), 95)) if velocity.size else 0.0
    if usual == 0:
        return
    drawn = axis.quiver(*where, *velocity, color=colour, pivot="mid", scale_units="width", scale=12 * usual,
                        width=0.005, zorder=2)
    key = float(f"{usual:.1g}")
    axis.quiverkey(drawn, 0.86, 1.03, key, f"{key:g} m/s", labelpos="W", coordinates="axes", color="k")


def meridian_figure(mill: Mill, rings: Rings,
                    quantities: Iterable[str] = ("solidity", "speed", "tangential")) -> Figure:
    """Maps of quantities in the r-z plane, next to each other, with arrows of radial and axial velocity."""
    names = list(quantities)
    height = 1.2 + 3.1 * _shown_height(mill, rings) / (2 * mill.radius)
    figure, axes = plt.subplots(1, len(names), figsize=(4.4 * len(names), height), layout="constrained", squeeze=False)
    for axis, name in zip(axes[0], names):
        image = draw_meridian(axis, mill, rings, name)
        figure.colorbar(image, ax=axis, label=label_of(name), shrink=0.8)
        axis.set_title(" ", fontsize=9)  # room for the arrows' key
    if rings.angular_velocity != 0 and _pins(mill):
        figure.supxlabel("left: half of the azimuth near the lowest pins; right: the other half", fontsize=9)
    return figure


def draw_slice(axis: Axes, mill: Mill, rings: Rings, pins: dict, quantity: str) -> QuadMesh:
    """A slice around the axis, PIN_SLICE thicknesses high, at the height of a level of pins, seen from above, with x to
    the right and y up at the grid's DEM time 0; x and y over R. Returns its image. Arrows are the velocity in the
    plane."""
    middle, thickness = float(pins["height_m"]), float(pins["thickness_m"])
    mean = slice_around(rings, middle - PIN_SLICE / 2 * thickness, middle + PIN_SLICE / 2 * thickness)
    values = _values(mean, quantity)
    r, theta = np.meshgrid(rings.r / mill.radius, rings.theta)
    axis.set_facecolor(EMPTY)
    image = axis.pcolormesh(r * np.cos(theta), r * np.sin(theta), values, **_colours(values, quantity))
    _slice_arrows(axis, mill, rings, mean)
    if rings.angular_velocity != 0:
        for arm in range(int(pins["arms"])):
            _draw_arm(axis, mill, pins, np.radians(pins["angle_deg"]) + 2 * np.pi * arm / int(pins["arms"]))
    axis.add_patch(Circle((0, 0), mill.impeller["shaft_diameter_m"] / 2 / mill.radius, fc=DARK, ec="none", zorder=3))
    axis.add_patch(Circle((0, 0), 1, fill=False, ec=DARK, lw=1.2))
    axis.set(xlim=(-1.08, 1.08), ylim=(-1.08, 1.08), aspect="equal", xlabel="x / R", ylabel="y / R")
    axis.set_title(f"z {1e3 * (middle - PIN_SLICE / 2 * thickness):.0f} to "
                   f"{1e3 * (middle + PIN_SLICE / 2 * thickness):.0f} mm", fontsize=9, loc="left")
    return image


def _draw_arm(axis: Axes, mill: Mill, pins: dict, angle: float) -> None:
    """A pin from the axis to its tip, seen from above."""
    along, across = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
    tip, half = pins["length_m"] / 2 / mill.radius * along, pins["thickness_m"] / 2 / mill.radius * across
    axis.add_patch(Polygon([half, tip + half, tip - half, -half], fc=DARK, ec="none", zorder=3))


def _slice_arrows(axis: Axes, mill: Mill, rings: Rings, mean: Means) -> None:
    """Velocity in the plane, at places that are about equally far apart, with a key."""
    r, theta, _ = rings.middles()
    spacing = 2 * mill.radius / ARROWS
    step = max(1, round(spacing / np.diff(rings.r)[0]))
    shown = np.zeros(mean.solidity.shape, bool)
    for ring in range(step // 2, len(r), step):
        shown[::max(1, round(spacing / (r[ring] * np.diff(theta)[0]))) if len(theta) > 1 else 1, ring] = True
    shown &= mean.solidity > CLEAR
    rr, angle = np.meshgrid(r / mill.radius, theta)
    rr, angle, velocity = rr[shown], angle[shown], mean.velocity[shown]
    x = velocity[:, 0] * np.cos(angle) - velocity[:, 1] * np.sin(angle)
    y = velocity[:, 0] * np.sin(angle) + velocity[:, 1] * np.cos(angle)
    usual = float(np.percentile(np.hypot(x, y), 95)) if x.size else 0.0
    if usual == 0:
        return
    drawn = axis.quiver(rr * np.cos(angle), rr * np.sin(angle), x, y, color="k", pivot="mid", scale_units="width",
                        scale=14 * usual, width=0.0045, zorder=2)
    key = float(f"{usual:.1g}")
    axis.quiverkey(drawn, 0.9, 1.03, key, f"{key:g} m/s", labelpos="W", coordinates="axes")


def slices_figure(mill: Mill, rings: Rings, quantities: Iterable[str] = ("solidity", "radial", "axial")) -> Figure:
    """Slices at all levels of pins, the highest on top, of quantities next to each other. Expects a level of pins."""
    names, levels = list(quantities), _pins(mill)[::-1]
    figure, axes = plt.subplots(len(levels), len(names), figsize=(4.1 * len(names), 3.6 * len(levels)),
                                layout="constrained", squeeze=False)
    for row, pins in zip(axes, levels):
        for axis, name in zip(row, names):
            figure.colorbar(draw_slice(axis, mill, rings, pins, name), ax=axis, label=label_of(name), shrink=0.85)
    return figure


def profiles_figure(mill: Mill, rings: Rings) -> Figure:
    """Solidity and the three velocities over the radius, in the bands below, at and above the pins or discs."""
    found = bands(mill, rings)
    r = rings.middles()[0] / mill.radius
    figure, axes = plt.subplots(1, 4, figsize=(15, 3.6), layout="constrained", sharex=True)
    for axis, name in zip(axes, ("solidity", *COMPONENTS)):
        for band, mean in found.items():
            words, colour = BANDS[band]
            values = mean.solidity if name == "solidity" else mean.velocity[:, COMPONENTS.index(name)]
            axis.plot(r, values, "o-", ms=3, lw=1.5, color=colour, label=words)
        axis.set(xlabel="r / R", ylabel=label_of(name), xlim=(0, 1))
        axis.grid(alpha=0.3)
    axes[0].legend(fontsize=8)
    for axis in axes[1:]:
        axis.axhline(0, color="0.5", lw=0.7)
    return figure


def boxes_figure(boxes: dict[str, Box]) -> Figure:
    """Box plots of quantities: median, quartiles, whiskers and mean (diamond); the solidity has its own axis."""
    moving = {name: box for name, box in boxes.items() if name != "solidity"}
    figure, axes = plt.subplots(1, 2, figsize=(6.5, 3.6), layout="constrained",
                                gridspec_kw={"width_ratios": (len(moving), 1)})
    mean = {"marker": "D", "markerfacecolor": "k", "markeredgecolor": "k", "markersize": 4}
    for axis, shown, label in ((axes[0], moving, "velocity, m/s"),
                               (axes[1], {"solidity": boxes["solidity"]}, "solidity, –")):
        axis.bxp([box.drawn(name) for name, box in shown.items()], showfliers=False, showmeans=True, meanprops=mean,
                 medianprops={"color": "#D55E00"})
        axis.set(ylabel=label)
        axis.grid(axis="y", alpha=0.3)
    axes[0].axhline(0, color="0.5", lw=0.7)
    return figure
