# SPDX-License-Identifier: GPL-3.0-or-later
"""What is read of a dry run of a stirred mill: power, the torque on each part, the mean speed of the balls, and whether
the run is steady.

All are means over the whole turns of the impeller at the run's end, with errors from the means of the turns."""
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from millfoam.files.data_files import read_csv, read_json
from millfoam.files.mill import Mill, read_mill
from millfoam.files.stirred_case import StirredCase
from millfoam.readings.batches import batch_means, whole_turns
from millfoam.readings.means import Mean, block_mean
from millfoam.readings.stirred_power import mean_from, mean_speed, scaled

from .own_mill import require_own_mill

DRIFT = 0.02  # of a mean, by which the last turns may differ from the first ones
ERRORS = 3  # or as many standard errors
ROUNDED = 1e-3  # of a turn: a record is at a time that is rounded to steps


@dataclass(frozen=True)
class Numbers:
    """A complete run: its name; its mill; number of balls; turns that are read, and the DEM time at which they begin,
    s; torques about +z on each part, N m; power of the drive, W; torque on all parts at rest over that of the impeller;
    mean speed of the balls, m/s; which of power and energies drift in these turns; and millDem's own verdict, which
    judges the whole run."""
    name: str
    mill: Mill
    balls: int
    turns: int
    begin: float
    torques: dict[str, Mean]
    power: Mean
    at_rest: Mean
    speed: Mean
    drifting: tuple[str, ...]
    whole_steady: bool

    @property
    def volume(self) -> float:
        """Volume of the slurry of the published runs, which is that of the balls, m3."""
        return self.mill.derived("charge", "volume_m3")


def drifts(means: np.ndarray) -> bool:
    """Whether the means of turns drift: those of the last half of the turns and of the first one differ by more than
    DRIFT of the mean, and by more than ERRORS standard errors. Of fewer than four turns the errors are not known. A
    single turn cannot show that it does not drift: it counts as a drift."""
    if len(means) < 2:
        return True
    half = len(means) // 2
    first, last = block_mean(means[:half]), block_mean(means[len(means) - half:])
    apart = last - first
    return abs(apart.value) > DRIFT * abs(means.mean()) and not abs(apart.value) <= ERRORS * apart.error


def read_numbers(folder: Path) -> Numbers:
    """Numbers of a run in its folder, which has its name. RuntimeError if it is not complete, or of another mill."""
    mill, results = read_mill(folder, "stirred"), read_json(folder / "dumps" / "results.json", "charge")
    require_own_mill(StirredCase(folder))
    end = float(mill.asked("dem", "duration"))
    if results["duration_s"] < end * (1 - 1e-6):
        raise RuntimeError(f"{folder}: the run ends at {results['duration_s']:.4g} s; expected {end:.4g} s")
    turns = whole_turns(end - float(mill.asked("averages", "start")), mill.turn)
    if turns < 1:
        raise RuntimeError(f"{folder}: averaged over less than a turn of the impeller, {mill.turn:.4g} s")
    begin = end - turns * mill.turn
    since = begin - ROUNDED * mill.turn
    columns, energy = (read_csv(folder / "dumps" / name) for name in ("torques.csv", "energy.csv"))

    def mean(values: np.ndarray) -> Mean:
        return mean_from(columns["time_s"], values, since, mill.turn)
    parts = list(results["part_torques_Nm"])
    torques = {part: mean(columns[f"{part}_Nm"]) for part in parts}
    impeller = torques["impeller"]
    missing = mean(np.sum([columns[f"{part}_Nm"] for part in parts], axis=0))
    return Numbers(folder.name, mill, results["balls"], turns, begin, torques,
                   scaled(Mean(abs(impeller.value), impeller.error, impeller.freedom), abs(mill.omega)),
                   Mean(1 - missing.value / impeller.value, abs(missing.error / impeller.value), missing.freedom),
                   mean_speed(folder / "dumps", since, mill.turn),
                   tuple(name for name in ("power_W", "kinetic_J", "potential_J")
                         if drifts(batch_means(energy["time_s"], energy[name], begin, mill.turn, turns))),
                   results["steady"])


def read_all(root: Path, names: Iterable[str]) -> tuple[dict[str, Numbers], list[str]]:
    """Name -> Numbers of the complete runs among these, in their order, each in its folder in `root`; and why the
    others are not complete."""
    found, missing = {}, []
    for name in names:
        if not (root / name / "mill.json").is_file():
            missing.append(f"{name}: not begun")
            continue
        try:
            found[name] = read_numbers(root / name)
        except RuntimeError as error:
            missing.append(f"{name}: {error}")
    return found, missing
