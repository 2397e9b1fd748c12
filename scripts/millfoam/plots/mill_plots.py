# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of a mill: maps of charge and slurry, a strip of frames, an animation."""
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import TypeVar

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PolyCollection, QuadMesh
from matplotlib.figure import Figure
from PIL.Image import Palette

from ..files import foam
from ..files.outline import circle
from ..files.solids_file import SolidsMap
from ..files.written_times import MillFlow
from ..readings.maps_of_times import PIXELS, mean_flow, mean_load
from .drawing import drawn

Thing = TypeVar("Thing")
SLURRY, SPEED, SOLIDITY = "Blues", "viridis", "YlOrBr"


def draw_mill(axis: Axes, flow: MillFlow, time: float) -> None:
    """The mill's outline at flow time `time` and an arrow for its sense of rotation; axes in mm."""
    draw_outline(axis, flow.turned(flow.outline(), time), flow.radius, flow.omega)


def draw_outline(axis: Axes, outline: np.ndarray | None, radius: float, omega: float) -> None:
    """A mill's outline [n, 2] (m), None for the circle of its `radius` (m), and an arrow for its sense at `omega`
    (rad/s)."""
    outline = circle(radius) if outline is None else outline
    axis.plot(*(1e3 * outline.T), color="0.15", lw=1.2)
    draw_sense(axis, radius, omega)


def draw_sense(axis: Axes, radius: float, omega: float) -> None:
    """An arrow for the sense of rotation at `omega` (rad/s) of a mill of `radius` (m), and the axes' limits in mm."""
    radius = 1e3 * radius
    start = np.radians(60 if omega < 0 else 30)
    end = np.radians(30 if omega < 0 else 60)
    arc = 1.09 * radius * np.array([[np.cos(a), np.sin(a)] for a in np.linspace(start, end, 20)])
    axis.plot(*arc[:-1].T, color="0.15", lw=1.5)
    axis.annotate("", arc[-1], arc[-4], arrowprops={"arrowstyle": "-|>", "color": "0.15", "lw": 1.5})
    limit = 1.17 * radius
    axis.set(xlim=(-limit, limit), ylim=(-limit, limit), aspect="equal", xlabel="x, mm", ylabel="y, mm")


def _arrows(axis: Axes, x: np.ndarray, y: np.ndarray, velocity: np.ndarray, speed: np.ndarray) -> None:
    """Arrows of equal length, a few across the mill, where the velocity is known."""
    known = np.isfinite(velocity[..., 0]) & (speed > 0)
    unit = velocity[..., :2] / np.where(known, speed, 1)[..., None]
    xx, yy = np.meshgrid(x, y)
    axis.quiver(1e3 * xx[known], 1e3 * yy[known], unit[known][:, 0], unit[known][:, 1], color="k", scale=22,
                width=0.006, headwidth=4, pivot="mid", alpha=0.75)


