# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether the averaged flow drifts: its second half compared with its first, its discharge with its feed, and its feed
with its hold-up."""
from dataclasses import dataclass

import numpy as np

from ..files.mill_case import MillCase
from ..readings.batches import batch_means, batches_of, error_about_line
from ..readings.means import Mean, time_steps
from .verdict import Check, judged
from .words import decimals

NAME = "The flow is steady"
ADVICE = "Run longer (flow.duration), or begin the averages later (--begin)."
DRIFT = 3.0  # standard errors up to which a difference may be by chance


@dataclass(frozen=True)
class Limits:
    """Shares of a scale. small: a difference up to it does not matter; large: if DRIFT standard errors are more, it is
    undecided whether there is a difference, because one that matters would not be seen."""
    small: float
    large: float


# large: of the hold-up twice what does not matter, up to which a drift is doubtful. Centre and torque scatter more: the
# slurry of a closed mill that is steady swings by several percent of the radius, and 5 % is the limit of the torques'
# balance, too (flow_checks). A discharge that is 5 % off changes the steady hold-up of the 30 cm mill by 1 to 3 %, by
# dV/dQ of trials
OF_HOLDUP, OF_CENTRE = Limits(0.01, 0.02), Limits(0.01, 0.05)
OF_TORQUE, OF_FEED = Limits(0.01, 0.05), Limits(0.02, 0.05)
LIMITS = {"holdUp": OF_HOLDUP, "torque_impeller": OF_TORQUE}  # of the others OF_CENTRE
WORDS = {"holdUp": "hold-up", "x": "centre's x", "y": "centre's y", "z": "centre's height",
         "torque_impeller": "torque of the impeller"}
# Columns of slurryBalance that must be steady, their units and scales, by machine
QUANTITIES = {"tumbling": (("holdUp", "ml", 1e6), ("x", "mm", 1e3), ("y", "mm", 1e3)),
              "stirred": (("holdUp", "ml", 1e6), ("z", "mm", 1e3), ("torque_impeller", "mN m", 1e3))}


@dataclass(frozen=True)
class Difference:
    """A difference that is small in a steady flow, with its standard error (NaN: not known) and the Limits of both, as
    shares of the same scale; name: in words, with what the scale is; text: the difference in words."""
    name: str
    value: float
    error: float
    limits: Limits
    text: str

    @property
    def over_limit(self) -> float:
        """Its size over DRIFT standard errors, or over what does not matter if that is more."""
        return float(abs(self.value) / np.fmax(self.error * DRIFT, self.limits.small))

    @property
    def undecided(self) -> str:
        """Why its error is too large to see a difference that matters, in words; otherwise empty."""
        reach = DRIFT * self.error
        return (f"{DRIFT:g} standard errors of {self.name} are {100 * reach:.2g} %, more than "
                f"{100 * self.limits.large:g} %" if reach > self.limits.large else "")


def course_of(middles: np.ndarray, in_turn: int, turn: float) -> np.ndarray:
    """Columns [n, …] of a linear model of batches around times [n] (s): a straight line and, of several batches in a
    turn of `turn` s, as many harmonics of the turn as they show."""
    angles = 2 * np.pi / turn * np.outer(middles, np.arange(1, in_turn // 2 + 1))
    return np.column_stack([np.ones(len(middles)), middles / middles.max(), np.cos(angles), np.sin(angles)])


def halves(times: np.ndarray, values: np.ndarray, begin: float, turn: float) -> Mean:
    """Difference of the means of two halves from `begin` (s) on, with its standard error from the batches of
    batches_of.

    The error comes from the batches' differences from their course (course_of), so that neither a drift nor what comes
    back with every turn increases it: halves of whole turns have the same of the latter. If the middle is left out,
    both are scaled to halves of the whole time, so that a drift counts the same for any number of turns."""
    chosen = times > begin + 1e-9 * turn
    # A value is that of the time since the one before
    start = (times - time_steps(times))[chosen][0]
    times, values = times[chosen], values[chosen]
    span = times[-1] - start
    length, half = batches_of(span, turn)
    first, last = (batch_means(times, values, begins, length, half) for begins in (start, times[-1] - half * length))
    batches = np.concatenate([first, last])
    if not np.isfinite(batches).all():
        return Mean(np.nan, np.nan)
    apart = span - half * length  # between the halves' middles
    middles = length * (np.arange(2 * half) % half) + apart * (np.arange(2 * half) >= half)
    model = course_of(middles, int(round(turn / length)) if half * length > 0.99 * turn else 0, turn)
    apart_from = batches - model @ np.linalg.lstsq(model, batches, rcond=None)[0]
    freedom = 2 * half - int(np.linalg.matrix_rank(model))
    error = np.sqrt(np.sum(apart_from**2) / freedom * 2 / half)
    scale = span / 2 / apart
    return Mean(float(scale * (last.mean() - first.mean())), float(scale * error), freedom)


def difference_with_error(value: float, error: float) -> str:
    """A difference with as many digits as its error allows, at most three after the point; alone if its error is
    not known."""
    if not np.isfinite(error):
        return f"{value:+.3g}"
    digits = min(decimals(error), 3) if error > 0 else 3
    return f"{value:+.{digits}f} ± {error:.{digits}f}"


def discharge_gap(columns: dict[str, np.ndarray], begin: float, turn: float) -> tuple[float, float]:
    """Slurry that does not leave, over the feed, from `begin` (s) on, and its standard error over whole turns, which a
    drift of the discharge does not increase; NaN if nothing was fed."""
    times = columns["Time"]
    late = times >= begin
    fed, gone = (columns[key][late][-1] - columns[key][late][0] for key in ("fed", "discharged"))
    if not fed > 0:
        return np.nan, np.nan
    rate = fed / (times[late][-1] - times[late][0])
    return 1 - gone / fed, error_about_line(times, columns["discharge"], begin, turn) / rate


def drifts(columns: dict[str, np.ndarray], begin: float, turn: float, radius: float,
           machine: str) -> list[Difference]:
    """Difference of each of the machine's QUANTITIES between the halves of the time from `begin` (s) on."""
    found = []
    for key, unit, scale in QUANTITIES[machine]:
        apart = halves(columns["Time"], columns[key], begin, turn)
        difference, error = apart.value, apart.error
        whole = radius if key in "xyz" else abs(columns[key][columns["Time"] >= begin].mean())
        of_what = f"{WORDS[key]} over the radius" if key in "xyz" else f"the {WORDS[key]}"
        text = f"{difference_with_error(scale * difference, scale * error)} {unit}"
        found.append(Difference(of_what, difference / whole, error / whole, LIMITS.get(key, OF_CENTRE),
                                f"{WORDS[key]} {text if np.isfinite(difference) else 'not known'}"))
    return found


