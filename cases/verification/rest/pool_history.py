# SPDX-License-Identifier: GPL-3.0-or-later
"""Spurious speeds of a pool that should be at rest, read from a run's written times and kept in its folder."""
import math
from dataclasses import astuple, dataclass, fields

import numpy as np

from millfoam.files import foam
from millfoam.files.data_files import read_csv, write_csv


BED = 0.05  # solidity from which on slurry is between balls
STILL = 1e-6  # m/s: lower speeds are at rest, independent of their round-off


@dataclass(frozen=True)
class Run:
    """One run of the matrix: mesh, solver, surface tension in N/m, whether the mesh turns, whether balls rest in the
    middle of it, and whether slurry fills all of it."""
    mesh: str
    solver: str
    tension: float
    turning: bool
    bed: bool = False
    filled: bool = False

    @property
    def setting(self):
        """Setting that runs of different solvers share."""
        return (f"{self.mesh}, {'turning' if self.turning else 'static'}, sigma {self.tension:g}"
                f"{', bed' if self.bed else ''}{', full' if self.filled else ''}")

    @property
    def name(self):
        return (f"{self.mesh}_{'turning' if self.turning else 'static'}_{'sigma' if self.tension else 'free'}"
                f"{'_bed' if self.bed else ''}{'_full' if self.filled else ''}_{self.solver}")


@dataclass
class History:
    """The pool at the written times (s): largest speed of the air and of the slurry, the slurry's rms speed, the
    largest speed of slurry between balls (m/s), its volume (m3), how far its share leaves [0, 1], and the number of
    steps taken."""
    time: np.ndarray
    air: np.ndarray
    slurry: np.ndarray
    slurry_rms: np.ndarray
    bed: np.ndarray
    volume: np.ndarray
    excess: np.ndarray
    steps: np.ndarray

    def at(self, time):
        """Index of a written time, or None where the run did not reach it."""
        index = int(np.argmin(np.abs(self.time - time)))
        return index if abs(self.time[index] - time) < 1e-6 else None

    @property
    def volume_change(self):
        """Largest relative change of the slurry's volume, from the first time on at which it is known."""
        known = self.volume[np.isfinite(self.volume)]
        return np.abs(known / known[0] - 1).max()

    @property
    def growth(self):
        """The rms speed's mean over the last quarter of the run over its mean in the quarter that ends halfway (at
        least STILL)."""
        end = self.time[-1]
        late = self.slurry_rms[self.time > 0.75 * end - 1e-9].mean()
        early = self.slurry_rms[(self.time > 0.25 * end + 1e-9) & (self.time < 0.5 * end + 1e-9)].mean()
        return late / max(early, STILL)


def largest_speeds(case):
    """Time (s) and largest speed (m/s) of every step [steps, 2], as the function object wrote them."""
    lines = (case / "postProcessing" / "speeds" / "0" / "fieldMinMax.dat").read_text().splitlines()
    # time, field, smallest, where, largest, where
    columns = [line.split("\t") for line in lines if not line.startswith("#")]
    return np.array([[float(column[0]), float(column[4])] for column in columns])


def measure(case):
    """History of a run out of its fields; a time that holds values that are not finite ends it."""
    mesh = foam.read_mesh(case)
    _, volume = mesh.centres_and_volumes()
    stepped = largest_speeds(case)[:, 0]
    # Balls displace no slurry in interFoam
    displaced = (case / "constant" / "bedProperties").is_file()
    rows = []
    for time, folder in foam.times(case):
        try:
            alpha = foam.read_field(folder / "alpha.slurry", mesh.cells)
            speed = np.linalg.norm(foam.read_field(folder / "U", mesh.cells), axis=1)
        except foam.FoamError:
            break
        known = (folder / "solidity").is_file()  # not at the start
        solidity = foam.read_field(folder / "solidity", mesh.cells) if known else np.zeros(mesh.cells)
        slurry = alpha * (1 - solidity) * volume
        rows.append((time, speed[alpha < 0.5].max(initial=0), speed[alpha >= 0.5].max(),
                     math.sqrt((slurry * speed**2).sum() / slurry.sum()),
                     speed[(alpha >= 0.5) & (solidity > BED)].max(initial=0),
                     (slurry.sum() if known else math.nan) if displaced else (alpha * volume).sum(),
                     max(0.0, -alpha.min(), alpha.max() - 1), np.count_nonzero(stepped < time + 1e-9)))
    return History(*np.array(rows).T)


def write_history(history, case):
    names = [field.name for field in fields(History)]
    write_csv(case / "history.csv", [dict(zip(names, map(float, row))) for row in zip(*astuple(history))])


def read_history(case):
    """History that write_history wrote, or None if another version wrote it."""
    columns = read_csv(case / "history.csv")
    return History(**columns) if list(columns) == [field.name for field in fields(History)] else None
