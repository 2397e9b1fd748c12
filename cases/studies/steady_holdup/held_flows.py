# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the runs of steady_holdup: flows that came to their end, trials, flows with a tracer, and what of the mill each
has changed."""
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TypeVar

import numpy as np

from millfoam.files.mill import Mill
from millfoam.files.mill_case import MillCase
from millfoam.readings.batches import batch_means, mean_over_turns, whole_turns
from millfoam.readings.means import Mean, mean_variance, time_mean, turns_mean
from millfoam.readings.residence import Residence, read_tracer, residence
from millstudies.own_mill import require_own_mill

MESHES = ("coarse", "own")
STARTS = ("low", "high")  # ends of names of flows with less or more slurry at the start
Found = TypeVar("Found")


@dataclass(frozen=True, order=True)
class Kind:
    """What trials and flows of a mesh share: speed (% of critical), whether they have balls, and the name of what is
    changed in the mill, or nothing."""
    speed: int
    balls: bool
    change: str = ""

    def __str__(self) -> str:
        words = f"{self.speed} %, {'with' if self.balls else 'without'} balls"
        return f"{words}, {self.change}" if self.change else words


def kind_of(case: MillCase, change: str) -> Kind:
    """Kind of a case with this change in its mill."""
    return Kind(round(100 * case.mill.critical_share), bool(case.law), change)


def change_of_flow(name: str) -> str:
    """Change of the mill of a flow BALLS_SPEED_FEED_CHANGE; nothing in other names, among them those of flows from
    other STARTS."""
    change = "_".join(name.split("_")[3:])
    return "" if change in STARTS else change


def change_of_trial(name: str) -> str:
    """Change of the mill of a trial BALLS_SPEED_CHANGE_START; nothing in BALLS_SPEED_START."""
    return "_".join(name.split("_")[2:-1])


@dataclass(frozen=True)
class HoldUps:
    """Of the mill with its pulp lifters, and of what lies in front of the grates (m3)."""
    whole: Mean
    chamber: Mean


@dataclass(frozen=True)
class Held:
    """A flow that came to its end: mesh; name; its mill and case; feed (m3/s); number of its late turns, and over them:
    hold-up of the mill with its pulp lifters (m3), and of what lies in front of the grates (m3), discharge (m3/s),
    height of the slurry's centre (m); flow time of the end (s); why it ended; the verdict in words; steady hold-ups, at
    which the discharge is the feed, if trials show them."""
    mesh: str
    name: str
    case: MillCase
    feed: float
    turns: int
    whole: Mean
    chamber: Mean
    discharge: Mean
    height: Mean
    end: float
    reason: str
    found: str
    steady: HoldUps | None = None

    @property
    def mill(self) -> Mill:
        return self.case.mill

    @property
    def kind(self) -> Kind:
        """By its case, and its change by its name."""
        return kind_of(self.case, change_of_flow(self.name))

    @property
    def is_base(self) -> bool:
        """Whether its mill is not changed and it has no other start."""
        return not self.name.endswith(STARTS) and not self.kind.change

    @property
    def ended_steady(self) -> bool:
        """Whether it ended because it was steady, not at its duration or after its hours."""
        return self.reason == "steady"

    @property
    def measured(self) -> HoldUps:
        """Over the late turns."""
        return HoldUps(self.whole, self.chamber)

    def of_turns(self, column: str) -> np.ndarray:
        """Means of a column of slurryBalance over each of the late turns [turns]."""
        return self._over_turns(self.case.balance["Time"], self.case.balance[column])

    @property
    def chamber_of_turns(self) -> np.ndarray:
        """Hold-up in front of the grates in each of the late turns [turns], m3."""
        _, moments, slices = axial_holdup(self.case)
        return self._over_turns(moments, slices.sum(axis=1))

    def _over_turns(self, times: np.ndarray, values: np.ndarray) -> np.ndarray:
        turn = self.case.turn
        return batch_means(times, values, self.end - self.turns * turn, turn, self.turns)

    @property
    def holdups(self) -> HoldUps:
        """The steady ones or, without trials, those over the late turns."""
        return self.steady or self.measured


def case_with_flow(folder: Path) -> MillCase:
    """Case of a folder. RuntimeError if it has no flow or no table of slurryBalance, or results of another mill."""
    case = MillCase(folder)
    if case.flow is None or case.balance is None:
        raise RuntimeError("; ".join(["no flow or no table of slurryBalance", *case.unusable]))
    require_own_mill(case)
    return case


def complete_case(folder: Path) -> MillCase:
    """Case of a folder whose flow came to the end that was asked for. RuntimeError if it is not complete."""
    case = case_with_flow(folder)
    if not case.record.complete:
        raise RuntimeError("the flow is not complete")
    return case


def axial_holdup(case: MillCase) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """z (m) of the slices in front of the grates, times (s) and hold-up (m3) [times, slices] of a case. RuntimeError if
    it has no such table."""
    found = case.axial("holdUp")
    if found is None:
        raise RuntimeError("; ".join(["no table of axialProfiles", *case.unusable]))
    return found


def late_turns(judged: float, end: float, turn: float) -> int:
    """Number of the late turns of a flow that ends at flow time `end` (s), of which the time `judged` (s) was judged:
    the whole turns of its last half, or those that were judged if they are more; one at least. turn: time of one, s."""
    return max(whole_turns(max(judged, end / 2), turn), 1)


def read_held(mesh: str, folder: Path) -> Held:
    """Held of a folder. RuntimeError if its flow has not come to its end."""
    if not (folder / "steady.json").is_file():
        raise RuntimeError("the flow has not come to its end")
    case = case_with_flow(folder)
    ended = case.own_end
    if ended is None:
        raise RuntimeError("; ".join(["the flow of mill.json has not come to its end: steady.json belongs to "
                                      "another one", *case.unusable]))
    turns = late_turns(ended["end_s"] - ended["begin_s"], ended["end_s"], case.turn)
    begin = ended["end_s"] - turns * case.turn

    def over_turns(times: np.ndarray, values: np.ndarray) -> Mean:
        return turns_mean(batch_means(times, values, begin, case.turn, turns))
    columns = case.balance
    _, moments, slices = axial_holdup(case)
    return Held(mesh, folder.name, case, case.feed or 0.0, turns, over_turns(columns["Time"], columns["holdUp"]),
                over_turns(moments, slices.sum(axis=1)), over_turns(columns["Time"], columns["discharge"]),
                over_turns(columns["Time"], columns["y"]), ended["end_s"], ended["reason"], ended["found"])


@dataclass(frozen=True)
class Trial:
    """A short flow: its kind; means over the last half of its time: hold-up of the mill with its pulp lifters (m3), and
    of what lies in front of the grates (m3); discharge (m3/s), with its error over whole turns."""
    kind: Kind
    volume: float
    chamber: float
    discharge: Mean


def read_trial(folder: Path) -> Trial:
    """Trial of a folder. RuntimeError if it is not complete."""
    case = complete_case(folder)
    columns = case.balance
    times = columns["Time"]
    begin = times[-1] / 2
    of_turns = mean_over_turns(times, columns["discharge"], begin, case.turn) or Mean(np.nan, np.nan)
    discharge = replace(of_turns, value=time_mean(times, columns["discharge"], begin))
    _, moments, slices = axial_holdup(case)
    return Trial(kind_of(case, change_of_trial(folder.name)), time_mean(times, columns["holdUp"], begin),
                 time_mean(moments, slices.sum(axis=1), begin), discharge)


@dataclass(frozen=True)
class Stay:
    """A flow with a tracer in its feed: name; how long slurry stays; hold-up over feed (s) from the tracer's begin
    on; smallest and largest concentration, over that of the inlet."""
    name: str
    found: Residence
    expected: float
    lowest: float
    highest: float


def read_stay(folder: Path) -> Stay:
    """Stay of a folder. RuntimeError if its flow or its tracer's table is not complete."""
    case = complete_case(folder)
    table, columns = read_tracer(folder), case.balance
    held, fed = (time_mean(columns["Time"], columns[name], table.begin) for name in ("holdUp", "feed"))
    return Stay(folder.name, residence(table), held / fed, table.lowest, table.highest)


