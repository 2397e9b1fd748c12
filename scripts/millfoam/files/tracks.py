# SPDX-License-Identifier: GPL-3.0-or-later
"""Tracks of single balls: of tracers from text files, and of balls from the dumps of a dry run (layout:
dem_driver/README.md)."""
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .dumps import numbered_dumps, read_timestep

POSITION = ("x", "y", "z")


@dataclass
class Trajectory:
    """Track of one tracer: time [n] (s), increasing; position [n, 3] (m). ValueError if these are not a track."""
    time: np.ndarray
    position: np.ndarray

    def __post_init__(self) -> None:
        self.time, self.position = np.asarray(self.time, dtype=float), np.asarray(self.position, dtype=float)
        if self.position.shape != (len(self.time), 3) or len(self.time) < 2:
            raise ValueError(f"{len(self.time)} times and positions {self.position.shape}; expected [n] and [n, 3], n "
                             "> 1")
        if not (np.isfinite(self.time).all() and np.isfinite(self.position).all()):
            raise ValueError("a track with values that are not finite")
        if not (np.diff(self.time) > 0).all():
            raise ValueError(f"time does not increase after {self.time[np.argmax(np.diff(self.time) <= 0)]} s")


def read_trajectory(path: Path | str, time_unit: float = 1.0, length_unit: float = 1.0) -> Trajectory:
    """Trajectory from a text file of lines t, x, y, z, separated by commas or blanks. Empty lines, lines that begin
    with #, and one line of names at the top are skipped. Units: in s and m. RuntimeError names file, line and value of
    a wrong number of columns, a word that is not a finite number, or a time that does not increase; also for fewer than
    two points."""
    rows: list[list[float]] = []
    with open(path) as file:
        for number, line in enumerate(file, 1):
            words = line.replace(",", " ").split()
            if not words or words[0].startswith("#") or (not rows and number == 1 and not _is_number(words[0])):
                continue
            row = _numbers(f"{path}:{number}", words)
            if rows and row[0] <= rows[-1][0]:
                raise RuntimeError(f"{path}:{number}: time {row[0]:g} after {rows[-1][0]:g}, expected times that "
                                   "increase")
            rows.append(row)
    if len(rows) < 2:
        raise RuntimeError(f"{path}: {len(rows)} points, expected 2 or more")
    table = np.array(rows)
    return Trajectory(table[:, 0] * time_unit, table[:, 1:] * length_unit)


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


def _numbers(where: str, words: list[str]) -> list[float]:
    if len(words) != 4:
        raise RuntimeError(f"{where}: {len(words)} columns, expected 4: t, x, y, z")
    for word in words:
        if not _is_number(word) or not np.isfinite(float(word)):
            raise RuntimeError(f"{where}: '{word}', expected a finite number")
    return [float(word) for word in words]


def read_tracks(dumps: Path | str, ids: Iterable[int], begin: float = 0.0,
                end: float = np.inf) -> dict[int, Trajectory]:
    """Tracks of the balls with these ids in the dumps from `begin` to `end` (DEM time, s): {id: Trajectory}.

    dumps: the folder DIR/dumps of a complete run. Every dump is read once, and only the lines of these balls are
    parsed, so that a few hundred tracks take only a little more time than the reading. Along a periodic axis the tracks
    continue beyond the box. RuntimeError names a ball that a dump lacks."""
    wanted = np.unique(np.asarray(ids, dtype=int))
    timestep = read_timestep(dumps)
    # Times that should agree may differ by rounding
    chosen = [(step, path) for step, path in numbered_dumps(dumps)
              if begin - timestep / 2 <= step * timestep <= end + timestep / 2]
    if not chosen:
        raise RuntimeError(f"{dumps}: no dump from {begin} to {end} s")
    time = np.array([step * timestep for step, _ in chosen])
    positions = np.empty((len(chosen), len(wanted), 3))
    for record, (_, path) in enumerate(chosen):
        positions[record], periods = balls_of_dump(path, wanted)
        if record > 0:
            round_axis = np.isfinite(periods)
            moved = positions[record][:, round_axis] - positions[record - 1][:, round_axis]
            positions[record][:, round_axis] -= np.round(moved / periods[round_axis]) * periods[round_axis]
    return {int(ball): Trajectory(time, positions[:, column]) for column, ball in enumerate(wanted)}


def balls_of_dump(path: Path | str, wanted: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Positions [len(wanted), 3] (m) of the balls `wanted` (ids, ascending) in one dump, and the box's periods [3],
    inf where it has walls."""
    data = Path(path).read_bytes()
    names, periods, start = _header(path, data)
    text = np.frombuffer(data, dtype=np.uint8)
    ends = start + np.flatnonzero(text[start:] == ord("\n"))
    starts = np.concatenate([[start], ends[:-1] + 1])
    ids = _leading_numbers(text, starts)
    lines = np.flatnonzero(np.isin(ids, wanted))
    lines = lines[np.argsort(ids[lines])]
    if not np.array_equal(ids[lines], wanted):
        missing = np.setdiff1d(wanted, ids[lines])
        raise RuntimeError(f"{path}: " + (f"no ball {missing[0]}" if len(missing) else "a ball appears twice"))
    table = np.array(b" ".join(data[starts[line]:ends[line]] for line in lines).split(),
                     dtype=float).reshape(len(lines), -1)
    return table[:, [names.index(name) for name in POSITION]], periods


def _header(path: Path | str, data: bytes) -> tuple[list[str], np.ndarray, int]:
    """Names of the columns, periods of the box (m), and the position of the first ball's line."""
    mark = data.find(b"ITEM: ATOMS")
    start = data.find(b"\n", mark) + 1
    lines = data[:max(start, 0)].decode().splitlines()
    names = lines[-1].split()[2:] if mark >= 0 and start > 0 else []
    if names[:1] != ["id"] or not set(POSITION) <= set(names):
        raise RuntimeError(f"{path}: columns {' '.join(names) or 'missing'}, expected id first, and "
                           f"{' '.join(POSITION)}")
    box = next(number for number, line in enumerate(lines) if line.startswith("ITEM: BOX BOUNDS"))
    bounds = np.array([line.split() for line in lines[box + 1:box + 4]], dtype=float)
    periodic = np.array([kind == "pp" for kind in lines[box].split()[3:6]])
    return names, np.where(periodic, bounds[:, 1] - bounds[:, 0], np.inf), start


def _leading_numbers(text: np.ndarray, starts: np.ndarray) -> np.ndarray:
    """The whole numbers that begin at `starts` of a text [bytes]; each ends before the first non-digit."""
    numbers = np.zeros(len(starts), dtype=np.int64)
    digits = np.ones(len(starts), dtype=bool)
    position = starts.copy()
    while digits.any():
        character = text[np.minimum(position, len(text) - 1)]
        digits &= (character >= ord("0")) & (character <= ord("9"))
        numbers = np.where(digits, 10 * numbers + character - ord("0"), numbers)
        position += 1
    return numbers
