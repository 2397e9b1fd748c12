# SPDX-License-Identifier: GPL-3.0-or-later
"""Cards of the report about the time that slurry stays in the mill, for each tracer of the flow."""
import numpy as np
from scipy.special import gammaln

from ..files.mill_case import MillCase
from ..files.tables import TableError
from ..readings.residence import Residence, TracerTable, hold_up_over_feed, read_tracer, residence, tracer_names
from . import figures, page
from .words import Name, uncertain

SHOWN = 4.0  # mean times in the picture
BINS = 50  # of each mean time


def residence_cards(case: MillCase) -> list[str]:
    """A picture and a table for each slurryTracer; none without one."""
    cards = []
    for name in tracer_names(case.folder):
        title = Name(f"Residence time: {name}")
        try:
            table = read_tracer(case.folder, name)
            found = residence(table)
        except (TableError, RuntimeError) as error:
            cards.append(page.table(None, [("not known", str(error))], title=title))
            continue
        cards += [page.picture(distribution(found), "E(t): share of the feed that leaves so long after it entered, for "
                               "each second, over bins of a fiftieth of the mean time. Second curve: stirred tanks in "
                               "series with the same mean and variance.",
                               title=title),
                  page.table(None, rows(case, table, found), title=Name(f"{title}, numbers"),
                             note=note(found))]
    return cards


def note(found: Residence) -> str:
    """What the numbers of a Residence assume of the tracer that has not left, how much depends on it, and that they
    have no error over time."""
    return f"{tail_words(found)} The numbers have no error over time: each tracer is fed once."


def tail_words(found: Residence) -> str:
    """In words, how the tracer leaves that has not left, and how much depends on it."""
    if not found.left:
        return "All tracer has left."
    share = f"{100 * found.left:.2g} % of the tracer has not left and is taken to leave"
    mean, spread = found.doubt
    if not found.tail:
        return f"{share} at the end of the record." + (
            " How slowly it leaves is lost in noise, so the error of the numbers is not known." if np.isnan(mean)
            else "")
    words = (f"another fit of the exponential changes the mean by {100 * mean:+.2g} % and the variance over its square "
             f"by {100 * spread:+.2g} %. They may be off by twice as much, and by more where slurry hardly moves."
             if np.isfinite([mean, spread]).all() else
             "no second fit of the exponential was found, so their error is not known.")
    return (f"{share} as an exponential. So mean, deviation, tanks and Péclet number are estimates: {words} Let the "
            "flow run longer to make this smaller.")


def rows(case: MillCase, table: TracerTable, found: Residence) -> list[tuple[str, str]]:
    """Rows (name, text) of a Residence."""
    peclet = "above 10⁶" if np.isinf(found.peclet) else f"{found.peclet:.3g}" if found.peclet else "0: a stirred tank"
    numbers = [("mean time in the mill", f"{found.mean:.4g} s")]
    expected = hold_up_over_feed(case.balance, table, case.turn) if case.balance is not None else None
    if expected:
        numbers.append(("hold-up over feed, from the tracer's begin on",
                        f"{uncertain(expected.value, expected.error, 's', '.4g')}, "
                        f"{100 * (found.mean / expected.value - 1):+.2g} %"))
    return numbers + [("standard deviation", f"{np.sqrt(max(found.variance, 0)):.4g} s"),
                      ("stirred tanks in series", f"{found.tanks:.3g}" if np.isfinite(found.tanks) else "no spread"),
                      ("Péclet number of axial dispersion, both ends closed", peclet),
                      ("tracer that has not left", f"{100 * found.left:.3g} %"),
                      ("time of its exponential", f"{found.tail:.3g} s" if found.tail else "–"),
                      ("missing in the tracer's balance", f"{table.missing:.1g}"),
                      ("smallest and largest concentration, of the inlet's",
                       f"{table.lowest:.1e} and 1 {table.highest - 1:+.1e}")]


def distribution(found: Residence) -> figures.Figure:
    """E(t) over BINS bins of the mean time, or as many as the rows allow, and that of tanks in series."""
    time, density = found.binned(max(found.mean / BINS, float(np.median(found.length))))
    shown = time < SHOWN * found.mean
    curves = [("simulation", time[shown], density[shown])]
    if 0.1 < found.tanks < 1e3:
        curves.append(("tanks in series", time[shown], tanks_in_series(found, time[shown])))
    return figures.lines_against(curves, "time in the mill, s", "E, 1/s")


def tanks_in_series(found: Residence, time: np.ndarray) -> np.ndarray:
    """E(t), 1/s, of tanks in series with the mean and variance of a Residence, at times (s)."""
    one = found.mean / found.tanks
    age = np.maximum(time, 1e-12 * found.mean)
    logs = (found.tanks - 1) * np.log(age / one) - age / one - gammaln(found.tanks) - np.log(one)
    return np.where(time > 0, np.exp(logs), 0.0)
