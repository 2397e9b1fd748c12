# SPDX-License-Identifier: GPL-3.0-or-later
"""Section of the report about the contacts of a dry run that wrote them: spectra of collisions and of dissipated
power."""
import numpy as np
from matplotlib.figure import Figure

from ..files.mill_case import MillCase
from ..readings.contact_spectra import PARTS, Spectra, power_to_dissipate, read_spectra
from . import page
from .case_readings import Readings
from .figures import COLOURS, axes_of

DUMPS = 300  # of contacts, at most; their spectrum is smooth and takes about ten seconds
NAMES = {"damping": "damping along the normal", "friction": "friction", "rolling": "rolling friction",
         "spring": "stored in springs"}


def contact_section(case: MillCase, _readings: Readings) -> list[str]:
    """Cards of the contacts of a dry run; none if it wrote no contacts."""
    folder = case.contacts
    if not folder:
        return []
    try:
        begin, end = contact_span(case)
        spectra, drive = read_spectra(folder, begin, end), power_to_dissipate(folder, begin, end)
    except (RuntimeError, OSError, ValueError) as error:
        return [page.paragraph(f"Contacts cannot be shown: {error}.")]
    span = (f"{spectra.dumps} dumps of contacts, every {1e3 * spectra.interval:.3g} ms of DEM time {begin:.3g} to "
            f"{end:.3g} s")
    return [page.picture(spectra_figure(spectra), "Top: collisions per second by their energy at first touch. "
                         "Bottom: dissipated power by the energy of the contacts' motion. Colour: the larger ball of "
                         f"a pair; grey: contacts with the wall. From {span}.", title="Spectra of energy"),
            page.table(*power_table(spectra), title="Power that contacts dissipate, mW",
                       note="Between balls of two diameters, and between balls and the wall."),
            page.table(None, balance_rows(spectra, drive), title="Where the drive's power goes",
                       note="In a steady state the contacts take the drive's power. The two numbers differ because "
                            "dumps are samples: more dumps at shorter intervals reduce the difference.")]


def contact_span(case: MillCase) -> tuple[float, float]:
    """DEM times between which contacts are read: the last DUMPS dumps, of a charge that becomes steady only those
    since then."""
    times = case.contact_times
    if len(times) < 3:
        raise RuntimeError(f"{case.contacts}/contacts: {len(times)} dumps, expected 3 or more")
    first = times[-min(DUMPS, len(times))]
    steady = float(case.results["steady_from"]) if case.results.get("steady") == "yes" else 0.0
    begin = max(steady, first)
    return (begin if begin <= times[-3] else first), times[-1]


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


def balance_rows(spectra: Spectra, drive: float) -> list[tuple[str, str]]:
    """Rows of the contacts' power and the drive's power (`drive`, W)."""
    parts = {part: spectra.power[part] for part in PARTS}
    taken = spectra.total_power()
    rows = [(f"{NAMES[part]}: between balls, at the wall", f"{1e3 * values[1:].sum():.3g}, {1e3 * values[0].sum():.3g} "
                                                           f"mW")
            for part, values in parts.items()]
    return rows + [("share of the friction at sliding contacts", f"{100 * spectra.sliding:.0f} %"),
                   ("all contacts", f"{1e3 * taken:.4g} mW"),
                   ("drive, minus the gain of the charge's energy", f"{1e3 * drive:.4g} mW"),
                   ("contacts over drive", f"{taken / drive:.3f}"),
                   ("collisions", f"{spectra.collisions.sum():.3g} per second")]