def expected_volume(feed: float, trials: Sequence[Trial]) -> float:
    """Hold-up (m3) at which the discharge is the feed (m3/s), by the straight line through two trials, limited to 0.2
    to 1.5 of the larger trial's hold-up. If less slurry does not discharge less, the mean of both."""
    less, more = sorted(trials, key=lambda one: one.volume)
    slope = (more.discharge.value - less.discharge.value) / (more.volume - less.volume)
    if not slope > 0:
        return (less.volume + more.volume) / 2
    volume = more.volume + (feed - more.discharge.value) / slope
    return float(np.clip(volume, 0.2 * more.volume, 1.5 * more.volume))


def trials_of(one: Held, trials: Sequence[Trial]) -> tuple[Trial, Trial] | None:
    """The two trials of a flow's kind, which are on coarse cells, the one with less slurry first. None without them, or
    if they do not show, with 95 % confidence (Mean.sign), that more slurry discharges more."""
    pair = sorted((trial for trial in trials if trial.kind == one.kind), key=lambda trial: trial.volume)
    if len(pair) != 2:
        return None
    return (pair[0], pair[1]) if (pair[1].discharge - pair[0].discharge).sign > 0 else None


def relaxation(one: Held, trials: Sequence[Trial]) -> float | None:
    """Time dV/dQ (s), by the line through trials_of a flow, in which a difference from its steady hold-up falls to
    37 %; None without these trials."""
    pair = trials_of(one, trials)
    return (pair[1].volume - pair[0].volume) / (pair[1].discharge - pair[0].discharge).value if pair else None


