# SPDX-License-Identifier: GPL-3.0-or-later
"""The numbers of one flow of the study."""
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from millfoam.files.data_files import read_json
from millfoam.files.mill_case import MillCase
from millfoam.files.slurry_file import SlurryMap
from millfoam.files.solids_file import SolidsMap
from millfoam.readings.batches import batch_means
from millfoam.readings.charge import circulation_centre
from millfoam.readings.means import Mean, block_mean, turns_mean
from millfoam.readings.slurry_conservation import feed_error, missing_share
from millfoam.readings.slurry_on_maps import axial_velocity
from millfoam.readings.slurry_over_time import mean_slurry, slurry_blocks
from millstudies.axial_slices import PRESSURES, Profile, Slices, pressure_drop, read_profile, read_slices
from millstudies.compared_runs import height
from millstudies.run_readings import RunReadings
from millstudies.statements import read

from runs import DIRECT, ITERATED, Run

TOP = 0.1  # share of the pixels with slurry, by height, that is the top of its shoulder
NEAR = 2  # pixels about the centre of circulation


class NotFinished(RuntimeError):
    """A run has not come to its end."""


@dataclass(frozen=True)
class Flow:
    """A flow: its Run, case and number of averaged turns; height of the slurry's centre (m), of all by slurryBalance
    and of that in front of the grates by axialProfiles (NaN without it); discharge (m3/s, by the outlet's own flux) and
    net rate of volume (m3/s); missing_share and feed_error of slurry_conservation (NaN without a feed); its Slices;
    Profile of the published slices, which reach over the pulp lifters, and of those in front of the grates; drops of
    the pressure by PRESSURES (Pa); what is read for published statements; map of the slurry; velocity along the axis at
    the top of the shoulder (m/s); slurry's share of the fluid at the charge's centre of circulation (NaN without
    balls)."""
    run: Run
    case: MillCase
    turns: int
    height: Mean
    chamber_height: Mean
    discharge: Mean
    net: Mean
    missing: float
    feed_error: float
    slices: Slices
    profile: Profile
    chamber: Profile
    drops: dict[str, Mean]
    readings: RunReadings
    slurry: SlurryMap
    top_velocity: Mean
    centre_share: Mean

    @property
    def holdup(self) -> tuple[float, float]:
        """Slurry in the mill at the first and at the last step, m3."""
        volumes = self.case.balance["holdUp"]
        return float(volumes[0]), float(volumes[-1])


def folders_of(root: Path, run: Run) -> list[Path]:
    """Folders of all flows of a run, the last of which has its results: `direct` of balls and slurry at the same time,
    and those of all passes of balls and slurry in turn. NotFinished if passes are to come."""
    folder = root / run.name
    if DIRECT in run.changes:
        return [folder / "direct"]
    if ITERATED not in run.changes:
        return [folder]
    if not (folder / "coupling.json").is_file():
        raise NotFinished("no pass of balls that feel the slurry is complete" if folder.is_dir() else "not begun")
    coupling = read_json(folder / "coupling.json", "coupling")
    if not coupling["settled"] and coupling["passes"] < coupling["most_passes"]:
        raise NotFinished(f"pass {coupling['passes']} of at most {coupling['most_passes']} changed the results")
    return [folder / name for name in coupling["folders"]]


def over_turns(case: MillCase, column: str, turns: int) -> Mean:
    """Mean of a column of slurryBalance over a MillCase's last whole turns."""
    columns = case.balance
    return turns_mean(batch_means(columns["Time"], columns[column], case.last - turns * case.turn, case.turn, turns))


def net_rate(case: MillCase, turns: int) -> Mean:
    """Growth of the hold-up over each of the last turns, m3/s."""
    columns = case.balance
    ends = case.last - case.turn * np.arange(turns, -1, -1)
    return block_mean(np.diff(np.interp(ends, columns["Time"], columns["holdUp"])) / case.turn)


def top_velocity(slurry: SlurryMap) -> float:
    """Mean velocity along the axis (m/s) of a SlurryMap's slurry, weighted by its volume, in the highest TOP of its
    pixels on the rising side, where its share is above a half; NaN without slurry."""
    velocity = axial_velocity(slurry)
    x, y = np.meshgrid(*slurry.centres())
    # The rising side is the left one of a mill that turns clockwise
    chosen = np.isfinite(velocity) & (x * slurry.sense > 0)
    if not chosen.any():
        return np.nan
    lowest = np.quantile(y[chosen], 1 - TOP)
    top = chosen & (y >= lowest)
    return float(np.average(velocity[top], weights=slurry.filled()[top]))


def share_at_centre(charge: SolidsMap, radius: float, maps: Sequence[SlurryMap]) -> Mean:
    """Mean share of slurry in the fluid about a charge's centre of circulation, over SlurryMap of blocks of time."""
    centre = circulation_centre(charge, radius)
    column, row = (int(np.argmin(np.abs(at - place))) for at, place in zip(maps[0].centres(), centre))
    about = np.s_[row - NEAR:row + NEAR + 1, column - NEAR:column + NEAR + 1]
    return block_mean([np.nanmean(one.share[about]) for one in maps])


def read_flow(run: Run, folder: Path) -> Flow:
    """Flow of a run's folder. NotFinished if it is not complete, RuntimeError if a reading fails."""
    case = MillCase(folder)
    if case.flow is None or case.is_cut_short:
        last = 0 if case.flow is None else case.last
        raise NotFinished(f"the flow ends at {last:.3g} s; expected {case.mill.flow('duration_s', np.nan):.3g} s")
    if case.balance is None:
        raise RuntimeError("no table of slurryBalance; expected one in postProcessing")
    if run.law and case.solids is None:
        raise NotFinished("; ".join(["no averages of its balls; expected solids.h5", *case.unusable]))
    slices, blocks = read_slices(case), list(slurry_blocks(case))
    humps = 3 if run.law else 2
    turns, slurry, columns, readings = len(slices.holdup), mean_slurry(case, blocks), case.balance, read(case)
    return Flow(run, case, turns, over_turns(case, "y", turns),
                height(readings) if readings.series else Mean(np.nan, np.nan),
                over_turns(case, "discharge", turns), net_rate(case, turns),
                missing_share(columns), feed_error(columns, case.feed) if case.feed else np.nan,
                slices, read_profile(slices, humps), read_profile(slices, humps, case.length),
                {name: pressure_drop(slices, name, case.length) for name in PRESSURES}, readings, slurry,
                block_mean([top_velocity(one) for one in blocks]),
                share_at_centre(case.charge, case.radius, blocks) if run.law else Mean(np.nan, np.nan))