def plot_maps(flow: MillFlow, solids: SolidsMap, begin: float, out: Path | str) -> None:
    """Four maps, averaged over the axis: solidity, balls' speed, slurry share, slurry speed."""
    slurry = mean_flow(flow, begin)
    ball_speed = np.linalg.norm(solids.velocity[..., :2], axis=-1)
    slurry_speed = np.linalg.norm(slurry.velocity[..., :2], axis=-1)
    top = np.nanmax([np.nanpercentile(ball_speed, 99), np.nanpercentile(slurry_speed, 99)])
    figure, axes = plt.subplots(2, 2, figsize=(11, 9.6), constrained_layout=True)
    masked_speed = np.where(solids.solidity > 0.005, ball_speed, np.nan)
    charge = np.where(solids.inside > 0.01, solids.solidity, np.nan)
    panels = [
        (1e3 * solids.x, 1e3 * solids.y, charge, SOLIDITY, (0, 0.65), "charge: solidity, –"),
        (1e3 * solids.x, 1e3 * solids.y, masked_speed, SPEED, (0, top), "charge: speed, m/s"),
        (1e3 * slurry.x, 1e3 * slurry.y, slurry.share, SLURRY, (0, 1), "slurry: share of the fluid, –"),
        (1e3 * slurry.x, 1e3 * slurry.y, slurry_speed, SPEED, (0, top), "slurry: speed, m/s"),
    ]
    for axis, (ex, ey, values, colours, limits, title) in zip(axes.flat, panels):
        image = axis.pcolormesh(ex, ey, values, cmap=colours, vmin=limits[0], vmax=limits[1], shading="flat")
        figure.colorbar(image, ax=axis, shrink=0.85)
        axis.set_title(title)
    x, y = solids.centres()
    _arrows(axes[0, 1], x, y, np.where(solids.shown()[..., None], solids.velocity, np.nan), ball_speed)
    (x, y), thin = slurry.centres(), slice(4, None, 9)
    _arrows(axes[1, 1], x[thin], y[thin],
            np.where((slurry.share > 0.3)[..., None], slurry.velocity, np.nan)[thin, thin], slurry_speed[thin, thin])
    last = flow.frames[-1][0]
    for axis in axes.flat:
        draw_mill(axis, flow, last)
    figure.suptitle(f"Averages over the axis; charge: DEM time {solids.begin:.3g} to {solids.end:.3g} s, "
                    f"slurry: flow time {begin:.3g} to {last:.3g} s; mill outline at the end")
    save(figure, out)


def load_figure(flow: MillFlow, begin: float) -> Figure:
    """Map of the fluid's force on the balls over their weight, which shows where one-way coupling holds. RuntimeError
    if the flow did not write that force."""
    load = flow.load(begin)
    if load is None:
        raise RuntimeError(f"{flow.case}: no forceOverWeight from {begin:g} s on")
    (mean, high), (x, y, ratio) = load, mean_load(flow, begin)
    edges = np.linspace(-1e3 * flow.radius, 1e3 * flow.radius, PIXELS + 1)
    figure, axis = plt.subplots(figsize=(6.4, 5.4), constrained_layout=True)
    image = axis.pcolormesh(edges, edges, ratio, cmap="magma_r", vmin=0, vmax=max(1, np.nanpercentile(ratio, 99)))
    figure.colorbar(image, ax=axis, shrink=0.9, label="force of the fluid on the balls / their weight, –")
    if np.nanmax(ratio) > 1:
        axis.contour(1e3 * x, 1e3 * y, np.nan_to_num(ratio), [1], colors="k", linewidths=1)
    draw_mill(axis, flow, flow.frames[-1][0])
    axis.set_title(f"mean over the balls {mean:.2f}, 95 % below {high:.2f}\n"
                   f"flow time {begin:.3g} to {flow.frames[-1][0]:.3g} s", fontsize=10)
    return figure


def save(figure: Figure, out: Path | str, dpi: int = 110) -> None:
    """Writes a figure to a PNG file and closes it."""
    drawn(figure, dpi).save(out, format="png", dpi=(dpi, dpi))
    plt.close(figure)


def draw_frame(axis: Axes, flow: MillFlow, time: float, path: Path, quads: np.ndarray,
               columns: np.ndarray) -> PolyCollection:
    """Slurry share over the axis at one time, with the charge's edge (solidity 0.2) if the flow has balls."""
    alpha = flow.over_axis(flow.field("alpha.slurry", path))
    turned = 1e3 * flow.turned(quads.reshape(-1, 2), time).reshape(quads.shape)
    patches = PolyCollection(turned, array=np.clip(alpha[columns], 0, 1), cmap=SLURRY, edgecolors="face", lw=0.2)
    patches.set_clim(0, 1)
    axis.add_collection(patches)
    if foam.is_there(path / "solidity"):
        phi = flow.over_axis(flow.field("solidity", path))
        x = (np.arange(PIXELS) + 0.5) / PIXELS * 2 * flow.radius - flow.radius
        grid = flow.on_grid(phi, time, x, x)
        if np.nanmax(grid) > 0.2:
            axis.contour(1e3 * x, 1e3 * x, np.nan_to_num(grid), [0.2], colors="tab:orange", linewidths=1.3)
    draw_mill(axis, flow, time)
    axis.set_title(f"t = {time:.2f} s, {abs(flow.omega * time) / (2 * np.pi):.2f} turns", fontsize=10)
    return patches


