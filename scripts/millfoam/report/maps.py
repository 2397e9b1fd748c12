# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps of the report: averages over the axis, in the mill's outline with its sense of rotation."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..files.mill_case import MillCase
from ..files.slurry_file import SlurryMap
from ..files.solids_file import SolidsMap
from ..plots import mill_plots
from .figures import RED

DIFFERENCE = "RdBu_r"


def draw_mill(axis: Axes, case: MillCase) -> None:
    """The mill of a case: its outline at the end of the averaged time, and its sense of rotation."""
    mill_plots.draw_outline(axis, case.outline, case.radius, case.omega)


def map_figure(case: MillCase, x: np.ndarray, y: np.ndarray, values: np.ndarray, label: str, colours: str,
               limits: tuple[float, float]) -> Figure:
    """Values [ny, nx] on pixels between x [nx + 1] and y [ny + 1] (m) in a case's mill; label: of the colour bar."""
    figure, axis = plt.subplots(figsize=(5.2, 4.4), constrained_layout=True)
    image = axis.pcolormesh(1e3 * x, 1e3 * y, values, cmap=colours, vmin=limits[0], vmax=limits[1])
    slack = 0.005 * (limits[1] - limits[0])
    below, above = np.nanmin(values, initial=np.inf) < limits[0] - slack, np.nanmax(values,
                                                                                    initial=-np.inf) > limits[1] + slack
    extend = {(True, True): "both", (True, False): "min", (False, True): "max"}.get((bool(below), bool(above)),
                                                                                    "neither")
    figure.colorbar(image, ax=axis, shrink=0.9, label=label, extend=extend)
    draw_mill(axis, case)
    return figure


def solidity_figure(case: MillCase, charge: SolidsMap) -> Figure:
    """Solidity of a SolidsMap."""
    values = np.where(charge.inside > 0.01, charge.solidity, np.nan)
    return map_figure(case, charge.x, charge.y, values, "solidity, –", mill_plots.SOLIDITY, (0, 0.65))


def speed_figure(case: MillCase, x: np.ndarray, y: np.ndarray, velocity: np.ndarray, known: np.ndarray,
                 top: float | None = None) -> Figure:
    """Speed across the axis with arrows of its direction, where it is `known` [ny, nx]; top: of the scale, m/s."""
    speed = np.where(known, np.linalg.norm(velocity[..., :2], axis=-1), np.nan)
    top = top or (np.nanpercentile(speed, 99) if np.isfinite(speed).any() else 1)
    figure = map_figure(case, x, y, speed, "speed across the axis, m/s", mill_plots.SPEED, (0, top))
    step = max(1, round(speed.shape[0] / 16))
    thin = (slice(step // 2, None, step),) * 2
    xx, yy = np.meshgrid((x[1:] + x[:-1]) / 2, (y[1:] + y[:-1]) / 2)
    shown = np.zeros(speed.shape, dtype=bool)
    shown[thin] = speed[thin] > 0
    unit = velocity[shown][:, :2] / speed[shown][:, None]
    figure.axes[0].quiver(1e3 * xx[shown], 1e3 * yy[shown], *unit.T, scale=24, width=0.005, pivot="mid", alpha=0.8)
    return figure


def z_velocity_figure(case: MillCase, slurry: SlurryMap) -> Figure:
    """The slurry's velocity along the axis where its share of the fluid is over 0.5."""
    velocity = 1e3 * np.where(slurry.share > 0.5, slurry.velocity[..., 2], np.nan)
    limit = np.nanpercentile(np.abs(velocity), 99) if np.isfinite(velocity).any() else 1
    return map_figure(case, slurry.x, slurry.y, velocity, "velocity along the axis, mm/s", DIFFERENCE, (-limit, limit))


def difference_figure(case: MillCase, x: np.ndarray, y: np.ndarray, values: np.ndarray, label: str,
                      least: float = 0.0) -> Figure:
    """Differences, red if positive, on a scale about zero up to their 99th percentile, but at least up to `least`."""
    limit = max(np.nanpercentile(np.abs(values), 99) if np.isfinite(values).any() else 0, least) or 1
    return map_figure(case, x, y, values, label, DIFFERENCE, (-limit, limit))


def histogram_figure(shares: np.ndarray, edges: np.ndarray) -> Figure:
    """Shares [bins] of the mill's inside by their difference of solidity between `edges` [bins + 1], in per cent."""
    figure, axis = plt.subplots(figsize=(5.2, 3.4), constrained_layout=True)
    axis.stairs(100 * shares, edges, fill=True, color=RED, alpha=0.7)
    held = np.flatnonzero(shares > 0)
    reach = np.abs(edges[[held[0], held[-1] + 1]]).max() if len(held) else 0.1
    axis.axvline(0, color="0.3", lw=0.8)
    axis.set(yscale="log", xlim=(-1.05 * reach, 1.05 * reach), xlabel="difference of solidity, –",
             ylabel="% of the mill's inside")
    axis.spines[["top", "right"]].set_visible(False)
    return figure