def with_relaxation(one: Held, trials: Sequence[Trial]) -> Held:
    """A flow whose errors of hold-ups allow for neighbouring turns that are at least as alike as their relaxation time
    t makes them: turns of T s have the correlation exp(-T/t) or more. Few late turns do not show it. Without it, for t
    of 16 to 30 turns, errors over 12 turns are 2 to 2.6 times too small, and over 48 up to 1.25 times. Without
    trials_of it the flow itself."""
    back = relaxation(one, trials)
    if back is None:
        return one
    least = float(np.exp(-one.case.turn / back))
    return replace(one, whole=turns_mean(one.of_turns("holdUp"), least),
                   chamber=turns_mean(one.chamber_of_turns, least))


def at_feed(one: Held, trials: Sequence[Trial]) -> HoldUps | None:
    """Hold-ups of a flow, moved along the straight line through trials_of it to where its discharge is its feed. The
    errors are from those of hold-up, discharge and slope, with their degrees of freedom. They are upper limits: where a
    flow discharges less by chance, it holds more, and the line takes this back. For 12 to 48 turns and dV/dQ of 16 to
    30 turns they are 1.2 to 1.45 times the deviations if discharges of turns are independent or alike (correlation
    0.4), and 1.6 to 1.85 times if they alternate (-0.3). None without these trials."""
    pair = trials_of(one, trials)
    if pair is None:
        return None
    less, more = pair
    gain, lacking = more.discharge - less.discharge, Mean(one.feed) - one.discharge

    def moved(held: Mean, way: float) -> Mean:
        of_lack = way / gain.value
        way_to_go = of_lack * lacking.value
        return (held + Mean(way_to_go, abs(of_lack) * lacking.error, lacking.freedom)
                + Mean(0.0, abs(way_to_go / gain.value) * gain.error, gain.freedom))
    return HoldUps(moved(one.whole, more.volume - less.volume), moved(one.chamber, more.chamber - less.chamber))


@dataclass(frozen=True)
class Scatter:
    """Standard deviations of the means of single late turns: of the discharge (m3/s) and of the hold-up (m3); and the
    hold-up's (m3) that follows from the discharge's if the discharges of turns are independent."""
    discharge: float
    holdup: float
    expected: float


def scatter(one: Held, trials: Sequence[Trial]) -> Scatter | None:
    """Scatter of a flow of two late turns or more; None without trials_of it.

    The hold-up V is the sum of the differences between feed and discharge Q. A difference from its steady value falls
    to 37 % within the time t = dV/dQ of the trials. If the discharges of turns of T s are independent, the variance of
    V is var(Q) T t/2, and neighbouring turns have the correlation exp(-T/t) (Uhlenbeck & Ornstein 1930, Phys. Rev.
    36:823). That of n turns about their own mean is less by the variance of this mean."""
    back = relaxation(one, trials)
    if back is None:
        return None
    discharge, holdup = (float(one.of_turns(name).std(ddof=1)) for name in ("discharge", "holdUp"))
    own_mean = mean_variance(float(np.exp(-one.case.turn / back)), one.turns)
    variance = one.case.turn * back / 2 * (1 - own_mean) * one.turns / (one.turns - 1)
    return Scatter(discharge, holdup, discharge * float(np.sqrt(variance)))


def named(folder: Path, read: Callable[[Path], Found]) -> Found:
    """What `read` finds in a folder. RuntimeError with the folder's name if it finds nothing."""
    try:
        return read(folder)
    except (RuntimeError, OSError) as error:
        raise RuntimeError(f"{folder.parent.name}/{folder.name}: {error}") from None


def read_each(folders: Sequence[Path], read: Callable[[Path], Found]) -> tuple[list[Found], list[str]]:
    """What `read` finds in each folder that is complete, and why the others are not."""
    found, missing = [], []
    for folder in folders:
        try:
            found.append(named(folder, read))
        except RuntimeError as error:
            missing.append(str(error))
    return found, missing


def read_trials(root: Path) -> tuple[list[Trial], list[str]]:
    """All complete trials of the study's runs, and why the others are not."""
    return read_each(sorted((root / "trial").glob("*")), read_trial)


def read_all(root: Path) -> tuple[list[Held], list[Trial], list[Stay], list[str]]:
    """Held of all complete flows, all complete trials, flows with a tracer, and why the others are not."""
    flows = [folder for mesh in MESHES for folder in sorted((root / mesh).glob("*"))]
    held, not_ended = read_each(flows, lambda folder: read_held(folder.parent.name, folder))
    trials, not_complete = read_trials(root)
    held = [with_relaxation(one, trials) for one in held]
    held = [replace(one, steady=at_feed(one, trials)) for one in held]
    stays, not_known = read_each(sorted((root / "residence").glob("*")), read_stay)
    return held, trials, stays, not_ended + not_complete + not_known


def by_groups(found: Sequence[Held]) -> dict[tuple[str, Kind], list[Held]]:
    """Mesh and kind -> flows in order of their feed, without those from other starts or of changed mills."""
    groups: dict[tuple[str, Kind], list[Held]] = {}
    for one in sorted(found, key=lambda one: one.feed):
        if one.is_base:
            groups.setdefault((one.mesh, one.kind), []).append(one)
    return groups
