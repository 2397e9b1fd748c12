# SPDX-License-Identifier: GPL-3.0-or-later
"""Section of the report about the contacts of a dry run: spectra of collisions and of dissipated power."""
from ..files.mill_case import MillCase
from ..readings.contact_spectra import PARTS, Spectra, power_to_dissipate, read_spectra
from . import page
from .case_readings import Readings
from .contact_figures import power_table, spectra_figure
from .contact_statistics_cards import statistics_cards

DUMPS = 300  # of contacts, at most; their spectrum is smooth and takes about ten seconds
NAMES = {"damping": "damping along the normal", "friction": "friction", "rolling": "rolling friction",
         "spring": "stored in springs"}


def contact_section(case: MillCase, _readings: Readings) -> list[str]:
    """Cards of the contacts of a dry run; none if it wrote no contacts. Statistics of every step replace dumps."""
    if case.results and case.results.get("contacts"):
        try:
            return statistics_cards(case)
        except (RuntimeError, OSError, ValueError) as error:
            return [page.paragraph(f"Contacts cannot be shown: {error}.")]
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
    steady = case.result("steady_from_s") if case.results and case.results.get("steady") else 0.0
    begin = max(steady, first)
    return (begin if begin <= times[-3] else first), times[-1]


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
