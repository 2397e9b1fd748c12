# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of the pools at rest: speeds against time, and maps of the speed with the surface."""
import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import LogNorm
from scipy.spatial import cKDTree

from millfoam.files import foam

matplotlib.use("Agg")

COLOURS = {"interFoam": "tab:red", "interIsoFoam": "tab:orange", "slurryFoam": "tab:blue"}
SLOWEST, FASTEST = 1e-5, 10.0  # m/s, of the maps' colours


def settings(histories):
    return list(dict.fromkeys(run.setting for run in histories))


def speeds(histories, out):
    """One panel a setting: air's and slurry's largest speed and the slurry's rms against time, a colour a solver."""
    names = settings(histories)
    columns = min(4, len(names))
    rows = -(-len(names) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(4 * columns, 3.4 * rows), squeeze=False, sharey=True,
                                constrained_layout=True)
    for axis, name in zip(axes.flat, names):
        for run, history in histories.items():
            if run.setting == name:
                colour = COLOURS[run.solver]
                axis.semilogy(history.time[1:], history.slurry_rms[1:], "-", lw=2, color=colour)
                axis.semilogy(history.time[1:], history.slurry[1:], "--", lw=1, color=colour)
                axis.semilogy(history.time[1:], history.air[1:], ":", lw=1, color=colour)
        axis.set(title=name, xlabel="time, s")
        axis.grid(alpha=0.3)
    for axis in axes.flat[len(names):]:
        axis.axis("off")
    for axis in axes[:, 0]:
        axis.set_ylabel("speed, m/s")
    styles = [plt.Line2D([], [], color="k", ls=style, label=label)
              for style, label in (("-", "slurry, rms"), ("--", "slurry, largest"), (":", "air, largest"))]
    solvers = dict.fromkeys(run.solver for run in histories)
    styles += [plt.Line2D([], [], color=COLOURS[solver], lw=2, label=solver) for solver in solvers]
    figure.legend(handles=styles, loc="lower center", ncol=3, fontsize=7, bbox_to_anchor=(0.5, 1.0))
    figure.suptitle("Spurious speeds of a pool that should be at rest")
    figure.savefig(out, dpi=110, bbox_inches="tight")
    plt.close(figure)


def section(mesh):
    """Cells of the layer in the middle of the axis: their outlines [n, 4, 2], centres [n, 2], and numbers [n]."""
    centres, _ = mesh.centres_and_volumes()
    patch = mesh.patches["feedEnd"]
    quads = mesh.points[np.array(mesh.faces[patch.start:patch.start + patch.size])]
    middle = 0.5 * (mesh.points[:, 2].min() + mesh.points[:, 2].max())
    layer = np.flatnonzero(np.abs(centres[:, 2] - middle) < np.abs(centres[:, 2] - middle).min() + 1e-9)
    place = quads[:, :, :2].mean(axis=1)
    number = layer[cKDTree(centres[layer, :2]).query(place)[1]]
    return quads[:, :, :2], centres[number, :2], number


def draw(axis, case, folder):
    mesh = foam.read_mesh(case, folder)
    outline, centre, number = section(mesh)
    speed = np.linalg.norm(foam.read_field(folder / "U", mesh.cells), axis=1)[number]
    alpha = foam.read_field(folder / "alpha.slurry", mesh.cells)[number]
    drawn = PolyCollection(outline, array=np.maximum(speed, SLOWEST), cmap="viridis", norm=LogNorm(SLOWEST, FASTEST),
                           edgecolors="face", linewidths=0.1)
    axis.add_collection(drawn)
    if (alpha < 0.5).any():
        axis.tricontour(centre[:, 0], centre[:, 1], alpha, levels=[0.5], colors="w", linewidths=1)
    axis.set_aspect("equal")
    axis.autoscale_view()
    axis.axis("off")
    return drawn


def maps(histories, work, out):
    """The speed in the middle of the axis at the end, with the surface: a row a setting, a column a solver."""
    names, solvers = settings(histories), list(dict.fromkeys(run.solver for run in histories))
    figure, axes = plt.subplots(len(names), len(solvers), figsize=(3.6 * len(solvers) + 1, 3.4 * len(names)),
                                squeeze=False, constrained_layout=True)
    for axis in axes.flat:
        axis.axis("off")
    for run, history in histories.items():
        axis = axes[names.index(run.setting), solvers.index(run.solver)]
        time, folder = foam.times(work / run.name)[len(history.time) - 1]
        drawn = draw(axis, work / run.name, folder)
        axis.set_title(f"{run.solver}: {run.setting}, {time:g} s", fontsize=8)
    figure.colorbar(drawn, ax=axes, label="|U|, m/s", shrink=0.5)
    figure.savefig(out, dpi=90)
    plt.close(figure)
