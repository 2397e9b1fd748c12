# SPDX-License-Identifier: GPL-3.0-or-later
"""Spectra of a charge's contacts, from dumps or from statistics of every step, as a figure and a table."""
import numpy as np
from matplotlib.figure import Figure

from ..readings.contact_spectra import Spectra
from .figures import COLOURS, axes_of


def spectra_figure(spectra: Spectra) -> Figure:
    """Collisions and dissipated power by energy, a curve for each class of the larger ball and one for the wall."""
    figure, (top, bottom) = axes_of(2, height=3.0)
    middles = np.sqrt(spectra.edges[1:] * spectra.edges[:-1])
    for axis, values, unit in ((top, spectra.collisions, 1.0), (bottom, spectra.dissipation(), 1e3)):
        wall, balls = values[0].sum(axis=0), values[1:].sum(axis=0)
        curves = [(f"{1e3 * diameter:.3g} mm", balls[k], COLOURS[(k - 1) % len(COLOURS)])
                  for k, diameter in enumerate(spectra.classes) if k > 0]
        for label, curve, colour in [*curves, ("wall", wall, "0.55")]:
            # The outermost bins hold what is beyond the edges
            seen = np.where(curve[1:-1] > 0, unit * curve[1:-1], np.nan)
            axis.step(middles, seen, where="mid", color=colour, label=label, lw=1.4)
        axis.set(xscale="log", yscale="log")
        # Single touches of very low energy would stretch the axis
        axis.set_ylim(bottom=max(axis.get_ylim()[0], 1e-6 * unit * values.max(initial=0)))
    top.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=4)
    top.set_ylabel("collisions, 1/s per bin")
    bottom.set(ylabel="dissipated power,\nmW per bin", xlabel="energy, J (5 bins per decade)")
    return figure


def power_table(spectra: Spectra) -> tuple[list[str], list[tuple]]:
    """Head and rows: dissipated power of each pair of classes, mW."""
    power = 1e3 * spectra.dissipation().sum(axis=-1)
    names = ["wall", *(f"{1e3 * diameter:.3g} mm" for diameter in spectra.classes[1:])]
    rows = [(f"ball of {names[k]}", *((value, ".3g") if value else "–" for value in (power + np.triu(power, 1).T)[k]))
            for k in range(1, len(names))]
    return ["", *names], rows
