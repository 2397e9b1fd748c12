# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of the slurry in a stirred mill: means in the r-z plane, and a section through the pins with the balls."""
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgba
from scipy.spatial import cKDTree

from ..files.mill import Mill
from ..readings.stirred_slurry import SlurryFlow, in_impeller, meridian_means
from .ball_sections import section
from .stirred_plots import DARK, draw_arrows, draw_impeller

RADIAL, AXIAL = 40, 80  # places of a map in the r-z plane
PIXELS, FINE = 320, 960  # along each side of a section: of the slurry, of the balls
SPECKS = 0.02  # share of slurry below which a cell is not counted in the height that pictures show


def maps_figure(mill: Mill, flow: SlurryFlow) -> plt.Figure:
    """r-z maps, means over the azimuth: share of slurry between the balls, tangential velocity with arrows."""
    top = _shown_height(mill, flow)
    edges = np.linspace(0, mill.radius, RADIAL + 1), np.linspace(0, top, AXIAL + 1)
    middle = [(edge[1:] + edge[:-1]) / 2 for edge in edges]
    share, solidity, mean = meridian_means(mill, flow, middle)
    velocity = np.moveaxis(mean, -1, 0)
    hidden = ~(share > 0.3)
    figure, axes = plt.subplots(1, 2, figsize=(9.5, 4.8), layout="constrained")
    both = np.concatenate([-edges[0][::-1], edges[0][1:]]) / mill.radius
    tangential = np.where(hidden, np.nan, velocity[1])
    for axis, values, name, colours in ((axes[0], share, "share of slurry between the balls", "Blues"),
                                        (axes[1], tangential, "tangential velocity, m/s", "viridis")):
        mirrored = np.concatenate([values[::-1], values]).T
        image = axis.pcolormesh(both, 1e3 * edges[1], mirrored, cmap=colours,
                                vmin=0, vmax=1 if name.startswith("share") else None)
        figure.colorbar(image, ax=axis, label=name)
        draw_impeller(axis, mill, False)
        for side in (-1, 1):
            axis.contour(side * middle[0] / mill.radius, 1e3 * middle[1], solidity.T, [0.1, 0.4],
                         colors="tab:orange", linewidths=(0.6, 1.2))
        axis.set(xlim=(-1, 1), ylim=(0, 1e3 * top), xlabel="r / R", ylabel="z, mm", aspect=1 / (1e3 * mill.radius))
        axis.set_facecolor("0.93")
    step = (slice(1, None, 4), slice(2, None, 5))
    known = ~hidden[step]
    r, z, radial, axial = (part[step][known] for part in (*np.meshgrid(*middle, indexing="ij"), velocity[0],
                                                          velocity[2]))
    draw_arrows(axes[1], np.array([np.concatenate([-r, r]) / mill.radius, 1e3 * np.tile(z, 2)]),
                np.array([np.concatenate([-radial, radial]), np.tile(axial, 2)]), "w")
    axes[0].set_title("orange: balls' solidity 0.1 and 0.4", fontsize=9)
    axes[1].set_title("radial and axial velocity:", fontsize=9, loc="left")
    return figure


def vortex_figure(mill: Mill, flow: SlurryFlow, record: tuple[float, Path] | None = None) -> plt.Figure:
    """A vertical section through the first pins, in the impeller's frame: speed of the slurry, the impeller, and the
    balls that the section cuts, of a record: its DEM time (s), and the dump."""
    angle = np.radians(mill.impeller["pins"][0]["angle_deg"]) if mill.impeller["pins"] else 0.0
    along = np.array([np.cos(angle), np.sin(angle), 0])
    x, z = np.linspace(-mill.radius, mill.radius, PIXELS), np.linspace(0, _shown_height(mill, flow), PIXELS)
    points = x[None, :, None] * along + z[:, None, None] * np.array([0, 0, 1])
    near = cKDTree(flow.centre).query(points.reshape(-1, 3))[1]
    share = flow.share[near].reshape(len(z), len(x))
    speed = np.linalg.norm(flow.velocity, axis=1)[near].reshape(share.shape)
    figure, axis = plt.subplots(figsize=(6.4, 5), layout="constrained")
    axis.set_facecolor("0.95")
    image = axis.pcolormesh(1e3 * x, 1e3 * z, np.where(share > 0.5, speed, np.nan), cmap="viridis", vmin=0)
    figure.colorbar(image, ax=axis, label="speed of the slurry, m/s (mean over time)")
    axis.contour(1e3 * x, 1e3 * z, share, [0.5], colors="tab:blue", linewidths=1.2)
    if record is not None:
        _draw_balls(axis, mill, record, angle, 1e3 * z[-1])
    axis.contourf(1e3 * x, 1e3 * z, in_impeller(mill, points), [0.5, 1.5], colors=[DARK], zorder=3)
    axis.set(xlim=(-1e3 * mill.radius, 1e3 * mill.radius), ylim=(0, 1e3 * z[-1]), xlabel="along the first pins, mm",
             ylabel="z, mm", aspect="equal")
    return figure


def _shown_height(mill: Mill, flow: SlurryFlow) -> float:
    """Height up to which pictures show the mill, m: a little above the slurry."""
    return min(mill.length, 1.3 * float(flow.centre[flow.share > SPECKS, 2].max()))


def _draw_balls(axis: Axes, mill: Mill, record: tuple[float, Path], angle: float, top: float) -> None:
    """The section of a vertical plane through the balls of a record, with their own sizes and shapes, up to `top` (mm);
    angle: of the plane in the impeller's frame, rad."""
    time, dump = record
    turned = angle + mill.derived("speed", "angular_velocity_rad_s") * time
    across, up = (np.linspace(low, high, FINE) for low, high in ((-1e3 * mill.radius, 1e3 * mill.radius), (0, top)))
    speeds = section(dump, np.array([np.cos(turned), np.sin(turned), 0.0]), across / 1e3, up / 1e3)
    # Between two balls, which have two speeds, or a ball and none
    rows, columns = speeds[1:] != speeds[:-1], speeds[:, 1:] != speeds[:, :-1]
    rim = (np.pad(rows, ((1, 0), (0, 0))) | np.pad(rows, ((0, 1), (0, 0)))
           | np.pad(columns, ((0, 0), (1, 0))) | np.pad(columns, ((0, 0), (0, 1))))
    colours = np.zeros((*speeds.shape, 4))
    colours[np.isfinite(speeds)] = to_rgba("0.8", 0.75)
    colours[rim & np.isfinite(speeds)] = to_rgba("0.3", 0.9)
    axis.imshow(colours, origin="lower", extent=(across[0], across[-1], 0, top), interpolation="nearest", zorder=2)
