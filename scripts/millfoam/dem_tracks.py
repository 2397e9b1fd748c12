# SPDX-License-Identifier: GPL-3.0-or-later
"""Tracks of single balls out of the dumps of a dry run (layout: dem_driver/README.md)."""
from pathlib import Path

import numpy as np

from .data_files import number, read_json
from .tracer import Trajectory

POSITION = ("x", "y", "z")


def read_notes(dumps):
    """DIR/dumps/run.json: timestep_s, interval (steps between dumps), angular_velocity_rad_s, …; RuntimeError naming
    what is wrong with it."""
    return read_json(Path(dumps) / "run.json", "dumps")


def read_timestep(dumps):
    """The dry run's time-step by DIR/dumps/run.json, s."""
    return number(read_notes(dumps), Path(dumps) / "run.json", "timestep_s")


def numbered_dumps(folder, kind="dump"):
    """[(step, path)] of a folder's `<kind>.<step>.txt`, by step; RuntimeError where there are none."""
    found = sorted((int(path.name.split(".")[1]), path) for path in Path(folder).glob(f"{kind}.*.txt"))
    if not found:
        raise RuntimeError(f"{folder}: no {kind}.<step>.txt")
    return found


def read_tracks(dumps, ids, begin=0.0, end=np.inf):
    """Tracks of the balls with these ids in the dumps from `begin` to `end` (DEM time, s): {id: Trajectory}.

    dumps: the folder DIR/dumps of a run that is whole. Every dump is read once; only the lines of the balls asked for
    are taken apart, so that a few hundred tracks cost little more than the reading. Along a periodic axis the tracks
    go on beyond the box. RuntimeError for a dump that lacks one of the balls, naming it."""
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


def balls_of_dump(path, wanted):
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
        raise RuntimeError(f"{path}: " + (f"no ball {missing[0]}" if len(missing) else "a ball that is there twice"))
    table = np.array(b" ".join(data[starts[line]:ends[line]] for line in lines).split(),
                     dtype=float).reshape(len(lines), -1)
    return table[:, [names.index(name) for name in POSITION]], periods


def _header(path, data):
    """Names of the columns, periods of the box (m) and where the first ball's line begins."""
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


def _leading_numbers(text, starts):
    """The whole numbers that begin at `starts` of a text [bytes], each up to the first character that is no digit."""
    numbers = np.zeros(len(starts), dtype=np.int64)
    digits = np.ones(len(starts), dtype=bool)
    position = starts.copy()
    while digits.any():
        character = text[np.minimum(position, len(text) - 1)]
        digits &= (character >= ord("0")) & (character <= ord("9"))
        numbers = np.where(digits, 10 * numbers + character - ord("0"), numbers)
        position += 1
    return numbers
