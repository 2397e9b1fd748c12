# SPDX-License-Identifier: GPL-3.0-or-later
"""What is read of a run: power, the torque on each part, the mean speed of the balls, and whether the run is steady.

All are means over the whole turns of the impeller at the run's end, with errors from the means of the turns."""
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from millfoam.files.data_files import read_csv, read_json
from millfoam.files.dumps import numbered_dumps, read_timestep
from millfoam.files.mill import Mill, read_mill
from millfoam.readings.batches import batch_means
from millfoam.readings.means import Mean, block_mean

from runs import Run

DRIFT = 0.02  # of a mean, by which the last turns may differ from the first ones
ERRORS = 3  # or as many standard errors


@dataclass(frozen=True)
class Numbers:
    """A complete run: its mill; number of balls; turns that are read, and the DEM time at which they begin, s;
    torques about +z on each part, N m; power of the drive, W; torque on all parts at rest over that of the impeller;
    mean speed of the balls, m/s; which of power and energies drift in these turns; and millDem's own verdict, which
    judges the whole run."""
    run: Run
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


def speeds_of(dumps: Path, begin: float) -> tuple[np.ndarray, np.ndarray]:
    """DEM times (s) of the dumps from `begin` on, and the mean speed of all balls at each (m/s)."""
    step = read_timestep(dumps)
    times, speeds = [], []
    for number, path in numbered_dumps(dumps):
        if number * step < begin * (1 - 1e-9):
            continue
        with open(path) as file:
            names = next(line for line in file if line.startswith("ITEM: ATOMS")).split()[2:]
            velocity = np.loadtxt(file, usecols=[names.index(name) for name in ("vx", "vy", "vz")], ndmin=2)
        times.append(number * step)
        speeds.append(np.linalg.norm(velocity, axis=1).mean())
    return np.array(times), np.array(speeds)


def drifts(means: np.ndarray) -> bool:
    """Whether the means of turns drift: those of the last half of the turns and of the first one differ by more than
    DRIFT of the mean, and by more than ERRORS standard errors. Of fewer than four turns the errors are not known."""
    half = len(means) // 2
    first, last = block_mean(means[:half]), block_mean(means[len(means) - half:])
    apart = last - first
    return abs(apart.value) > DRIFT * abs(means.mean()) and not abs(apart.value) <= ERRORS * apart.error


def read_numbers(run: Run, folder: Path) -> Numbers:
    """Numbers of a run in its folder. RuntimeError if it is not complete."""
    mill, results = read_mill(folder, "stirred"), read_json(folder / "dumps" / "results.json", "charge")
    end = float(mill.asked("dem", "duration"))
    if results["duration_s"] < end * (1 - 1e-6):
        raise RuntimeError(f"{folder}: the run ends at {results['duration_s']:.4g} s; expected {end:.4g} s")
    turns = int((end - float(mill.asked("averages", "start"))) / mill.turn + 0.005)  # times are rounded
    if turns < 1:
        raise RuntimeError(f"{folder}: averaged over less than a turn of the impeller, {mill.turn:.4g} s")
    begin = end - turns * mill.turn
    columns, energy = (read_csv(folder / "dumps" / name) for name in ("torques.csv", "energy.csv"))

    def by_turns(times: np.ndarray, values: np.ndarray) -> np.ndarray:
        return batch_means(times, values, begin, mill.turn, turns)

    def mean(values: np.ndarray) -> Mean:
        return block_mean(by_turns(columns["time_s"], values))
    parts = list(results["part_torques_Nm"])
    torques = {part: mean(columns[f"{part}_Nm"]) for part in parts}
    impeller = torques["impeller"]
    missing = mean(np.sum([columns[f"{part}_Nm"] for part in parts], axis=0))
    return Numbers(run, mill, results["balls"], turns, begin, torques,
                   Mean(-impeller.value * mill.omega, impeller.error * abs(mill.omega)),
                   Mean(1 - missing.value / impeller.value, abs(missing.error / impeller.value)),
                   block_mean(by_turns(*speeds_of(folder / "dumps", begin))),
                   tuple(name for name in ("power_W", "kinetic_J", "potential_J")
                         if drifts(by_turns(energy["time_s"], energy[name]))), results["steady"])
