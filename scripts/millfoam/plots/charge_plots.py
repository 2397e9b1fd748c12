# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of the charge's readings: its map with the readings, and the tangential velocity along the line."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.figure import Figure

from ..files.solids_file import SolidsMap
from ..readings.charge import Charge, TangentialProfile
from .mill_plots import draw_outline

BLUE, GREEN, GREY = "#0072B2", "#009E73", "0.45"  # Okabe and Ito's, which colour-blind readers can distinguish
ARROWS = 17  # across the mill


def _signed(words: str) -> str:
    """Words with minus signs."""
    return words.replace("-", "−")


def _arrows(axis: Axes, charge: SolidsMap) -> None:
    """Mean velocity where the charge is, every few voxels, with a key."""
    x, y = charge.centres()
    step = max(1, round(len(x) / ARROWS))
    thin = (slice(step // 2, None, step),) * 2
    xx, yy = np.meshgrid(1e3 * x, 1e3 * y)
    speed = np.linalg.norm(charge.velocity[..., :2], axis=-1)
    shown = np.zeros(speed.shape, bool)
    shown[thin] = True
    shown &= charge.shown() & np.isfinite(speed)
    top = np.max(speed[shown])
    arrows = axis.quiver(xx[shown], yy[shown], *charge.velocity[shown][:, :2].T, color=GREY, angles="xy", pivot="mid",
                         scale_units="width", scale=14 * top, width=0.004)
    key = float(f"{top / 2:.1g}")
    axis.quiverkey(arrows, 0.9, 1.03, key, f"{key:g} m/s", labelpos="W", coordinates="axes")


def charge_figure(charge: SolidsMap, readings: Charge, radius: float, outline: np.ndarray | None = None) -> Figure:
    """Figure of a SolidsMap with its Charge (readings.charge.read_charge) in a mill of `radius` (m): solidity,
    velocities, outline [n, 2] (m; without it the shell's circle) and sense, centre of circulation and the line through
    it, free surface with its logistic, toe and shoulder."""
    figure, axis = plt.subplots(figsize=(5.2, 5.1), layout="constrained")
    figure.get_layout_engine().set(rect=(0, 0.14, 1, 0.86))
    figure.colorbar(_draw(axis, charge, readings, radius, outline), ax=axis, label="solidity, –", shrink=0.9)
    # A legend of the figure, because it is wider than the map; a legend of the axis would shrink the map
    figure.legend(loc="lower center", fontsize=9, frameon=False)
    return figure


def draw_charge(axis: Axes, charge: SolidsMap, readings: Charge, radius: float) -> QuadMesh:
    """Draws the content of charge_figure on an axis; returns the solidity's image, for a colour bar."""
    image = _draw(axis, charge, readings, radius, None)
    axis.legend(loc="upper center", bbox_to_anchor=(0.5, -0.12), fontsize=9, frameon=False)
    return image


def _draw(axis: Axes, charge: SolidsMap, readings: Charge, radius: float, outline: np.ndarray | None) -> QuadMesh:
    solidity = np.where(charge.inside > 0.01, charge.solidity, np.nan)
    image = axis.pcolormesh(1e3 * charge.x, 1e3 * charge.y, solidity, cmap="YlOrBr", vmin=0, vmax=0.65)
    draw_outline(axis, outline, radius, charge.sense)
    _arrows(axis, charge)
    surface, profile = readings.surface, readings.tangential
    outwards = np.array(readings.centre) / np.hypot(*readings.centre)
    axis.plot(*(1e3 * outwards[:, None] * profile.distance[[0, -1]]), color=GREEN, lw=1.2, ls="-.")
    axis.plot(*(1e3 * surface.points.T), color=BLUE, lw=2.2,
              label=_signed(f"free surface, shoulder {readings.shoulder:.0f}° (square) to toe {readings.toe:.0f}° "
                            "(triangle)"))
    left, right = np.sort(surface.points[:, 0])[[0, -1]]
    x = np.linspace(left, right, 200)
    axis.plot(1e3 * x, 1e3 * surface.fitted(x), color="k", lw=1.4, ls="--",
              label=f"logistic, RMSD {1e3 * surface.rmsd:.2g} mm")
    axis.plot(*(1e3 * surface.points[0]), "s", color=BLUE, mec="w", ms=8)
    axis.plot(*(1e3 * surface.points[-1]), "^", color=BLUE, mec="w", ms=9)
    x, y = 1e3 * np.array(readings.centre)
    axis.plot(x, y, "o", color=GREEN, mec="w", ms=9, ls="-.",
              label=_signed(f"centre of circulation ({x:.1f}, {y:.1f}) mm and line"))
    axis.set_title(f"DEM time {charge.begin:.3g} to {charge.end:.3g} s", fontsize=10, loc="left")
    return image


def tangential_figure(profile: TangentialProfile) -> Figure:
    """Figure of a TangentialProfile: velocity with its cubic, their difference, and shear rate, against the
    distance."""
    figure, axes = plt.subplots(3, 1, figsize=(5.4, 6.2), sharex=True, constrained_layout=True,
                                gridspec_kw={"height_ratios": (2, 1, 1.3)})
    distance = 1e3 * profile.distance
    fitted = profile.fitted(profile.distance)
    axes[0].plot(distance, profile.velocity, color=BLUE, lw=2, label="map")
    axes[0].plot(distance, fitted, color="k", lw=1.3, ls="--", label=f"cubic, RMSD {profile.rmsd:.2g} m/s")
    axes[0].legend(frameon=False, fontsize=9)
    axes[0].set(ylabel="tangential velocity, m/s\n(positive as the mill turns)")
    axes[1].plot(distance, profile.velocity - fitted, color=BLUE, lw=1.5)
    axes[1].set(ylabel="map − cubic, m/s")
    axes[2].plot(distance, profile.shear_rate, color="k", lw=1.5)
    axes[2].set(ylabel="shear rate du/dr, 1/s", xlabel="distance from the mill's centre, mm\n" + _signed(
        f"(line at {profile.angle:.0f}° from straight down)"))
    for axis in axes:
        axis.axhline(0, color=GREY, lw=0.7)
        axis.margins(x=0)
    figure.align_ylabels(axes)
    return figure