def gap_of_feed(columns: dict[str, np.ndarray], begin: float, turn: float) -> Difference:
    """Difference of feed and discharge from `begin` (s) on, over the feed."""
    share, error = discharge_gap(columns, begin, turn)
    text = f"feed minus discharge is {difference_with_error(100 * share, 100 * error)} % of the feed"
    if share < 0:
        text += f" (discharges {1 - share:.3g} times its feed)"
    return Difference("feed less discharge over the feed", share, error, OF_FEED,
                      text if np.isfinite(share) else "nothing was fed in this time")


def judge_steadiness(columns: dict[str, np.ndarray], begin: float, turn: float, radius: float, feed: float,
                     machine: str = "tumbling") -> Check:
    """Whether hold-up and centre of the slurry, of a stirred mill also the torque of its impeller, agree between the
    two halves of the time from `begin` (s) on, and whether, with a feed (m3/s), as much slurry leaves as enters and the
    feed has replaced the slurry once since the flow's start. It is doubtful and undecided if they agree only because
    errors are large. columns: of slurryBalance; turn: of the mill, its time in s; radius: of the mill, m; machine: a
    key of QUANTITIES."""
    turns, held = (columns["Time"][-1] - begin) / turn, columns["holdUp"][columns["Time"] >= begin].mean()
    when = f"from {begin:g} s on ({turns:.2g} turns)"
    if not held > 0:
        return Check(NAME, "fails", f"{when} there is no slurry in the mill", ADVICE)
    found = drifts(columns, begin, turn, radius, machine)
    words = ", ".join(one.text for one in found)
    own = ", of the radius and of the torque" if machine == "stirred" else " and of the radius"
    limits = f"limit {DRIFT:g} standard errors, or {100 * OF_HOLDUP.small:g} % of the hold-up{own}"
    over = [one.over_limit for one in found]
    if feed > 0:
        gap = gap_of_feed(columns, begin, turn)
        found.append(gap)
        fed = columns["fed"][-1]
        # Slurry needs the time in which it is replaced to find its place along the axis. Alone this is only a doubt
        over += [gap.over_limit, held / max(fed, held / 2)]
        words += f"; {gap.text}; so far the feed has replaced the slurry {fed / held:.2g} times"
        limits += f", or {100 * OF_FEED.small:g} % of the feed; the slurry replaced once"
    undecided = [one.undecided for one in found if one.undecided]
    text = (f"{when}, second half minus first: {words} ({limits})"
            + "".join(f"; undecided: {why}" for why in undecided))
    check = judged(NAME, float(np.max(over)), 1, text, ADVICE, doubtful=2)
    if undecided and check.state == "holds":
        return Check(NAME, "look", text, "Run longer (flow.duration): more turns have smaller errors.", undecided=True)
    return check


def flow_steadiness(case: MillCase) -> Check:
    """judge_steadiness of the averaged time of a MillCase."""
    columns = case.balance
    if columns is None or (columns["Time"] >= case.begin).sum() < 20:
        return Check(NAME, "unknown", "the time series of slurryBalance is missing or too short",
                     "Add slurryBalance to controlDict, or run longer.")
    return judge_steadiness(columns, case.begin, case.turn, case.radius, case.mill.flow("feed_m3_s", 0.0),
                            case.machine)
