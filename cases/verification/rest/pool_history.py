# SPDX-License-Identifier: GPL-3.0-or-later
"""Spurious speeds of a pool that should be at rest, read from a run's written times and kept beside it."""
import csv
import math
import re
from dataclasses import astuple, dataclass, fields

import numpy as np

from millfoam import foam


STILL = 1e-6  # m/s: what moves less is at rest, however its round-off develops


@dataclass(frozen=True)
class Run:
    """One run of the matrix: mesh, solver, surface tension in N/m, and whether the mesh turns."""
    mesh: str
    solver: str
    tension: float
    turning: bool

    @property
    def setting(self):
        """What runs of different solvers have in common."""
        return f"{self.mesh}, {'turning' if self.turning else 'static'}, sigma {self.tension:g}"

    @property
    def name(self):
        return f"{self.mesh}_{'turning' if self.turning else 'static'}_{'sigma' if self.tension else 'free'}_{self.solver}"


@dataclass
class History:
    """The pool at the written times (s): largest speed of the air and of the slurry, the slurry's rms speed (m/s), its
    volume (m3), how far its share leaves [0, 1], and the number of steps taken."""
    time: np.ndarray
    air: np.ndarray
    slurry: np.ndarray
    slurry_rms: np.ndarray
    volume: np.ndarray
    excess: np.ndarray
    steps: np.ndarray

    def at(self, time):
        """Index of a written time, or None where the run did not reach it."""
        index = int(np.argmin(np.abs(self.time - time)))
        return index if abs(self.time[index] - time) < 1e-6 else None

    @property
    def volume_change(self):
        """Largest relative change of the slurry's volume."""
        return np.abs(self.volume / self.volume[0] - 1).max()

    @property
    def growth(self):
        """The rms speed's mean over the last quarter of the run over its mean in the quarter that ends halfway (at least
        STILL)."""
        end = self.time[-1]
        late = self.slurry_rms[self.time > 0.75 * end - 1e-9].mean()
        early = self.slurry_rms[(self.time > 0.25 * end + 1e-9) & (self.time < 0.5 * end + 1e-9)].mean()
        return late / max(early, STILL)


def measure(case):
    """History of a run out of its fields; a time that holds values that are not finite ends it."""
    mesh = foam.read_mesh(case)
    _, volume = mesh.centres_and_volumes()
    solver_log = next(path for path in case.glob("log.*") if path.name.endswith("Foam"))
    stepped = np.array(re.findall(r"^Time = (\S+)", solver_log.read_text(), flags=re.M), dtype=float)
    rows = []
    for time, folder in foam.times(case):
        try:
            alpha = foam.read_field(folder / "alpha.slurry", mesh.cells)
            speed = np.linalg.norm(foam.read_field(folder / "U", mesh.cells), axis=1)
        except foam.FoamError:
            break
        slurry = alpha * volume
        rows.append((time, speed[alpha < 0.5].max(), speed[alpha >= 0.5].max(),
                     math.sqrt((slurry * speed**2).sum() / slurry.sum()), slurry.sum(),
                     max(0.0, -alpha.min(), alpha.max() - 1), np.count_nonzero(stepped < time + 1e-9)))
    return History(*np.array(rows).T)


def write_history(history, case):
    with open(case / "history.csv", "w", newline="") as out:
        writer = csv.writer(out)
        writer.writerow(field.name for field in fields(History))
        writer.writerows(zip(*(map(repr, map(float, column)) for column in astuple(history))))


def read_history(case):
    with open(case / "history.csv", newline="") as lines:
        rows = list(csv.reader(lines))
    return History(*np.array(rows[1:], dtype=float).T)
