# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether the averaged flow drifts: its second half compared with its first, its discharge with its feed, and its feed
with its hold-up."""
import numpy as np

from ..files.mill_case import MillCase
from ..readings.batches import batch_means, batches_of, error_about_line
from .verdict import Check, judged
from .words import decimals

NAME = "The flow is steady"
GAP = 0.02  # of the feed that may stay in the mill
DRIFT = 3.0  # standard errors between the two halves of the averages
WORDS = {"holdUp": "hold-up", "x": "centre's x", "y": "centre's y", "z": "centre's height",
         "torque_impeller": "torque of the impeller"}
# Columns of slurryBalance that must be steady, their units and scales, by machine
QUANTITIES = {"tumbling": (("holdUp", "ml", 1e6), ("x", "mm", 1e3), ("y", "mm", 1e3)),
              "stirred": (("holdUp", "ml", 1e6), ("z", "mm", 1e3), ("torque_impeller", "mN m", 1e3))}


def halves(times: np.ndarray, values: np.ndarray, begin: float, turn: float) -> tuple[float, float]:
    """Difference of the means of two halves from `begin` (s) on, and its standard error from the batches of
    batches_of.

    The error comes from the batches' differences from a straight line, so that a drift does not increase it. If the
    middle is left out, both are scaled to halves of the whole time, so that a drift counts the same for any number of
    turns."""
    chosen = times >= begin
    times, values = times[chosen], values[chosen]
    span = times[-1] - times[0]
    length, half = batches_of(span, turn)
    first, last = (batch_means(times, values, start, length, half) for start in (times[0], times[-1] - half * length))
    batches = np.concatenate([first, last])
    if not np.isfinite(batches).all():
        return np.nan, np.nan
    apart = span - half * length  # between the halves' middles
    middles = length * (np.arange(2 * half) % half) + apart * (np.arange(2 * half) >= half)
    straight = np.polyval(np.polyfit(middles, batches, 1), middles)
    error = np.sqrt(np.sum((batches - straight) ** 2) / (2 * half - 2) * 2 / half)
    scale = span / 2 / apart
    return scale * (last.mean() - first.mean()), scale * error


def difference_with_error(value: float, error: float) -> str:
    """A difference with as many digits as its error allows, at most three after the point; alone if its error is
    not known."""
    if not np.isfinite(error):
        return f"{value:+.3g}"
    digits = min(decimals(error), 3) if error > 0 else 3
    return f"{value:+.{digits}f} ± {error:.{digits}f}"


def discharge_gap(columns: dict[str, np.ndarray], begin: float, turn: float) -> tuple[float, float]:
    """Slurry that does not leave, over the feed, from `begin` (s) on, and its standard error over whole turns, which a
    drift of the discharge does not increase."""
    times = columns["Time"]
    late = times >= begin
    fed, gone = (columns[key][late][-1] - columns[key][late][0] for key in ("fed", "discharged"))
    rate = fed / (times[late][-1] - times[late][0])
    return 1 - gone / fed, error_about_line(times, columns["discharge"], begin, turn) / rate


def judge_steadiness(columns: dict[str, np.ndarray], begin: float, turn: float, radius: float, feed: float,
                     machine: str = "tumbling") -> Check:
    """Whether hold-up and centre of the slurry, of a stirred mill also the torque of its impeller, agree between the
    two halves of the time from `begin` (s) on, and whether, with a feed (m3/s), as much slurry leaves as enters and the
    feed has replaced the slurry once since the flow's start. columns: of slurryBalance; turn: of the mill, its time in
    s; radius: of the mill, m; machine: a key of QUANTITIES."""
    drifts, words = [], []
    for key, unit, scale in QUANTITIES[machine]:
        difference, error = halves(columns["Time"], columns[key], begin, turn)
        # A drift below 1 % of the hold-up, of the radius or of the torque does not matter
        floor = 0.01 * (radius if key in "xyz" else abs(columns[key][columns["Time"] >= begin].mean()))
        drifts.append(abs(difference) / np.maximum(error * DRIFT, floor))
        words.append(f"{WORDS[key]} {difference_with_error(scale * difference, scale * error)} {unit}")
    own = ", of the radius and of the torque" if machine == "stirred" else " and of the radius"
    limits = f"limit {DRIFT:g} standard errors, or 1 % of the hold-up{own}"
    gap = ""
    if feed > 0:
        share, error = discharge_gap(columns, begin, turn)
        drifts.append(abs(share) / np.fmax(error * DRIFT, GAP))
        held, fed = columns["holdUp"][columns["Time"] >= begin].mean(), columns["fed"][-1]
        # Slurry needs the time in which it is replaced to find its place along the axis. Alone this is only a doubt
        drifts.append(held / max(fed, held / 2))
        gap = (f"; {difference_with_error(100 * share, 100 * error)} % of the feed stays; so far the feed has replaced "
               f"the slurry {fed / held:.2g} times")
        limits += f", or {100 * GAP:g} % of the feed; the slurry replaced once"
    turns = (columns["Time"][-1] - begin) / turn
    return judged(NAME, np.max(drifts), 1, f"from {begin:g} s on ({turns:.2g} turns), second half minus first: "
                  + ", ".join(words) + f"{gap} ({limits})",
                  "Run longer (flow.duration), or begin the averages later (--begin).", doubtful=2)


def flow_steadiness(case: MillCase) -> Check:
    """judge_steadiness of the averaged time of a MillCase."""
    columns = case.balance
    if columns is None or (columns["Time"] >= case.begin).sum() < 20:
        return Check(NAME, "unknown", "the time series of slurryBalance is missing or too short",
                     "Add slurryBalance to controlDict, or run longer.")
    return judge_steadiness(columns, case.begin, case.turn, case.radius, case.mill.flow("feed_m3_s", 0.0),
                            case.machine)