def plot_strip(flow: MillFlow, out: Path | str, count: int = 6) -> None:
    """`count` frames of the slurry, equally spaced in time."""
    quads, columns = flow.end_wall()
    numbers = np.unique(np.linspace(0, len(flow.frames) - 1, count).round().astype(int))
    rows = (len(numbers) + 2) // 3
    figure, axes = plt.subplots(rows, 3, figsize=(12.5, 4.2 * rows), constrained_layout=True, squeeze=False)
    for axis, number in zip(axes.flat, numbers):
        time, path = flow.frames[number]
        patches = draw_frame(axis, flow, time, path, quads, columns)
    for axis in axes.flat[len(numbers):]:
        axis.set_visible(False)
    charge = any(foam.is_there(path / "solidity") for _, path in (flow.frames[number] for number in numbers))
    figure.colorbar(patches, ax=axes, shrink=0.6,
                    label="slurry share over the axis, –" + ("  (orange: charge, solidity 0.2)" if charge else ""))
    save(figure, out, dpi=100)


def frame_figures(flow: MillFlow, frames: Iterable[tuple[float, Path]]) -> Iterator[Figure]:
    """One figure for each of `frames` (time in s, folder) of the slurry, on the same page; save each one before
    the next."""
    quads, columns = flow.end_wall()

    def draw(axis: Axes, frame: tuple[float, Path]) -> PolyCollection:
        time, path = frame
        return draw_frame(axis, flow, time, path, quads, columns)

    return redrawn_figures(frames, draw, 0.8, "slurry share over the axis, –")


def charge_figures(charges: Iterable[SolidsMap], radius: float, omega: float,
                   outline_at: Callable[[float], np.ndarray | None]) -> Iterator[Figure]:
    """One figure for each SolidsMap's solidity in a mill of `radius` (m) that turns at `omega` (rad/s), on the same
    page; outline_at(time in s): its outline [n, 2] (m), or None."""
    def draw(axis: Axes, charge: SolidsMap) -> QuadMesh:
        solidity = np.where(charge.inside > 0.01, charge.solidity, np.nan)
        image = axis.pcolormesh(1e3 * charge.x, 1e3 * charge.y, solidity, cmap=SOLIDITY, vmin=0, vmax=0.65)
        draw_outline(axis, outline_at(charge.end), radius, omega)
        axis.set_title(f"DEM time {charge.begin:.3g} to {charge.end:.3g} s", fontsize=10)
        return image

    return redrawn_figures(charges, draw, 0.85, "solidity over the axis, –")


def redrawn_figures(things: Iterable[Thing], draw: Callable[[Axes, Thing], ScalarMappable], shrink: float,
                    label: str) -> Iterator[Figure]:
    """One figure, drawn again for each of `things` by draw(axis, thing), which returns what the colour bar shows. The
    layout is computed only once, for the first of them, because it takes longer than the drawing."""
    figure, axis = plt.subplots(figsize=(5.4, 4.6), layout="constrained")
    for number, thing in enumerate(things):
        axis.clear()
        shown = draw(axis, thing)
        if number == 0:
            figure.colorbar(shown, ax=axis, shrink=shrink, label=label)
            figure.draw_without_rendering()
            figure.set_layout_engine("none")
        yield figure
    plt.close(figure)


def animate(flow: MillFlow, out: Path | str, most: int = 60) -> None:
    """Writes at most `most` of the frames, equally spaced, as an endless GIF."""
    frames = [flow.frames[k] for k in np.unique(np.linspace(0, len(flow.frames) - 1, most).astype(int))]
    pictures = [drawn(figure, 80).convert("P", palette=Palette.ADAPTIVE, colors=128)
                for figure in frame_figures(flow, frames)]
    pictures[0].save(out, save_all=True, append_images=pictures[1:], duration=100, loop=0)
